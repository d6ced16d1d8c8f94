// What the modules in program memory declare: loading and unloading leaves nothing.

#include "runtime/program/program_tables.h"

#include <catch2/catch.hpp>

TEST_CASE("a module that is loaded and unloaded again and again leaves nothing in the tables", "[runtime]") {
    const rt::TypeDesc type{"num", "num", rt::DescKind::Num, 4, 0, {0, 0, 0}, nullptr, nullptr, nullptr};
    const rt::TypeDesc* const types[] = {&type};
    float value = 0;
    rt::GlobalDesc data[2]{};
    data[0].name = "own";
    data[1].name = "reg1";
    data[1].flags = rt::kDataPredefined;
    for (rt::GlobalDesc& global : data) {
        global.module = "Part";
        global.type = &type;
        global.address = &value;
    }
    rt::ProgramDesc unit{};
    unit.globals = data;
    unit.globalCount = 2;
    unit.types = types;
    unit.typeCount = 1;
    rt::ProgramTables tables;
    const auto load = [&] {
        rt::LoadedModule module;
        module.name = "Part";
        module.task = 0;
        tables.addUnit(unit, module);
    };
    for (int i = 0; i < 3; ++i) {
        load();
        CHECK(tables.globals().size() == 2);
        CHECK(tables.types().size() == 1);
        CHECK(tables.remove(0, "part"));
        CHECK(tables.globals().size() == 1); // data of the language: others may refer to them
        CHECK(tables.types().empty());
    }
    load();
    CHECK(tables.findGlobal("reg1", "", 0, true) == &data[1]);
}

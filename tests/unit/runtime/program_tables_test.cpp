// The declarations of the modules in program memory: loading and unloading leaves nothing.

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

TEST_CASE("what names in calls have led to is forgotten when modules come and go", "[runtime]") {
    rt::RoutineEntry routine{};
    routine.name = "work";
    routine.module = "Part";
    rt::ProgramDesc unit{};
    unit.routines = &routine;
    unit.routineCount = 1;
    rt::ProgramTables tables;
    rt::LoadedModule module;
    module.name = "Part";
    module.task = 0;
    rt::String name;
    name.assign("work");
    const char* const from = "Main";
    tables.addUnit(unit, module);
    CHECK(tables.calls().find(name, from, 0) == nullptr);
    tables.calls().keep(name, from, 0, routine);
    CHECK(tables.calls().find(name, from, 0) == &routine);
    CHECK(tables.calls().find(name, from, 1) == nullptr);
    CHECK(tables.calls().find(name, routine.module, 0) == nullptr);
    CHECK(tables.remove(0, "Part"));
    CHECK(tables.calls().find(name, from, 0) == nullptr);
    tables.calls().keep(name, from, 0, routine);
    tables.addUnit(unit, module);
    CHECK(tables.calls().find(name, from, 0) == nullptr);
}

TEST_CASE("names in calls count up to their length, whatever lies after it", "[runtime]") {
    const rt::RoutineEntry routine{};
    const char* const from = "Main";
    for (const std::size_t length : {1U, 7U, 8U, 9U, 16U, 79U, 80U}) {
        rt::CallCache calls;
        rt::String name, same, other, shorter;
        std::memset(same.bytes, '?', sizeof same.bytes);
        name.assign(std::string(length, 'n'));
        same.assign(std::string(length, 'n'));
        other.assign(std::string(length - 1, 'n') + 'm');
        shorter.assign(std::string(length - 1, 'n'));
        calls.keep(name, from, 0, routine);
        CHECK(calls.find(same, from, 0) == &routine);
        CHECK(calls.find(other, from, 0) == nullptr);
        CHECK(calls.find(shorter, from, 0) == nullptr);
    }
}

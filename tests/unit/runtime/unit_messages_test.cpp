// The messages of executables and rapidc when a module is loaded.

#include <catch2/catch.hpp>

#include "runtime/host/unit_messages.h"

using namespace rt;

namespace {

std::string request(const ProgramTables& tables, const std::deque<LoadedFile>& files) {
    LoadRequest load;
    load.task = "T_ROB1";
    load.taskIndex = 2;
    load.path = "/home/x/part.modx";
    load.shown = "HOME:/part.modx";
    load.bytes = "MODULE Part\r\n! \xe4\nENDMODULE"; // ISO 8859-1
    return writeUnitRequest("sources \xff", false, load, {tables, files}, {{"doOne", "signaldo"}});
}

std::string answer() {
    UnitAnswer made;
    made.unit.verdict = LoadResult::Verdict::Made;
    made.unit.module = "Part";
    made.unit.image.size = 8192;
    made.unit.image.program = 16;
    made.unit.image.segments.push_back({4096, 100, std::string("\0\x90", 2), true, false});
    made.unit.image.patches.push_back({8, -4, 0});
    made.unit.image.patches.push_back({16, 4096, -1});
    made.unit.image.imports = {"rt_raise"};
    made.unit.data.push_back({"import/M/x", "x", "M"});
    made.open.names = {"'y' (part.modx:3)"};
    return writeUnitAnswer(made);
}

} // namespace

TEST_CASE("a request to compile a module comes across", "[units]") {
    int32_t gone = 0;
    const GlobalDesc data[] = {{"x", "Main", nullptr, nullptr, 1, kDataLocal, -1, nullptr, 7}};
    const ModuleDesc modules[] = {{"Main", "main.modx", 2, &gone}};
    ProgramDesc program{}, unit{};
    program.globals = data;
    program.globalCount = 1;
    program.modules = modules;
    program.moduleCount = 1;
    ProgramTables tables;
    tables.setProgram(program);
    LoadedModule other;
    other.name = "Other";
    other.task = 2;
    other.file = "/home/x/other.modx";
    tables.addUnit(unit, other);

    const auto read =
        readUnitRequest(request(tables, {{2, "/home/x/other.modx", "HOME:/other.modx", "\xff"}}));
    REQUIRE(read);
    CHECK(read->sources == "sources \xff");
    CHECK_FALSE(read->references);
    CHECK(read->signals == SignalNames{{"doOne", "signaldo"}});
    CHECK(read->load.task == "T_ROB1");
    CHECK(read->load.taskIndex == 2);
    CHECK(read->load.shown == "HOME:/part.modx");
    CHECK(read->load.bytes == "MODULE Part\r\n! \xe4\nENDMODULE");
    REQUIRE(read->files.size() == 1);
    CHECK(read->files[0].bytes == "\xff");
    REQUIRE(read->tables.findModule(2, "main"));
    CHECK(read->tables.findModule(2, "main")->unit == nullptr);
    REQUIRE(read->tables.findFile(2, "/home/x/other.modx"));
    CHECK(read->tables.findFile(2, "/home/x/other.modx")->unit != nullptr);
    REQUIRE(findUnitData(read->tables, "X", "", 2) == nullptr); // LOCAL
    REQUIRE(findUnitData(read->tables, "X", "main", 2));
    CHECK(findUnitData(read->tables, "X", "main", 2)->kind == 1);
}

TEST_CASE("an answer with a compiled module comes across", "[units]") {
    const auto read = readUnitAnswer(answer());
    REQUIRE(read);
    CHECK(read->unit.verdict == LoadResult::Verdict::Made);
    CHECK(read->unit.module == "Part");
    const UnitImage& image = read->unit.image;
    CHECK(image.size == 8192);
    CHECK(image.program == 16);
    REQUIRE(image.segments.size() == 1);
    CHECK(image.segments[0].bytes == std::string("\0\x90", 2));
    CHECK(image.segments[0].writable);
    CHECK_FALSE(image.segments[0].executable);
    REQUIRE(image.patches.size() == 2);
    CHECK(image.patches[0].addend == -4);
    CHECK(image.patches[1].import == -1);
    CHECK(image.imports == std::vector<std::string>{"rt_raise"});
    REQUIRE(read->unit.data.size() == 1);
    CHECK(read->unit.data[0].module == "M");
    CHECK(read->open.names == std::vector<std::string>{"'y' (part.modx:3)"});
}

TEST_CASE("other bytes are neither a request nor an answer", "[units]") {
    const std::string whole[] = {request({}, {}), answer()};
    for (const std::string& bytes : whole) {
        for (size_t length = 0; length < bytes.size(); ++length) {
            CHECK_FALSE(readUnitRequest(std::string_view(bytes).substr(0, length)));
            CHECK_FALSE(readUnitAnswer(std::string_view(bytes).substr(0, length)));
        }
        for (size_t at = 0; at < bytes.size(); ++at) { // damaged ones must not do any harm
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
            (void)readUnitRequest(damaged);
            (void)readUnitAnswer(damaged);
        }
    }
    CHECK_FALSE(readUnitRequest(whole[1]));
    CHECK_FALSE(readUnitAnswer(whole[0]));
    CHECK_FALSE(readUnitAnswer(std::string(1000000, '\x81'))); // arrays in arrays
}

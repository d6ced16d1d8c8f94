// Values of persistents go into their declarations; whatever else the file holds stays.

#include "frontend/edit/save_values.h"
#include "frontend/syntax/parser.h"
#include "unit/syntax/syntax_test.h"

#include <catch2/catch.hpp>

using namespace rapid;

namespace {

edit::SavedModule save(const std::string& bytes, const std::vector<edit::DataValue>& values,
                       const std::string& path = "m.mod") {
    const test::Parsed parsed = test::parseText(bytes, false, path);
    return edit::saveValues(*parsed.tree, values);
}

std::string module(const std::string& declaration) {
    return "MODULE m\n" + declaration + "\nENDMODULE\n";
}

} // namespace

TEST_CASE("only literals that differ are replaced", "[edit][save]") {
    const auto saved = save(module("PERS pose p:=[ [1.0, 2,!c\n03],[1,0,0,-0.50]];PERS string s := \"a\" ;"),
                            {{"M", "P", "[[1,2.5,3],[1,0,0,-0.5]]"}, {"m", "s", "\"b \"\" \\\\ \\07\""}});
    REQUIRE(saved.ok());
    CHECK(saved.notes.empty());
    CHECK(saved.bytes ==
          module("PERS pose p:=[ [1.0, 2.5,!c\n03],[1,0,0,-0.50]];PERS string s := \"b \"\" \\\\ \\07\" ;"));
}

TEST_CASE("signs and kinds of literals", "[edit][save]") {
    CHECK(save(module("PERS num n := -5;"), {{"m", "n", "5"}}).bytes == module("PERS num n := 5;"));
    CHECK(save(module("PERS num n := 5;"), {{"m", "n", "-5"}}).bytes == module("PERS num n := -5;"));
    CHECK(save(module("PERS num n := 0;"), {{"m", "n", "-0"}}).bytes == module("PERS num n := -0;"));
    CHECK(save(module("PERS num n := 0x10;"), {{"m", "n", "16"}}).bytes == module("PERS num n := 0x10;"));
    CHECK(save(module("PERS bool b := true;"), {{"m", "b", "TRUE"}}).bytes == module("PERS bool b := true;"));
    CHECK(save(module("PERS bool b := true;"), {{"m", "b", "FALSE"}}).bytes ==
          module("PERS bool b := FALSE;"));
}

TEST_CASE("a file that has been changed meanwhile keeps what does not fit", "[edit][save]") {
    const auto stays = [](const std::string& declaration, const std::string& value) {
        const auto saved = save(module(declaration), {{"m", "x", value}, {"m", "y", "2"}});
        INFO(declaration << " " << value);
        CHECK(saved.ok());
        CHECK(saved.notes.size() == 1);
        return saved.bytes == module(declaration);
    };
    const std::string y = "PERS num y:=2;";
    CHECK(stays("PERS string x:=\"\";" + y, "1"));
    CHECK(stays("PERS num x{2}:=[1,2];" + y, "[1,2,3]"));
    CHECK(stays("PERS num x{2}:=[1,2];" + y, "1"));
    CHECK(stays("VAR num x:=1;" + y, "2"));
    CHECK(stays("PERS num z:=1;" + y, "2"));
    CHECK(stays("PERS num x:=1;" + y, "2 + 3 *"));
    // The others are written.
    CHECK(save(module("PERS num y:=1;"), {{"m", "x", "1"}, {"m", "y", "2"}}).bytes ==
          module("PERS num y:=2;"));
}

TEST_CASE("a persistent without initial value stays without", "[edit][save]") {
    const auto saved = save(module("PERS num x;"), {{"m", "x", "7"}});
    CHECK(saved.bytes == module("PERS num x;"));
    CHECK(saved.notes.empty());
}

TEST_CASE("two modules of one file", "[edit][save]") {
    const std::string file =
        "MODULE a\nPERS num x:=1;\nENDMODULE\nMODULE b\nLOCAL PERS num x:=1;\nENDMODULE\n";
    CHECK(save(file, {{"B", "x", "2"}}).bytes ==
          "MODULE a\nPERS num x:=1;\nENDMODULE\nMODULE b\nLOCAL PERS num x:=2;\nENDMODULE\n");
}

TEST_CASE("strings in the encoding of the file, as codes where it has no such character", "[edit][save]") {
    const std::string latin1 = module("! \xFC\nPERS string s:=\"\";");
    CHECK(save(latin1, {{"m", "s", "\"\xC3\xB6\""}}).bytes == module("! \xFC\nPERS string s:=\"\xF6\";"));
    CHECK(save(latin1, {{"m", "s", "\"\xE4\xB8\xAD\""}}).bytes ==
          module("! \xFC\nPERS string s:=\"\\E4\\B8\\AD\";"));
    const std::string utf8 = "\xEF\xBB\xBF" + module("! \xC3\xBC\nPERS string s:=\"\";");
    CHECK(save(utf8, {{"m", "s", "\"\xE4\xB8\xAD\""}}, "m.modx").bytes ==
          "\xEF\xBB\xBF" + module("! \xC3\xBC\nPERS string s:=\"\xE4\xB8\xAD\";"));
}

// One initial value changes; every other byte of the file stays.

#include "frontend/edit/apply_edits.h"
#include "frontend/edit/initial_value.h"
#include "unit/syntax/syntax_test.h"

#include <catch2/catch.hpp>

using namespace rapid;

namespace {

std::string set(const std::string& bytes, const std::string& data, const std::string& value,
                const std::string& path = "m.mod") {
    const test::Parsed parsed = test::parseText(bytes, false, path);
    const auto edits = edit::setInitialValue(*parsed.tree, data, value);
    if (!edits.ok()) return "refused: " + edits.problem;
    if (edits.files.empty()) return bytes;
    REQUIRE(edits.files.size() == 1);
    const auto result = edit::applyEdits(*edits.files[0].file, edits.files[0].edits);
    return result.ok() ? result.bytes : "refused: " + result.problem;
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    return text.replace(at, part.size(), by);
}

} // namespace

TEST_CASE("an initial value is replaced in every encoding and with every line end", "[edit]") {
    const std::string umlauts[] = {"\xF6\xDF", "\xC3\xB6\xC3\x9F", "ab"};
    const std::string marks[] = {"", "", "\xEF\xBB\xBF"};
    for (const std::string& lineEnd : {std::string("\n"), std::string("\r\n"), std::string("\r")})
        for (size_t i = 0; i < std::size(umlauts); ++i) {
            const std::string bytes = marks[i] + "MODULE m " + lineEnd + "\t! gr" + umlauts[i] + "e  " +
                                      lineEnd + "  pers  robtarget p1 := [[1,2,3], ! x" + lineEnd +
                                      " [1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]  ; CONST num n:=1;" +
                                      lineEnd + "VAR num a{2} ;ENDMODULE";
            INFO(i << " " << lineEnd.size());
            CHECK(set(bytes, "N", "-2.5") == replaced(bytes, "n:=1", "n:=-2.5"));
            CHECK(set(bytes, "m.A", "[1,2]") == replaced(bytes, "a{2} ;", "a{2}:=[1,2] ;"));
            const size_t begin = bytes.find("[[1"), end = bytes.find("]]") + 2;
            const std::string value = "[[4,5,6],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
            CHECK(set(bytes, "M.p1", " " + value) == bytes.substr(0, begin) + value + bytes.substr(end));
        }
}

TEST_CASE("values are written in the encoding of the file", "[edit]") {
    const std::string bytes = "MODULE m\nPERS string s:=\"\xF6\";\nENDMODULE\n";
    CHECK(set(bytes, "s", "\"\xC3\xBC\"") == replaced(bytes, "\xF6", "\xFC"));
    CHECK_THAT(set(bytes, "s", "\"\xE4\xB8\xAD\""),
               Catch::Contains("refused") && Catch::Contains("ISO 8859-1"));
}

TEST_CASE("an equal value changes nothing", "[edit]") {
    const test::Parsed parsed = test::parseText("MODULE m\nVAR num a:=1;\nENDMODULE\n");
    const auto edits = edit::setInitialValue(*parsed.tree, "a", "1");
    CHECK(edits.ok());
    CHECK(edits.files.empty());
}

TEST_CASE("values and names that cannot be used are refused", "[edit]") {
    const std::string text = "MODULE m\nVAR num a:=1;\nPROC p()\nVAR num local:=1;\nENDPROC\nENDMODULE\n"
                             "MODULE k\nVAR num a:=1;\nENDMODULE\n";
    using Catch::Contains;
    CHECK_THAT(set(text, "b", "1"), Contains("declares no data 'b'"));
    CHECK_THAT(set(text, "local", "1"), Contains("declares no data"));
    CHECK_THAT(set(text, "a", "1"), Contains("m.a"));
    CHECK(set(text, "k.a", "7") == replaced(text, "k\nVAR num a:=1", "k\nVAR num a:=7"));
    CHECK_THAT(set(text, "m.a", ""), Contains("empty"));
    CHECK_THAT(set(text, "m.a", "1;"), Contains("is not a value"));
    CHECK_THAT(set(text, "m.a", "1\n"), Contains("several lines"));
    CHECK_THAT(set(text, "m.a", "1 ! x"), Contains("comment"));
    CHECK_THAT(set(text, "m.a", "[1,"), Contains("is not a value"));
    CHECK_THAT(set(text, "m.a", "! x"), Contains("refused"));
}

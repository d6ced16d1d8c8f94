// Inputs at and beyond the limits: deep, long, many.

#include "frontend/diag/messages/syntax.h"
#include "syntax_test.h"

#include <catch2/catch.hpp>

using namespace rapid;
using test::inProcedure;
using test::parseText;

namespace {

std::string repeat(const std::string& text, size_t count) {
    std::string out;
    out.reserve(text.size() * count);
    for (size_t i = 0; i < count; ++i)
        out += text;
    return out;
}

void checkOneTooDeep(const std::string& body) {
    const test::Parsed parsed = parseText(inProcedure(body));
    REQUIRE(parsed.sink.all().size() == 1);
    CHECK(parsed.sink.all()[0].code == diag::say::NestingTooDeep.code);
    CHECK(syntax::printSource(*parsed.tree) == inProcedure(body));
    CHECK_FALSE(syntax::printTree(*parsed.tree).empty());
}

} // namespace

TEST_CASE("nesting that people write is read", "[syntax][limits]") {
    CHECK(parseText(inProcedure("x := " + repeat("(", 500) + "1" + repeat(")", 500) + ";")).codes().empty());
    CHECK(parseText(inProcedure("x := 1" + repeat(" + 1", 500) + ";")).codes().empty());
    CHECK(parseText(inProcedure(repeat("IF a THEN\n", 300) + repeat("ENDIF\n", 300))).codes().empty());
    CHECK(parseText(inProcedure("IF a THEN\n" + repeat("ELSEIF b THEN\n x := 1;\n", 20000) + "ENDIF\n"))
              .codes()
              .empty());
    CHECK(parseText(inProcedure("x := [1" + repeat(", -1", 100000) + "];")).codes().empty());
}

TEST_CASE("bottomless nesting costs one diagnostic and no stack", "[syntax][limits]") {
    constexpr size_t kMany = 200000;
    checkOneTooDeep("x := " + repeat("(", kMany) + "1" + repeat(")", kMany) + ";");
    checkOneTooDeep("x := " + repeat("[", kMany) + "1" + repeat("]", kMany) + ";");
    checkOneTooDeep("x := " + repeat("f(", kMany) + "1" + repeat(")", kMany) + ";");
    checkOneTooDeep("x := " + repeat("a{", kMany) + "1" + repeat("}", kMany) + ";");
    checkOneTooDeep("x := " + repeat("NOT ", kMany) + "a;");
    checkOneTooDeep("x := 1" + repeat(" + 1", kMany) + ";");
    checkOneTooDeep("x := a" + repeat(".b", kMany) + ";");
    checkOneTooDeep("x := " + repeat("(", 900) + "1" + repeat(" + 1)", 900) + repeat(" + 1", kMany) + ";");
    checkOneTooDeep(repeat("IF a THEN\n", kMany) + repeat("ENDIF\n", kMany));
    checkOneTooDeep(repeat("IF a ", kMany) + "Stop;");
    checkOneTooDeep(repeat("FOR i FROM 1 TO 2 DO\n", kMany) + repeat("ENDFOR\n", kMany));
    checkOneTooDeep(repeat("WHILE a DO ", kMany) + repeat("ENDWHILE ", kMany));
    checkOneTooDeep(repeat("TEST a CASE 1: ", kMany) + repeat("ENDTEST ", kMany));
}

TEST_CASE("after a routine that is too deep the next one is read", "[syntax][limits]") {
    const test::Parsed parsed = parseText("MODULE m\nPROC a()\n" + repeat("IF a THEN\n", 5000) +
                                          "ENDPROC\nPROC b()\nx = 1;\n" + "ENDPROC\nENDMODULE\n");
    CHECK(parsed.codes() == "RAP1109@1003:1 RAP1205@5005:3");
}

TEST_CASE("signs without end are one kind of mistake and bounded", "[syntax][limits]") {
    const test::Parsed parsed = parseText(inProcedure("x := " + repeat("-", 100000) + "1;"));
    CHECK(parsed.sink.errorCount() <= 200);
}

TEST_CASE("a million mistakes and lines of megabytes are handled", "[syntax][limits][slow]") {
    const test::Parsed many = parseText(inProcedure(repeat("x := ) 1;\n", 1000000)));
    CHECK(many.sink.errorCount() == 200);
    CHECK(many.sink.all().size() == 201);

    const test::Parsed junk = parseText(inProcedure(repeat("@\n", 1000000)));
    CHECK(junk.sink.errorCount() > 0);
    CHECK(junk.sink.errorCount() <= 200);

    const std::string longLine = inProcedure(repeat("x := 1; ", 1250000) + "y = 1;");
    const test::Parsed line = parseText(longLine);
    CHECK(line.codes() == "RAP1205@3:10000003");
    const std::string shown = line.shown();
    CHECK(shown.size() < 500);
    CHECK(shown.find("y = 1;") != std::string::npos);

    const test::Parsed oneJunk = parseText(inProcedure(repeat("@ x ", 1000000)));
    CHECK(oneJunk.sink.errorCount() <= 2);
    for (const char* piece :
         {"\u00A0 x ", "@\u00A0", "'", "' \u201C", "@ ' x ", "@ # x ", "& ", "@ \u2013 ", "\u00A0 @ # "}) {
        INFO(piece);
        const test::Parsed foreign = parseText(inProcedure(repeat(piece, 300000)));
        CHECK(foreign.sink.errorCount() > 0);
        CHECK(foreign.sink.errorCount() <= 200);
    }
}

TEST_CASE("the way back from an unfinished line is not taken twice", "[syntax][limits]") {
    for (const char* body : {"{\na l = z := 1;", "{\n  a l=z:=", "IF x {\na l = z := 1;\n}",
                             "a{\nb l = z := 1;\nc l = z := 1;"}) {
        INFO(body);
        const test::Parsed parsed = parseText(inProcedure(body));
        CHECK(parsed.sink.hasErrors());
        CHECK(parsed.sink.errorCount() <= 6);
    }
}

TEST_CASE("unfinished texts end with the file", "[syntax][limits]") {
    const std::string text = inProcedure(
        "IF a AND NOT b THEN\n  MoveL [[1,2],[3]], v100\\V:=5, fine, t{1}.x;\nELSE\n"
        "  FOR i FROM 1 TO 2 DO %\"p\"% a \\b?c; ENDFOR\nENDIF\nTEST x CASE 1: x := f(a\\b); ENDTEST");
    REQUIRE(parseText(text).codes().empty());
    for (size_t length = 0; length + 1 < text.size(); ++length) { // the last line end is free
        const std::string part = text.substr(0, length);
        const test::Parsed parsed = parseText(part);
        INFO(part);
        CHECK(syntax::printSource(*parsed.tree) == part);
        CHECK(parsed.sink.hasErrors());
        CHECK(parsed.sink.errorCount() <= 8); // each open block and the text before it
    }
}

// Recovery strategies (frontend/syntax/recovery): each explains its mistake by one diagnostic, and the edit that it
// proposes gives a text without mistakes.

#include "syntax_test.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace rapid;
using rapid::test::inProcedure;
using rapid::test::parseText;

namespace {

struct Mistake {
    const char* strategy;
    std::string wrong;
    std::string right;
};

/// The text after the first fix of the diagnostic.
std::string mended(const std::string& text, const diag::Diagnostic& diagnostic) {
    std::string out = text;
    if (diagnostic.fixes.empty()) return "(no fix)";
    std::vector<TextEdit> edits = diagnostic.fixes.front().edits;
    std::sort(edits.begin(), edits.end(),
              [](const TextEdit& a, const TextEdit& b) { return a.range.begin > b.range.begin; });
    for (const TextEdit& edit : edits)
        out.replace(edit.range.begin, edit.range.end - edit.range.begin, edit.replacement);
    return out;
}

void check(const std::vector<Mistake>& mistakes, std::string (*frame)(const std::string&)) {
    for (const Mistake& mistake : mistakes) {
        const std::string wrong = frame(mistake.wrong), right = frame(mistake.right);
        const test::Parsed parsed = parseText(wrong);
        INFO(mistake.strategy << "\n" << wrong << "\n" << parsed.shown());
        REQUIRE(parsed.sink.all().size() == 1);
        CHECK(mended(wrong, parsed.sink.all().front()) == right);
        CHECK(parseText(right).codes().empty());
        CHECK(syntax::printSource(*parsed.tree) == wrong);
    }
}

std::string asItIs(const std::string& text) {
    return text;
}
std::string inModule(const std::string& text) {
    return "MODULE m\n" + text + "\nENDMODULE\n";
}
std::string inHandler(const std::string& text) {
    return inProcedure("Stop;\nERROR\n" + text);
}

} // namespace

TEST_CASE("misspelt declarations are read as they were meant", "[syntax]") {
    check({{"LastEnd", "MODULE m\nEND\n", "MODULE m\nENDMODULE\n"},
           {"LastEnd", "MODULE m\nEND MODULE\n", "MODULE m\nENDMODULE\n"},
           {"MisspeltDeclaration", "MODULE m\nENDMODUEL\n", "MODULE m\nENDMODULE\n"}},
          asItIs);
    check({{"WordForGlobal", "GLOBAL PROC p()\nENDPROC", "PROC p()\nENDPROC"},
           {"MisspeltDeclaration", "PORC p()\nENDPROC", "PROC p()\nENDPROC"},
           {"MisspeltDeclaration", "LOCLA VAR num x;", "LOCAL VAR num x;"},
           {"MisspeltDeclaration", "TARP t\nENDTRAP", "TRAP t\nENDTRAP"},
           {"MisspeltDeclaration", "FUCN num f()\nRETURN 1;\nENDFUNC", "FUNC num f()\nRETURN 1;\nENDFUNC"},
           {"MisspeltDeclaration", "ALAIS num n;", "ALIAS num n;"},
           {"MisspeltData", "VRA num x;", "VAR num x;"},
           {"RunTogether", "VARnum x;", "VAR num x;"},
           {"RunTogether", "PROCpick()\nENDPROC", "PROC pick()\nENDPROC"}},
          inModule);
}

TEST_CASE("words that are too many or misspelt in a record are read as they were meant", "[syntax]") {
    check({{"MisspeltEndrecord", "RECORD r\nnum x;\nENDRECRD", "RECORD r\nnum x;\nENDRECORD"},
           {"MisspeltEndrecord", "RECORD r\nnum x;\nEND RECORD", "RECORD r\nnum x;\nENDRECORD"},
           {"WordBeforeComponent", "RECORD r\nVAR num x;\nENDRECORD", "RECORD r\nnum x;\nENDRECORD"}},
          inModule);
}

TEST_CASE("misspelt words of instructions are read as they were meant", "[syntax]") {
    check({{"MisspeltData", "VRA num x;\nx := 1;", "VAR num x;\nx := 1;"},
           {"MisspeltInstruction", "FRO i FROM 1 TO 2 DO\nENDFOR", "FOR i FROM 1 TO 2 DO\nENDFOR"},
           {"MisspeltInstruction", "CONECT i WITH t;", "CONNECT i WITH t;"},
           {"WordForCall", "CALL pick 1;", "pick 1;"},
           {"MisspeltHead", "FI a THEN\nENDIF", "IF a THEN\nENDIF"},
           {"MisspeltHead", "WIHLE a DO\nENDWHILE", "WHILE a DO\nENDWHILE"},
           {"MisspeltExpected", "FOR i FORM 1 TO 2 DO\nENDFOR", "FOR i FROM 1 TO 2 DO\nENDFOR"},
           {"MisspeltExpected", "WHILE a THEN\nENDWHILE", "WHILE a DO\nENDWHILE"},
           {"MisspeltNot", "b := NTO a;", "b := NOT a;"},
           {"MisspeltOperator", "b := a ADN c;", "b := a AND c;"},
           {"PercentForMod", "n := 5 % 3;", "n := 5 MOD 3;"}},
          inProcedure);
    check({{"TornTrynext", "TRY NEXT;", "TRYNEXT;"}}, inHandler);
}

TEST_CASE("heads and branches of blocks are read as they were meant", "[syntax]") {
    check({{"HeadOfOtherBlock", "IF a DO\nStop;\nENDWHILE", "WHILE a DO\nStop;\nENDWHILE"},
           {"HeadOfOtherBlock", "WHILE a THEN\nStop;\nENDIF", "IF a THEN\nStop;\nENDIF"},
           {"HeadOfOtherBlock", "IF n\nCASE 1:\nStop;\nENDTEST", "TEST n\nCASE 1:\nStop;\nENDTEST"},
           {"ForWithCondition", "FOR n < 3 DO\nStop;\nENDWHILE", "WHILE n < 3 DO\nStop;\nENDWHILE"},
           {"DeclaredCounter", "FOR VAR num i FROM 1 TO 2 DO\nENDFOR", "FOR i FROM 1 TO 2 DO\nENDFOR"},
           {"DeclaredCounter", "FOR num i FROM 1 TO 2 DO\nENDFOR", "FOR i FROM 1 TO 2 DO\nENDFOR"},
           {"InForFrom", "FOR i IN 1 TO 2 DO\nENDFOR", "FOR i FROM 1 TO 2 DO\nENDFOR"},
           {"AssignForFrom", "FOR i := 1 TO 2 DO\nENDFOR", "FOR i FROM 1 TO 2 DO\nENDFOR"},
           {"ElseForElseif", "IF a THEN\nStop;\nELSE b THEN\nExit;\nENDIF",
            "IF a THEN\nStop;\nELSEIF b THEN\nExit;\nENDIF"},
           {"ThenAfterElse", "IF a THEN\nStop;\nELSE THEN\nExit;\nENDIF",
            "IF a THEN\nStop;\nELSE \nExit;\nENDIF"},
           {"CaseElse", "TEST n\nCASE 1:\nStop;\nCASE ELSE:\nENDTEST",
            "TEST n\nCASE 1:\nStop;\nDEFAULT:\nENDTEST"}},
          inProcedure);
}

TEST_CASE("words that end or continue a list are found", "[syntax]") {
    check({{"PieceOfEnd", "PROC p()\nENDPR", "PROC p()\nENDPROC"},
           {"OtherRoutineEnd", "PROC p()\nendfunction", "PROC p()\nENDPROC"},
           {"BraceForEnd", "PROC p()\nStop;\n}", "PROC p()\nStop;\nENDPROC"},
           {"LoneEnd", "PROC p()\nStop;\nEND", "PROC p()\nStop;\nENDPROC"}},
          inModule);
    check(
        {{"NextWithCounter", "FOR i FROM 1 TO 2 DO\nNEXT i", "FOR i FROM 1 TO 2 DO\nENDFOR"},
         {"EndAndWord", "IF a THEN\nStop;\nEND IF", "IF a THEN\nStop;\nENDIF"},
         {"MisspeltListWord", "IF a THEN\nStop;\nELES\nExit;\nENDIF", "IF a THEN\nStop;\nELSE\nExit;\nENDIF"},
         {"MisspeltListWord", "TEST n\nCSAE 1:\nStop;\nENDTEST", "TEST n\nCASE 1:\nStop;\nENDTEST"},
         {"PieceOfError", "Stop;\nER\nTRYNEXT;", "Stop;\nERROR\nTRYNEXT;"},
         {"CaseForTest", "CASE n\nCASE 1:\nStop;\nENDTEST", "TEST n\nCASE 1:\nStop;\nENDTEST"},
         {"ElseForDefault", "TEST n\nCASE 1:\nStop;\nELSE\nENDTEST",
          "TEST n\nCASE 1:\nStop;\nDEFAULT:\nENDTEST"}},
        inProcedure);
}

TEST_CASE("signs of other languages and slips are read as they were meant", "[syntax]") {
    check({{"SemicolonInList", "x := f(1; 2);", "x := f(1, 2);"},
           {"SemicolonInCase", "TEST n\nCASE 1;2:\nStop;\nENDTEST", "TEST n\nCASE 1,2:\nStop;\nENDTEST"},
           {"SlashForBackslash", "ConfL/Off;", "ConfL\\Off;"},
           {"CommaAfterCall", "Incr n,\nTPWrite \"a\";", "Incr n;\nTPWrite \"a\";"},
           {"ColonForAssign", "n : = 1;", "n := 1;"},
           {"DashComment", "-- pick the part\nStop;", "! pick the part\nStop;"},
           {"RemComment", "REM pick\nStop;", "! pick\nStop;"},
           {"Prose", "pick up the next part\nStop;", "! pick up the next part\nStop;"}},
          inProcedure);
    check({{"SlashForBackslash", "PROC p(num a /num b)\nENDPROC", "PROC p(num a \\num b)\nENDPROC"}},
          inModule);
}

TEST_CASE("an IF without THEN whose block is closed is one mistake", "[syntax]") { // BlockOfCompactIf
    const std::string wrong = inProcedure("IF a\n  Stop;\nELSE\n  Exit;\nENDIF");
    const test::Parsed parsed = parseText(wrong);
    INFO(parsed.shown());
    REQUIRE(parsed.sink.all().size() == 1);
    CHECK(mended(wrong, parsed.sink.all().front()) ==
          inProcedure("IF a THEN\n  Stop;\nELSE\n  Exit;\nENDIF"));
}

TEST_CASE("a word for END that ends nothing is reported alone", "[syntax]") {
    CHECK(parseText(inProcedure("Stop;\nENDWHILE\nStop;")).codes() == "RAP1203@4:1"); // WordWithoutOpener
    CHECK(parseText(inProcedure("IF a THEN\n  END\n  Stop;\nENDIF")).codes() == "RAP1203@4:3"); // LoneEnd
}

// One mistake costs one diagnostic, at the place where it was made.

#include "frontend/diag/messages/syntax.h"
#include "syntax_test.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace rapid;
using rapid::test::inProcedure;
using rapid::test::parseText;

namespace {

struct Case {
    const char* name;
    const char* text;
    const char* expected; ///< code@line:column; the body begins in line 3
};

void check(const Case& item, const std::string& text) {
    const test::Parsed parsed = parseText(text);
    INFO(item.name << "\n" << text << "\n" << parsed.shown());
    CHECK(parsed.codes() == item.expected);
    CHECK(syntax::printSource(*parsed.tree) == text);
}

const std::vector<Case> kBodies = {
    // ---- semicolons
    {"missing after an assignment", "x := 1\ny := 2;", "RAP1201@3:7"},
    {"missing after a call", "MoveL p1, v100, fine, tool0\nMoveL p2, v100, fine, tool0;", "RAP1201@3:28"},
    {"missing after a call without arguments", "TPErase\nTPWrite \"a\";", "RAP1201@3:8"},
    {"missing before an assignment that could be an argument", "TPErase\nx := 1;", "RAP1201@3:8"},
    {"missing before a call that could be an argument", "TPErase\nStop;", "RAP1201@3:8"},
    {"missing before ENDIF", "IF a THEN\n  x := 1\nENDIF", "RAP1201@4:9"},
    {"missing before ELSE", "IF a THEN\n  x := 1\nELSE\n  x := 2;\nENDIF", "RAP1201@4:9"},
    {"missing before ENDPROC", "x := 1", "RAP1201@3:7"},
    {"missing before IF", "x := 1\nIF a THEN\n  y := 1;\nENDIF", "RAP1201@3:7"},
    {"missing before FOR", "x := f(1)\nFOR i FROM 1 TO 2 DO\n  y := i;\nENDFOR", "RAP1201@3:10"},
    {"missing before ERROR", "x := 1\nERROR\n  RETRY;", "RAP1201@3:7"},
    {"missing before a label", "x := 1\nlbl:\ny := 1;", "RAP1201@3:7"},
    {"missing after RETURN", "RETURN\nx := 1;", "RAP1201@3:7"},
    {"missing after RETRY", "RETRY\nx := 1;", "RAP1201@3:6"},
    {"missing after GOTO", "GOTO a\nx := 1;", "RAP1201@3:7"},
    {"missing after a string", "TPWrite \"a\"\nx := 1;", "RAP1201@3:12"},
    {"missing in the same line", "x := 1 y := 2;", "RAP1201@3:7"},
    {"missing after a comment", "x := 1 ! one\ny := 2;", "RAP1201@3:7"},
    {"missing after a declaration", "VAR num a\nVAR num b;\nb := 1;", "RAP1201@3:10"},
    {"missing after the last declaration", "VAR num a := 1\na := 2;", "RAP1201@3:15"},
    {"missing after CONNECT", "CONNECT i WITH t\nISignalDI di, 1, i;", "RAP1201@3:17"},
    {"missing before WHILE", "Incr x\nWHILE a DO\n  Incr x;\nENDWHILE", "RAP1201@3:7"},
    {"missing before TEST", "Incr x\nTEST x\nCASE 1:\n  Stop;\nENDTEST", "RAP1201@3:7"},
    {"missing inside CASE", "TEST x\nCASE 1:\n  y := 1\nCASE 2:\n  y := 2;\nENDTEST", "RAP1201@5:9"},
    {"too many", ";;x := 1;;\n;", ""},

    // ---- blocks
    {"ENDIF missing", "IF a THEN\n  x := 1;\n", "RAP1202@6:1"},
    {"ENDIF missing in FOR", "FOR i FROM 1 TO 2 DO\n  IF a THEN\n    x := 1;\nENDFOR\ny := 2;",
     "RAP1202@6:1"},
    {"ENDFOR missing", "FOR i FROM 1 TO 2 DO\n  x := 1;\n", "RAP1202@6:1"},
    {"ENDWHILE missing before ERROR", "WHILE a DO\n  x := 1;\nERROR\n  RETRY;", "RAP1202@5:1"},
    {"ENDTEST missing", "TEST x\nCASE 1:\n  y := 1;\nDEFAULT:\n  y := 2;\n", "RAP1202@9:1"},
    {"ENDIF without IF", "x := 1;\nENDIF\ny := 2;", "RAP1203@4:1"},
    {"ENDFOR without FOR", "x := 1;\nENDFOR\ny := 2;", "RAP1203@4:1"},
    {"ELSE without IF", "x := 1;\nELSE\n  y := 2;\nENDIF\nz := 3;", "RAP1203@4:1"},
    {"CASE without TEST", "x := 1;\nCASE 2:\n  y := 2;\nCASE 3:\n  y := 3;\nENDTEST\nz := 3;", "RAP1203@4:1"},
    {"THEN missing before a block with ELSE", "IF a = 1\n  x := 1;\nELSE\n  x := 2;\nENDIF\ny := 1;",
     "RAP1204@3:9"},
    {"wrong END word", "IF a THEN\n  x := 1;\nENDWHILE\ny := 2;", "RAP1202@5:1"},
    {"ENDIF misspelt", "IF a THEN\n  x := 1;\nENDIFF\ny := 2;", "RAP1206@5:1"},
    {"ENDIF in two words", "IF a THEN\n  x := 1;\nEND IF\ny := 2;", "RAP1206@5:1"},
    {"ENDWHILE misspelt", "WHILE a DO\n  x := 1;\nENDWHIL\ny := 2;", "RAP1206@5:1"},
    {"ELSEIF misspelt", "IF a THEN\n  x := 1;\nELSIF b THEN\n  x := 2;\nENDIF\ny := 2;", "RAP1206@5:1"},
    {"IF misspelt", "FI a = 1 THEN\n  x := 1;\nENDIF\ny := 2;", "RAP1206@3:1"},
    {"DO missing", "WHILE a = 1\n  x := 1;\nENDWHILE\ny := 2;", "RAP1204@3:12"},
    {"FOR alone", "FOR\nx := 1;", "RAP1101@3:4"},
    {"FOR without the rest of its head", "FOR i FR\nx := 1;", "RAP1204@3:7"},
    {"FOR without TO", "FOR i FROM 1\nx := 1;\nENDFOR", "RAP1204@3:13"},
    {"WHILE alone", "WHILE\nx := 1;\nENDWHILE", "RAP1101@3:6"},
    {"ELSEIF alone", "IF a THEN\n  x := 1;\nELSEIF\n  x := 2;\nENDIF", "RAP1101@5:7"},
    {"CASE alone", "TEST x\nCASE\n  y := 1;\nENDTEST", "RAP1101@4:5"},
    {"a condition over several lines", "WHILE a AND\n  b OR\n  c{1}.d = 2\nDO\n  x := 1;\nENDWHILE", ""},
    {"a second ELSE below the outer IF",
     "IF a THEN\n  IF b THEN\n    x := 1;\n  ELSE\n    x := 2;\nELSE\n  x := 3;\nENDIF", "RAP1202@8:1"},
    {"FROM missing", "FOR i 1 TO 2 DO\n  x := 1;\nENDFOR", "RAP1204@3:7"},
    {":= in FOR", "FOR i := 1 TO 2 DO\n  x := 1;\nENDFOR", "RAP1204@3:7"},
    {"junk before THEN", "IF a b THEN\n  x := 1;\nENDIF\ny := 1;", "RAP1204@3:6"},
    {"no instruction after IF", "IF a\nENDPROC\nPROC b()", "RAP1204@3:5"},
    {"DEFAULT not last", "TEST x\nDEFAULT:\n  y := 1;\nCASE 1:\n  y := 2;\nENDTEST", "RAP1211@6:1"},
    {"ELSE not last", "IF a THEN\nELSE\n  x := 1;\nELSEIF b THEN\n  x := 2;\nENDIF", "RAP1213@6:1"},
    {"instruction before CASE", "TEST x\n  y := 1;\nCASE 1:\n  y := 2;\nENDTEST", "RAP1212@4:3"},
    {"colon missing after CASE", "TEST x\nCASE 1\n  y := 1;\nENDTEST", "RAP1101@4:7"},
    {"colon missing after DEFAULT", "TEST x\nDEFAULT\n  y := 1;\nENDTEST", "RAP1101@4:8"},

    // ---- expressions and calls
    {"operand missing", "x := 1 + ;", "RAP1101@3:10"},
    {"value missing", "x := ;", "RAP1101@3:6"},
    {"parenthesis missing", "x := (1 + 2;\ny := 1;", "RAP1103@3:12"},
    {"parenthesis missing at the end of a line", "x := (1 + 2\ny := 1;", "RAP1103@3:12"},
    {"parenthesis too many", "x := 1 + 2);\ny := 1;", "RAP1101@3:11"},
    {"bracket missing", "x := [1, 2;\ny := 1;", "RAP1103@3:11"},
    {"comma missing in a call", "x := f(1 2);\ny := 1;", "RAP1103@3:10"},
    {"comma missing in an instruction", "MoveL p1 v100, fine, tool0;\ny := 1;", "RAP1101@3:10"},
    {"argument missing", "MoveL p1,, v100;\ny := 1;", "RAP1101@3:10"},
    {"argument missing at the end", "MoveL p1, ;\ny := 1;", "RAP1101@3:11"},
    {"= in an assignment", "x = 5;\ny := 1;", "RAP1205@3:3"},
    {"= in an assignment to an element", "x{1} = 5;\ny := 1;", "RAP1205@3:6"},
    {"= in an optional argument", "Foo \\a=5;\ny := 1;", "RAP1205@3:7"},
    {"sign after an operator", "x := 2*-3;", "RAP1104@3:8"},
    {"two signs", "x := --3;", "RAP1104@3:7"},
    {"sign after plus", "x := a + -b;", "RAP1104@3:10"},
    {"relations do not chain", "b := 1 < x < 3;", "RAP1105@3:12"},
    {"NOT as an operand", "b := a = NOT c;", "RAP1106@3:10"},
    {"component of a call", "x := CRobT().trans.x;", "RAP1107@3:13"},
    {"index of a component", "x := a.b{1};", "RAP1108@3:9"},
    {"':' for THEN after a name in two words", "VAR num x := 1\nVAR num n Rows;\nIF x:\nx := nRows;\nENDIF",
     "RAP1201@3:15 RAP1101@4:9 RAP1204@5:5"},
    {"':' for ':=' before a quotient", "b : a / zero;\ny := 1;", "RAP1112@3:3"},
    {"call with parentheses, which the checker reports", "Foo(1, 2);\ny := 1;", ""},
    {"call with empty parentheses, which the checker reports", "Foo();\ny := 1;", ""},
    {"late binding not closed", "%\"a\" b;\ny := 1;", "RAP1103@3:6"},
    {"reserved word as a name", "VAR num to;\nx := 1;", "RAP1102@3:9"},
    {"conditional argument without name", "Foo \\a?;\ny := 1;", "RAP1101@3:8"},
    {"assignment without target", ":= 5;\ny := 1;", "RAP1101@3:1"},
    {"number glued to a word", "x := 12abc;\ny := 1;", "RAP1010@3:6"},
    {"hexadecimal number without digits", "x := 0x;", "RAP1010@3:6"},
    {"number with two points", "x := 1.2.3;", "RAP1010@3:6"},
    {"exponent without digits", "x := 1E;", "RAP1010@3:6"},
    {"number out of range", "x := 1E999;", "RAP1011@3:6"},

    // ---- characters
    {"unknown character", "x := 1 @ 2;\ny := 1;", "RAP1001@3:8"},
    {"unknown characters in a line", "@ # $ & ~\ny := 1;", "RAP1001@3:1"},
    {"unknown characters in two lines", "x := @;\ny := #;", "RAP1001@3:6 RAP1001@4:6"},
    {"typographic quotes", "TPWrite “hello world”;\ny := 1;", "RAP1112@3:9"},
    {"name that begins with _", "VAR num _a;\ny := 1;", "RAP1013@3:9"},
    {"string not closed", "TPWrite \"hello;\ny := 1;", "RAP1006@3:9"},
    {"string not closed inside parentheses", "x := f(\"hello);\ny := 1;", "RAP1006@3:8"},
    {"string with a bad escape", "TPWrite \"a\\q\";", "RAP1007@3:11"},
    {"text without a comment mark", "this is a sentence for the reader\ny := 1;", "RAP1112@3:1"},
    {"text that ends in a full stop", "See if the robot moves.\ny := 1;", "RAP1101@3:5"},

    // ---- routines
    {"declaration after an instruction", "x := 1;\nVAR num a;\na := 2;", "RAP1207@4:9"},
    {"declaration in a block", "IF a THEN\n  VAR num b;\nENDIF", "RAP1207@4:11"},
    {"LOCAL in a routine", "LOCAL VAR num a;\nx := 1;", "RAP1310@3:1"},
    {"UNDO before ERROR", "UNDO\nERROR", "RAP1208@4:1"},
    {"second UNDO", "UNDO\nUNDO", "RAP1209@4:1"},
    {"ERROR twice with lists", "ERROR (ERR_A)\nRETRY;\nERROR (ERR_B, ERR_C)\nTRYNEXT;", ""},
    {"ENDPROC missing", "x := 1;\nPROC b()\n", "RAP1202@4:1"},
    {"ENDPROC missing before LOCAL PROC", "x := 1;\nLOCAL PROC b()\n", "RAP1202@4:1"},
    {"ENDPROC too many", "ENDPROC\nx := 1;", "RAP1309@4:1"},
    {"module end in a routine", "x := 1;\nENDMODULE\nMODULE n\nPROC b()", "RAP1202@4:1"},
};

const std::vector<Case> kModules = {
    {"no module", "", "RAP1301@1:1"},
    {"only a comment", "! nothing\n", "RAP1301@2:1"},
    {"no module word", "PROC main()\nENDPROC\n", "RAP1302@1:1"},
    {"the text ends after a name", "MODULE x\nMODULEENDMODULE\n", "RAP1309@2:1 RAP1202@3:1"},
    {"text after the module", "MODULE m\nENDMODULE\nx := 1;\ny := 2;\n", "RAP1302@3:1"},
    {"comment around the module", "! a\nMODULE m\nENDMODULE\n! b\n", "RAP1014@1:1"},
    {"two modules", "MODULE m\nENDMODULE\nMODULE n\nENDMODULE\n", ""},
    {"ENDMODULE missing", "MODULE m\nVAR num a;\n", "RAP1202@3:1"},
    {"ENDMODULE missing between two", "MODULE m\nMODULE n\nENDMODULE\n", "RAP1202@2:1"},
    {"unknown attribute", "MODULE m(SYSMODULE, HIDDEN)\nENDMODULE\n", "RAP1303@1:21"},
    {"attribute order", "MODULE m(NOSTEPIN, SYSMODULE)\nENDMODULE\n", "RAP1304@1:20"},
    {"attribute twice", "MODULE m(SYSMODULE, SYSMODULE)\nENDMODULE\n", "RAP1305@1:21"},
    {"NOVIEW with another", "MODULE m(NOVIEW, NOSTEPIN)\nENDMODULE\n", "RAP1306@1:18"},
    {"NOVIEW with SYSMODULE", "MODULE m(SYSMODULE, NOVIEW)\nENDMODULE\n", ""},
    {"all others together", "MODULE m(SYSMODULE, NOSTEPIN, VIEWONLY, READONLY)\nENDMODULE\n", ""},
    {"PROC without parentheses", "MODULE m\nPROC a\n  x := 1;\nENDPROC\nENDMODULE\n", "RAP1307@2:7"},
    {"PROC with a semicolon", "MODULE m\nPROC a();\n  x := 1;\nENDPROC\nENDMODULE\n", ""},
    {"TRAP with parentheses", "MODULE m\nTRAP t()\n  x := 1;\nENDTRAP\nENDMODULE\n", "RAP1308@2:7"},
    {"FUNC without type", "MODULE m\nFUNC f()\n  RETURN 1;\nENDFUNC\nENDMODULE\n", "RAP1319@2:6"},
    {"FUNC closed by ENDPROC", "MODULE m\nFUNC num f()\n  RETURN 1;\nENDPROC\nENDMODULE\n", "RAP1202@4:1"},
    {"BACKWARD in FUNC", "MODULE m\nFUNC num f()\n  RETURN 1;\nBACKWARD\nENDFUNC\nENDMODULE\n",
     "RAP1210@4:1"},
    {"instructions outside", "MODULE m\nx := 1;\ny := 2;\nPROC a()\nENDPROC\nENDMODULE\n", "RAP1309@2:1"},
    {"PROC misspelt", "MODULE m\nPROK a()\n  VAR num x;\n  x := 1;\nENDPROC\nENDMODULE\n", "RAP1206@2:1"},
    {"ENDPROC alone", "MODULE m\nENDPROC\nPROC a()\nENDPROC\nENDMODULE\n", "RAP1203@2:1"},
    {"semicolon after ENDPROC", "MODULE m\nPROC a()\nENDPROC;\nENDMODULE\n", "RAP1324@3:8"},
    {"semicolons after a declaration and ENDMODULE",
     "MODULE m\nVAR num a;;;\nENDMODULE;\nMODULE n\nENDMODULE\n", "RAP1324@2:11 RAP1324@3:10"},
    {"semicolon after ENDRECORD", "MODULE m\nRECORD r\n  num a;\nENDRECORD;\nENDMODULE\n", "RAP1324@4:10"},
    {"empty record", "MODULE m\nRECORD r\nENDRECORD\nENDMODULE\n", "RAP1311@2:8"},
    {"array component", "MODULE m\nRECORD r\n  num a{3};\nENDRECORD\nENDMODULE\n", "RAP1312@3:8"},
    {"record semicolon missing", "MODULE m\nRECORD r\n  num a\n  num b;\nENDRECORD\nENDMODULE\n",
     "RAP1201@3:8"},
    {"ENDRECORD missing", "MODULE m\nRECORD r\n  num a;\nPROC b()\nENDPROC\nENDMODULE\n", "RAP1202@4:1"},
    {"constant without value", "MODULE m\nCONST num a;\nENDMODULE\n", "RAP1313@2:11"},
    {"= in a declaration", "MODULE m\nVAR num a = 1;\nENDMODULE\n", "RAP1205@2:11"},
    {"number as dimension of a parameter", "MODULE m\nPROC a(num b{3})\nENDPROC\nENDMODULE\n",
     "RAP1314@2:14"},
    {"alternative of a required parameter", "MODULE m\nPROC a(num b | num c)\nENDPROC\nENDMODULE\n",
     "RAP1315@2:14"},
    {"comma missing between parameters", "MODULE m\nPROC a(num b num c)\n  x := 1;\nENDPROC\nENDMODULE\n",
     "RAP1103@2:14"},
    {"parenthesis missing after parameters", "MODULE m\nPROC a(num b\n  x := 1;\nENDPROC\nENDMODULE\n",
     "RAP1103@2:13"},
    {"parameter without name", "MODULE m\nPROC a(num)\n  x := 1;\nENDPROC\nENDMODULE\n", "RAP1101@2:11"},
    {"two names in a declaration", "MODULE m\nVAR num a, b;\nVAR num c;\nENDMODULE\n", "RAP1101@2:10"},
    {"declaration without name", "MODULE m\nVAR num;\nVAR num c;\nENDMODULE\n", "RAP1101@2:8"},
    {"name too long", "MODULE m\nVAR num a23456789012345678901234567890123;\nENDMODULE\n", "RAP1009@2:9"},
    {"longest name", "MODULE m\nVAR num a2345678901234567890123456789012;\nENDMODULE\n", ""},
    {"longest name with Latin-1 letters", "MODULE m\nVAR num ä2345678901234567890123456789012;\nENDMODULE\n",
     ""},
    {"file header", "%%%\nVERSION:1\nLANGUAGE:ENGLISH\n%%%\nMODULE m\nENDMODULE\n", ""},
    {"file header not closed", "%%%\nVERSION:1\nMODULE m\nENDMODULE\n", "RAP1012@1:1"},
    {"placeholder in the wrong list", "MODULE m\nPROC a(<ALT>)\nENDPROC\nENDMODULE\n", "RAP1111@2:8"},
    {"LOCAL without declaration", "MODULE m\nLOCAL x := 1;\nVAR num a;\nENDMODULE\n", "RAP1101@2:7"},
};

} // namespace

TEST_CASE("one mistake in a routine costs one diagnostic", "[syntax]") {
    for (const Case& item : kBodies)
        check(item, inProcedure(item.text));
}

TEST_CASE("one mistake in a module costs one diagnostic", "[syntax]") {
    for (const Case& item : kModules)
        check(item, item.text);
}

TEST_CASE("a note says where an unfinished block begins", "[syntax]") {
    const test::Parsed parsed = parseText(inProcedure("IF a THEN\n  x := 1;\n"));
    REQUIRE(parsed.sink.all().size() == 1);
    const diag::Diagnostic& d = parsed.sink.all()[0];
    REQUIRE(d.notes.size() == 1);
    CHECK(d.notes[0].file->lineColumn(d.notes[0].range.begin).line == 3);
    CHECK(d.message == "found ENDPROC, expected ENDIF");
}

TEST_CASE("a note says which IF has no THEN", "[syntax]") {
    // By its margin the ENDIF belongs to the IF: there the word is missing.
    const test::Parsed aligned = parseText(inProcedure("IF a\n  x := 1;\nENDIF\n"));
    REQUIRE(aligned.codes() == "RAP1204@3:5");
    CHECK(aligned.sink.all()[0].notes.size() == 1);
    const test::Parsed parsed = parseText(inProcedure("IF a\n  x := 1;\n  ENDIF\n"));
    REQUIRE(parsed.codes() == "RAP1203@5:3");
    REQUIRE(parsed.sink.all()[0].notes.size() == 1);
    CHECK(parsed.sink.all()[0].notes[0].range.begin == std::string("MODULE m\nPROC main()\n").size());
}

TEST_CASE("no more than 200 errors a file, and a note that there are more", "[syntax]") {
    std::string body;
    for (int i = 0; i < 1000; ++i)
        body += "x = 1;\n";
    const test::Parsed parsed = parseText(inProcedure(body));
    CHECK(parsed.sink.errorCount() == 200);
    REQUIRE(parsed.sink.all().size() == 201);
    CHECK(parsed.sink.sorted().back().code == diag::say::TooManyErrors.code);
    CHECK(parsed.tree->modules.size() == 1);
}

TEST_CASE("every semicolon of a program can be missed", "[syntax]") {
    const std::string text =
        "MODULE m\n"
        "  RECORD r\n    num a;\n    num b;\n  ENDRECORD\n"
        "  ALIAS num level;\n"
        "  LOCAL VAR num x := 1;\n"
        "  PERS tooldata t := [TRUE, [[0,0,0],[1,0,0,0]], [0,[0,0,0],[1,0,0,0],0,0,0]];\n"
        "  PROC main()\n    VAR num a{2};\n    VAR string s := \"a;b\";\n"
        "    TPErase;\n    TPWrite \"x\" \\Num:=x;\n    a{1} := (x + 2) * Abs(x);\n"
        "    MoveL Offs(p1, 0, 0,\n      10), v100, fine, tool0 \\WObj:=wobj0;\n"
        "    IF x = 1 RETURN;\n"
        "    IF x = 2 THEN\n      x := 3;\n    ELSE\n      Stop;\n    ENDIF\n"
        "    FOR i FROM 1 TO 2 DO\n      Incr x;\n    ENDFOR\n"
        "    TEST x\n    CASE 1:\n      a := b;\n    DEFAULT:\n      EXIT;\n    ENDTEST\n"
        "    GOTO done;\n    CONNECT i1 WITH trap1;\n    %\"p\" + s%;\n  done:\n    x := a{2};\n"
        "  ERROR\n    IF ERRNO = 1 RETRY;\n    RAISE;\n  ENDPROC\nENDMODULE\n";
    REQUIRE(parseText(text).codes().empty());
    size_t tried = 0;
    for (size_t at = text.find(';'); at != std::string::npos; at = text.find(';', at + 1)) {
        if (text.compare(at - 1, 3, "a;b") == 0) continue;
        std::string broken = text;
        broken.erase(at, 1);
        const test::Parsed parsed = parseText(broken);
        INFO(broken.substr(at > 40 ? at - 40 : 0, 80) << "\n" << parsed.shown());
        const LineColumn place = parsed.tree->source->lineColumn(static_cast<uint32_t>(at));
        CHECK(parsed.codes() == "RAP1201@" + std::to_string(place.line) + ":" + std::to_string(place.column));
        ++tried;
    }
    CHECK(tried > 20);
}

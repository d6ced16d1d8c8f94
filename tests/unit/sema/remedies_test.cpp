// The remedy in a message about a value that does not fit, and that it makes the program right.

#include "sema_testing.h"

#include "frontend/edit/apply_edits.h"

#include <catch2/catch.hpp>

namespace {

using namespace rapid;
using namespace rapid::sema;

struct Case {
    std::string body;    ///< of main; one mistake in it
    std::string code;    ///< its diagnostic
    std::string remedy;  ///< how the message ends
    std::string instead; ///< the line after the fix; empty: none is offered
};

const std::string kBefore =
    "MODULE m\n"
    "  CONST robtarget p10:=[[600,0,500],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "  CONST jointtarget jp:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "  VAR intnum irq;\n"
    "  VAR clock watch;\n"
    "  VAR num n;\n"
    "  VAR num row{3};\n"
    "  VAR num grid{2,3};\n"
    "  VAR dnum large;\n"
    "  VAR string s;\n"
    "  VAR bool b;\n"
    "  VAR pos at;\n"
    "  VAR robtarget target;\n"
    "  PROC main()\n";
const std::string kAfter = "\n  ENDPROC\n"
                           "  TRAP onChange\n  ENDTRAP\n"
                           "  FUNC num give(string text)\n    RETURN StrLen(text);\n  ENDFUNC\n"
                           "ENDMODULE\n";

// Manual 1.2 (types), 1.3.1 and 1.3.2 (operators), 1.1.5 (arguments), 3 (instructions and their parameters).
const Case kCases[] = {
    {"MoveL p10,100,z50,tool0;", "RAP4011", "; did you mean 'v100'?", "MoveL p10,v100,z50,tool0;"},
    {"MoveL p10,v100,50,tool0;", "RAP4011", "; did you mean 'z50'?", "MoveL p10,v100,z50,tool0;"},
    {"MoveL p10,123,z50,tool0;", "RAP4011", "'num', expected 'speeddata'", ""},
    {"MoveL jp,v100,z50,tool0;", "RAP4011", ": MoveAbsJ moves to a jointtarget", ""},
    {"MoveAbsJ p10,v100,z50,tool0;", "RAP4011", ": MoveJ and MoveL move to a robtarget", ""},
    {"target := jp;", "RAP2104", ": CalcRobT gives the robtarget of joint angles", ""},
    {"WaitTime \"1.5\";", "RAP4011", ": a number is written without quotes", "WaitTime 1.5;"},
    {"WaitTime \"soon\";", "RAP4011", ": StrToVal reads a value from a text", ""},
    {"WaitTime large;", "RAP4011", ": convert it with DnumToNum", ""},
    {"n := \"5\";", "RAP2104", ": a number is written without quotes", "n := 5;"},
    {"n := TRUE;", "RAP2104", ": write 1", "n := 1;"},
    {"n := row;", "RAP2104", ": choose an element, as in row{1}", ""},
    {"n := grid;", "RAP2104", ": choose an element, as in grid{1,1}", ""},
    {"b := 0;", "RAP2104", ": write FALSE", "b := FALSE;"},
    {"b := n;", "RAP2104", ": compare it, as in n <> 0", ""},
    {"s := 5;", "RAP2104", ": write a text between double quotes", "s := \"5\";"},
    {"s := n + 1;", "RAP2104", ": make a text of the number with NumToStr", ""},
    {"s := large;", "RAP2104", ": make a text of the number with DnumToStr", ""},
    {"s := at;", "RAP2104", ": ValToStr makes a text of it", ""},
    {"at := p10;", "RAP2104", "; did you mean 'p10.trans'?", "at := p10.trans;"},
    {"at := CRobT();", "RAP2104", ": only its component 'trans' is one", ""},
    {"target := Offs(p10.trans,0,0,1);", "RAP4011", "; did you mean 'p10'?", "target := Offs(p10,0,0,1);"},
    {"IF n b := TRUE;", "RAP3007", ": compare it, as in n <> 0", ""},
    {"IF 1 b := TRUE;", "RAP3007", ": write TRUE", "IF TRUE b := TRUE;"},
    {"IF n = \"5\" b := TRUE;", "RAP3004", ": a number is written without quotes", "IF n = 5 b := TRUE;"},
    {"IF \"5\" = n b := TRUE;", "RAP3004", ": a number is written without quotes", "IF 5 = n b := TRUE;"},
    {"IF b = 1 b := FALSE;", "RAP3004", ": write TRUE", "IF b = TRUE b := FALSE;"},
    {"n := give(7);", "RAP4011", ": write a text between double quotes", "n := give(\"7\");"},
    {"TPWrite \"n: \", n;", "RAP4001", "; did you mean '\\Num:=n'?", "TPWrite \"n: \", \\Num:=n;"},
    {"TPWrite \"n: \"\\n;", "RAP4003", "; did you mean '\\Num:=n'?", "TPWrite \"n: \"\\Num:=n;"},
    {"MoveL p10,v100,z50,tool0\\wobj0;", "RAP4003", "; did you mean '\\WObj:=wobj0'?",
     "MoveL p10,v100,z50,tool0\\WObj:=wobj0;"},
    {"target := CRobT(tool0);", "RAP4001", "; did you mean '\\Tool:=tool0'?",
     "target := CRobT(\\Tool:=tool0);"},
    {"ClkStart(watch);", "RAP4012", "expected a variable", "ClkStart watch;"},
    {"ClkStart (watch);", "RAP4012", "expected a variable", "ClkStart watch;"},
    {"ConfL/Off;", "RAP1112", "expected '\\' before an optional argument", "ConfL\\Off;"},
    {"target := CRobT(/Tool:=tool0);", "RAP1112", "expected '\\' before an optional argument",
     "target := CRobT(\\Tool:=tool0);"},
    {"CONNECT irq WITH onChange();", "RAP1101", ": a trap routine is named, not called",
     "CONNECT irq WITH onChange;"},
    {"IF n > 1 AND < 5 b := TRUE;", "RAP1101",
     ": each comparison names both of its sides, as in n > 1 AND n < 5", ""},
    {"target := p10 + [0,0,50];", "RAP3001",
     "'robtarget' and '[0,0,50]': Offs and RelTool give a robtarget that is moved", ""},
    {"target := p10 - at;", "RAP3001", ": Offs and RelTool give a robtarget that is moved", ""},
    {"target := [0,0,50] + p10;", "RAP3001",
     "'[0,0,50]' and 'robtarget': Offs and RelTool give a robtarget that is moved", ""},
    {"target.z := 5;", "RAP2005", "; did you mean 'trans.z'?", "target.trans.z := 5;"},
    {"n := give \"7\";", "RAP1101", "expected ';', or '(' before the arguments of a function", ""},
    {"row := 5;", "RAP2104", ": it goes into one element, or each gets a value of its own", ""},
    {"MoveJ *,v100,z50,tool0;", "RAP1101",
     "expected a position: manuals and the pendant show '*' for one that is not written out", ""},
    {"MoveC p10,*,v100,z50,tool0;", "RAP1101",
     "expected a position: manuals and the pendant show '*' for one that is not written out", ""},
    {"TPWrite \"n\"\\Num:n;", "RAP1112", "found ':', expected ':='", "TPWrite \"n\"\\Num:=n;"},
    {"MoveAbsJ jp,NoEOffs:=TRUE,v100,z50,tool0;", "RAP4005", "write '\\' before its name",
     "MoveAbsJ jp,\\NoEOffs,v100,z50,tool0;"},
    {"10: n := 5;", "RAP1101",
     "expected an instruction: a branch of TEST begins with CASE, a label with a letter", ""},
    {"MoveAbsJ jp,NoEOffs,v100,z50,tool0;", "RAP4005", "write '\\' before its name",
     "MoveAbsJ jp,\\NoEOffs,v100,z50,tool0;"},
    {"MoveL p10,v110,z50,tool0;", "RAP2001", "; predefined are 'v100' and 'v150'", ""},
    {"MoveL p10,v100,z25,tool0;", "RAP2001", "; predefined are 'z20' and 'z30'", ""},
    {"MoveL p10,v100,z500,tool0;", "RAP2001", "; predefined is 'z200'", ""},
    {"SetDO doGrip, ON;", "RAP2001", "; did you mean 'high'?", "SetDO doGrip, high;"},
};

std::vector<diag::Diagnostic> errorsOf(const std::string& body) {
    std::vector<diag::Diagnostic> errors = testing::checkTexts({kBefore + body + kAfter})->sink.sorted();
    std::erase_if(errors, [](const diag::Diagnostic& d) { return d.severity != diag::Severity::Error; });
    return errors;
}

} // namespace

TEST_CASE("a value that does not fit is one message that says what would", "[sema]") {
    for (const Case& item : kCases) {
        INFO(item.body);
        const std::vector<diag::Diagnostic> errors = errorsOf(item.body);
        REQUIRE(errors.size() == 1);
        const diag::Diagnostic& d = errors.front();
        INFO(d.message);
        CHECK(diag::codeName(d.code) == item.code);
        CHECK(d.message.ends_with(item.remedy));
        REQUIRE(d.fixes.size() == (item.instead.empty() ? 0 : 1));
        if (item.instead.empty()) continue;
        const std::string whole = kBefore + item.body + kAfter;
        CHECK(edit::applyEditsToText(whole, d.fixes.front().edits).bytes == kBefore + item.instead + kAfter);
        CHECK(errorsOf(item.instead).empty());
    }
}

namespace {

/// The fixes of the first error, "?" before those that are not certain.
std::vector<std::string> fixesOf(const std::string& declarations, const std::string& instruction) {
    const std::string text =
        "MODULE m\n" + declarations + "\n  PROC main()\n" + instruction + "\n  ENDPROC\nENDMODULE\n";
    const auto checked = testing::checkTexts({text});
    std::vector<std::string> fixes;
    for (const diag::Diagnostic& d : checked->sink.sorted()) {
        if (d.severity != diag::Severity::Error) continue;
        for (const auto& fix : d.fixes) {
            const edit::EditResult result = edit::applyEdits(*d.file, fix.edits);
            REQUIRE(result.ok());
            const size_t begin = result.bytes.find("main()\n") + 7;
            fixes.push_back((fix.certain ? "" : "?") +
                            result.bytes.substr(begin, result.bytes.find('\n', begin) - begin));
        }
        break;
    }
    return fixes;
}
using Fixes = std::vector<std::string>;

} // namespace

// Manual 1.1.2: what a module declares hides what is predefined.
TEST_CASE("a name that the program has taken is not proposed", "[sema]") {
    const std::string target =
        "CONST robtarget p10:=[[0,0,5],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];";
    CHECK(fixesOf(target, "MoveL p10,100,fine,tool0;") == Fixes{"?MoveL p10,v100,fine,tool0;"});
    CHECK(fixesOf(target + "LOCAL CONST num v100:=5;", "MoveL p10,100,fine,tool0;").empty());
    CHECK(fixesOf("VAR dnum d; VAR num n;", "d := n;") == Fixes{"d := NumToDnum(n);"});
    CHECK(fixesOf("VAR dnum d; VAR num n; FUNC dnum NumToDnum(num a) RETURN 4; ENDFUNC", "d := n;").empty());
    CHECK(fixesOf("VAR num n;", "n := on;") == Fixes{"?n := high;"});
    CHECK(fixesOf("VAR num n; PROC high() ENDPROC", "n := on;").empty());
}

TEST_CASE("a long value is written out in its remedy", "[sema]") {
    const std::string longName = "listOfAllThePartsOnTheTable";
    CHECK(fixesOf("VAR pos at; VAR robtarget " + longName + "{2};",
                  "at := " + longName + "{ 1 + 1 - 1 + 1 - 1 };") ==
          Fixes{"?at := " + longName + "{ 1 + 1 - 1 + 1 - 1 }.trans;"});
}

// Manual 1.1.5: INOUT, VAR and PERS parameters take data; a value that a function makes is none.
TEST_CASE("no value is offered where data is passed on", "[sema]") {
    const auto messages = [](const std::string& parameter, const std::string& argument) {
        return testing::checkTexts({"MODULE m\n  PROC p(" + parameter +
                                    ")\n  ENDPROC\n  PROC main()\nVAR num n; VAR "
                                    "string s; VAR num row{2};\np " +
                                    argument + ";\n  ENDPROC\nENDMODULE\n"})
            ->messages();
    };
    CHECK(messages("VAR string a", "n") ==
          Fixes{"RAP4011 at 6:3: argument 'a' of 'p' is 'num', expected 'string'"});
    CHECK(messages("INOUT num a", "s") ==
          Fixes{"RAP4011 at 6:3: argument 'a' of 'p' is 'string', expected 'num'"});
    CHECK(messages("VAR num a", "row") == Fixes{"RAP4011 at 6:3: argument 'a' of 'p' is 'num{2}', expected "
                                                "'num': choose an element, as in row{1}"});
    CHECK(messages("num a{*}", "n") ==
          Fixes{"RAP4011 at 6:3: argument 'a' of 'p' is 'num', expected 'num{*}'"});
}

TEST_CASE("arguments are swapped for certain only where no other order fits", "[sema]") {
    const std::string text = "PROC p(num a, num b, string c) ENDPROC PROC q(num a, string c) ENDPROC";
    CHECK(fixesOf(text, "p \"x\", 1, 2;") == Fixes{"?p 2, 1, \"x\";"});
    CHECK(fixesOf(text, "q \"x\", 1;") == Fixes{"q 1, \"x\";"});
}

TEST_CASE("parentheses become those of an index where indices stand in them", "[sema]") {
    CHECK(fixesOf("VAR num n; VAR num row{2};", "n := row(1);") == Fixes{"n := row{1};"});
    CHECK(fixesOf("VAR num n; VAR num row{2};", "n := row();").empty());
    CHECK(fixesOf("VAR num n; VAR num row{2};", "n := row(1,2);").empty());
    CHECK(fixesOf("VAR num n; VAR num row{2};", "n := row(\\a:=1);").empty());
}

// Manual 1.2.5: an aggregate is between brackets as a whole.
TEST_CASE("parts of a value without brackets around them are one message", "[sema]") {
    const std::string text =
        "MODULE m\n  CONST robtarget q := [1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9];\n"
        "  VAR pos p := [1,2,3];\nENDMODULE\n";
    CHECK(testing::checkTexts({text})->messages() ==
          std::vector<std::string>{"RAP1101 at 2:31: found ',', expected ';': a value of several parts is "
                                   "between '[' and ']' as a whole"});
}

// Manual 1.2.7: dimensions are constant. Errors of the constant are reported at its declaration.
TEST_CASE("a constant without value as dimension is one message", "[sema]") {
    const std::string text =
        "MODULE m\n  CONST num k := reg1 + 1;\n  VAR num row{k};\n  VAR num grid{2,k*2};\n"
        "  VAR num other{reg1};\nENDMODULE\n";
    CHECK(testing::checkTexts({text})->codes() == std::vector<std::string>{"RAP3030", "RAP2042"});
}

// Inputs and outputs, single signals and groups have instructions of their own (manual 1.8).
TEST_CASE("a signal of a different kind names the instruction that takes it", "[sema]") {
    const auto messages = [](const std::string& body) {
        CheckOptions options;
        options.configurationKnown = true;
        options.signals = {
            {"di1", "signaldi"}, {"do1", "signaldo"}, {"go1", "signalgo"}, {"ai1", "signalai"}};
        return testing::checkTexts({"MODULE m\n  PROC main()\n" + body + "\n  ENDPROC\nENDMODULE\n"}, options)
            ->messages();
    };
    CHECK(messages("WaitDI do1, 1;") ==
          std::vector<std::string>{"RAP4011 at 3:8: argument 'Signal' of 'WaitDI' is 'signaldo', expected "
                                   "'signaldi': WaitDO takes one"});
    CHECK(messages("SetDO go1, 1;") ==
          std::vector<std::string>{"RAP4011 at 3:7: argument 'Signal' of 'SetDO' is 'signalgo', expected "
                                   "'signaldo': SetGO takes one"});
    CHECK(messages("SetDO di1, 1;") ==
          std::vector<std::string>{"RAP4011 at 3:7: argument 'Signal' of 'SetDO' is 'signaldi', expected "
                                   "'signaldo': an input cannot be set"});
    CHECK(messages("WaitDI ai1, 1;") ==
          std::vector<std::string>{"RAP4011 at 3:8: argument 'Signal' of 'WaitDI' is 'signalai', expected "
                                   "'signaldi': WaitAI takes one"});
}

// Refactorings: the changed program is checked again, and has no mistake.

#include "frontend/query/refactoring.h"

#include "frontend/edit/apply_edits.h"
#include "query_testing.h"

#include <catch2/catch.hpp>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

using Lines = std::vector<std::string>;

std::vector<Refactoring> offers(const Program& p, std::string_view id, int first, int last) {
    std::vector<Refactoring> found;
    for (Refactoring& refactoring :
         refactoringsAt(p.snapshot(), p.file(first), {p.offset(first), p.offset(last)}))
        if (refactoring.id == id) found.push_back(std::move(refactoring));
    return found;
}
Lines titles(const Program& p, std::string_view id, int first = 1, int last = 1) {
    Lines out;
    for (const Refactoring& refactoring : offers(p, id, first, last))
        out.push_back(refactoring.title);
    return out;
}

/// The text after the refactoring with this title; the program with it must check.
std::string after(const Program& p, std::string_view title, int first = 1, int last = 1) {
    for (const Refactoring& refactoring :
         refactoringsAt(p.snapshot(), p.file(first), {p.offset(first), p.offset(last)})) {
        if (refactoring.title != title) continue;
        const auto result = edit::applyEditsToText(p.file(first).text(), refactoring.edits);
        CHECK(result.problem == "");
        std::vector<std::string> texts;
        for (const auto& file : p.tasks()[0].files)
            texts.push_back(file->path() == p.file(first).source().path() ? result.bytes
                                                                          : std::string(file->text()));
        const auto checked = sema::testing::checkTexts(texts);
        INFO(result.bytes);
        CHECK(checked->messages() == Lines{});
        return result.bytes;
    }
    FAIL("no such refactoring: " << title);
    return {};
}

bool contains(const std::string& text, std::string_view part) {
    INFO(text << "\n--- lacks ---\n" << part);
    CHECK(text.find(part) != std::string::npos);
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("query: create a procedure from its call", "[query][refactoring]") {
    const Program p({"MODULE m\n   VAR string text;\n   VAR num list{3};\n\n   PROC main()\n      VAR clock "
                     "timer;\n      pi$1ck text,2,list,timer\\fast\\height:=1.5;\n   ENDPROC\n\n"
                     "   PROC other()\n   ENDPROC\nENDMODULE\n"});
    contains(after(p, "Create procedure 'pick'"),
             "   ENDPROC\n\n   PROC pick(string text,num arg2,num list{*},VAR clock timer \\switch fast "
             "\\num height)\n   ENDPROC\n\n   PROC other()");
}

TEST_CASE("query: create functions and traps", "[query][refactoring]") {
    const Program p({"MODULE m\nPROC main()\nVAR string s;\nVAR intnum i;\ns:=nam$1ed(1);\nIF is$2Done() "
                     "TPErase;\nCONNECT i WITH al$3arm;\nENDPROC\nENDMODULE\n"});
    CHECK(titles(p, "create-routine", 1) == Lines{"Create function 'named'"});
    const Program text({inMain("VAR string s;\ns:=nam$1ed(1);")});
    contains(after(text, "Create function 'named'"), "FUNC string named(num arg1)\n   RETURN \"\";\nENDFUNC");
    const Program boolean({inMain("IF is$1Done() TPErase;")});
    contains(after(boolean, "Create function 'isDone'"), "FUNC bool isDone()\n   RETURN FALSE;\nENDFUNC");
    const Program trap({inMain("CONNECT i WITH al$1arm;", "VAR intnum i;\n")});
    contains(after(trap, "Create trap routine 'alarm'"), "TRAP alarm\nENDTRAP");
}

TEST_CASE("query: declare data of the type that is expected", "[query][refactoring]") {
    const std::string cell =
        "CONST robtarget p10:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n";
    const Program point({inMain("MoveL ho$1me,v100,fine,tool0;", cell)});
    CHECK(titles(point, "declare-data").front() == "Declare 'home' as CONST robtarget");
    contains(after(point, "Declare 'home' as CONST robtarget"),
             "9E9]];\nCONST robtarget home:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n");
    const Program tool({inMain("MoveL p10,v100,fine,grip$1per;", cell)});
    CHECK(titles(tool, "declare-data") == Lines{"Declare 'gripper' as PERS tooldata"});
    after(tool, "Declare 'gripper' as PERS tooldata");
    const Program assigned({inMain("te$1xt:=\"a\";")});
    CHECK(titles(assigned, "declare-data") == Lines{"Declare local 'text' as VAR string",
                                                    "Declare 'text' as VAR string",
                                                    "Declare 'text' as PERS string"});
    contains(after(assigned, "Declare local 'text' as VAR string"),
             "PROC main()\nVAR string text;\ntext:=\"a\";");
    after(assigned, "Declare 'text' as PERS string");
    const Program list({inMain("TPWrite \"a\"\\Num:=li$1st{2};")});
    contains(after(list, "Declare 'list' as VAR num{10}"), "VAR num list{10};");
    const Program interrupt({inMain("CONNECT ti$1mer WITH alarm;", "TRAP alarm\nENDTRAP\n")});
    CHECK(titles(interrupt, "declare-data").at(1) == "Declare 'timer' as VAR intnum");
}

TEST_CASE("query: insert missing arguments in their place", "[query][refactoring]") {
    const std::string cell =
        "PROC report(string text\\num count,num level\\bool last)\nENDPROC\nVAR clock timer;\n"
        "CONST robtarget p10:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n";
    const auto check = [&](std::string_view call, std::string_view title, std::string_view expected) {
        const Program p({inMain(call, cell)});
        contains(after(p, title), expected);
    };
    check("rep$1ort \"a\"\\count:=1;", "Insert missing arguments: 0", "report \"a\"\\count:=1,0;");
    check("rep$1ort \"a\"\\last:=TRUE;", "Insert missing arguments: 0", "report \"a\",0\\last:=TRUE;");
    check("rep$1ort;", "Insert missing arguments: \"\",0", "report \"\",0;");
    check("Mo$1veL p10;", "Insert missing arguments: v100,fine,tool0", "MoveL p10,v100,fine,tool0;");
    check("Clk$1Start;", "Insert missing arguments: timer", "ClkStart timer;");
    check("report \"a\",Ab$1s();", "Insert missing arguments: 0", "report \"a\",Abs(0);");
    const Program complete({inMain("rep$1ort \"a\",1;", cell)});
    CHECK(titles(complete, "insert-arguments").empty());
}

TEST_CASE("query: extract instructions with what they need", "[query][refactoring]") {
    const Program p(
        {"MODULE m\n   VAR num total;\n\n   PROC work(num given,PERS tooldata tool)\n      VAR num sum;\n    "
         "  VAR num list{3};\n"
         "      $1FOR i FROM 1 TO 3 DO\n         sum:=sum+list{i}+given;\n      ENDFOR\n      total:=sum;\n  "
         "    MoveL p,v100,fine,tool;$2\n      TPWrite \"a\"\\Num:=sum;\n   ENDPROC\n"
         "   CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nENDMODULE\n"});
    const std::string text = after(p, "Extract procedure", 1, 2);
    contains(text, "      VAR num list{3};\n      extracted1 given,tool,sum,list;\n      TPWrite");
    contains(text, "   ENDPROC\n\n   PROC extracted1(num given,PERS tooldata tool,INOUT num sum,num "
                   "list{*})\n      FOR i FROM 1 TO 3 DO\n"
                   "         sum:=sum+list{i}+given;\n      ENDFOR\n      total:=sum;\n      MoveL "
                   "p,v100,fine,tool;\n   ENDPROC\n");
}

TEST_CASE("query: instructions that cannot leave their routine are not extracted", "[query][refactoring]") {
    for (const char* body : {"$1RETURN;$2", "$1here:\nTPErase;$2\nGOTO here;", "$1IF Present(o) TPErase;$2",
                             "TPErase;\nERROR\n$1RETRY;$2", "IF TRUE THEN\n$1TPErase;\nENDIF\nTPEra$2se;"}) {
        INFO(body);
        const Program p({"MODULE m\nPROC main(\\num o)\n" + std::string(body) + "\nENDPROC\nENDMODULE\n"});
        CHECK(titles(p, "extract-routine", 1, 2).empty());
    }
    const Program inner({inMain("IF TRUE THEN\n$1TPErase;\nTPErase;\n$2ENDIF")});
    contains(after(inner, "Extract procedure", 1, 2), "IF TRUE THEN\nextracted1;\nENDIF");
}

TEST_CASE("query: inline a constant", "[query][refactoring]") {
    const Program p({"MODULE m\nCONST num base:=2;\n! The limit.\nCONST num li$1mit:=base+3; ! in mm\nVAR "
                     "num x:=1;\nPROC main()\nx:=2*limit;\nIF x>Limit x:=1;\nENDPROC\nENDMODULE\n"});
    const std::string text = after(p, "Inline constant 'limit'");
    contains(text, "x:=2*(base+3);\nIF x>(base+3) x:=1;");
    contains(text, "! The limit.\nVAR num x:=1;");
    const Program parts({inMain(
        "x:=p$1.trans.x;",
        "VAR num x;\nCONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n")});
    CHECK(titles(parts, "inline-constant").empty());
}

TEST_CASE("query: change the kind of data as its uses allow", "[query][refactoring]") {
    const Program p(
        {"MODULE m\nVAR num wri$1tten;\nVAR num re$2ad;\nCONST num si$3ze:=3;\nPERS tooldata "
         "to$4ol:=[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nVAR num list{size};\n"
         "PROC main()\nwritten:=read;\nMoveL p,v100,fine,tool;\nlist{1}:=1;\nENDPROC\n"
         "CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nENDMODULE\n"});
    CHECK(titles(p, "convert-data", 1) == Lines{"Make 'written' PERS"});
    CHECK(titles(p, "convert-data", 2) == Lines{"Make 'read' CONST", "Make 'read' PERS"});
    CHECK(titles(p, "convert-data", 3).empty());
    CHECK(titles(p, "convert-data", 4).empty());
    contains(after(p, "Make 'read' CONST", 2, 2), "CONST num read:=0;");
    contains(after(p, "Make 'written' PERS", 1, 1), "PERS num written:=0;");
}

TEST_CASE("query: sort the targets around", "[query][refactoring]") {
    const std::string value = ":=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];";
    const auto target = [&](const char* name) { return std::string("   CONST robtarget ") + name + value; };
    const Program p({"MODULE m\n" + target("p20") + " ! last\n   CONST robtarget p$13" + value + "\n" +
                     target("p10") + "\n   VAR num n;\n" + target("a") + "\nENDMODULE\n"});
    CHECK(after(p, "Sort 3 targets by name") == "MODULE m\n" + target("p3") + "\n" + target("p10") + "\n" +
                                                    target("p20") + " ! last\n   VAR num n;\n" + target("a") +
                                                    "\nENDMODULE\n");
    const Program sorted(
        {"MODULE m\n   CONST robtarget p$11" + value + "\n" + target("p2") + "\nENDMODULE\n"});
    CHECK(titles(sorted, "sort-targets").empty());
}

TEST_CASE("query: add the handlers that a routine lacks, in their order", "[query][refactoring]") {
    const Program p({"MODULE m\n   PROC ma$1in()\n      TPErase;\n   ENDPROC\n   FUNC num f$2()\n      "
                     "RETURN 1;\n   ERROR\n      RETURN 2;\n   ENDFUNC\nENDMODULE\n"});
    CHECK(titles(p, "add-handler", 1) ==
          Lines{"Add ERROR handler", "Add UNDO handler", "Add BACKWARD handler"});
    CHECK(titles(p, "add-handler", 2) == Lines{"Add UNDO handler"});
    contains(after(p, "Add ERROR handler"), "      TPErase;\n   ERROR\n      RAISE;\n   ENDPROC");
    after(p, "Add UNDO handler");
    after(p, "Add BACKWARD handler");
    after(p, "Add UNDO handler", 2, 2);
    const Program all({"MODULE m\nPROC ma$1in()\nTPErase;\nUNDO\nTPErase;\nENDPROC\nENDMODULE\n"});
    contains(after(all, "Add ERROR handler"), "TPErase;\nERROR\n   RAISE;\nUNDO\n");
    contains(after(all, "Add BACKWARD handler"), "TPErase;\nBACKWARD\n");
}

// Issue 19, code actions: "add missing handler". It is missed where an instruction can fail, so it is offered there, too.
TEST_CASE("query: an instruction offers the ERROR handler that its routine lacks", "[query][refactoring]") {
    const Program p(
        {"MODULE m\n   VAR num n$3;\n   PROC main()\n      Lo$1ad \"x.mod\";\n   ENDPROC\n   PROC "
         "safe()\n      Lo$2ad \"x.mod\";\n   ERROR\n      RETURN;\n   ENDPROC\nENDMODULE\n"});
    CHECK(titles(p, "add-handler", 1) == Lines{"Add ERROR handler"});
    contains(after(p, "Add ERROR handler"),
             "Load \"x.mod\";\n   ERROR\n      RAISE;\n   ENDPROC\n   PROC safe");
    CHECK(titles(p, "add-handler", 2).empty());
    CHECK(titles(p, "add-handler", 3).empty());
}

// Issue 19, code actions: "teach values into PERS". A value that is written out gets a name; PERS, so that ModPos can change it.
TEST_CASE("query: a value that is written out becomes data", "[query][refactoring]") {
    const Program p({"MODULE m\nCONST robtarget "
                     "p10:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\n"
                     "MoveL [[4$100,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
                     "WaitTime $20.5$3;\nENDPROC\nENDMODULE\n"});
    const std::string taught = after(p, "Teach the value into PERS robtarget 'p20'");
    contains(taught, "PERS robtarget p20:=[[400,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n");
    contains(taught, "MoveL p20,v100,fine,tool0;");
    contains(after(p, "Extract constant 'p20'"), "CONST robtarget p20:=[[400,0,500]");
    // A number only when it is selected as a whole.
    CHECK(titles(p, "teach-value", 2, 2) == Lines{});
    contains(after(p, "Teach the value into PERS num 'value1'", 2, 3), "PERS num value1:=0.5;\n");
}

TEST_CASE("query: values that must stay where they are", "[query][refactoring]") {
    // Initial values and labels need constants; names may mean another thing in the module.
    const Program p({"MODULE m\nVAR pos start:=[1$1,2,3];\nPROC main()\nVAR num i;\nVAR pos p:=[4$2,5,6];\n"
                     "TEST i\nCASE $31$4:\ni:=2;\nENDTEST\np:=[i$5,2,3];\nENDPROC\nENDMODULE\n"});
    CHECK(titles(p, "teach-value", 1, 1) == Lines{});
    CHECK(titles(p, "teach-value", 2, 2) == Lines{});
    CHECK(titles(p, "teach-value", 3, 4) == Lines{});
    CHECK(titles(p, "teach-value", 5, 5) == Lines{});
}

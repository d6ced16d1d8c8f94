// While a line is being typed the rest of the text keeps its tree: for every prefix of a statement or declaration there
// are few diagnostics, and all declarations around it are still there.

#include "syntax_test.h"

#include "frontend/syntax/ast.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace rapid;

namespace {

/// Names of the declarations of the first module, with the kinds of statements in the bodies of its routines.
std::string outline(const syntax::SyntaxTree& tree) {
    std::string out;
    for (const syntax::ModuleDecl* module : tree.modules) {
        for (const syntax::Decl* decl : module->decls) {
            if (decl->kind == syntax::NodeKind::Routine) {
                const auto* routine = static_cast<const syntax::RoutineDecl*>(decl);
                out += std::string(tree.text(routine->name)) + " ";
            } else if (decl->kind == syntax::NodeKind::Data) {
                out += std::string(tree.text(static_cast<const syntax::DataDecl*>(decl)->name)) + " ";
            } else if (decl->kind == syntax::NodeKind::Record) {
                out += std::string(tree.text(static_cast<const syntax::RecordDecl*>(decl)->name)) + " ";
            }
        }
    }
    return out;
}

/// The text that follows is that of a usual module: instructions, blocks, a handler, other routines.
struct Frame {
    const char* before;
    const char* after;
    const char* names;
};

void typeInto(const Frame& frame, const std::vector<const char*>& lines, size_t mostDiagnostics) {
    for (const char* line : lines) {
        const std::string whole = line;
        for (size_t length = 0; length <= whole.size(); ++length) {
            const std::string text = frame.before + whole.substr(0, length) + frame.after;
            const test::Parsed parsed = test::parseText(text);
            INFO("typed: " << whole.substr(0, length) << "\n" << parsed.shown());
            CHECK(parsed.sink.all().size() <= mostDiagnostics);
            CHECK(outline(*parsed.tree) == frame.names);
            CHECK(syntax::printSource(*parsed.tree) == text);
        }
    }
}

const std::vector<const char*> kStatements = {
    "count := count + limits{2}.x * (1 - sin(30));",
    "limits{count, 2} := [[1,2,3],[1,0,0,0]];",
    "MoveL Offs(pPick,0,0,50), v200, z10, tGrip\\WObj:=wobjCell;",
    "MoveAbsJ home\\NoEOffs, v1000, fine, tool0;",
    "TPWrite \"parts: \"\\Num:=count;",
    "WaitDI diReady, 1\\MaxTime:=5\\TimeFlag:=late;",
    "WaitUntil diReady = 1 AND NOT late;",
    "%\"routine\" + NumToStr(count,0)% count, \\fast;",
    "IF count > 3 SetDO doLamp, 1;",
    "IF count > 3 THEN SetDO doLamp, 1; ENDIF",
    "FOR i FROM 1 TO 10 STEP 2 DO Incr count; ENDFOR",
    "WHILE count < 3 DO Incr count; ENDWHILE",
    "TEST count CASE 1, 2: Incr count; DEFAULT: Stop; ENDTEST",
    "CONNECT alarm WITH tAlarm;",
    "GOTO again;",
    "again:",
    "RETURN;",
    "RAISE ERR_USER;",
    "other count, \\fast?slow;",
    "reg1 := Present(slow);",
    "! a comment",
    "<SMT>",
};

const std::vector<const char*> kBlocks = {
    "IF count > 3 THEN\n    Incr count;\n  ELSEIF count = 2 THEN\n    Stop;\n  ELSE\n    x := 1;\n  ENDIF",
    "FOR i FROM 1 TO 10 DO\n    Incr count;\n  ENDFOR",
    "WHILE count < 3 DO\n    Incr count;\n  ENDWHILE",
    "TEST count\n  CASE 1:\n    Incr count;\n  DEFAULT:\n    Stop;\n  ENDTEST",
};

const std::vector<const char*> kData = {
    "VAR num total := 1 + 2;",
    "CONST robtarget p := [[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
    "VAR string names{3, 2};",
};

} // namespace

TEST_CASE("a statement that is being typed at the end of a routine", "[syntax][typing]") {
    const Frame frame = {
        "MODULE m\nVAR num count;\nPROC first()\n  Stop;\nENDPROC\nPROC main()\n  Stop;\n  ",
        "\nENDPROC\nFUNC num last(num a)\n  RETURN a;\nENDFUNC\nTRAP tAlarm\n  Stop;\nENDTRAP\nENDMODULE\n",
        "count first main last tAlarm "};
    typeInto(frame, kStatements, 2);
    typeInto(frame, kBlocks, 2);
    typeInto(frame, kData, 2);
}

TEST_CASE("a statement that is being typed between others", "[syntax][typing]") {
    const Frame frame = {
        "MODULE m\nPROC main()\n  Stop;\n  ",
        "\n  count := 1;\n  MoveL p1, v100, fine, tool0;\n  IF a THEN\n    Stop;\n  ENDIF\nERROR\n  "
        "RETRY;\nENDPROC\nPROC last()\nENDPROC\nENDMODULE\n",
        "main last "};
    typeInto(frame, kStatements, 2);
    typeInto(frame, kBlocks, 2);
}

TEST_CASE("a statement that is being typed in nested blocks", "[syntax][typing]") {
    const Frame frame = {
        "MODULE m\nPROC main()\n  WHILE TRUE DO\n    IF a THEN\n      ",
        "\n    ELSE\n      Stop;\n    ENDIF\n  ENDWHILE\nENDPROC\nPROC last()\nENDPROC\nENDMODULE\n",
        "main last "};
    typeInto(frame, kStatements, 2);
    typeInto(frame, kBlocks, 2);
}

TEST_CASE("a declaration that is being typed in a module", "[syntax][typing]") {
    const Frame frame = {"MODULE m\nVAR num before;\n",
                         "\nVAR num after;\nPROC last()\n  Stop;\nENDPROC\nENDMODULE\n", ""};
    const std::vector<const char*> lines = {
        "LOCAL PERS tooldata t := [TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];",
        "TASK PERS num n{2} := [1,2];",
        "CONST num c := 1;",
        "ALIAS num level;",
        "RECORD part\n  num x;\n  pos y;\nENDRECORD",
        "PROC work(num a, VAR num b{*} \\switch on | switch off, \\num c)\n  Stop;\nENDPROC",
        "FUNC num twice(num a)\n  RETURN 2 * a;\nENDFUNC",
        "LOCAL TRAP tStop\n  Stop;\nENDTRAP",
    };
    for (const char* line : lines) {
        const std::string whole = line;
        for (size_t length = 0; length <= whole.size(); ++length) {
            const test::Parsed parsed = test::parseText(frame.before + whole.substr(0, length) + frame.after);
            INFO("typed: " << whole.substr(0, length) << "\n" << parsed.shown());
            CHECK(parsed.sink.all().size() <= 3); // a routine without its end takes what follows
            const std::string names = outline(*parsed.tree);
            CHECK(names.starts_with("before "));
            CHECK(names.ends_with("last "));
        }
    }
}

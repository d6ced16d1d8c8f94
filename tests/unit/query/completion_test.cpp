// Completion: what is offered follows from the type that is expected (editor contract 8).

#include "query_testing.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

std::vector<std::string> labels(const CompletionList& list, bool fittingOnly = false) {
    std::vector<std::string> found;
    for (const CompletionItem& item : list.items)
        if (!fittingOnly || item.fits) found.push_back(item.label);
    return found;
}

CompletionList complete(const Program& program, int marker = 1) {
    return completionAt(program.snapshot(), program.file(marker), program.offset(marker));
}

bool has(const CompletionList& list, std::string_view label) {
    return std::any_of(list.items.begin(), list.items.end(),
                       [&](const CompletionItem& item) { return item.label == label; });
}

const CompletionItem& item(const CompletionList& list, std::string_view label) {
    const auto found = std::find_if(list.items.begin(), list.items.end(),
                                    [&](const CompletionItem& i) { return i.label == label; });
    REQUIRE(found != list.items.end());
    return *found;
}

constexpr std::string_view kCell =
    "CONST robtarget p10:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "PERS tooldata gripper:=[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
    "PERS wobjdata table:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n"
    "CONST speeddata slow:=[10,10,10,10];\nVAR num count;\nVAR string text;\n";

} // namespace

TEST_CASE("query: arguments of a movement by their type", "[query][completion]") {
    const Program program({inMain("MoveL p10,$1;\nMoveL p10,v100,$2;\nMoveL p10,v100,fine,$3;\n"
                                  "MoveL $4\nMoveL p10,v100,fine,gripper\\WObj:=$5;",
                                  kCell)});
    const CompletionList speed = complete(program, 1);
    CHECK(has(speed, "v100"));
    CHECK(has(speed, "slow"));
    CHECK_FALSE(has(speed, "z10"));
    CHECK_FALSE(has(speed, "count"));
    CHECK_FALSE(has(speed, "MoveJ"));
    CHECK(speed.items.front().label == "slow"); // what the program declares comes before what is predefined
    const CompletionList zone = complete(program, 2);
    CHECK(has(zone, "fine"));
    CHECK(has(zone, "z10"));
    CHECK_FALSE(has(zone, "v100"));
    const CompletionList tool = complete(program, 3);
    CHECK(has(tool, "gripper"));
    CHECK(has(tool, "tool0"));
    CHECK_FALSE(has(tool, "table"));
    const CompletionList point = complete(program, 4);
    CHECK(has(point, "p10"));
    CHECK(has(point, "CRobT"));
    CHECK_FALSE(has(point, "v100"));
    const CompletionList frame = complete(program, 5);
    CHECK(has(frame, "table"));
    CHECK(has(frame, "wobj0"));
    CHECK_FALSE(has(frame, "gripper"));
}

TEST_CASE("query: an argument after a comma that ends its line, before other instructions",
          "[query][completion]") {
    const Program program(
        {inMain("MoveL p10,$1\nStop;\nMoveL p10,v100, $2\nTPWrite \"x\";\nMoveL p10,v100,fine,\n$3TPWrite "
                "\"y\";\np10.$4\nStop;",
                kCell)});
    CHECK(complete(program, 1).items.front().label == "slow");
    CHECK_FALSE(has(complete(program, 1), "MoveJ"));
    CHECK(has(complete(program, 2), "z10"));
    CHECK_FALSE(has(complete(program, 2), "TPWrite"));
    CHECK(has(complete(program, 3), "TPWrite")); // the next line begins an instruction
    CHECK(labels(complete(program, 4)) == std::vector<std::string>{"trans", "rot", "robconf", "extax"});
}

TEST_CASE("query: instructions that the program uses come before others", "[query][completion]") {
    const Program program({inMain("MoveL p10,v100,fine,gripper;\nWaitTime 1;\nm$1\ncount:=a$2;", kCell),
                           "MODULE other\nPROC more()\nVAR num n;\nn:=ACos(1);\nENDPROC\nENDMODULE\n"});
    const auto moves = labels(complete(program, 1));
    REQUIRE(moves.size() > 3);
    CHECK(moves[0] == "main");
    CHECK(moves[1] == "more");
    CHECK(moves[2] == "MoveL");
    CHECK(labels(complete(program, 2)).front() == "ACos");
}

TEST_CASE("query: nothing is offered after the last required argument", "[query][completion]") {
    const Program program({inMain("shift 1,$1;\nshift 1,$2\nStop;\ncount:=Abs(1,$3);\nshift 1,\\$4;",
                                  "VAR num count;\nPROC shift(num by\\switch fast)\nENDPROC")});
    for (const int marker : {1, 2, 3})
        CHECK(complete(program, marker).items.empty());
    CHECK(labels(complete(program, 4)) == std::vector<std::string>{"fast"});
}

TEST_CASE("query: names that begin with the letters typed come first", "[query][completion]") {
    const Program program(
        {inMain("mo$1\nstop$2\ncount:=a$3;", "VAR num count;\nVAR num myOffset;\nVAR num xAbs;")});
    const auto moves = labels(complete(program, 1));
    CHECK(moves.front().starts_with("Mo"));
    const auto other = std::find(moves.begin(), moves.end(), "myOffset");
    REQUIRE(other != moves.end());
    CHECK(std::find(moves.begin(), other, "MoveL") != other);
    CHECK(complete(program, 2).items.front().label == "Stop"); // written whole
    const auto values = labels(complete(program, 3));
    const auto scattered = std::find(values.begin(), values.end(), "xAbs");
    REQUIRE(scattered != values.end());
    CHECK(std::find(values.begin(), scattered, "Abs") != scattered);
}

TEST_CASE("query: a declaration does not offer its own name as its value", "[query][completion]") {
    const Program program({inMain("VAR num own:=$1;\nFOR loop FROM $2 TO 3 DO\nENDFOR",
                                  "VAR num count;\nCONST num limit:=$3;")});
    CHECK(has(complete(program, 1), "count"));
    CHECK_FALSE(has(complete(program, 1), "own"));
    CHECK(has(complete(program, 2), "own"));
    CHECK_FALSE(has(complete(program, 2), "loop"));
    CHECK_FALSE(has(complete(program, 3), "limit"));
}

TEST_CASE("query: speeds are offered in the order of their numbers", "[query][completion]") {
    const Program program({inMain("MoveL p10,v$1", kCell)});
    const auto found = labels(complete(program));
    const auto at = [&](std::string_view name) {
        return std::find(found.begin(), found.end(), name) - found.begin();
    };
    CHECK(at("v50") < at("v100"));
    CHECK(at("v100") < at("v1000"));
}

TEST_CASE("query: letters are replaced", "[query][completion]") {
    const Program program({inMain("MoveL p10,v10$1,fine,gripper;\n  Mov$2", kCell)});
    const CompletionList speed = complete(program);
    CHECK(program.file().text().substr(speed.replace.begin, speed.replace.end - speed.replace.begin) ==
          "v10");
    CHECK(has(speed, "v1000"));
    CHECK_FALSE(has(speed, "vmax"));
    const CompletionList move = complete(program, 2);
    CHECK(move.replace.end - move.replace.begin == 3);
    CHECK(item(move, "MoveL").snippet == "MoveL ${1:ToPoint},${2:Speed},${3:Zone},${4:Tool};$0");
    CHECK(item(move, "MoveL").insertText == "MoveL");
}

TEST_CASE("query: optional arguments that are neither given nor excluded", "[query][completion]") {
    const std::string routine =
        "PROC report(string text\\num count\\switch loud|switch quiet,num level\\bool last)\n"
        "ENDPROC\n";
    const Program program({inMain("report \"a\"\\$1;\nreport \"a\"\\count:=1\\$2;\nreport \"a\"\\loud\\$3;\n"
                                  "report \"a\",1\\$4;\nreport \"a\"\\$5\\loud,1;\nMoveL p10,v100\\$6",
                                  std::string(kCell) + routine)});
    CHECK(labels(complete(program, 1)) == std::vector<std::string>{"count", "loud", "quiet"});
    CHECK(labels(complete(program, 2)) == std::vector<std::string>{"loud", "quiet"});
    CHECK(labels(complete(program, 3)) == std::vector<std::string>{"count", "last"}); // none is in order
    CHECK(labels(complete(program, 4)) == std::vector<std::string>{"last"});
    CHECK(labels(complete(program, 5)) == std::vector<std::string>{"count"});
    const CompletionList speed = complete(program, 6);
    CHECK(labels(speed) == std::vector<std::string>{"V", "T", "KeepStartPath", "KeepEndPath"});
    CHECK(item(speed, "V").insertText == "V:=");
    CHECK(item(complete(program, 1), "loud").insertText == "loud");
}

TEST_CASE("query: components after a dot, even of what is not complete", "[query][completion]") {
    const Program program(
        {inMain("count:=p10.$1;\ncount:=p10.trans.$2\ncount:=points{1}.tr$3;\nrec.$4\nnothing.$5",
                std::string(kCell) + "RECORD part\nnum width;\nstring name;\nENDRECORD\n"
                                     "VAR part rec;\nVAR robtarget points{3};\n")});
    CHECK(labels(complete(program, 1)) == std::vector<std::string>{"trans", "rot", "robconf", "extax"});
    CHECK(labels(complete(program, 2)) == std::vector<std::string>{"x", "y", "z"});
    CHECK(labels(complete(program, 3)) == std::vector<std::string>{"trans"});
    CHECK(labels(complete(program, 4)) == std::vector<std::string>{"width", "name"});
    CHECK(labels(complete(program, 5)).empty());
}

TEST_CASE("query: instructions, keywords and data begin a statement", "[query][completion]") {
    const Program program({inMain("VAR num own;\n$1\ncount:=1;", kCell)});
    const CompletionList list = complete(program);
    CHECK(has(list, "TPWrite"));
    CHECK(has(list, "count"));
    CHECK(has(list, "own"));
    CHECK(item(list, "IF").snippet.find("ENDIF") != std::string::npos);
    CHECK(item(list, "FOR").snippet.find("ENDFOR") != std::string::npos);
    CHECK(item(list, "IF").insertText == "IF ");
    CHECK(has(list, "ERROR"));
    CHECK_FALSE(has(list, "Abs"));  // functions are not instructions
    CHECK_FALSE(has(list, "v100")); // constants are not assigned
    CHECK_FALSE(has(list, "p10"));
}

TEST_CASE("query: declarations and modules", "[query][completion]") {
    const Program program({"MODULE m\n$1\nPROC main()\nENDPROC\n$2\nENDMODULE\n", "$3"});
    const CompletionList first = complete(program, 1), later = complete(program, 2);
    for (const char* word : {"PROC", "FUNC", "TRAP", "VAR", "PERS", "CONST", "RECORD", "LOCAL"}) {
        CHECK(has(first, word));
        CHECK(has(later, word));
    }
    CHECK_FALSE(has(first, "TPWrite"));
    CHECK(item(first, "PROC").snippet.find("ENDPROC") != std::string::npos);
    CHECK(has(complete(program, 3), "MODULE"));
}

TEST_CASE("query: types where types are expected", "[query][completion]") {
    const Program program({"MODULE m\nRECORD part\n$1\nENDRECORD\nVAR $2\nPROC a($3)\nENDPROC\n"
                           "FUNC $4 f()\nRETURN 1;\nENDFUNC\nPROC b(VAR $5)\nENDPROC\nENDMODULE\n"});
    for (int marker = 1; marker <= 5; ++marker) {
        INFO(marker);
        const CompletionList list = complete(program, marker);
        CHECK(has(list, "num"));
        CHECK(has(list, "robtarget"));
        CHECK_FALSE(has(list, "v100"));
        CHECK_FALSE(has(list, "anytype"));
        CHECK(has(list, "VAR") == (marker == 3));
    }
}

TEST_CASE("query: no names where a new one is chosen, and none in comments and numbers",
          "[query][completion]") {
    const Program program(
        {"MODULE m\nVAR num $1\nPROC main()\nVAR string a$2;\n! about $3\nTPWrite \"te$4xt\";\n"
         "TPWrite 12$5;\nENDPROC\nPROC $6\nENDMODULE\n"});
    for (int marker = 1; marker <= 6; ++marker) {
        INFO(marker);
        CHECK(labels(complete(program, marker)).empty());
    }
}

TEST_CASE("query: signals of the right kind", "[query][completion]") {
    sema::CheckOptions options;
    options.signals = {
        {"do_grip", "signaldo"}, {"di_ready", "signaldi"}, {"go_speed", "signalgo"}, {"ao_flow", "signalao"}};
    options.configurationKnown = true;
    const Program program({inMain("SetDO $1;\nWaitDI $2\nSetGO $3\nSetAO $5\nIF $4")}, {}, options);
    CHECK(labels(complete(program, 1)) == std::vector<std::string>{"do_grip"});
    CHECK(labels(complete(program, 2)) == std::vector<std::string>{"di_ready"});
    CHECK(labels(complete(program, 3)) == std::vector<std::string>{"go_speed"});
    CHECK(has(complete(program, 4), "di_ready"));
    CHECK(labels(complete(program, 5)) == std::vector<std::string>{"ao_flow"});
}

TEST_CASE("query: expected types of operands, indices, aggregates and results", "[query][completion]") {
    const Program program(
        {"MODULE m\n" + std::string(kCell) +
         "VAR num list{3};\nVAR bool done;\nCONST robtarget p20:=[p10.trans,$1];\n"
         "CONST orient turned:=[1,0,0,0];\n"
         "FUNC string named()\nRETURN $2;\nENDFUNC\n"
         "PROC main()\ncount:=list{$3};\nIF text=$4\nWHILE $5\nTEST text\nCASE $6:\nENDTEST\n"
         "done:=count>1 AND $7;\nRAISE $8;\nENDPROC\nENDMODULE\n"});
    CHECK(has(complete(program, 1), "turned"));
    CHECK_FALSE(has(complete(program, 1), "count"));
    CHECK(item(complete(program, 2), "text").fits);
    CHECK_FALSE(has(complete(program, 2), "count"));
    CHECK(item(complete(program, 3), "count").fits);
    CHECK_FALSE(has(complete(program, 3), "text"));
    CHECK(item(complete(program, 4), "text").fits);
    CHECK_FALSE(has(complete(program, 4), "count"));
    CHECK(item(complete(program, 5), "done").fits);
    CHECK(item(complete(program, 6), "text").fits);
    CHECK_FALSE(has(complete(program, 6), "count"));
    CHECK(item(complete(program, 7), "done").fits);
    CHECK(complete(program, 8).items.front().detail == "CONST errnum");
    CHECK(item(complete(program, 8), "ERR_DIVZERO").fits);
}

TEST_CASE("query: names are seen as the scopes of RAPID say", "[query][completion]") {
    const Program program(
        {"MODULE a\nLOCAL VAR num hidden;\nVAR num shown;\nPROC main()\nVAR num inner;\n"
         "FOR i FROM 1 TO 2 DO\n$1:=1;\nshown:=$2;\nENDFOR\nshown:=$3;\nENDPROC\n"
         "PROC other()\nVAR num elsewhere;\nENDPROC\nENDMODULE\n",
         "MODULE b\nLOCAL VAR num ofB;\nVAR num globalOfB;\nLOCAL PROC notHere()\nENDPROC\nENDMODULE\n"});
    const CompletionList start = complete(program, 1), inLoop = complete(program, 2),
                         after = complete(program, 3);
    for (const char* name : {"hidden", "shown", "inner", "globalOfB"}) {
        CHECK(has(start, name));
        CHECK(has(inLoop, name));
    }
    for (const char* name : {"elsewhere", "ofB", "notHere"}) {
        CHECK_FALSE(has(start, name));
        CHECK_FALSE(has(inLoop, name));
    }
    CHECK(has(inLoop, "i"));
    CHECK_FALSE(has(after, "i"));
    CHECK_FALSE(has(start, "i")); // a loop variable cannot be assigned
}

TEST_CASE("query: traps, labels and late-bound procedures", "[query][completion]") {
    const Program program(
        {inMain("VAR intnum i;\nCONNECT i WITH $1;\nstart:\nGOTO $2;\n%\"pr$3\"%;\nCONNECT $4",
                "TRAP alarm\nENDTRAP\nPROC proc1()\nENDPROC\n")});
    CHECK(labels(complete(program, 1)) == std::vector<std::string>{"alarm"});
    CHECK(labels(complete(program, 2)) == std::vector<std::string>{"start"});
    CHECK(has(complete(program, 3), "proc1"));
    CHECK_FALSE(has(complete(program, 3), "alarm"));
    CHECK(has(complete(program, 4), "i"));
    CHECK_FALSE(has(complete(program, 4), "alarm"));
}

TEST_CASE("query: one of several required parameters", "[query][completion]") {
    sema::CheckOptions options;
    options.signals = {{"di_found", "signaldi"}};
    const Program program({inMain("SearchL \\Stop,$1", "PERS bool found:=FALSE;\nVAR bool other;\n")}, {},
                          options);
    CHECK(has(complete(program), "di_found"));
    CHECK(has(complete(program), "found"));
    CHECK_FALSE(has(complete(program), "other")); // not a persistent
}

TEST_CASE("query: completion at the end of a text that is being written", "[query][completion]") {
    const std::pair<const char*, const char*> cases[] = {
        {"MODULE m\nRECORD part\nstring name;\nd$1", "dnum"},
        {"MODULE m\nRECORD part\n$1", "num"},
        {"MODULE m\nPROC main()\nVAR num count;\nTP$1", "TPWrite"},
        {"MODULE m\nPROC main()\nVAR num count;\ncount:=c$1", "count"},
        {"MODULE m\nPROC main()\nVAR n$1", "num"},
        {"MODULE m\nFUNC num f(num given)\nRETURN g$1", "given"},
        {"MODULE m\nPROC main()\nFOR i FROM 1 TO 3 DO\nTPWrite \"\"\\Num:=$1", "i"},
        {"MODULE m\nPROC main(string s)\nTEST s\nCASE $1", "s"},
        {"MODULE m\nPROC main()\nIF TRUE TP$1", "TPWrite"},
        {"MODULE m\nPROC main()\nIF TRUE $1", "THEN"},
        {"MODULE m\nPROC main()\nEraseModule \"$1\";\nENDPROC\nENDMODULE\nMODULE other\nENDMODULE\n",
         "other"},
        {"MODULE m\nPROC main(\\num o,\\switch s)\nIF Present($1)", "s"},
        {"MODULE m\nPROC inner(\\switch a)\nENDPROC\nPROC main(\\num o\\switch s)\ninner \\a?$1", "s"},
        {"MODULE m\nPROC main()\n! text\n$1", "IF"},
        {"MOD$1", "MODULE"},
    };
    for (const auto& [text, expected] : cases) {
        INFO(text);
        const Program program({text});
        CHECK(has(complete(program), expected));
    }
    const Program present({"MODULE m\nPROC main(\\num o\\switch s,num r)\nVAR num v;\nIF Present($1)"});
    CHECK(labels(complete(present)) == std::vector<std::string>{"o", "s"});
}

TEST_CASE("query: a new point is declared with its first use", "[query][completion]") {
    const Program program({inMain("MoveL $1\nMoveL pick$2,v100", kCell)});
    const CompletionList list = complete(program);
    const CompletionItem& next = item(list, "p20");
    CHECK(next.kind == ItemKind::NewData);
    REQUIRE(next.edits.size() == 1);
    CHECK(next.edits[0].replacement ==
          "\nCONST robtarget p20:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];");
    CHECK(item(complete(program, 2), "pick").kind == ItemKind::NewData);
}

TEST_CASE("query: documentation of an item is found by its key", "[query][completion]") {
    const Program program({inMain("$1", "! Counts parts.\n! In both boxes.\nPROC countParts()\nENDPROC\n")});
    const CompletionList list = complete(program);
    const ItemDocumentation own = resolveItem(program.snapshot(), item(list, "countParts").key);
    CHECK(own.declaration == "PROC countParts()");
    CHECK(own.markdown == "Counts parts.\nIn both boxes.");
    const ItemDocumentation move = resolveItem(program.snapshot(), item(list, "MoveJ").key);
    CHECK(move.markdown.find("Moves quickly to a position") != std::string::npos);
    CHECK(resolveItem(program.snapshot(), "12:nowhere.mod").markdown.empty());
}

TEST_CASE("query: a cancelled completion ends early", "[query][completion]") {
    const Program program({inMain("count:=$1", kCell)});
    Cancel cancel;
    cancel.request();
    const CompletionList all = complete(program);
    const CompletionList cut =
        completionAt(program.snapshot(), program.file(), program.offset(), {}, &cancel);
    CHECK(cut.items.size() < all.items.size());
}

TEST_CASE("query: a short list holds the best items of the long one", "[query][completion]") {
    std::string declarations(kCell);
    for (int i = 0; i < 300; ++i) // in an order of their own
        declarations += "VAR speeddata Speed" + std::to_string(i * 7 % 300) + ";\nPROC work" +
                        std::to_string(i * 11 % 300) + "()\nENDPROC\n";
    for (char first = 'z'; first >= 'a'; --first) // without numbers, in both cases
        declarations += std::string("VAR speeddata ") + first + "Rate;\nVAR speeddata " +
                        static_cast<char>(first - 32) + "_x12y;\n";
    const Program program({inMain("MoveL p10,$1;\n$2\ncount:=$3;", declarations)});
    for (const int marker : {1, 2, 3}) {
        CompletionOptions all, few;
        all.limit = 100'000;
        few.limit = 25;
        const auto items = [&](const CompletionOptions& options) {
            return completionAt(program.snapshot(), program.file(marker), program.offset(marker), options);
        };
        std::vector<std::string> best = labels(items(all));
        CHECK_FALSE(items(all).incomplete);
        REQUIRE(best.size() > 25);
        best.resize(25);
        CHECK(labels(items(few)) == best);
        CHECK(items(few).incomplete);
    }
}

// Definition, type definition, implementation, references, highlights, renaming (editor contract 11 and 12).

#include "frontend/query/navigation.h"

#include "frontend/edit/apply_edits.h"
#include "frontend/query/renaming.h"
#include "query_testing.h"

#include <catch2/catch.hpp>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

/// "t1_1.modx:3 name" for each place.
std::vector<std::string> show(const std::vector<Location>& places) {
    std::vector<std::string> out;
    for (const Location& place : places)
        out.push_back(
            place.file->path() + ":" + std::to_string(place.file->lineColumn(place.range.begin).line) + " " +
            std::string(place.file->text().substr(place.range.begin, place.range.end - place.range.begin)));
    return out;
}
std::vector<std::string> show(const std::vector<Use>& uses) {
    std::vector<std::string> out;
    for (const Use& use : uses) {
        static constexpr const char* kNames[] = {"declared", "read", "write", "both", "call"};
        out.push_back(use.place.file->path() + ":" +
                      std::to_string(use.place.file->lineColumn(use.place.range.begin).line) + " " +
                      kNames[static_cast<int>(use.access)]);
    }
    return out;
}
using Lines = std::vector<std::string>;

std::vector<std::string> definition(const Program& p, int marker) {
    return show(definitionAt(p.snapshot(), p.file(marker), p.offset(marker)));
}
std::vector<Use> uses(const Program& p, int marker) {
    return usesOf(p.snapshot(), meaningAt(p.snapshot(), p.file(marker), p.offset(marker)));
}
RenameResult rename(const Program& p, int marker, std::string_view name) {
    return renameAt(p.snapshot(), p.file(marker), p.offset(marker), name, p.tasks(), p.options());
}
/// The text of a file after the edits.
std::string after(const RenameResult& result, std::string_view path) {
    CHECK(result.problem == "");
    for (const auto& file : result.files)
        if (file.file->path() == path) return edit::applyEditsToText(file.file->text(), file.edits).bytes;
    return "not changed";
}

} // namespace

TEST_CASE("query: definitions of every kind of name", "[query][navigation]") {
    const Program p({"MODULE m\nRECORD part\nnum width;\nENDRECORD\nVAR part box;\nPROC report(\\num "
                     "count)\nstart:\nGOTO st$1art;\nENDPROC\n"
                     "TRAP alarm\nENDTRAP\nPROC main()\nVAR intnum i;\nCONNECT i WITH "
                     "al$2arm;\nbox.wi$3dth:=1;\nreport \\cou$4nt:=2;\n"
                     "FOR k FROM 1 TO 2 DO\nbox.width:=k$5;\nENDFOR\nVel$6Set 100,1000;\nENDPROC\n"
                     "PROC last(pa$7rt given)\nMoveL p,v1$8,fine,to$9ol0;\nENDPROC\nENDMODULE\n"});
    CHECK(definition(p, 1) == Lines{"t1_1.modx:7 start"});
    CHECK(definition(p, 2) == Lines{"t1_1.modx:10 alarm"});
    CHECK(definition(p, 3) == Lines{"t1_1.modx:3 width"});
    CHECK(definition(p, 4) == Lines{"t1_1.modx:6 count"});
    CHECK(definition(p, 5) == Lines{"t1_1.modx:17 k"});
    const auto predefined = definitionAt(p.snapshot(), p.file(6), p.offset(6));
    REQUIRE(predefined.size() == 1);
    CHECK(predefined[0].isLibrary);
    CHECK(show(predefined)[0].ends_with(" VelSet"));
    CHECK(definition(p, 7) == Lines{"t1_1.modx:2 part"});
    CHECK(definition(p, 8).empty()); // nothing is named v1
    CHECK(definition(p, 9).size() == 1);
}

TEST_CASE("query: type definitions", "[query][navigation]") {
    const Program p({"MODULE m\nRECORD part\nnum width;\nENDRECORD\nALIAS part piece;\nVAR piece box;\nFUNC "
                     "part made()\nRETURN bo$1x;\nENDFUNC\n"
                     "PROC main()\nbox:=ma$2de();\nbox.wid$3th:=1;\nENDPROC\nENDMODULE\n"});
    const auto type = [&](int m) { return show(typeDefinitionAt(p.snapshot(), p.file(m), p.offset(m))); };
    CHECK(type(1) == Lines{"t1_1.modx:5 piece"});
    CHECK(type(2) == Lines{"t1_1.modx:2 part"});
    REQUIRE(type(3).size() == 1);
    CHECK(type(3)[0].ends_with(" num"));
}

TEST_CASE("query: calls by name lead to the procedures they may mean", "[query][navigation]") {
    const Program p({"MODULE m\nVAR num n;\nPROC proc1()\nENDPROC\nPROC proc2()\nENDPROC\nPROC "
                     "procedure()\nENDPROC\nPROC main()\n"
                     "%\"pr$1oc1\"%;\n%\"pr$2oc\"+NumToStr(n,0)%;\nCallByVar "
                     "\"pr$3oc\",n;\npr$4oc2;\nENDPROC\nENDMODULE\n"});
    const auto implementation = [&](int m) {
        return show(implementationAt(p.snapshot(), p.file(m), p.offset(m)));
    };
    CHECK(implementation(1) == Lines{"t1_1.modx:3 proc1"});
    CHECK(implementation(2) == Lines{"t1_1.modx:3 proc1", "t1_1.modx:5 proc2", "t1_1.modx:7 procedure"});
    CHECK(implementation(3) == Lines{"t1_1.modx:3 proc1", "t1_1.modx:5 proc2"});
    CHECK(implementation(4) == Lines{"t1_1.modx:5 proc2"});
    CHECK(definition(p, 1) == Lines{"t1_1.modx:3 proc1"});
}

// Manual 1.1.5: the string contains a procedure name as written in a call; MODULE:NAME means the procedure of that module.
TEST_CASE("query: a call by name with a module leads to its procedure only", "[query][navigation]") {
    const Program p({"MODULE m\nPROC work()\nENDPROC\nPROC main()\n%\"Other:wo$1rk\"%;\n%\"gone:wo$2rk\"%;\n"
                     "ENDPROC\nENDMODULE\n",
                     "MODULE other\nLOCAL PROC idle()\nENDPROC\nPROC work()\nENDPROC\nENDMODULE\n"});
    const auto implementation = [&](int m) {
        return show(implementationAt(p.snapshot(), p.file(m), p.offset(m)));
    };
    CHECK(implementation(1) == Lines{"t1_2.modx:4 work"});
    CHECK(implementation(2).empty());
}

TEST_CASE("query: references of all tasks; a shared persistent is one", "[query][navigation]") {
    const std::string shared = "MODULE shared(SYSMODULE)\nPERS num common:=0;\nENDMODULE\n";
    const Program p = Program::ofTasks({{"MODULE a\nPERS num speed:=1;\nVAR num own;\nPROC "
                                         "main()\nspe$1ed:=own$2;\ncomm$3on:=1;\nENDPROC\nENDMODULE\n",
                                         shared},
                                        {"MODULE b\nPERS num speed;\nVAR num own;\nPROC "
                                         "main()\nown:=speed;\nIncr common;\nENDPROC\nENDMODULE\n",
                                         shared}});
    CHECK(show(uses(p, 1)) ==
          Lines{"t1_1.modx:2 declared", "t1_1.modx:5 write", "t2_1.modx:2 declared", "t2_1.modx:5 read"});
    CHECK(show(uses(p, 2)) == Lines{"t1_1.modx:3 declared", "t1_1.modx:5 read"});
    CHECK(show(uses(p, 3)) == Lines{"t1_1.modx:6 write", "t1_2.modx:2 declared", "t2_1.modx:6 both"});
    CHECK(definition(p, 1) == Lines{"t1_1.modx:2 speed", "t2_1.modx:2 speed"});
}

TEST_CASE("query: references leave out other things of the same name", "[query][navigation]") {
    const Program p({"MODULE m\nVAR num n;\nRECORD r\nnum n;\nENDRECORD\nVAR r rec;\nPROC a(num "
                     "n)\nn:=1;\nENDPROC\nPROC main()\nrec.n:=$1n;\na n;\n"
                     "FOR n FROM 1 TO 2 DO\nTPWrite \"n\"\\Num:=n;\nENDFOR\nENDPROC\nENDMODULE\n"});
    CHECK(show(uses(p, 1)) == Lines{"t1_1.modx:2 declared", "t1_1.modx:11 read", "t1_1.modx:12 read"});
}

TEST_CASE("query: highlights say what is read and written", "[query][navigation]") {
    const Program p({"MODULE m\nVAR num n;\nVAR num list{3};\nPROC main()\nn$1:=n+1;\nIncr "
                     "n;\nlist{n}:=2;\nENDPROC\nENDMODULE\n",
                     "MODULE o\nPROC other()\nn:=1;\nENDPROC\nENDMODULE\n"});
    CHECK(show(highlightsAt(p.snapshot(), p.file(), p.offset())) ==
          Lines{"t1_1.modx:2 declared", "t1_1.modx:5 write", "t1_1.modx:5 read", "t1_1.modx:6 both",
                "t1_1.modx:7 read"});
}

TEST_CASE("query: renaming follows named arguments and Present", "[query][rename]") {
    const Program p(
        {"MODULE m\nPROC report(\\num co$1unt)\nIF Present(count) TPWrite \"count\"\\Num:=Count;\nENDPROC\n"
         "PROC main()\nreport\\count:=1;\nENDPROC\nENDMODULE\n"});
    const RenameResult result = rename(p, 1, "number");
    CHECK(after(result, "t1_1.modx") ==
          "MODULE m\nPROC report(\\num number)\nIF Present(number) TPWrite \"count\"\\Num:=number;\nENDPROC\n"
          "PROC main()\nreport\\number:=1;\nENDPROC\nENDMODULE\n");
    REQUIRE(result.notes.size() == 1);
    CHECK(result.notes[0].text == "the string \"count\" spells the old name and stays as it is");
}

TEST_CASE("query: renaming in all tasks, and of components and modules", "[query][rename]") {
    const Program p =
        Program::ofTasks({{"MODULE a$3\nRECORD part\nnum wid$2th;\nENDRECORD\nPERS num sp$1eed:=1;\nPROC "
                           "main()\nVAR part q;\nq.width:=speed;\nENDPROC\nENDMODULE\n"},
                          {"MODULE b\nPERS num speed;\nPROC main()\nspeed:=2;\nENDPROC\nENDMODULE\n"}});
    const RenameResult speed = rename(p, 1, "velocity");
    CHECK(after(speed, "t1_1.modx").find("q.width:=velocity;") != std::string::npos);
    CHECK(after(speed, "t2_1.modx") ==
          "MODULE b\nPERS num velocity;\nPROC main()\nvelocity:=2;\nENDPROC\nENDMODULE\n");
    const RenameResult width = rename(p, 2, "breadth");
    CHECK(after(width, "t1_1.modx").find("num breadth;\nENDRECORD") != std::string::npos);
    CHECK(after(width, "t1_1.modx").find("q.breadth:=speed;") != std::string::npos);
    CHECK(after(rename(p, 3, "other"), "t1_1.modx").starts_with("MODULE other\n"));
}

// A persistent that tasks share has the same type in all of them (manual 1.20), the names of its components included.
TEST_CASE("query: records of shared persistents are renamed in all tasks", "[query][rename]") {
    const auto task = [](const char* module, const std::string& body, const std::string& marks) {
        return "MODULE " + std::string(module) + "\nRECORD si" + (marks.empty() ? "" : "$2") + "ze\nnum wid" +
               marks + "th;\nENDRECORD\nRECORD part\nsize of;\nENDRECORD\n" +
               "RECORD other\nnum width;\nENDRECORD\nPERS part shared{2}:=[[[1]],[[2]]];\nVAR other o;\nPROC "
               "main()\n" +
               body + "\nENDPROC\nENDMODULE\n";
    };
    const Program p = Program::ofTasks({{task("a", "shared{1}.of.width:=o.width;", "$1")},
                                        {task("b", "o.width:=shared{2}.of.width;", "")},
                                        {"MODULE c\nRECORD size\nnum width;\nENDRECORD\nVAR size s;\n"
                                         "PROC main()\ns.width:=1;\nENDPROC\nENDMODULE\n"}});
    const RenameResult width = rename(p, 1, "breadth");
    CHECK(width.problem == "");
    CHECK(after(width, "t1_1.modx").find("shared{1}.of.breadth:=o.width;") != std::string::npos);
    CHECK(after(width, "t2_1.modx").find("RECORD size\nnum breadth;") != std::string::npos);
    CHECK(after(width, "t2_1.modx").find("o.width:=shared{2}.of.breadth;") != std::string::npos);
    CHECK(width.files.size() == 2); // the third task shares nothing
    const RenameResult size = rename(p, 2, "extent");
    CHECK(size.problem == "");
    CHECK(after(size, "t2_1.modx").find("RECORD extent\nnum width;\nENDRECORD\nRECORD part\nextent of;") !=
          std::string::npos);
    CHECK(size.files.size() == 2);
}

TEST_CASE("query: a record of a module that several tasks load is renamed once", "[query][rename]") {
    const std::string shared =
        "MODULE shared\nRECORD part\nnum wid$1th;\nENDRECORD\nPERS part common:=[0];\nENDMODULE\n";
    const std::string plain =
        "MODULE shared\nRECORD part\nnum width;\nENDRECORD\nPERS part common:=[0];\nENDMODULE\n";
    const std::string use = "\nPROC main()\ncommon.width:=1;\nENDPROC\nENDMODULE\n";
    const Program p = Program::ofTasks({{"MODULE a" + use, shared}, {"MODULE b" + use, plain}});
    const RenameResult width = rename(p, 1, "breadth");
    CHECK(width.problem == "");
    CHECK(width.files.size() == 4);
    for (const char* path : {"t1_1.modx", "t2_1.modx"})
        CHECK(after(width, path).find("common.breadth:=1;") != std::string::npos);
    for (const char* path : {"t1_2.modx", "t2_2.modx"})
        CHECK(after(width, path).find("num breadth;") != std::string::npos);
}

TEST_CASE("query: names that cannot be renamed, and new ones that are refused", "[query][rename]") {
    const Program p(
        {"MODULE m\nVAR num n;\nVAR num taken;\nPROC main()\nVAR num inner;\nn$1:=Abs$2(3$3);\nI$4F TRUE "
         "THEN\nENDIF\n! n$5\nTPWrite \"n$6\";\ninner:=n;\nENDPROC\n"
         "PROC other()\nnothing$7:=1;\nma$8in;\nENDPROC\nENDMODULE\n"});
    for (int marker : {2, 3, 4, 5, 6, 7, 8}) {
        INFO(marker);
        CHECK_FALSE(renameTargetAt(p.snapshot(), p.file(marker), p.offset(marker)).problem.empty());
        CHECK_FALSE(rename(p, marker, "fine1").problem.empty());
    }
    CHECK(renameTargetAt(p.snapshot(), p.file(), p.offset()).problem == "");
    CHECK(renameTargetAt(p.snapshot(), p.file(), p.offset()).name == "n");
    for (const char* name :
         {"", "1a", "a b", "IF", "taken", "TAKEN", "inner", "Abs", "a2345678901234567890123456789012x"}) {
        INFO(name);
        const RenameResult result = rename(p, 1, name);
        CHECK_FALSE(result.problem.empty());
        CHECK(result.files.empty());
    }
    CHECK(rename(p, 1, "a2345678901234567890123456789012").problem == "");
}

TEST_CASE("query: renaming in a program with mistakes", "[query][rename]") {
    const Program p({"MODULE m\nVAR num n;\nPROC main()\nn$1:=1;\nunknown:=n;\nn:=;\nENDPROC\nENDMODULE\n"});
    CHECK(after(rename(p, 1, "k"), "t1_1.modx") ==
          "MODULE m\nVAR num k;\nPROC main()\nk:=1;\nunknown:=k;\nk:=;\nENDPROC\nENDMODULE\n");
}

// A name changes at all its places and means the same; a change of the program is refused.

#include "frontend/edit/apply_edits.h"
#include "frontend/edit/rename.h"
#include "unit/sema/sema_testing.h"

#include <catch2/catch.hpp>

using namespace rapid;

namespace {

using Texts = std::vector<std::string>;

struct Renamed {
    Texts texts; ///< all files in order, changed or not
    std::string problem;
    std::vector<std::string> notes;
};

Renamed renameIn(const std::vector<Texts>& tasks, const std::string& path, const std::string& name,
                 const std::string& type = ".modx") {
    std::vector<sema::TaskInput> inputs;
    Renamed out;
    std::vector<std::string> paths;
    for (size_t t = 0; t < tasks.size(); ++t) {
        sema::TaskInput& input = inputs.emplace_back();
        input.name = "T_ROB" + std::to_string(t + 1);
        for (size_t i = 0; i < tasks[t].size(); ++i) {
            paths.push_back("t" + std::to_string(t) + "m" + std::to_string(i) + type);
            input.files.push_back(std::make_shared<const SourceFile>(paths.back(), tasks[t][i]));
            out.texts.push_back(tasks[t][i]);
        }
    }
    sema::CheckOptions options;
    options.library = sema::testing::library();
    diag::Sink sink;
    auto program = sema::check(inputs, options, sink);
    REQUIRE_FALSE(sink.hasErrors());
    const auto set = edit::rename(std::move(program), inputs, options, path, name);
    out.problem = set.problem;
    out.notes = set.notes;
    for (const auto& file : set.files)
        for (size_t i = 0; i < paths.size(); ++i)
            if (paths[i] == file.file->path()) {
                const auto result = edit::applyEdits(*file.file, file.edits);
                REQUIRE(result.ok());
                out.texts[i] = result.bytes;
            }
    return out;
}

std::string renameOne(const std::string& text, const std::string& path, const std::string& name) {
    const Renamed out = renameIn({{text}}, path, name);
    return out.problem.empty() ? out.texts[0] : "refused: " + out.problem;
}

std::string body(const std::string& lines) {
    return "MODULE m\nVAR num glob;\nPROC p()\n" + lines + "\nENDPROC\nENDMODULE\n";
}

} // namespace

TEST_CASE("data are renamed in declaration and uses, in every case, and nothing else", "[edit][rename]") {
    CHECK(renameOne("MODULE m\n! glob\nVAR num Glob := 1 ;\nPROC p()\n  GLOB:=glob+1; ! glob\n  TPWrite "
                    "\"Num:=glob\";"
                    "\n TPWrite \"\"\\Num:=glob;\nENDPROC\nENDMODULE\n",
                    "glob", "count") == "MODULE m\n! glob\nVAR num count := 1 ;\nPROC p()\n  count:=count+1; "
                                        "! glob\n  TPWrite \"Num:=glob\";"
                                        "\n TPWrite \"\"\\Num:=count;\nENDPROC\nENDMODULE\n");
}

TEST_CASE("a local name does not touch the global one it hides", "[edit][rename]") {
    const std::string text =
        "MODULE m\nVAR num x;\nPROC p(num y)\nVAR num x;\nx:=y;\nENDPROC\nPROC q()\nx:=1;\nENDPROC\n"
        "ENDMODULE\n";
    CHECK(renameOne(text, "m.x", "z") == "MODULE m\nVAR num z;\nPROC p(num y)\nVAR num "
                                         "x;\nx:=y;\nENDPROC\nPROC q()\nz:=1;\nENDPROC\nENDMODULE\n");
    CHECK(renameOne(text, "m.p.x", "z") == "MODULE m\nVAR num x;\nPROC p(num y)\nVAR num "
                                           "z;\nz:=y;\nENDPROC\nPROC q()\nx:=1;\nENDPROC\nENDMODULE\n");
    CHECK_THAT(renameOne(text, "x", "z"), Catch::Contains("several things") && Catch::Contains("m.p.x"));
}

TEST_CASE("the variables of a routine's loops are renamed together", "[edit][rename]") {
    const std::string text =
        "MODULE m\nPROC p()\nFOR i FROM 1 TO 2 DO\nreg1:=i;\nENDFOR\nFOR i FROM 1 TO 2 DO\n"
        "FOR I FROM 3 TO 4 DO\nreg2:=i;\nENDFOR\nreg3:=i;\nENDFOR\nENDPROC\nENDMODULE\n";
    CHECK(renameOne(text, "m.p.i", "k") ==
          "MODULE m\nPROC p()\nFOR k FROM 1 TO 2 DO\nreg1:=k;\nENDFOR\nFOR k FROM 1 TO 2 DO\n"
          "FOR k FROM 3 TO 4 DO\nreg2:=k;\nENDFOR\nreg3:=k;\nENDFOR\nENDPROC\nENDMODULE\n");
}

TEST_CASE("routines, parameters, types, labels and traps are renamed", "[edit][rename]") {
    CHECK(renameOne(
              "MODULE m\nFUNC num f(num a\\num b)\nIF Present(b) RETURN a+b;\nRETURN f(1\\b:=2);\nENDFUNC\n"
              "PROC q()\nVAR num r;\nr:=f(1\\B:=2)+f(3\\b:=4);\nENDPROC\nENDMODULE\n",
              "m.f.b", "extra") ==
          "MODULE m\nFUNC num f(num a\\num extra)\nIF Present(extra) RETURN a+extra;\nRETURN "
          "f(1\\extra:=2);\nENDFUNC\n"
          "PROC q()\nVAR num r;\nr:=f(1\\extra:=2)+f(3\\extra:=4);\nENDPROC\nENDMODULE\n");
    CHECK(renameOne("MODULE m\nRECORD rec\nnum a;\nENDRECORD\nALIAS rec al;\nVAR rec v;\nFUNC rec f(REC "
                    "x)\nRETURN x;\n"
                    "ENDFUNC\nENDMODULE\n",
                    "rec", "part") == "MODULE m\nRECORD part\nnum a;\nENDRECORD\nALIAS part al;\nVAR part "
                                      "v;\nFUNC part f(part x)\nRETURN x;\n"
                                      "ENDFUNC\nENDMODULE\n");
    CHECK(renameOne(body("again:\nglob:=1;\nGOTO AGAIN;"), "m.p.again", "loop") ==
          body("loop:\nglob:=1;\nGOTO loop;"));
    CHECK(renameOne("MODULE m\nVAR intnum i;\nTRAP t\nRETURN;\nENDTRAP\nPROC p()\nCONNECT i WITH "
                    "t;\nENDPROC\nENDMODULE\n",
                    "t", "onSignal") == "MODULE m\nVAR intnum i;\nTRAP onSignal\nRETURN;\nENDTRAP\nPROC "
                                        "p()\nCONNECT i WITH onSignal;\nENDPROC\n"
                                        "ENDMODULE\n");
    CHECK(renameOne(body("FOR i FROM 1 TO 3 DO\nglob:=i;\nENDFOR"), "m.p.i", "k") ==
          body("FOR k FROM 1 TO 3 DO\nglob:=k;\nENDFOR"));
}

TEST_CASE("uses in other modules of the task are renamed, and only in this task", "[edit][rename]") {
    const std::string a = "MODULE a\nVAR num x;\nENDMODULE\n",
                      b = "MODULE b\nPROC p()\nx:=1;\nENDPROC\nENDMODULE\n";
    const Renamed out = renameIn({{a, b}, {a, b}}, "a.x", "y");
    CHECK_THAT(out.problem,
               Catch::Contains("several things") && Catch::Contains("a.x in t0m0.modx, a.x in t1m0"));
    const Renamed one = renameIn({{a, b}}, "x", "y");
    CHECK(one.texts ==
          Texts{"MODULE a\nVAR num y;\nENDMODULE\n", "MODULE b\nPROC p()\ny:=1;\nENDPROC\nENDMODULE\n"});
}

TEST_CASE("a persistent that tasks share is renamed in all of them", "[edit][rename]") {
    const std::string a = "MODULE a\nPERS num x:=1;\nENDMODULE\n";
    const std::string b = "MODULE b\nPERS num X:=1;\nPROC p()\nx:=1;\nENDPROC\nENDMODULE\n";
    const Renamed out = renameIn({{a}, {b}}, "x", "y");
    CHECK(out.problem.empty());
    CHECK(out.texts == Texts{"MODULE a\nPERS num y:=1;\nENDMODULE\n",
                             "MODULE b\nPERS num y:=1;\nPROC p()\ny:=1;\nENDPROC\nENDMODULE\n"});
}

TEST_CASE("names that cannot be given are refused", "[edit][rename]") {
    const std::string text =
        "MODULE m\nVAR num x;\nVAR num y;\nPROC p()\nVAR num z;\nx:=z;\nENDPROC\nENDMODULE\n";
    using Catch::Contains;
    CHECK_THAT(renameOne(text, "x", "y"), Contains("clashes"));
    CHECK_THAT(renameOne(text, "x", "z"), Contains("instead of 'm.x'"));        // hidden in p
    CHECK_THAT(renameOne(text, "m.p.z", "x"), Contains("choose another name")); // hides x in p
    CHECK_THAT(renameOne(text, "x", "MoveL"), Contains("predefined"));
    CHECK_THAT(renameOne(text, "x", "while"), Contains("word of the language"));
    CHECK_THAT(renameOne(text, "x", "2x"), Contains("is not a name"));
    CHECK_THAT(renameOne(text, "x", "a b"), Contains("is not a name"));
    CHECK_THAT(renameOne(text, "x", ""), Contains("is not a name"));
    CHECK_THAT(renameOne(text, "x", std::string(33, 'a')), Contains("32"));
    CHECK_THAT(renameOne(text, "nothing", "a"), Contains("no declaration"));
    CHECK_THAT(renameOne(text, "num", "a"), Contains("predefined"));
    CHECK_THAT(renameOne("MODULE m\nPROC main()\nENDPROC\nENDMODULE\n", "main", "start"),
               Contains("starts with"));
    CHECK_THAT(renameOne(body("SetDO doX, 1;"), "doX", "doY"), Contains("configuration"));
}

TEST_CASE("only the case of a name is changed", "[edit][rename]") {
    CHECK(renameOne(body("GLOB:=glob;"), "glob", "Glob") ==
          "MODULE m\nVAR num Glob;\nPROC p()\nGlob:=Glob;\nENDPROC\nENDMODULE\n");
}

TEST_CASE("strings that spell the old name are pointed at", "[edit][rename]") {
    const Renamed out = renameIn({{body("%\"Q\"%;\nENDPROC\nPROC q()\nglob:=1;")}}, "q", "r");
    CHECK(out.problem.empty());
    REQUIRE(out.notes.size() == 1);
    CHECK_THAT(out.notes[0], Catch::Contains("t0m0.modx:4:2"));
}

TEST_CASE("renaming keeps other bytes in ISO 8859-1 and with mixed line ends", "[edit][rename]") {
    const std::string bytes = "MODULE m\r\n! gr\xF6\xDF"
                              "e \r\nVAR num gr\xF6\xDF"
                              "e;\nPROC p()\r\n\tGR\xD6\xDF"
                              "E:=1;\r\nENDPROC\nENDMODULE";
    const Renamed out = renameIn({{bytes}},
                                 "gr\xC3\xB6\xC3\x9F"
                                 "e",
                                 "l\xC3\xA4nge", ".mod");
    CHECK(out.problem.empty());
    CHECK(out.texts[0] == "MODULE m\r\n! gr\xF6\xDF"
                          "e \r\nVAR num l\xE4nge;\nPROC p()\r\n\tl\xE4nge:=1;\r\nENDPROC\nENDMODULE");
}

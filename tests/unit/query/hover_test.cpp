// Hover: declaration, comment, value (editor contract 10).

#include "frontend/query/hover.h"

#include "query_testing.h"

#include <catch2/catch.hpp>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

Hover hover(const Program& program, int marker) {
    INFO(marker);
    const auto found = hoverAt(program.snapshot(), program.file(marker), program.offset(marker));
    REQUIRE(found);
    return *found;
}

} // namespace

TEST_CASE("query: hover shows declarations as they are written", "[query][hover]") {
    const Program program(
        {"MODULE m\n! Sum of all parts.\nPERS num total:=0;\n\n! A part.\nRECORD part\nnum width; ! in "
         "mm\nstring name;\n"
         "ENDRECORD\nLOCAL VAR part parts{3,4};\n! Reports.\n! Twice.\nPROC report(string text \\num "
         "count|num other, VAR num x{*})\n"
         "ENDPROC\nLOCAL FUNC bool isDone(\\switch all)\nRETURN TRUE;\nENDFUNC\nTRAP alarm\nENDTRAP\nALIAS "
         "num level;\n"
         "PROC main()\nVAR num n{2};\n$1total:=1;\nparts{1,2}.wi$2dth:=2;\nrepo$3rt \"a\"\\count:=1,n;\n"
         "IF isDo$4ne() n{1}:=to$9tal;\nreport \"a\"\\cou$5nt:=1,n;\nMoveL p10,v10$6,fine,tool0;\nENDPROC\n"
         "PROC second(pa$7rt given,lev$8el l)\nENDPROC\nENDMODULE\n"});
    CHECK(hover(program, 1).declaration == "PERS num total");
    CHECK(hover(program, 1).documentation == "Sum of all parts.");
    CHECK(hover(program, 2).declaration == "num part.width");
    CHECK(hover(program, 2).documentation == "in mm");
    CHECK(hover(program, 3).declaration == "PROC report(string text\\num count | num other,VAR num x{*})");
    CHECK(hover(program, 3).documentation == "Reports.\nTwice.");
    CHECK(hover(program, 4).declaration == "LOCAL FUNC bool isDone(\\switch all)");
    CHECK(hover(program, 5).declaration == "\\num count");
    CHECK(hover(program, 6).declaration == "CONST speeddata v10");
    CHECK(hover(program, 6).value == "[10,500,5000,1000]");
    CHECK(hover(program, 7).declaration == "RECORD part\n   num width;\n   string name;\nENDRECORD");
    CHECK(hover(program, 7).documentation == "A part.");
    CHECK(hover(program, 8).declaration == "ALIAS num level");
    CHECK(hover(program, 9).range == SourceRange{program.offset(9) - 2, program.offset(9) + 3});
}

// Contract item 10: the declaration is shown, also with a data type that the program does not have.
TEST_CASE("query: hover names a data type that is not known", "[query][hover]") {
    const Program program(
        {"MODULE m\nRECORD pair\nnum a;\ngone b;\nENDRECORD\nVAR gone da$1ta{2};\nVAR pa$4ir "
         "p;\nPROC wo$2rk(gone x{*})\nENDPROC\nFUNC gone ma$3de()\nENDFUNC\nENDMODULE\n"});
    CHECK(hover(program, 1).declaration == "VAR gone data{2}");
    CHECK(hover(program, 2).declaration == "PROC work(gone x{*})");
    CHECK(hover(program, 3).declaration == "FUNC gone made()");
    CHECK(hover(program, 4).declaration == "RECORD pair\n   num a;\n   gone b;\nENDRECORD");
}

TEST_CASE("query: hover evaluates constants and shows points as tables", "[query][hover]") {
    const Program program({inMain(
        "x:=lim$1it;\nMoveL p$2,v100,fine,tool0;\nMoveAbsJ j$3,v100,fine,tool0;\nRAISE ERR_DIV$4ZERO;\n"
        "x:=lo$5cal1;",
        "CONST num base:=4;\nCONST num limit:=base*2.5;\nVAR num x:=3;\n"
        "CONST robtarget p:=[[100,200.5,-3],[1,0,0,0],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        "CONST jointtarget j:=[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];\n")});
    CHECK(hover(program, 1).declaration == "CONST num limit");
    CHECK(hover(program, 1).value == "10");
    const std::string table = hover(program, 2).table;
    CHECK(table.find("| position (mm) | x | y | z |\n|---|---:|---:|---:|\n| | 100 | 200.5 | -3 |") == 0);
    CHECK(table.find("| orientation | q1 | q2 | q3 | q4 |") != std::string::npos);
    CHECK(table.find("| configuration | cf1 | cf4 | cf6 | cfx |") != std::string::npos);
    CHECK(hover(program, 3).table.find("| robot axes (deg) | rax_1 | rax_2 |") == 0);
    CHECK(hover(program, 3).table.find("| | - | - | - | - | - | - |") !=
          std::string::npos); // axes that are not used
    CHECK(hover(program, 4).facts == "Number of the error: 1003");
}

TEST_CASE("query: hover of signals shows their definition", "[query][hover]") {
    sema::CheckOptions options;
    options.signals = {{"do_grip", "signaldo"}};
    options.configurationKnown = true;
    const Program program(
        {inMain("SetDO do_gr$1ip,1;")},
        {"EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name \"do_grip\" -SignalType \"DO\" \\\n"
         "      -Device \"board\" -DeviceMap \"3\"\n"},
        options);
    CHECK(hover(program, 1).declaration == "signaldo do_grip");
    CHECK(hover(program, 1).facts == "`DO` in EIO0.cfg: Device board; DeviceMap 3");
}

TEST_CASE("query: hover of keywords, and none where there is no name", "[query][hover]") {
    const Program program(
        {inMain("$1IF TRUE THEN\nENDIF\n! lim$2it\nTPWrite \"a lim$3it\";\nTPWrite$4 $5 \"x\";",
                "CONST num limit:=1;\n")});
    CHECK(hover(program, 1).declaration == "IF");
    CHECK_FALSE(hover(program, 1).documentation.empty());
    for (int marker : {2, 3, 5})
        CHECK_FALSE(hoverAt(program.snapshot(), program.file(marker), program.offset(marker)));
    CHECK(hover(program, 4).documentation.find("- `String`:") != std::string::npos);
}

TEST_CASE("query: hover in what cannot be read", "[query][hover]") {
    const Program program({inMain("x := lim$1it + ;\nMoveL p,v10$2", "CONST num limit:=1;\nVAR num x;\n")});
    CHECK(hover(program, 1).declaration == "CONST num limit");
    CHECK(hover(program, 2).declaration == "CONST speeddata v10");
}

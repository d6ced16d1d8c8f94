// Signature help: the active parameter (editor contract 9).

#include "frontend/query/signature_help.h"

#include "query_testing.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

std::string active(const Program& program, int marker) {
    const auto help = signatureHelpAt(program.snapshot(), program.file(marker), program.offset(marker));
    if (!help) return "none";
    if (help->active < 0) return "no parameter of " + help->label;
    const SignatureParameter& parameter = help->parameters.at(static_cast<size_t>(help->active));
    return help->label.substr(parameter.begin, parameter.end - parameter.begin);
}

} // namespace

TEST_CASE("query: active parameter of instructions and functions", "[query][signature]") {
    const std::string routines = "PROC report(string text\\num count,num level)\nENDPROC\n"
                                 "FUNC num sum(num a,num b\\num c|num d)\nRETURN a;\nENDFUNC\nVAR num x;\n";
    const Program program({inMain("report $1\"te$2xt\"\\$3count:=1$4,$5sum($6 1,2$7\\d:=$8)$9;", routines)});
    CHECK(active(program, 1) == "string text");
    CHECK(active(program, 2) == "string text");
    CHECK(active(program, 3) == "\\num count");
    CHECK(active(program, 4) == "\\num count");
    CHECK(active(program, 5) == "num level");
    CHECK(active(program, 6) == "num a");
    CHECK(active(program, 7) == "num b");
    CHECK(active(program, 8) == "num d");
    CHECK(active(program, 9) == "num level");
}

TEST_CASE("query: signature of what is being written", "[query][signature]") {
    const std::pair<const char*, const char*> cases[] = {
        {"MoveL $1", "robtarget ToPoint"},
        {"MoveL p10,v100\\$1", "\\num V"},
        {"MoveL p10,v100\\T$1", "num T"},
        {"MoveL p10,v100\\$1\nMoveL p10,v100\\T:=1,fine,tool0;", "\\num V"},
        {"x:=Abs($1", "num Value"},
        {"x:=Abs($1\nx:=2;", "num Value"},
        {"MoveL p10,v100,fine,tool0,$1", "no parameter"},
        {"x:=1$1;", "none"},
        {"TPWrite \"a\"; $1", "none"},
        {"TPWrite \"a\"; ! TPWrite $1", "none"},
        {"IF x=1 TPWrite $1", "string String"},
        {"unknown $1", "none"},
        {"TPWrite\n  $1\"text\";", "string String"},
    };
    for (const auto& [text, expected] : cases) {
        INFO(text);
        const Program program({inMain(text, "VAR num x;\n")});
        CHECK(active(program, 1).substr(0, std::string(expected).size()) == expected);
    }
}

TEST_CASE("query: the parameter that fits, of several that exclude each other", "[query][signature]") {
    const Program program(
        {inMain("BitSet $1whole,1;\nBitSet $2small,1;", "VAR dnum whole;\nVAR byte small;\n")});
    CHECK(active(program, 1) == "INOUT dnum DnumData");
    CHECK(active(program, 2) == "INOUT byte BitData");
}

TEST_CASE("query: documentation of the signature and its parameters", "[query][signature]") {
    const Program program({inMain("MoveJ $1")});
    const auto help = signatureHelpAt(program.snapshot(), program.file(), program.offset());
    REQUIRE(help);
    CHECK(help->documentation.find("Moves quickly") == 0);
    CHECK(help->parameters.at(0).documentation == "execution continues while the robot moves");
}

TEST_CASE("query: documentation of a parameter over two lines", "[query][signature]") {
    const Program program({inMain("SearchL $1")});
    const auto help = signatureHelpAt(program.snapshot(), program.file(), program.offset());
    REQUIRE(help);
    const auto load = std::find_if(help->parameters.begin(), help->parameters.end(), [](const auto& one) {
        return one.documentation.starts_with("total load of tool and payload");
    });
    REQUIRE(load != help->parameters.end());
    CHECK(load->documentation.ends_with("load0 means no change"));
}

// More of something than anybody writes: still the right answer.

#include "sema_testing.h"

#include <catch2/catch.hpp>
#include <set>

namespace {

using namespace rapid::sema::testing;
using Messages = std::vector<std::string>;

/// "MODULE m ... ENDMODULE" with a procedure `wide` of 300 optional parameters p0, p1 ...
std::string withWideProcedure(const std::string& calls) {
    std::string parameters;
    for (int i = 0; i < 300; ++i)
        parameters += "\\num p" + std::to_string(i);
    return "MODULE m\n  PROC wide(num first" + parameters + ")\n  ENDPROC\n  PROC caller()\n" + calls +
           "  ENDPROC\nENDMODULE\n";
}

} // namespace

TEST_CASE("arguments find their parameter among hundreds", "[sema]") {
    std::string all = "    wide 1";
    for (int i = 0; i < 300; ++i)
        all += "\\P" + std::to_string(i) + ":=" + std::to_string(i);
    CHECK(checkTexts({withWideProcedure(all + ";\n")})->messages() == Messages{});
    CHECK(checkTexts({withWideProcedure("    wide 1\\p7:=1\\p7:=2;\n    wide 1\\p299:=1\\p3:=2;\n"
                                        "    wide 1\\first:=2;\n    wide 1\\pq299:=2;\n")})
              ->codes() == Messages{"RAP4006", "RAP4008", "RAP4004", "RAP4003"});
}

TEST_CASE("labels find their like among thousands", "[sema]") {
    std::string text = "MODULE m\n  PROC p()\n";
    for (int i = 0; i < 3000; ++i)
        text += "    a" + std::to_string(i) + ":\n";
    text += "    a5:\n    GOTO a2999;\n    GOTO a3000;\n  ENDPROC\nENDMODULE\n";
    const auto checked = checkTexts({text});
    CHECK(checked->codes() == Messages{"RAP2015", "RAP2007"});
}

TEST_CASE("components find their like among thousands", "[sema]") {
    std::string text = "MODULE m\n  RECORD wide\n";
    for (int i = 0; i < 3000; ++i)
        text += "    num c" + std::to_string(i) + ";\n";
    text += "  ENDRECORD\n  RECORD other\n    num c2999;\n  ENDRECORD\n  VAR wide w;\n  VAR other o;\n"
            "  PROC p()\n    w.C2999 := o.c2999;\n    w.c3000 := o.c0;\n    w.c0 := w.c1;\n  ENDPROC\n"
            "ENDMODULE\n";
    CHECK(checkTexts({text})->codes() == Messages{"RAP2005", "RAP2005"});
}

TEST_CASE("dimensions that depend on thousands of others are refused", "[sema]") {
    std::string text = "MODULE m\n";
    for (int i = 0; i < 30000; ++i)
        text += "  CONST num c" + std::to_string(i) + "{c" + std::to_string(i + 1) + "{1}}:=[1];\n";
    text += "  CONST num c30000{1}:=[1];\nENDMODULE\n";
    const Messages codes = checkTexts({text})->codes();
    CHECK_FALSE(codes.empty());
    CHECK(std::set<std::string>(codes.begin(), codes.end()) == std::set<std::string>{"RAP3039"});
}

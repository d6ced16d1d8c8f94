// Words that became reserved late, in files of older and newer systems.

#include "frontend/diag/messages/syntax.h"
#include "syntax_test.h"

#include <catch2/catch.hpp>

namespace {

using namespace rapid;
using diag::Code;
namespace say = diag::say;

std::vector<Code> codesOf(const std::string& path, const std::string& text) {
    diag::Sink sink;
    syntax::parse(std::make_shared<const SourceFile>(path, text), sink);
    std::vector<Code> codes;
    for (const diag::Diagnostic& d : sink.all())
        codes.push_back(d.code);
    return codes;
}

const std::string kProgram = "MODULE m\n"
                             "  VAR bool continue := TRUE;\n"
                             "  PROC main()\n"
                             "    IF continue TPWrite \"on\";\n"
                             "    ELSEIF_ := 1;\n"
                             "    WHILE continue DO\n"
                             "      continue := FALSE;\n"
                             "      CONTINUE;\n"
                             "    ENDWHILE\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";

} // namespace

TEST_CASE("a file of an older system uses a later word as a name: one note", "[syntax]") {
    const std::vector<Code> note = {say::LaterReservedWord.code};
    for (const char* path : {"m.mod", "m.sys", "m.prg", "M.MOD"}) {
        INFO(path);
        CHECK(codesOf(path, kProgram) == note);
    }
    const std::vector<Code> error = {say::ReservedWordAsName.code};
    for (const char* path : {"m.modx", "m.sysx"}) {
        INFO(path);
        CHECK(codesOf(path, kProgram) == error);
    }
}

TEST_CASE("where nothing is named by it the later word is what it is today", "[syntax]") {
    const std::string text = "MODULE m\n  PROC main()\n    WHILE TRUE DO\n      IF reg1 = 1 CONTINUE;\n"
                             "      BREAK;\n    ENDWHILE\n  UNDO\n    Stop;\n  ENDPROC\nENDMODULE\n";
    CHECK(codesOf("m.mod", text).empty());
}

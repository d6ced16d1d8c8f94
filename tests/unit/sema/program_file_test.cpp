// Program files (.pgf) in all their spellings.

#include "frontend/project/program_file.h"

#include <catch2/catch.hpp>

using rapid::project::readProgramFile;

namespace {

/// The modules joined by '|'; "none" for a text that is not a program file.
std::string read(std::string_view text) {
    std::vector<std::string> modules;
    if (!readProgramFile(text, modules)) return "none";
    std::string out;
    for (const std::string& module : modules)
        out += (out.empty() ? "" : "|") + module;
    return out;
}

} // namespace

TEST_CASE("a program file names its modules", "[project]") {
    CHECK(
        read(
            "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>\r\n<Program>\r\n\t<Module>Main.mod</Module>\r\n"
            "\t<Module> b.mod </Module>\r\n</Program>") == "Main.mod|b.mod");
    CHECK(read("<program><MODULE>a.mod</MODULE></program>") == "a.mod");
    CHECK(read("<Program><Module>lib\\a.mod</Module></Program>") == "lib/a.mod");
    CHECK(read("<Program><Module>A&amp;B.mod</Module><Module>&#233;&#xE9;.mod</Module></Program>") ==
          "A&B.mod|\xC3\xA9\xC3\xA9.mod");
    CHECK(read("<Program><Module>\xE9.mod</Module></Program>") == "\xC3\xA9.mod"); // ISO 8859-1
    CHECK(read("<Program><!-- <Module>old.mod</Module> --><Module/><Module></Module></Program>") == "");
}

TEST_CASE("other texts are reported", "[project]") {
    CHECK(read("") == "none");
    CHECK(read("MODULE m\nENDMODULE\n") == "none");
    CHECK(read("<Program><Module>a.mod") == "none");
    CHECK(read("<Program><Module") == "none");
    CHECK(read("<Program>") == "none");
    CHECK(read("<Program><Module>a.mod</Module>") == "none"); // cut off
    CHECK(read("<Program/>") == "");
    CHECK(read("<Program><Module>&#0;&#x110000;&bad;&</Module></Program>") == "&#0;&#x110000;&bad;&");
}

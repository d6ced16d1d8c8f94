// "did you mean": of the kind that is wanted there, and near by the measure of both names.

#include "sema_testing.h"

#include <catch2/catch.hpp>

namespace {

using namespace rapid;
using namespace rapid::sema;
using Messages = std::vector<std::string>;

} // namespace

TEST_CASE("a suggestion is of the kind that is wanted", "[sema]") {
    const std::string text = "MODULE m\n"
                             "  RECORD gripper\n"
                             "    num force;\n"
                             "  ENDRECORD\n"
                             "  VAR num grippes;\n"
                             "  VAR num count;\n"
                             "  VAR intnum i;\n"
                             "  VAR grippen tool;\n"
                             "  PROC main()\n"
                             "    grippen;\n"
                             "    count:=grippen(1);\n"
                             "    count:=grippen;\n"
                             "  ENDPROC\n"
                             "  PROC second()\n"
                             "    CONNECT i WITH grippen;\n"
                             "  ENDPROC\n"
                             "  PROC grippex()\n"
                             "  ENDPROC\n"
                             "  FUNC num grippey(num n)\n"
                             "    RETURN n;\n"
                             "  ENDFUNC\n"
                             "  TRAP grippet\n"
                             "  ENDTRAP\n"
                             "ENDMODULE\n";
    const auto checked = testing::checkTexts({text});
    CHECK(checked->messages() ==
          Messages{
              "RAP2002 at 8:7: 'grippen' is not a known data type; did you mean 'gripper'?",
              "RAP2003 at 10:5: 'grippen' is not a known procedure or instruction; did you mean 'grippex'?",
              "RAP2004 at 11:12: 'grippen' is not a known function; did you mean 'grippey'?",
              "RAP2001 at 12:12: 'grippen' is not declared; did you mean 'grippes'?",
              "RAP2006 at 15:20: 'grippen' is not a known trap routine; did you mean 'grippet'?"});
}

TEST_CASE("a long name is not a misspelt short one", "[sema]") {
    // Search_1D of an add-in and SearchC differ by three letters, of which SearchC has seven.
    const std::string text = "MODULE m\n"
                             "  PROC main()\n"
                             "    Searching;\n"
                             "    SearchG;\n"
                             "  ENDPROC\n"
                             "ENDMODULE\n";
    const auto checked = testing::checkTexts({text});
    CHECK(checked->messages() ==
          Messages{
              "RAP2003 at 3:5: 'Searching' is not a known procedure or instruction",
              "RAP2003 at 4:5: 'SearchG' is not a known procedure or instruction; did you mean 'SearchC'?"});
}

// What the diagnostics of projects and tasks mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {6001, Kind::File,
     "Executing a program means executing its procedure main, which one module of each task must have "
     "(manual 1.1.3). rapidc check does not ask for it, build and run do.",
     "",
     "MODULE m\n"
     "  PROC main()\n"
     "  ENDPROC\n"
     "ENDMODULE"},
    {6002, Kind::File,
     "The entry routine is called by the system without arguments: it must be a global procedure "
     "without required parameters (manual 1.1.3).",
     "",
     "MODULE m\n"
     "  PROC main()\n"
     "  ENDPROC\n"
     "ENDMODULE"},
    {6003, Kind::File,
     "The entry routine is called from outside its module, so it must not be LOCAL (manual 1.1.3).",
     "",
     "MODULE m\n"
     "  PROC main()\n"
     "  ENDPROC\n"
     "ENDMODULE"},
    {6004, Kind::File,
     "A global persistent is one and the same in all tasks that declare it, so type and dimensions "
     "must agree (manual 1.20). Declare it TASK PERS or LOCAL PERS where it is meant for one task "
     "only.",
     "",
     "MODULE m\n"
     "  TASK PERS num total := 0;\n"
     "ENDMODULE"},
    {6005, Kind::File,
     "Tasks are known by their names; the positional inputs make up T_ROB1. Choose another name in "
     "--task=NAME=INPUT.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6010, Kind::File,
     "The same file was named twice on the command line, or named and found in a folder.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6020, Kind::File,
     "There is no file or folder of this name. Relative paths count from the current folder.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6021, Kind::File,
     "The file exists but cannot be read; the message of the operating system follows.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6022, Kind::File,
     "The folder, and the folders directly in it, have no file with one of the endings of RAPID "
     "modules.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6023, Kind::File,
     "rapidc tells inputs by their endings: .mod, .modx, .sys, .sysx and .prg are modules, .pgf are "
     "programs, .cfg are configurations.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6024, Kind::File,
     "A program file (.pgf) is XML with the root element Program and one Module element for each "
     "module (manual 1.1.3).",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6025, Kind::File,
     "The program file names a module that is not beside it. Copy the module there, or name the "
     "modules instead of the program file.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6026, Kind::File,
     "The inputs bring no module: configuration files alone are no program.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6027, Kind::File,
     "Modules of a backup may be encrypted, and only the controller can read them. The rest is "
     "checked; names that are declared nowhere else are assumed to be in the encrypted modules.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations6xxx() {
    return kExplanations;
}

} // namespace rapid::diag

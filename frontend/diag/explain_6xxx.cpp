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
    {6006, Kind::File,
     "A controller runs up to 20 tasks (manual 1.20).",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6007, Kind::File,
     "A module that SYS.cfg (CAB_TASK_MODULES) or a backup (TASK0) installs shared is there once for all tasks, with "
     "one value of each of its data that are not TASK data (manual 1.2.2). The tasks were given modules of this name "
     "that declare the data differently: use the same file in all of them.",
     "",
     "MODULE m(SYSMODULE)\n"
     "  TASK VAR num counter := 0;\n"
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
     "A controller can encrypt modules, and only a controller can read them. The rest of the task "
     "is checked; names that are declared nowhere else may be declared in the encrypted module, so "
     "they are no errors.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6040, Kind::File,
     "A configuration file (.cfg) has text that is not in the form of ABB's system parameters: a "
     "section, a colon, then lines of -Attribute value.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6050, Kind::File,
     "What a backup holds, in one line: system, RobotWare version, number of tasks and of signals "
     "in EIO.cfg, robot (use_robot_type in MOC.cfg, else the option line in backinfo.txt), add- "
     "ins.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6051, Kind::File,
     "What a task of a backup is made of: type and entry routine (CAB_TASKS in SYS.cfg), modules "
     "that are read, modules that are encrypted or were not saved. What those declare is not "
     "known, so a name that no module declares may come from them.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6052, Kind::File,
     "backinfo.txt lists a task that CAB_TASKS in SYS.cfg does not have. Options such as SafeMove "
     "make tasks of their own (SC_CBC, PSC_CBC), whose parameters are not saved. The task is read; "
     "without an entry routine it is left out of a run.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6053, Kind::File,
     "CAB_TASKS in SYS.cfg has a task for which the backup has no folder RAPID/TASKn. Copy the "
     "folder from a complete backup, or remove the task from SYS.cfg.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6054, Kind::File,
     "CAB_TASK_MODULES in SYS.cfg names a module that the controller loads at start from an add-in "
     "or from a folder that is not part of the backup. The program does not link without it: copy "
     "the file from the add-in into RAPID/TASKn/SYSMOD, or into HOME if SYS.cfg loads it from "
     "there.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6055, Kind::File,
     "The list of modules in BACKINFO/backinfo.txt names a file that the task's folder does not "
     "have, in any letter case. The backup is not complete: copy the file there.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6056, Kind::File,
     "The task's folder holds a module that the list in BACKINFO/backinfo.txt does not name, so it "
     "was added by hand. rapidc reads it; a controller that restores the backup does not. Add a "
     "line for it to backinfo.txt.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6057, Kind::File,
     "Nothing of the task can be run: all its modules are encrypted or missing, or none that can "
     "be read declares its entry routine. The other tasks run without it.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6058, Kind::File,
     "A backup should have BACKINFO/backinfo.txt, which names tasks and modules. Without it the "
     "folder TASKn is taken for the n-th task of CAB_TASKS in SYS.cfg, and every module in it is "
     "read.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6059, Kind::File,
     "CAB_TASK_MODULES in SYS.cfg names a module of RobotWare itself (RELEASE:), for example "
     "ScreenMaker. Backups never hold such modules. Names that no module declares may be declared "
     "there.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6060, Kind::File,
     "The configuration names a robot for which rapidc has no model. Checking is not affected. To "
     "run the program name a model that is known with --robot, for example --robot=\"IRB "
     "120-3/0.58\".",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6030, Kind::File,
     "rapidc.json holds the settings of a project: an object with the sections \"warnings\" and "
     "\"format\". It is looked for beside the first input and in the folders above it.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6031, Kind::File,
     "rapidc.json has a section or a name that rapidc does not know; it has no effect.",
     "",
     "MODULE m\n"
     "ENDMODULE"},
    {6032, Kind::File,
     "The value of a setting in rapidc.json is not of the kind that the setting takes. A warning is "
     "\"off\", \"warning\" or \"error\".",
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

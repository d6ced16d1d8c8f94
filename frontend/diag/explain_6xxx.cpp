// What the diagnostics of projects and tasks mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {6001, Kind::Files,
     "Executing a program means executing its procedure main, which one module of each task must have "
     "(manual 1.1.3). rapidc check does not ask for it, build and run do.",
     R"ex($ rapidc build main.mod
main.mod:
  MODULE MainModule
    PROC start()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc build main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6002, Kind::Files,
     "The entry routine is called by the system without arguments: it must be a global procedure "
     "without required parameters (manual 1.1.3). rapidc check reports it only if it is no procedure at all.",
     R"ex($ rapidc build main.mod
main.mod:
  MODULE MainModule
    PROC main(num parts)
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc build main.mod
main.mod:
  MODULE MainModule
    PROC main(\num parts)
    ENDPROC
  ENDMODULE)ex"},
    {6003, Kind::Files,
     "The entry routine is called from outside its module, so it must not be LOCAL (manual 1.1.3).",
     R"ex($ rapidc build main.mod
main.mod:
  MODULE MainModule
    LOCAL PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc build main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6004, Kind::Files,
     "A global persistent is one and the same in all tasks that declare it, so type and dimensions "
     "must agree (manual 1.20). Declare it TASK PERS or LOCAL PERS where it is meant for one task "
     "only.",
     R"ex($ rapidc check first.mod --task=T_ROB2=second.mod
first.mod:
  MODULE first
    PERS num total := 0;
    PROC main()
      total := 1;
    ENDPROC
  ENDMODULE
second.mod:
  MODULE second
    PERS bool total := FALSE;
    PROC main()
      total := TRUE;
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check first.mod --task=T_ROB2=second.mod
first.mod:
  MODULE first
    PERS num total := 0;
    PROC main()
      total := 1;
    ENDPROC
  ENDMODULE
second.mod:
  MODULE second
    TASK PERS bool total := FALSE;
    PROC main()
      total := TRUE;
    ENDPROC
  ENDMODULE)ex"},
    {6005, Kind::Files,
     "Tasks are known by their names; the positional inputs make up T_ROB1. Choose another name in "
     "--task=NAME=INPUT. Further inputs of one task follow after commas, or in another --task of its name.",
     R"ex($ rapidc check first.mod --task=T_ROB1=second.mod
first.mod:
  MODULE first
    PROC main()
    ENDPROC
  ENDMODULE
second.mod:
  MODULE second
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check first.mod --task=T_ROB2=second.mod
first.mod:
  MODULE first
    PROC main()
    ENDPROC
  ENDMODULE
second.mod:
  MODULE second
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6006, Kind::Files,
     "A controller runs up to 20 tasks (manual 1.20); a program with more could not be loaded there. Each --task and "
     "each task of the configuration counts, T_ROB1 included. Leave out what this run does not need, or put programs "
     "that may run one after the other together in one task.",
     R"ex($ rapidc check main.mod --task=T_2=main.mod --task=T_3=main.mod --task=T_4=main.mod --task=T_5=main.mod --task=T_6=main.mod --task=T_7=main.mod --task=T_8=main.mod --task=T_9=main.mod --task=T_10=main.mod --task=T_11=main.mod --task=T_12=main.mod --task=T_13=main.mod --task=T_14=main.mod --task=T_15=main.mod --task=T_16=main.mod --task=T_17=main.mod --task=T_18=main.mod --task=T_19=main.mod --task=T_20=main.mod --task=T_21=main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod --task=T_2=main.mod --task=T_3=main.mod --task=T_4=main.mod --task=T_5=main.mod --task=T_6=main.mod --task=T_7=main.mod --task=T_8=main.mod --task=T_9=main.mod --task=T_10=main.mod --task=T_11=main.mod --task=T_12=main.mod --task=T_13=main.mod --task=T_14=main.mod --task=T_15=main.mod --task=T_16=main.mod --task=T_17=main.mod --task=T_18=main.mod --task=T_19=main.mod --task=T_20=main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6007, Kind::Files,
     "A module that SYS.cfg (CAB_TASK_MODULES) or a backup (TASK0) installs shared is there once for all tasks, with "
     "one value of each of its data that are not TASK data (manual 1.2.2). The tasks were given modules of this name "
     "that declare the data differently: use the same file in all of them.",
     R"ex($ rapidc build first -o cell --task=T_ROB2=second --config=SYS.cfg
first/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
first/common.sys:
  MODULE common(SYSMODULE)
    VAR num count := 0;
  ENDMODULE
second/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
second/common.sys:
  MODULE common(SYSMODULE)
    VAR bool count := FALSE;
  ENDMODULE
SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASK_MODULES:

        -File "common.sys" -ModName "common" -AllTask -Shared)ex",
     R"ex($ rapidc build first -o cell --task=T_ROB2=second --config=SYS.cfg
first/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
first/common.sys:
  MODULE common(SYSMODULE)
    VAR num count := 0;
  ENDMODULE
second/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
second/common.sys:
  MODULE common(SYSMODULE)
    VAR num count := 0;
  ENDMODULE
SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASK_MODULES:

        -File "common.sys" -ModName "common" -AllTask -Shared)ex"},
    {6010, Kind::Files,
     "The same file was named twice on the command line, or named and found in a folder.",
     R"ex($ rapidc check main.mod ./main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6020, Kind::Files,
     "There is no file or folder of this name. Relative paths count from the current folder.",
     R"ex($ rapidc check mian.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6021, Kind::Files,
     "The file exists but cannot be read; the message of the operating system follows.",
     R"ex($ rapidc check cell.pgf
cell.pgf:
  <?xml version="1.0" encoding="ISO-8859-1" ?>
  <Program>
  <Module>main.mod</Module>
  </Program>
main.mod/readme.txt:
  A folder that has the name of the module.)ex",
     R"ex($ rapidc check cell.pgf
cell.pgf:
  <?xml version="1.0" encoding="ISO-8859-1" ?>
  <Program>
  <Module>main.mod</Module>
  </Program>
main.mod:
  MODULE main
  ENDMODULE)ex"},
    {6022, Kind::Files,
     "The folder, and the folders directly in it, have no file with one of the endings of RAPID "
     "modules.",
     R"ex($ rapidc check cell
cell/readme.txt:
  The modules are on the robot.)ex",
     R"ex($ rapidc check cell
cell/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6023, Kind::Files,
     "rapidc tells inputs by their endings: .mod, .modx, .sys, .sysx and .prg are modules, .pgf are "
     "programs, .cfg are configurations.",
     R"ex($ rapidc check main.txt
main.txt:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6024, Kind::Files,
     "A program file (.pgf) is XML with the root element Program and one Module element for each "
     "module (manual 1.1.3).",
     R"ex($ rapidc check cell.pgf
cell.pgf:
  MODULE MainModule
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check cell.pgf
cell.pgf:
  <Program>
    <Module>main.mod</Module>
  </Program>
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6025, Kind::Files,
     "The program file names a module that is not beside it. Copy the module there, or name the "
     "modules instead of the program file.",
     R"ex($ rapidc check cell.pgf
cell.pgf:
  <Program>
    <Module>main.mod</Module>
    <Module>tools.mod</Module>
  </Program>
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check cell.pgf
cell.pgf:
  <Program>
    <Module>main.mod</Module>
  </Program>
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6026, Kind::Files,
     "The inputs bring no module: configuration files alone are no program.",
     R"ex($ rapidc check EIO.cfg
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO")ex",
     R"ex($ rapidc check main.mod EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO")ex"},
    {6027, Kind::Files,
     "A controller can encrypt modules, and only a controller can read them. The rest of the task "
     "is checked; names that are declared nowhere else may be declared in the encrypted module, so "
     "they are no errors.",
     R"ex($ rapidc check cell
cell/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
cell/secret.mod (bytes FC 86 41 07 00 9E 22 51):)ex",
     R"ex($ rapidc check cell
cell/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6040, Kind::Files,
     "A configuration file (.cfg) has text that is not in the form of ABB's system parameters (a "
     "section, a colon, then lines of -Attribute value), or what it says cannot be: a signal without "
     "a name or of an unknown type, two signals of one name, a group signal without bits.",
     R"ex($ rapidc check main.mod --config=EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        Name = "doLamp")ex",
     R"ex($ rapidc check main.mod --config=EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO")ex"},
    {6041, Kind::Files,
     "A cross connection names a signal that no EIO_SIGNAL defines. It is left out, the rest works: the "
     "signal may be one of an add-in, which a backup does not hold. Else correct the name or define "
     "the signal.",
     R"ex($ rapidc check main.mod --config=EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO"
  #
  EIO_CROSS:

        -Name "lamp" -Res "doLamp" -Act1 "diDoor")ex",
     R"ex($ rapidc check main.mod --config=EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO"

        -Name "diDoor" -SignalType "DI"
  #
  EIO_CROSS:

        -Name "lamp" -Res "doLamp" -Act1 "diDoor")ex"},
    {6030, Kind::Files,
     "rapidc.json holds the settings of a project: an object with the sections \"warnings\" and "
     "\"format\". It is looked for beside the first input and in the folders above it.",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
rapidc.json:
  { "warnings": { "unused-variable": "off" })ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
rapidc.json:
  { "warnings": { "unused-variable": "off" } })ex"},
    {6031, Kind::Files,
     "rapidc.json has a section or a name that rapidc does not know; it has no effect.",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
rapidc.json:
  { "warning": { "unused-variable": "off" } })ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
rapidc.json:
  { "warnings": { "unused-variable": "off" } })ex"},
    {6032, Kind::Files,
     "The value of a setting in rapidc.json is not of the kind that the setting takes. A warning is "
     "\"off\", \"warning\" or \"error\".",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
rapidc.json:
  { "warnings": { "unused-variable": "never" } })ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
rapidc.json:
  { "warnings": { "unused-variable": "off" } })ex"},
    {6042, Kind::Files,
     "Files of many programs are called .cfg. One whose first line is not that of system parameters, such as "
     "'EIO:CFG_1.0:7:0::', is left out when it merely lies in a folder. Named with --config it is an error.",
     R"ex($ rapidc check cell
cell/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
cell/tool.cfg:
  [camera]
  port = 3000)ex",
     R"ex($ rapidc check cell
cell/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations6xxx() {
    return kExplanations;
}

} // namespace rapid::diag

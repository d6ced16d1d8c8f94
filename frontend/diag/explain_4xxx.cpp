// What the diagnostics of calls mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {4001, Kind::Body,
     "The call has more required arguments than the routine has parameters. Optional arguments are "
     "given by name after a backslash (manual 1.3.4).",
     "reg1 := Sqrt(4, 2);",
     "reg1 := Sqrt(4);"},
    {4002, Kind::Body,
     "All required parameters need an argument, in order (manual 1.1.5).",
     "TPWrite;",
     "TPWrite \"hello\";"},
    {4003, Kind::Body,
     "The name after the backslash is no optional parameter of the routine.",
     "TPWrite \"value\" \\Number:=5;",
     "TPWrite \"value\" \\Num:=5;"},
    {4004, Kind::Module,
     "The backslash marks optional arguments; required ones are written without it (manual 1.3.4).",
     "PROC work(num a)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work \\a:=1;\n"
     "ENDPROC",
     "PROC work(num a)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work a:=1;\n"
     "ENDPROC"},
    {4005, Kind::Module,
     "An optional argument needs a backslash before its name (manual 1.3.4).",
     "PROC work(num a \\num b)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work b:=2, 1;\n"
     "ENDPROC",
     "PROC work(num a \\num b)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work 1 \\b:=2;\n"
     "ENDPROC"},
    {4006, Kind::Body,
     "Each parameter takes at most one argument.",
     "TPWrite \"value\" \\Num:=1 \\Num:=2;",
     "TPWrite \"value\" \\Num:=1;"},
    {4007, Kind::Body,
     "Parameters separated by '|' exclude each other: at most one may be given (manual 1.1.5).",
     "TPWrite \"value\" \\Num:=1 \\Bool:=TRUE;",
     "TPWrite \"value\" \\Num:=1;"},
    {4008, Kind::Module,
     "Arguments stand in the order of the parameters, optional ones as well (manual 1.3.4).",
     "PROC work(num a \\num b, num c)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work 1, 3 \\b:=2;\n"
     "ENDPROC",
     "PROC work(num a \\num b, num c)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work 1 \\b:=2, 3;\n"
     "ENDPROC"},
    {4009, Kind::Module,
     "A switch is given by its name alone (manual 1.1.5). To pass on a switch of the own routine use "
     "a conditional argument: \\fast?fast.",
     "PROC move(\\switch fast)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  move \\fast:=TRUE;\n"
     "ENDPROC",
     "PROC move(\\switch fast)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  move \\fast;\n"
     "ENDPROC"},
    {4010, Kind::Body,
     "Only switches are given by name alone; other optional arguments need a value (manual 1.3.4).",
     "TPWrite \"value\" \\Num;",
     "TPWrite \"value\" \\Num:=reg1;"},
    {4011, Kind::Body,
     "The argument must have the type of the parameter; an alias counts as the type it stands for "
     "(manual 1.3.4).",
     "TPWrite 5;",
     "TPWrite \"\" \\Num:=5;"},
    {4012, Kind::Body,
     "A VAR parameter needs a variable, a PERS parameter an entire persistent, an INOUT parameter "
     "either: the routine writes to it. Constants, expressions, loop variables and system variables "
     "cannot be written (manual 1.1.5).",
     "Incr 5;",
     "Incr reg1;"},
    {4013, Kind::Module,
     "A persistent is passed to PERS and INOUT parameters as a whole, not as an element or a "
     "component (manual 1.1.5). Copy the part to a variable and back. Instructions of RobotWare that "
     "change a value, such as Incr, take parts.",
     "PERS num list{3} := [1, 2, 3];\n"
     "PROC work(PERS num a)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work list{1};\n"
     "ENDPROC",
     "PERS num list{3} := [1, 2, 3];\n"
     "PROC work(PERS num a{*})\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work list;\n"
     "ENDPROC"},
    {4014, Kind::Module,
     "The routine has a parameter for each of several types, but none for the type of the argument.",
     "PROC send(VAR signalgo code)\n"
     "  SetGO code, \"5\";\n"
     "ENDPROC",
     "PROC send(VAR signalgo code)\n"
     "  SetGO code, 5;\n"
     "ENDPROC"},
    {4015, Kind::Module,
     "\\a?b passes b on if it is present; b must be an optional parameter of the routine that makes "
     "the call (manual 1.3.4).",
     "PROC tell(num level)\n"
     "  TPWrite \"\" \\Num?level;\n"
     "ENDPROC",
     "PROC tell(\\num level)\n"
     "  TPWrite \"\" \\Num?level;\n"
     "ENDPROC"},
    {4016, Kind::Module,
     "The name before ':=' must be that of the parameter whose turn it is (manual 1.3.4).",
     "PROC work(num a, num b)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work 1, c:=2;\n"
     "ENDPROC",
     "PROC work(num a, num b)\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  work 1, b:=2;\n"
     "ENDPROC"},
    {4017, Kind::Module,
     "In \\a?b either both a and b are switches or neither is.",
     "PROC work(\\switch fast)\n"
     "ENDPROC\n"
     "PROC main(\\num speed)\n"
     "  work \\fast?speed;\n"
     "ENDPROC",
     "PROC work(\\switch fast)\n"
     "ENDPROC\n"
     "PROC main(\\switch speed)\n"
     "  work \\fast?speed;\n"
     "ENDPROC"},
    {4018, Kind::Module,
     "Present tells whether an optional parameter of the routine itself was given; other data is "
     "always there (manual 1.1.5).",
     "VAR num level;\n"
     "PROC tell()\n"
     "  IF Present(level) reg1 := level;\n"
     "ENDPROC",
     "PROC tell(\\num level)\n"
     "  IF Present(level) reg1 := level;\n"
     "ENDPROC"},
    {4019, Kind::Body,
     "The parameter takes data of several types, but not of this one.",
     "reg2 := Dim(reg1, 1);",
     "VAR num list{3};\n"
     "reg2 := Dim(list, 1);"},
    {4020, Kind::Files,
     "A signal that the program names is not in the configuration given with --config. Define it "
     "there (type EIO_SIGNAL) or correct the name.",
     R"ex($ rapidc check main.mod --config=EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
      SetDO doLamb, 1;
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO")ex",
     R"ex($ rapidc check main.mod --config=EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
      SetDO doLamp, 1;
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:6:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO")ex"},
    {4021, Kind::Body,
     "Signals are defined by the configuration of the controller (manual 1.9). Without it rapidc "
     "takes the name for a signal of the type that is needed here; a name that is only compared with numbers "
     "may be a signal. Pass the configuration to have names and types checked: --config=EIO.cfg. 'rapidc "
     "signals' writes one from what the program uses, and with --assume-signals the program runs without.",
     "SetDO doLamp, 1;",
     "VAR signaldo doLamp;\n"
     "AliasIO \"lamp\", doLamp;\n"
     "SetDO doLamp, 1;"},
    {4022, Kind::Body,
     "Mechanical units are defined by the configuration of the controller; the name is taken for one. "
     "Pass the configuration with --config=MOC.cfg.",
     "ActUnit STN_1;",
     "TPWrite \"no unit\";"},
    {4023, Kind::Module,
     "'?' passes on an optional argument; a required parameter always needs its argument (manual "
     "1.3.4).",
     "PROC work(num a)\n"
     "ENDPROC\n"
     "PROC main(\\num b)\n"
     "  work \\a?b;\n"
     "ENDPROC",
     "PROC work(\\num a)\n"
     "ENDPROC\n"
     "PROC main(\\num b)\n"
     "  work \\a?b;\n"
     "ENDPROC"},
    {4024, Kind::Body,
     "Dim gives the size of one dimension of an array; arrays have one to three (manual 1.1.5, "
     "1.2.2).",
     "VAR num list{4};\n"
     "reg1 := Dim(list, 2);",
     "VAR num list{4};\n"
     "reg1 := Dim(list, 1);"},
    {4025, Kind::Files,
     "The instruction or function belongs to a RobotWare option. The backup lists the options of its "
     "controller, and this one is not among them: the controller does not know the name.",
     R"ex($ rapidc check . -W no-builtin-not-implemented
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    VAR wzstationary cell;
    VAR shapedata box;
    PROC main()
      WZBoxDef \Inside, box, [0,0,0], [500,500,500];
      WZLimSup \Stat, cell, box;
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check . -W no-builtin-not-implemented
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    608-1 World Zones
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    VAR wzstationary cell;
    VAR shapedata box;
    PROC main()
      WZBoxDef \Inside, box, [0,0,0], [500,500,500];
      WZLimSup \Stat, cell, box;
    ENDPROC
  ENDMODULE)ex"},
    {4026, Kind::Module,
     "Arguments without a name belong to the parameters in their order (manual 1.1.5, 1.3.4). Here each of two "
     "arguments has the data type of the other one.",
     "PROC go(robtarget p)\n"
     "  MoveL p, fine, v100, tool0;\n"
     "ENDPROC",
     "PROC go(robtarget p)\n"
     "  MoveL p, v100, fine, tool0;\n"
     "ENDPROC"},
    {4027, Kind::Files,
     "With --assume-signals the signals that no configuration defines exist all the same, with the type that "
     "the instructions and functions need which they are used with. Group signals have as many bits as their "
     "values need: 8, 16 or 32.",
     R"ex($ rapidc check main.mod --assume-signals
main.mod:
  MODULE MainModule
    PROC main()
      SetDO doLamp, 1;
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod --assume-signals --config=EIO.cfg
main.mod:
  MODULE MainModule
    PROC main()
      SetDO doLamp, 1;
    ENDPROC
  ENDMODULE
EIO.cfg:
  EIO:CFG_1.0:7:0::
  #
  EIO_SIGNAL:

        -Name "doLamp" -SignalType "DO")ex"},
    {4028, Kind::Module,
     "SetupCyclicBool has its condition evaluated again and again, also after the routine has ended. So the condition "
     "can refer only to what stays: values, signals, and persistents and variables of a module. It calls no function.",
     "PERS bool hot := FALSE;\n"
     "PERS num heat := 0;\n"
     "PROC go()\n"
     "  VAR num limit := 80;\n"
     "  SetupCyclicBool hot, heat > limit;\n"
     "ENDPROC",
     "PERS bool hot := FALSE;\n"
     "PERS num heat := 0;\n"
     "CONST num limit := 80;\n"
     "PROC go()\n"
     "  SetupCyclicBool hot, heat > limit;\n"
     "ENDPROC"},
    {4030, Kind::Body,
     "Cameras of Integrated Vision are configured on the controller; the name is taken for one. A run gets it with "
     "--camera=NAME=FILE.json, which says what the camera sees; otherwise the camera does not answer "
     "(ERR_CAM_COM_TIMEOUT).",
     "CamSetRunMode feederCamera;",
     "TPWrite \"no camera\";"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations4xxx() {
    return kExplanations;
}

} // namespace rapid::diag

// What the diagnostics of backups mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {6050, Kind::Files,
     "What a backup holds, in one line: system, RobotWare version, number of tasks and of signals "
     "in EIO.cfg, robot (use_robot_type in MOC.cfg, else the option line in backinfo.txt), add- "
     "ins.",
     R"ex($ rapidc check .
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
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6051, Kind::Files,
     "What a task of a backup is made of: type and entry routine (CAB_TASKS in SYS.cfg), modules "
     "that are read, modules that are encrypted or were not saved. What those declare is not "
     "known, so a name that no module declares may come from them.",
     R"ex($ rapidc check .
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
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6052, Kind::Files,
     "backinfo.txt lists a task that CAB_TASKS in SYS.cfg does not have. Options such as SafeMove "
     "make tasks of their own (SC_CBC, PSC_CBC), whose parameters are not saved. The task is read; "
     "without an entry routine it is left out of a run.",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  >>TASK2: (T_WATCH,,)
  PROGMOD/watch.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
RAPID/TASK2/PROGMOD/watch.mod:
  MODULE watch
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  >>TASK2: (T_WATCH,,)
  PROGMOD/watch.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
        -Name "T_WATCH" -Type "STATIC"
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
RAPID/TASK2/PROGMOD/watch.mod:
  MODULE watch
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6053, Kind::Files,
     "CAB_TASKS in SYS.cfg has a task for which the backup has no folder RAPID/TASKn. Copy the "
     "folder from a complete backup, or remove the task from SYS.cfg.",
     R"ex($ rapidc check .
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
        -Name "T_WATCH" -Type "STATIC"
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  >>TASK2: (T_WATCH,,)
  PROGMOD/watch.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
        -Name "T_WATCH" -Type "STATIC"
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
RAPID/TASK2/PROGMOD/watch.mod:
  MODULE watch
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6054, Kind::Files,
     "CAB_TASK_MODULES in SYS.cfg names a module that the controller loads at start from an add-in "
     "or from a folder that is not part of the backup. The program does not link without it: copy "
     "the file from the add-in into RAPID/TASKn/SYSMOD, or into HOME if SYS.cfg loads it from "
     "there.",
     R"ex($ rapidc check .
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
  #
  CAB_TASK_MODULES:

        -File "GRIPPER:/RAPID/gripping.sys" -ModName "gripping" -Task "T_ROB1"
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  SYSMOD/gripping.sys @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
  #
  CAB_TASK_MODULES:

        -File "GRIPPER:/RAPID/gripping.sys" -ModName "gripping" -Task "T_ROB1"
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
RAPID/TASK1/SYSMOD/gripping.sys:
  MODULE gripping(SYSMODULE)
  ENDMODULE)ex"},
    {6055, Kind::Files,
     "The list of modules in BACKINFO/backinfo.txt names a file that the task's folder does not "
     "have, in any letter case. The backup is not complete: copy the file there.",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  PROGMOD/tools.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  PROGMOD/tools.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
RAPID/TASK1/PROGMOD/tools.mod:
  MODULE tools
  ENDMODULE)ex"},
    {6056, Kind::Files,
     "The task's folder holds a module that the list in BACKINFO/backinfo.txt does not name, so it "
     "was added by hand. rapidc reads it, unless a listed file has the same module; a controller "
     "that restores the backup reads none of these. Add a line for it to backinfo.txt, or remove it.",
     R"ex($ rapidc check .
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
    PROC main()
    ENDPROC
  ENDMODULE
RAPID/TASK1/PROGMOD/tools.mod:
  MODULE tools
  ENDMODULE)ex",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  PROGMOD/tools.mod @
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
RAPID/TASK1/PROGMOD/tools.mod:
  MODULE tools
  ENDMODULE)ex"},
    {6057, Kind::Files,
     "Nothing of the task can be run: all its modules are encrypted or missing, or none that can "
     "be read declares its entry routine. The other tasks run without it.",
     R"ex($ rapidc check .
BACKINFO/backinfo.txt:
  >>SYSTEM_ID:
  cell
  >>PRODUCTS_ID:
  RobotWare Version: 7.10.0

    623-1 Multitasking
  >>TASK1: (T_ROB1,,)
  PROGMOD/main.mod @
  >>TASK2: (SC_CBC,,)
  >>EOF:
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
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
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6058, Kind::Files,
     "A backup should have BACKINFO/backinfo.txt, which names tasks and modules. Without it the "
     "folder TASKn is taken for the n-th task of CAB_TASKS in SYS.cfg, and every module in it is "
     "read.",
     R"ex($ rapidc check .
SYSPAR/SYS.cfg:
  SYS:CFG_1.0:6:0::
  #
  CAB_TASKS:

        -Name "T_ROB1" -Type "NORMAL" -MotionTask
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
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
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6059, Kind::Files,
     "CAB_TASK_MODULES in SYS.cfg names a module of RobotWare itself (RELEASE:), for example "
     "ScreenMaker. Backups never hold such modules. Names that no module declares may be declared "
     "there.",
     R"ex($ rapidc check .
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
  #
  CAB_TASK_MODULES:

        -File "RELEASE:/options/ScreenMaker.sys" -ModName "ScreenMaker" -AllTask -Hidden
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
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
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
    {6060, Kind::Files,
     "The configuration names a robot for which rapidc has no model. Checking is not affected. To "
     "run the program name a model that is known with --robot, for example --robot=\"IRB "
     "120-3/0.58\".",
     R"ex($ rapidc check .
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
SYSPAR/MOC.cfg:
  MOC:CFG_1.0:6:0::
  #
  ROBOT:

        -name "ROB_1" -use_robot_type "ROB1_9999_X"
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check .
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
SYSPAR/MOC.cfg:
  MOC:CFG_1.0:6:0::
  #
  ROBOT:

        -name "ROB_1" -use_robot_type "ROB1_120_0.58_3"
RAPID/TASK1/PROGMOD/main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE)ex"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanationsOfBackups() {
    return kExplanations;
}

} // namespace rapid::diag

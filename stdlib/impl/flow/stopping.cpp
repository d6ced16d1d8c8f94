// Manual 1.5: stopping and ending.

#include "runtime/abi/support_natives.h"
#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"

#include "natives/program_flow.h"
#include "stdlib_constants.h"

using namespace rt;

extern "C" {

/// Movement that has been ordered is finished first. \NoRegain changes nothing: the robot of a virtual controller is
/// where it stopped.
Status rt_Stop(TaskCore* task, bool, bool AllMoveTasks) {
    Task& owner = taskOf(task);
    if (owner.ignoredInUndo("Stop")) return kOk;
    if (owner.isMotionTask())
        if (const Status status = owner.controller().motion(owner).waitIdle(owner)) return status;
    return owner.stopHere("Stop", AllMoveTasks);
}

/// The arm is stopped at once, not at the end of the movement.
Status rt_DebugBreak(TaskCore* task) {
    Task& owner = taskOf(task);
    if (owner.ignoredInUndo("DebugBreak")) return kOk;
    if (owner.isMotionTask()) owner.controller().motion(owner).programStop();
    return owner.stopHere("DebugBreak");
}

/// \StopBlock: a start needs the program pointer moved first. \Halt: the motors go off; a start switches them on again.
Status rt_SystemStopAction(TaskCore* task, bool Stop, bool StopBlock, bool Halt) {
    if (Stop + StopBlock + Halt != 1)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "SystemStopAction needs one of \\Stop, \\StopBlock and \\Halt");
    Task& owner = taskOf(task);
    if (owner.ignoredInUndo("SystemStopAction")) return kOk;
    owner.controller().motion(owner).programStop();
    return owner.stopHere("SystemStopAction", true, StopBlock ? StopCause::Blocked : StopCause::Instruction);
}

Status rt_ExitCycle(TaskCore* task) {
    return taskOf(task).requestExitCycle();
}

Status rt_takeBackward(TaskCore* task, bool* result) {
    *result = taskOf(task).takeBackward();
    return kOk;
}

Status rt_exitProgram(TaskCore* task) {
    return taskOf(task).requestExit();
}
}

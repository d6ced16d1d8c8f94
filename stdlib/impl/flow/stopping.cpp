// Manual 1.5: stopping and ending.

#include "runtime/host/controller.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/support_natives.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;

extern "C" {

/// Movement that has been ordered is finished first.
Status rt_Stop(TaskCore* task) {
    Task& owner = taskOf(task);
    if (owner.isMotionTask())
        if (const Status status = owner.controller().motion().waitIdle(owner)) return status;
    return owner.stopHere();
}

Status rt_DebugBreak(TaskCore* task) {
    return taskOf(task).stopHere();
}

Status rt_SystemStopAction(TaskCore* task, bool Stop, bool StopBlock, bool Halt) {
    if (Stop + StopBlock + Halt != 1)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "SystemStopAction needs one of \\Stop, \\StopBlock and \\Halt");
    return taskOf(task).stopHere(true);
}

Status rt_ExitCycle(TaskCore* task) {
    return taskOf(task).requestExitCycle();
}

Status rt_takeBackward(TaskCore* task, uint8_t* result) {
    *result = taskOf(task).takeBackward() ? 1 : 0;
    return kOk;
}

Status rt_exitProgram(TaskCore* task) {
    return taskOf(task).requestExit();
}
}

// Manual 1.8: stopping and starting movement.

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <algorithm>

using namespace rt;

namespace {

MotionDriver& driverOf(TaskCore* task) {
    return taskOf(task).controller().motion();
}

} // namespace

// \AllMotionTasks changes nothing: there is one robot.
extern "C" {

/// The arm always brakes on its path as fast as its limits allow, with and without \Quick.
Status rt_StopMove(TaskCore* task, bool, bool) {
    driverOf(task).stopMove();
    return kOk;
}

Status rt_StartMove(TaskCore* task, bool) {
    MotionDriver& driver = driverOf(task);
    if (!driver.isStopMoveActive() && driver.system().isMoving())
        return lib::fail(task, err::ERR_ALRDY_MOVING, "the robot moves already");
    driver.startMove();
    return kOk;
}

/// Compiled as this call followed by RETRY.
Status rt_StartMoveRetry(TaskCore* task) {
    return rt_StartMove(task, false);
}

/// The program waits at the movement that runs until its corner path begins, so the instruction that ordered the movement and
/// the latest one are the same, or the error waits for the next one.
Status rt_ProcerrRecovery(TaskCore* task, bool SyncOrgMoveInst, bool SyncLastMoveInst, Handle* ProcSignal) {
    if (SyncOrgMoveInst == SyncLastMoveInst)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "ProcerrRecovery needs one of \\SyncOrgMoveInst and \\SyncLastMoveInst");
    Controller& controller = taskOf(task).controller();
    const IoSystem& io = controller.io();
    if (ProcSignal != nullptr && io.value(io.idOf(*ProcSignal)) == 0)
        return lib::fail(task, err::ERR_PROCSIGNAL_OFF,
                         "the process signal is 0: the process is off already");
    controller.motion().raiseProcessError(err::ERR_PATH_STOP);
    return kOk;
}

/// The stop is forgotten: the next movement ordered starts at once.
Status rt_StopMoveReset(TaskCore* task, bool) {
    MotionDriver& driver = driverOf(task);
    if (!driver.isStopMoveActive()) return kOk;
    driver.clearPath();
    driver.startMove();
    return kOk;
}

Status rt_ClearPath(TaskCore* task) {
    driverOf(task).clearPath();
    return kOk;
}

Status rt_IsStopMoveAct(TaskCore* task, bool* result, bool, bool) {
    *result = driverOf(task).isStopMoveActive();
    return kOk;
}

/// At StepLength / StepTime, at most 250 mm/s. A step ends at the beginning of the movement it began in; the next one may go
/// on in the movement before.
Status rt_StepBwdPath(TaskCore* task, float StepLength, float StepTime) {
    constexpr double kFastest = 250; // mm/s
    if (const Status status = lib::requireMotionTask(task)) return status;
    if (!(StepLength > 0) || !(StepTime > 0))
        return lib::fail(task, err::ERR_ARGVALERR, "StepBwdPath: length and time must be above 0");
    bool possible = false;
    const double speed = std::min(kFastest, static_cast<double>(StepLength) / static_cast<double>(StepTime));
    if (const Status status = driverOf(task).stepBack(taskOf(task), StepLength, speed, possible))
        return status;
    if (possible) return kOk;
    return lib::fail(
        task, err::ERR_BWDLIMIT,
        "there is no path to step back on: the robot must have been stopped on its path, and goes back no "
        "further than the beginning of the movement before the one that was stopped");
}

Status rt_PathLevel(TaskCore*, float* result) {
    *result = 1; // StorePath is not available
    return kOk;
}

/// There is one path level: nothing is ever stored below an interrupt's.
Status rt_PFRestart(TaskCore* task, bool* result, bool, bool Irpt) {
    *result = !Irpt && driverOf(task).pathInterrupted();
    return kOk;
}
}

// Manual 1.8: stopping and starting movement, path levels.

#include "runtime/host/synchronised_group.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "natives/errors.h"
#include "natives/path.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <algorithm>

using namespace rt;

namespace {

MotionDriver& driverOf(TaskCore* task) {
    return lib::motionOf(task);
}

/// Not recoverable: the instruction does not fit the path level.
Status levelMisused(TaskCore* task, std::string why) {
    return taskOf(task).fatal(static_cast<int>(EventId::LevelMisused), std::move(why));
}

StopOrigin originOf(TaskCore* task) {
    return taskOf(task).isMotionTask() ? StopOrigin::MotionTask : StopOrigin::OtherTask;
}

/// The robot of the task, or with \AllMotionTasks every one.
template <class Action> void forRobots(TaskCore* task, bool allMotionTasks, Action action) {
    if (!allMotionTasks) return action(driverOf(task));
    for (const auto& driver : taskOf(task).controller().motions())
        action(*driver);
}

/// Raises an error when the robot cannot start now.
Status checkStart(TaskCore* task, MotionDriver& driver) {
    constexpr double kFarthest = 10, kMostTurned = 20; // mm, deg
    if (!driver.isStopMoveActive() && driver.system().isMoving())
        return lib::fail(task, err::ERR_ALRDY_MOVING, "the robot moves already");
    if (!taskOf(task).controller().motorsOn())
        return lib::fail(task, err::ERR_STARTMOVE, "the robot cannot start: its motors are off");
    if (driver.isProgramStopped())
        return lib::fail(task, err::ERR_PROGSTOP,
                         "the robot cannot start: the program of its task is stopped");
    if (const auto gap = driver.gapToPath(); gap && (gap->mm > kFarthest || gap->degrees > kMostTurned))
        return lib::fail(
            task, err::ERR_PATHDIST,
            fmt::format(
                "the robot is {:.1f} mm and {:.1f} degrees from its path; at most 10 mm and 20 degrees are "
                "allowed: move it back to where the path was interrupted before RestoPath",
                gap->mm, gap->degrees));
    return kOk;
}

} // namespace

extern "C" {

Status rt_StopMove(TaskCore* task, bool Quick, bool AllMotionTasks) {
    const auto kind = Quick ? motion::StopKind::Quick : motion::StopKind::Normal;
    forRobots(task, AllMotionTasks,
              [task, kind](MotionDriver& driver) { driver.stopMove(originOf(task), kind); });
    return kOk;
}

Status rt_StartMove(TaskCore* task, bool AllMotionTasks) {
    Status status = kOk;
    forRobots(task, AllMotionTasks, [&](MotionDriver& driver) {
        if (status == kOk) status = checkStart(task, driver);
    });
    if (status != kOk) return status;
    forRobots(task, AllMotionTasks, [task](MotionDriver& driver) { driver.startMove(originOf(task)); });
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
    MotionDriver& driver = driverOf(task);
    const auto group = driver.synchronised(); // an error of one robot concerns all that move with it
    if (group == nullptr) driver.raiseProcessError(err::ERR_PATH_STOP);
    if (group != nullptr)
        for (const SynchronisedGroup::Member& member : group->members())
            member.driver->raiseProcessError(err::ERR_PATH_STOP);
    return kOk;
}

/// The stop is forgotten: the next movement ordered starts at once.
Status rt_StopMoveReset(TaskCore* task, bool AllMotionTasks) {
    forRobots(task, AllMotionTasks, [task](MotionDriver& driver) {
        if (!driver.isStopMoveActive(originOf(task))) return;
        driver.clearLevel();
        driver.startMove(originOf(task));
    });
    return kOk;
}

Status rt_ClearPath(TaskCore* task) {
    driverOf(task).clearLevel();
    return kOk;
}

Status rt_IsStopMoveAct(TaskCore* task, bool* result, bool FromMoveTask, bool FromNonMoveTask) {
    const MotionDriver& driver = driverOf(task);
    *result = FromMoveTask      ? driver.isStopMoveActive(StopOrigin::MotionTask)
              : FromNonMoveTask ? driver.isStopMoveActive(StopOrigin::OtherTask)
                                : driver.isStopMoveActive();
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

/// One movement path can be stored at a time (PathLevel is 1 or 2).
Status rt_StorePath(TaskCore* task, bool KeepSync) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    if (KeepSync && driverOf(task).synchronised() == nullptr)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "\\KeepSync is for robots in synchronised movement (SyncMoveOn)");
    if (driverOf(task).pathLevel() > 1)
        return levelMisused(
            task, "StorePath: a path is stored already, and only one can be. Execute RestoPath first.");
    return driverOf(task).storePath(taskOf(task), KeepSync);
}

Status rt_RestoPath(TaskCore* task) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    if (driverOf(task).pathLevel() == 1)
        return levelMisused(task, "RestoPath: no path is stored. Execute StorePath first.");
    return driverOf(task).restorePath(taskOf(task));
}

Status rt_PathLevel(TaskCore* task, float* result) {
    *result = static_cast<float>(driverOf(task).pathLevel());
    return kOk;
}

/// Without a switch: on the present path level.
Status rt_PFRestart(TaskCore* task, bool* result, bool Base, bool Irpt) {
    MotionDriver& driver = driverOf(task);
    *result = driver.pathInterrupted(Base ? 1 : Irpt ? 2 : driver.pathLevel());
    return kOk;
}
}

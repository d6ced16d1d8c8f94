// Manual 1.8: path recorder. Where the manual is silent: without \ID the way back leads to the latest PathRecStart before the
// arm, without the need of a path level of its own as long as the path of the present level is finished. Movements are
// executed again with their types, zones and tools; lines and circles begin where the arm is, which after a corner is up
// to its zone beside the line. Nothing that was to be done on the path (TriggIO ...) is done again. The recording does not
// outlive the process.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/path_recorder.h"
#include "stdlib/impl/motion/state.h"

#include "natives/path.h"
#include "stdlib_constants.h"

#include <string>

using namespace rt;

namespace {

lib::PathRecorder& recorderOf(TaskCore* task) {
    return lib::motionOf(task).service<lib::PathRecorder>();
}

Status recorderMisused(TaskCore* task, std::string why) {
    return taskOf(task).fatal(static_cast<int>(EventId::PathRecorderMisused), std::move(why));
}

lib::PathRecorder::Manner mannerOf(const data::Pos* toolOffs, const data::Speeddata* speed) {
    lib::PathRecorder::Manner manner;
    if (toolOffs != nullptr) manner.offset.pos = {toolOffs->x, toolOffs->y, toolOffs->z};
    if (speed != nullptr) manner.speed = {speed->v_tcp, speed->v_ori, speed->v_leax, speed->v_reax};
    return manner;
}

/// -1: a variable that PathRecStart has not named.
Handle idOf(const Handle* id) {
    if (id == nullptr) return 0;
    return *id == 0 ? -1 : *id;
}

/// kOk, or the reason why the recorder cannot move the robot now.
Status checkMovable(TaskCore* task, const char* instruction) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    if (lib::motionSystemOf(task).isIdle()) return kOk;
    return recorderMisused(
        task, std::string(instruction) +
                  ": movements are unfinished. Put them aside with StorePath, or wait until the robot "
                  "is at a stop point.");
}

} // namespace

extern "C" {

Status rt_PathRecStart(TaskCore* task, Handle* ID) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    lib::PathRecorder& recorder = recorderOf(task);
    if (*ID == 0) *ID = recorder.newId();
    recorder.start(task, *ID);
    return kOk;
}

Status rt_PathRecStop(TaskCore* task, bool Clear) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    recorderOf(task).stop();
    if (Clear) recorderOf(task).clear();
    return kOk;
}

Status rt_PathRecMoveBwd(TaskCore* task, Handle* ID, const data::Pos* ToolOffs,
                         const data::Speeddata* Speed) {
    if (const Status status = checkMovable(task, "PathRecMoveBwd")) return status;
    Task& owner = taskOf(task);
    const auto goal = recorderOf(task).goalBack(lib::motionSystemOf(task), idOf(ID));
    if (!goal)
        return recorderMisused(task,
                               "PathRecMoveBwd: no path back to there is recorded (see PathRecValidBwd).");
    return recorderOf(task).moveBack(owner, *goal, mannerOf(ToolOffs, Speed));
}

Status rt_PathRecMoveFwd(TaskCore* task, Handle* ID, const data::Pos* ToolOffs,
                         const data::Speeddata* Speed) {
    if (const Status status = checkMovable(task, "PathRecMoveFwd")) return status;
    const auto goal = recorderOf(task).goalForward(idOf(ID));
    if (!goal)
        return recorderMisused(task,
                               "PathRecMoveFwd: PathRecMoveBwd has not left a path forward to there (see "
                               "PathRecValidFwd).");
    return recorderOf(task).moveForward(taskOf(task), *goal, mannerOf(ToolOffs, Speed));
}

Status rt_PathRecValidBwd(TaskCore* task, bool* result, Handle* ID) {
    *result = recorderOf(task).goalBack(lib::motionSystemOf(task), idOf(ID)).has_value();
    return kOk;
}

Status rt_PathRecValidFwd(TaskCore* task, bool* result, Handle* ID) {
    *result = recorderOf(task).goalForward(idOf(ID)).has_value();
    return kOk;
}
}

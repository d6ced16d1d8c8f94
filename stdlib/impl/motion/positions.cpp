// Manual 1.8: positions that are read.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/finite.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;

namespace {

motion::MotionSystem& systemOf(TaskCore* task) {
    return taskOf(task).controller().motion().system();
}

/// \TaskRef and \TaskName name the motion task whose robot is meant; without them it is the only robot there is.
Status checkTask(TaskCore* task, const Handle* ref, const String* name) {
    if (!ref && !name) return kOk;
    Controller& controller = taskOf(task).controller();
    const Task* other = nullptr;
    if (name)
        other = controller.findTask(name->view());
    else if (*ref >= 1 && *ref <= static_cast<Handle>(controller.tasks().size()))
        other = controller.tasks()[static_cast<size_t>(*ref - 1)].get();
    if (!other) return lib::fail(task, err::ERR_TASKNAME, "there is no such task");
    if (!other->isMotionTask())
        return lib::fail(task, err::ERR_NOT_MOVETASK, "task " + other->name() + " moves no robot");
    return kOk;
}

motion::FrameSetup framesFor(TaskCore* task, const data::Tooldata* tool, const data::Wobjdata* workObject) {
    motion::FrameSetup frames = lib::frameSetup(lib::motionState(task), tool, workObject);
    frames.baseFrame = systemOf(task).model().baseFrame;
    return frames;
}

const data::Wobjdata& world() {
    static const data::Wobjdata kWorld = lib::MotionState().workObject;
    return kWorld;
}

motion::RobTarget currentTarget(TaskCore* task, const data::Tooldata* tool,
                                const data::Wobjdata* workObject) {
    motion::RobTarget target = systemOf(task).currentTarget(framesFor(task, tool, workObject));
    lib::addOffsets(target.extax, lib::motionState(task).axisOffsets, -1);
    return target;
}

} // namespace

extern "C" {

Status rt_CRobT(TaskCore* task, data::Robtarget* result, Handle* TaskRef, const String* TaskName,
                data::Tooldata* Tool, data::Wobjdata* WObj) {
    if (const Status status = checkTask(task, TaskRef, TaskName)) return status;
    return lib::give(task, result,
                     lib::toRobtarget(currentTarget(task, Tool, WObj), systemOf(task).kinematics()));
}

Status rt_CPos(TaskCore* task, data::Pos* result, data::Tooldata* Tool, data::Wobjdata* WObj) {
    return lib::give(task, result, lib::toPos(currentTarget(task, Tool, WObj).pose.pos));
}

Status rt_CJointT(TaskCore* task, data::Jointtarget* result, Handle* TaskRef, const String* TaskName) {
    if (const Status status = checkTask(task, TaskRef, TaskName)) return status;
    return lib::give(task, result,
                     lib::toJointtarget(systemOf(task).currentJoints(), systemOf(task).kinematics()));
}

Status rt_CTool(TaskCore* task, data::Tooldata* result, Handle* TaskRef, const String* TaskName) {
    if (const Status status = checkTask(task, TaskRef, TaskName)) return status;
    *result = lib::motionState(task).tool;
    return kOk;
}

Status rt_CWObj(TaskCore* task, data::Wobjdata* result, Handle* TaskRef, const String* TaskName) {
    if (const Status status = checkTask(task, TaskRef, TaskName)) return status;
    *result = lib::motionState(task).workObject;
    return kOk;
}

Status rt_CalcRobT(TaskCore* task, data::Robtarget* result, const data::Jointtarget* Joint_target,
                   data::Tooldata* Tool, data::Wobjdata* WObj) {
    const motion::FrameSetup frames = framesFor(task, Tool, WObj ? WObj : &world());
    const motion::MotionSystem& system = systemOf(task);
    motion::JointTarget joints = lib::toJoints(*Joint_target, system.kinematics());
    constexpr std::size_t kAxis7 = 6; // 9E9: where it is
    if (joints.robax.size() > kAxis7 && !motion::isConnected(joints.robax[kAxis7]))
        joints.robax[kAxis7] = system.currentJoints().robax[kAxis7];
    motion::RobTarget target = motion::calcRobTarget(system.kinematics(), joints, frames);
    lib::addOffsets(target.extax, lib::motionState(task).axisOffsets, -1);
    return lib::give(task, result, lib::toRobtarget(target, system.kinematics()));
}

/// \UseCurWObjPos only matters for work objects that another unit moves.
Status rt_CalcJointT(TaskCore* task, data::Jointtarget* result, bool, const data::Robtarget* Rob_target,
                     data::Tooldata* Tool, data::Wobjdata* WObj, float* ErrorNumber) {
    const motion::FrameSetup frames = framesFor(task, Tool, WObj ? WObj : &world());
    motion::RobTarget target = lib::toTarget(*Rob_target, systemOf(task).kinematics());
    lib::addOffsets(target.extax, lib::motionState(task).axisOffsets, 1);
    motion::MotionSystem& system = systemOf(task);
    const auto joints =
        motion::calcJointTarget(system.kinematics(), target, frames, system.currentJoints().robax);
    if (ErrorNumber) *ErrorNumber = 0;
    if (joints) return lib::give(task, result, lib::toJointtarget(*joints, systemOf(task).kinematics()));
    const Status number = lib::motionErrno(joints.error());
    if (!ErrorNumber) return lib::fail(task, number, joints.error().message());
    *ErrorNumber = static_cast<float>(number);
    *result = {};
    return kOk;
}

/// Manual 1.7: without a switch, both displacement and offsets are taken out; \InPDisp keeps the position in the
/// displacement frame, \InEOffs keeps the axes in the offset frame.
Status rt_ORobT(TaskCore* task, data::Robtarget* result, const data::Robtarget* OrgPoint, bool InPDisp,
                bool InEOffs) {
    const lib::MotionState& state = lib::motionState(task);
    motion::RobTarget target = lib::toTarget(*OrgPoint, systemOf(task).kinematics());
    if (!InPDisp) target.pose = state.displacement * target.pose;
    if (!InEOffs) lib::addOffsets(target.extax, state.axisOffsets, 1);
    return lib::give(task, result, lib::toRobtarget(target, systemOf(task).kinematics()));
}

Status rt_RobName(TaskCore* task, String* result) {
    Task& owner = taskOf(task);
    result->assign(owner.isMotionTask() ? std::string_view(owner.controller().motion().unitName())
                                        : std::string_view());
    return kOk;
}
}

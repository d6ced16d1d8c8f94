// Manual 1.8: positions that are read.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/finite.h"

#include "natives/motion_misc.h"
#include "natives/motion_settings.h"
#include "natives/positions.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

/// The task whose robot is meant: that of \TaskRef or \TaskName, else the calling one.
Status askedTask(TaskCore* task, const Handle* ref, const String* name, TaskCore*& asked) {
    asked = task;
    if (!ref && !name) return kOk;
    Controller& controller = taskOf(task).controller();
    Task* other = nullptr;
    if (name)
        other = controller.findTask(name->view());
    else if (*ref >= 1 && *ref <= static_cast<Handle>(controller.tasks().size()))
        other = controller.tasks()[static_cast<size_t>(*ref - 1)].get();
    if (!other) return lib::fail(task, err::ERR_TASKNAME, "there is no such task");
    if (!other->isMotionTask())
        return lib::fail(task, err::ERR_NOT_MOVETASK, "task " + other->name() + " moves no robot");
    asked = other;
    return kOk;
}

const data::Wobjdata& world() {
    static const data::Wobjdata kWorld = lib::MotionState().workObject;
    return kWorld;
}

/// Null for tool and work object: those in force in the task that is asked.
Status currentTarget(TaskCore* task, TaskCore* asked, const data::Tooldata* tool,
                     const data::Wobjdata* workObject, motion::RobTarget& target) {
    const lib::MotionState& state = lib::motionState(asked);
    motion::FrameSetup frames;
    if (const Status status = lib::frameSetup(task, tool ? tool : &state.tool,
                                              workObject ? workObject : &state.workObject, frames))
        return status;
    frames.displacement = state.displacement;
    target = lib::motionSystemOf(asked).currentTarget(frames);
    lib::addOffsets(target.extax, state.axisOffsets, -1);
    return kOk;
}

} // namespace

extern "C" {

Status rt_CRobT(TaskCore* task, data::Robtarget* result, Handle* TaskRef, const String* TaskName,
                data::Tooldata* Tool, data::Wobjdata* WObj) {
    TaskCore* asked = nullptr;
    if (const Status status = askedTask(task, TaskRef, TaskName, asked)) return status;
    motion::RobTarget target;
    if (const Status status = currentTarget(task, asked, Tool, WObj, target)) return status;
    return lib::give(task, result, lib::toRobtarget(target, lib::motionSystemOf(asked).kinematics()));
}

Status rt_CPos(TaskCore* task, data::Pos* result, data::Tooldata* Tool, data::Wobjdata* WObj) {
    motion::RobTarget target;
    if (const Status status = currentTarget(task, task, Tool, WObj, target)) return status;
    return lib::give(task, result, lib::toPos(target.pose.pos));
}

Status rt_CJointT(TaskCore* task, data::Jointtarget* result, Handle* TaskRef, const String* TaskName) {
    TaskCore* asked = nullptr;
    if (const Status status = askedTask(task, TaskRef, TaskName, asked)) return status;
    return lib::give(task, result,
                     lib::toJointtarget(lib::motionSystemOf(asked).currentJoints(),
                                        lib::motionSystemOf(asked).kinematics()));
}

Status rt_CTool(TaskCore* task, data::Tooldata* result, Handle* TaskRef, const String* TaskName) {
    TaskCore* asked = nullptr;
    if (const Status status = askedTask(task, TaskRef, TaskName, asked)) return status;
    *result = lib::motionState(asked).tool;
    return kOk;
}

Status rt_CWObj(TaskCore* task, data::Wobjdata* result, Handle* TaskRef, const String* TaskName) {
    TaskCore* asked = nullptr;
    if (const Status status = askedTask(task, TaskRef, TaskName, asked)) return status;
    *result = lib::motionState(asked).workObject;
    return kOk;
}

Status rt_CalcRobT(TaskCore* task, data::Robtarget* result, const data::Jointtarget* Joint_target,
                   data::Tooldata* Tool, data::Wobjdata* WObj) {
    motion::FrameSetup frames;
    if (const Status status = lib::frameSetup(task, Tool, WObj ? WObj : &world(), frames)) return status;
    const motion::MotionSystem& system = lib::motionSystemOf(task);
    motion::JointTarget joints = lib::toJoints(*Joint_target, system.kinematics());
    constexpr std::size_t kAxis7 = 6; // 9E9: where it is
    if (joints.robax.size() > kAxis7 && !motion::isConnected(joints.robax[kAxis7]))
        joints.robax[kAxis7] = system.currentJoints().robax[kAxis7];
    motion::RobTarget target = system.toRobTarget(joints, frames);
    lib::addOffsets(target.extax, lib::motionState(task).axisOffsets, -1);
    return lib::give(task, result, lib::toRobtarget(target, system.kinematics()));
}

/// Without \UseCurWObjPos a work object that a unit moves is where the external axes of the target bring it.
Status rt_CalcJointT(TaskCore* task, data::Jointtarget* result, bool UseCurWObjPos,
                     const data::Robtarget* Rob_target, data::Tooldata* Tool, data::Wobjdata* WObj,
                     float* ErrorNumber) {
    motion::FrameSetup frames;
    if (const Status status = lib::frameSetup(task, Tool, WObj ? WObj : &world(), frames)) return status;
    motion::RobTarget target = lib::toTarget(*Rob_target, lib::motionSystemOf(task).kinematics());
    lib::addOffsets(target.extax, lib::motionState(task).axisOffsets, 1);
    const motion::MotionSystem& system = lib::motionSystemOf(task);
    if (UseCurWObjPos && frames.userMover != nullptr) {
        frames.workObject.uframe = frames.userMover->frame(system.currentJoints().extax);
        frames.userMover = nullptr;
    }
    const auto joints = system.toJointTarget(target, frames);
    if (ErrorNumber) *ErrorNumber = 0;
    if (joints) return lib::give(task, result, lib::toJointtarget(*joints, system.kinematics()));
    if (!ErrorNumber) return lib::failMotion(task, joints.error());
    *ErrorNumber = static_cast<float>(lib::motionErrno(joints.error()));
    *result = {};
    return kOk;
}

/// Manual 1.7: without a switch, both displacement and offsets are taken out; \InPDisp keeps the position in the
/// displacement frame, \InEOffs keeps the axes in the offset frame.
Status rt_ORobT(TaskCore* task, data::Robtarget* result, const data::Robtarget* OrgPoint, bool InPDisp,
                bool InEOffs) {
    const lib::MotionState& state = lib::motionState(task);
    motion::RobTarget target = lib::toTarget(*OrgPoint, lib::motionSystemOf(task).kinematics());
    if (!InPDisp) target.pose = state.displacement * target.pose;
    if (!InEOffs) lib::addOffsets(target.extax, state.axisOffsets, 1);
    return lib::give(task, result, lib::toRobtarget(target, lib::motionSystemOf(task).kinematics()));
}

Status rt_RobName(TaskCore* task, String* result) {
    Task& owner = taskOf(task);
    result->assign(lib::movesRobot(owner) ? std::string_view(lib::motionOf(task).unitName())
                                          : std::string_view(""));
    return kOk;
}
}

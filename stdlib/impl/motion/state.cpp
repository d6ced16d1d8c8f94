#include "stdlib/impl/motion/state.h"

#include "stdlib/impl/conveyor/indexing.h"
#include "stdlib/impl/conveyor/sensor_sync.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/motion/independent_axes.h"
#include "stdlib/impl/motion/path_recorder.h"
#include "stdlib/impl/motion/soft_servo.h"
#include "stdlib/impl/motion/speed_outputs.h"
#include "stdlib/impl/motion/world_zones.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace rt::lib {

MotionState& motionState(TaskCore* task) {
    return motionOf(task).service<MotionState>();
}

void restoreDefaults(Task& task) {
    if (!task.isMotionTask()) return;
    MotionDriver& motion = task.controller().motion(task);
    auto& state = motion.service<MotionState>();
    MotionState defaults;
    defaults.tool = state.tool;
    defaults.workObject = state.workObject;
    state = defaults;
    motion.setCornerWarning(true);
    motion.setSpeedLimits({});
}

void resetSettings(Task& task) {
    if (!task.isMotionTask()) return;
    restoreDefaults(task);
    MotionDriver& motion = task.controller().motion(task);
    motion.setProgramOverride(100);
    endSpeedOutputs(task);
    endStopSupervision(task);
    endTemporaryZones(task);
    endPathRecording(motion);
    endCorrections(motion);
    endSoftServo(task.controller(), motion);
    endIndependentMode(motion);
    endSensorSync(task);
    resetIndexing(task.controller());
}

Status requireMotionTask(TaskCore* task) {
    if (taskOf(task).isMotionTask()) return kOk;
    return fail(task, err::ERR_NOT_MOVETASK,
                "only a motion task may move the robot; set MotionTask of this task");
}

motion::ExternalAxes toAxes(const data::Extjoint& a) {
    return {a.eax_a, a.eax_b, a.eax_c, a.eax_d, a.eax_e, a.eax_f};
}

namespace {

data::Extjoint toExtjoint(const motion::ExternalAxes& axes) {
    const auto f = [&](size_t i) { return static_cast<float>(motion::isConnected(axes[i]) ? axes[i] : 9e9); };
    return {f(0), f(1), f(2), f(3), f(4), f(5)};
}

} // namespace

motion::Pose toMovePose(const data::Robtarget& target) {
    constexpr double kRounding = 0.1; // of programs that write orientations with one or two digits
    motion::Pose pose = toFrame(target);
    const motion::Quat raw = toQuat(target.rot);
    if (!(std::fabs(norm(raw) - 1) < kRounding)) pose.rot = raw;
    return pose;
}

motion::RobTarget toTarget(const data::Robtarget& target, const robot::Kinematics& arm) {
    const auto whole = [](float v) { return static_cast<int>(std::lround(v)); };
    const data::Confdata& c = target.robconf;
    motion::RobTarget result{
        toMovePose(target), {whole(c.cf1), whole(c.cf4), whole(c.cf6), whole(c.cfx)}, toAxes(target.extax)};
    if (!arm.hasArmAngle()) return result;
    if (motion::isConnected(result.extax[0])) result.armAngle = result.extax[0];
    result.extax[0] = motion::kNotConnected;
    return result;
}

data::Robtarget toRobtarget(const motion::RobTarget& target, const robot::Kinematics& arm) {
    const motion::ConfData& c = target.conf;
    motion::ExternalAxes axes = target.extax;
    if (arm.hasArmAngle()) axes[0] = std::isnan(target.armAngle) ? motion::kNotConnected : target.armAngle;
    return {toPos(target.pose.pos),
            toOrient(target.pose.rot),
            {static_cast<float>(c.cf1), static_cast<float>(c.cf4), static_cast<float>(c.cf6),
             static_cast<float>(c.cfx)},
            toExtjoint(axes)};
}

motion::JointTarget toJoints(const data::Jointtarget& target, const robot::Kinematics& arm) {
    const data::Robjoint& r = target.robax;
    const float axes[] = {r.rax_1, r.rax_2, r.rax_3, r.rax_4, r.rax_5, r.rax_6};
    motion::JointTarget joints{robot::Joints::zeros(arm.jointCount()), toAxes(target.extax)};
    for (size_t i = 0; i < joints.robax.size(); ++i) {
        const auto number = static_cast<size_t>(arm.axisNumber(i));
        joints.robax[i] = number <= std::size(axes) ? axes[number - 1]
                                                    : std::exchange(joints.extax[0], motion::kNotConnected);
    }
    return joints;
}

data::Jointtarget toJointtarget(const motion::JointTarget& joints, const robot::Kinematics& arm) {
    float axes[6] = {};
    motion::ExternalAxes external = joints.extax;
    for (size_t i = 0; i < joints.robax.size(); ++i) {
        const auto number = static_cast<size_t>(arm.axisNumber(i));
        if (number <= std::size(axes))
            axes[number - 1] = static_cast<float>(joints.robax[i]);
        else
            external[0] = joints.robax[i];
    }
    return {{axes[0], axes[1], axes[2], axes[3], axes[4], axes[5]}, toExtjoint(external)};
}

void addOffsets(motion::ExternalAxes& axes, const motion::ExternalAxes& offsets, double sign) {
    for (size_t i = 0; i < axes.size(); ++i)
        if (motion::isConnected(axes[i]) && motion::isConnected(offsets[i])) axes[i] += sign * offsets[i];
}

namespace {

/// The controller stops with an event that no error handler takes: MoveC has no error constant for it.
bool makesNoCircle(motion::MotionErrorKind kind) {
    using Kind = motion::MotionErrorKind;
    return kind == Kind::CirclePointsTooClose || kind == Kind::CirclePointsCollinear ||
           kind == Kind::CircleTooLarge;
}

} // namespace

Status motionErrno(const motion::MotionError& error) {
    using Kind = motion::MotionErrorKind;
    switch (error.kind) {
    case Kind::BadArgument: return err::ERR_ARGVALERR;
    case Kind::JointOutOfRange:
    case Kind::ElbowOutOfRange:
    case Kind::NoSuchConfiguration:
    case Kind::ConfigurationMismatch:
    case Kind::Singularity: return err::ERR_ROBLIMIT;
    case Kind::Unreachable:
    case Kind::CirclePointsTooClose:
    case Kind::CirclePointsCollinear:
    case Kind::CircleTooLarge:
    case Kind::QueueFull: return err::ERR_OUTSIDE_REACH;
    }
    return err::ERR_OUTSIDE_REACH;
}

Status failMotion(TaskCore* task, const motion::MotionError& error) {
    using Kind = motion::MotionErrorKind;
    constexpr Kind kOfTheModel[] = {Kind::Unreachable, Kind::JointOutOfRange, Kind::NoSuchConfiguration,
                                    Kind::ConfigurationMismatch, Kind::Singularity};
    if (makesNoCircle(error.kind))
        return taskOf(task).fatal(static_cast<int>(EventId::CircleUncertain), error.message());
    const Status number = motionErrno(error);
    const Controller& controller = taskOf(task).controller();
    const MotionGroup& group = controller.units().groups()[motionOf(task).group()];
    const bool dependsOnModel =
        std::find(std::begin(kOfTheModel), std::end(kOfTheModel), error.kind) != std::end(kOfTheModel);
    if (!group.isModelAssumed || !dependsOnModel) return fail(task, number, error.message());
    return fail(task, number,
                fmt::format("{}; no robot is given, so this is the {}: name yours with --robot",
                            error.message(), group.model.name));
}

} // namespace rt::lib

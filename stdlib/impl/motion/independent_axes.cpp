// Manual 1.8, 2.2.4: independent axes: axis 6 of the robot, and external axes that MOC.cfg marks (ARM independent_joint_on).
// IndReset is also for axis 4 of IRB 1600, 2600 and 4600. Where the manual is silent:
// IndRMove without a direction takes the short way; IndReset without a reference keeps the position; it waits until the robot
// is at a stop point. VelSet and the speed override count as they are when a movement is ordered or the program started.
// WaitRob looks at the path of the arm only; WZLimSup stops a turning axis in the zone, not before.

#include "stdlib/impl/motion/independent_axes.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/motion/world_zones.h"
#include "stdlib/impl/support/fail.h"

#include "natives/axes.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

using namespace rt;

namespace {

constexpr std::size_t kAxis4 = 3, kAxis6 = 5; // from 0
constexpr double kTurn = 360;

/// The order of the axis; kept while the program is stopped.
struct IndependentOrder {
    bool endless = false;
    double goal = 0;  ///< deg, mm
    double speed = 0; ///< deg/s, mm/s as programmed; endless: with its direction
    double ramp = 1;  ///< share of the acceleration
};

/// An axis that the program names, and what it can do.
struct NamedAxis {
    motion::GroupAxis axis;
    double fastest = 0;      ///< deg/s, mm/s
    double acceleration = 0; ///< deg/s^2, mm/s^2
    double jerk = 0;         ///< deg/s^3; 0 = not limited
    bool rotating = true;
};

double secondsNow(const motion::MotionSystem& arm) {
    return static_cast<double>(arm.now()) * 1e-9;
}

/// The axes of a motion group that move for themselves.
class IndependentAxes {
  public:
    void order(MotionDriver& motion, const NamedAxis& axis, const IndependentOrder& order) {
        if (!std::exchange(listening_, true))
            motion.addListener([this, &motion](ArmChange news) { take(motion, news); });
        const auto known = std::find_if(orders_.begin(), orders_.end(),
                                        [&](const Ordered& entry) { return entry.axis.axis == axis.axis; });
        Ordered& entry = known == orders_.end() ? orders_.emplace_back() : *known;
        entry = {axis, order};
        carryOut(motion, entry);
    }
    /// The latest one of the axis, which moves for itself.
    const IndependentOrder& order(const motion::GroupAxis& axis) const {
        return std::find_if(orders_.begin(), orders_.end(),
                            [&](const Ordered& entry) { return entry.axis.axis == axis; })
            ->order;
    }

  private:
    struct Ordered {
        NamedAxis axis;
        IndependentOrder order;
    };
    /// The speed in force, at most what the axis can do; 0 while an override holds it.
    static double speedOf(MotionDriver& motion, const Ordered& entry) {
        const double override = motion.system().overrideShare();
        if (override <= 0) return 0;
        const double share = 0.01 * motion.service<lib::MotionState>().settings.velocityPercent * override;
        const double speed = entry.order.speed * std::clamp(share, 1e-3, 1.0);
        return std::clamp(speed, -entry.axis.fastest, entry.axis.fastest);
    }
    static void carryOut(MotionDriver& motion, const Ordered& entry) {
        motion::MotionSystem& arm = motion.system();
        const motion::GroupAxis axis = entry.axis.axis;
        const IndependentOrder& order = entry.order;
        const double now = secondsNow(arm);
        const motion::MotionState state = arm.current();
        const motion::AxisMoment here =
            axis.isExternal ? motion::AxisMoment{state.extax[axis.index], 0}
                            : motion::AxisMoment{state.joints[axis.index], state.jointSpeed[axis.index]};
        const motion::AxisCourse course =
            arm.independent(axis) != nullptr ? *arm.independent(axis) : motion::AxisCourse(now, here);
        const double acceleration = entry.axis.acceleration * order.ramp;
        const double speed = speedOf(motion, entry);
        arm.setIndependent(axis, order.endless || speed == 0
                                     ? course.turning(now, speed, acceleration, entry.axis.jerk)
                                     : course.movedTo(now, order.goal, speed, acceleration, entry.axis.jerk));
        motion.service<lib::WorldZones>().noteMotion();
    }
    /// A program that is stopped stops the axes, too.
    void take(MotionDriver& motion, ArmChange news) {
        if (news == ArmChange::Start) isStopped_ = false;
        if (news == ArmChange::StopOnPath || news == ArmChange::MotorsOff) isStopped_ = true;
        motion::MotionSystem& arm = motion.system();
        for (const Ordered& entry : orders_) {
            const motion::AxisCourse* course = arm.independent(entry.axis.axis);
            if (course == nullptr) continue;
            if (news == ArmChange::Start || (news == ArmChange::Override && !isStopped_))
                carryOut(motion, entry);
            if (news == ArmChange::StopOnPath || news == ArmChange::MotorsOff)
                arm.setIndependent(
                    entry.axis.axis,
                    course->turning(secondsNow(arm), 0, entry.axis.acceleration, entry.axis.jerk));
        }
    }

    std::vector<Ordered> orders_;
    bool listening_ = false;
    bool isStopped_ = false; // with the program
};

motion::AxisMoment momentOf(const motion::MotionSystem& arm, const motion::GroupAxis& axis) {
    return arm.independent(axis)->at(secondsNow(arm));
}

double positionOf(const motion::MotionSystem& arm, const motion::GroupAxis& axis) {
    const motion::JointTarget here = arm.currentJoints();
    return axis.isExternal ? here.extax[axis.index] : here.robax[axis.index];
}

/// It is at rest, and is not about to move.
bool isResting(const motion::MotionSystem& arm, const motion::GroupAxis& axis) {
    return momentOf(arm, axis).speed == 0 && arm.independent(axis)->settledAt() <= secondsNow(arm);
}

/// Axis 4 of these can be reset, although it cannot be independent.
bool canResetAxis4(const robot::RobotModel& model) {
    const auto is = [&](const char* family) { return model.name.starts_with(family); };
    return is("IRB 1600-") || is("IRB 2600-") || is("IRB 4600-");
}

enum class Purpose : uint8_t { Move, Reset };

Status robotAxis(TaskCore* task, std::size_t number, Purpose purpose, NamedAxis& axis) {
    const motion::MotionSystem& arm = lib::motionSystemOf(task);
    const robot::RobotModel& model = arm.model();
    const bool isAxis4 = purpose == Purpose::Reset && number == kAxis4 && canResetAxis4(model);
    if (number != kAxis6 && !isAxis4)
        return lib::fail(
            task, err::ERR_AXIS_ACT,
            "axis 6 is the only one of the robot that can be independent (IndReset: also axis 4 of IRB "
            "1600, 2600 and 4600)");
    if (isAxis4 && arm.independent({false, kAxis6}) != nullptr)
        return lib::fail(task, err::ERR_AXIS_ACT,
                         "axis 6 is in independent mode: reset it before axis 4 (IndReset)");
    axis.axis = {false, number};
    axis.fastest = model.maxSpeed[number];
    axis.acceleration = model.maxAcceleration[number];
    if (arm.planner() == motion::Planner::Optimal) axis.jerk = model.maxJerk[number];
    return kOk;
}

Status externalAxis(TaskCore* task, const MechanicalUnit& unit, std::size_t number, NamedAxis& axis) {
    const MechanicalUnit::Axis& own = unit.own[number];
    if (!unit.isActive)
        return lib::fail(task, err::ERR_AXIS_ACT, unit.name + " is not active: execute ActUnit first");
    if (!own.mayBeIndependent)
        return lib::fail(task, err::ERR_AXIS_ACT,
                         "axis " + own.single + " of " + unit.name +
                             " cannot be independent: its ARM in MOC.cfg has no independent_joint_on");
    axis.axis = {true, own.index};
    axis.fastest = own.limits.maxSpeed;
    axis.acceleration = own.limits.maxAcceleration;
    axis.rotating = own.limits.rotating;
    return kOk;
}

/// The axis, which belongs to the task's group and can be independent; else ERR_AXIS_PAR, ERR_AXIS_ACT.
Status findAxis(TaskCore* task, const Handle* handle, float number, Purpose purpose, NamedAxis& axis) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    const MechanicalUnit* unit = handle == nullptr ? nullptr : lib::unitOf(task, *handle, status);
    if (status != kOk) return status;
    if (unit == nullptr || unit->isRobot || unit->group != lib::motionOf(task).group()) {
        const int index = lib::robotAxis(task, handle, number, status);
        return index < 0 ? status : robotAxis(task, static_cast<std::size_t>(index), purpose, axis);
    }
    const bool isThere =
        number == std::floor(number) && number >= 1 && number <= static_cast<float>(unit->own.size());
    if (!isThere) return lib::fail(task, err::ERR_AXIS_PAR, "the mechanical unit has no such axis");
    return externalAxis(task, *unit, static_cast<std::size_t>(number) - 1, axis);
}

/// The axis is in independent mode; else ERR_AXIS_ACT.
Status checkIndependent(TaskCore* task, const Handle* unit, float number, NamedAxis& axis) {
    if (const Status status = findAxis(task, unit, number, Purpose::Move, axis)) return status;
    if (lib::motionSystemOf(task).independent(axis.axis) != nullptr) return kOk;
    return lib::fail(task, err::ERR_AXIS_ACT, "the axis is not in independent mode (IndAMove ...)");
}

Status orderMove(TaskCore* task, const NamedAxis& axis, bool endless, double goal, double speed,
                 const float* ramp) {
    if (!endless && !(speed > 0))
        return lib::fail(task, err::ERR_ARGVALERR, "the speed of an independent axis must be above 0");
    if (!std::isfinite(speed) || !std::isfinite(goal))
        return lib::fail(task, err::ERR_ARGVALERR, "an independent axis needs numbers that are finite");
    if (ramp != nullptr && !(*ramp >= 1 && *ramp <= 100))
        return lib::fail(task, err::ERR_ARGVALERR, "\\Ramp must lie between 1 and 100 percent");
    const IndependentOrder order{endless, goal, speed,
                                 ramp == nullptr ? 1.0 : 0.01 * static_cast<double>(*ramp)};
    MotionDriver& motion = lib::motionOf(task);
    motion.service<IndependentAxes>().order(motion, axis, order);
    return kOk;
}

/// The position that one of the two arguments gives: of a robtarget the external axis that is meant.
Status readPosition(TaskCore* task, const NamedAxis& axis, const data::Robtarget* target, const float* number,
                    double& position) {
    if ((target == nullptr) == (number == nullptr))
        return lib::fail(
            task, err::ERR_ARGVALERR,
            "one position must be given: a number (\\ToAbsNum, \\ToRelNum, \\RefNum) or a robtarget");
    if (number != nullptr) {
        position = *number;
        return kOk;
    }
    if (!axis.axis.isExternal)
        return lib::fail(
            task, err::ERR_ARGVALERR,
            "a position of axis 6 is given as a number (\\ToAbsNum, \\ToRelNum, \\RefNum): a robtarget "
            "has those of additional axes");
    position = lib::toAxes(target->extax)[axis.axis.index];
    if (motion::isConnected(position)) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR, "the robtarget has no position of this axis (9E9)");
}

Status requireRotating(TaskCore* task, const NamedAxis& axis) {
    if (axis.rotating) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR,
                     "a linear axis makes no revolutions: use IndAMove or IndDMove, and IndReset \\Old");
}

/// The position with the same angle as `angle` that lies nearest to `from`, or beyond it in the direction.
double sameAngle(double angle, double from, bool forward, bool backward) {
    const double turns = (from - angle) / kTurn;
    const double whole = forward ? std::ceil(turns) : backward ? std::floor(turns) : std::round(turns);
    return angle + whole * kTurn;
}

Status checkOneDirection(TaskCore* task, int count) {
    if (count <= 1) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR, "one of \\Short, \\Fwd and \\Bwd can be given");
}

} // namespace

namespace rt::lib {

void endIndependentMode(MotionDriver& motion) {
    motion::MotionSystem& arm = motion.system();
    for (const motion::GroupAxis& axis : arm.independentAxes()) {
        const double position = momentOf(arm, axis).position;
        const bool turns = !axis.isExternal; // external axes keep their place, which may be a length
        arm.endIndependent(axis, turns ? position - kTurn * std::round(position / kTurn) : position);
    }
    motion.refresh();
}

} // namespace rt::lib

extern "C" {

Status rt_IndAMove(TaskCore* task, Handle* MecUnit, float Axis, const data::Robtarget* ToAbsPos,
                   const float* ToAbsNum, float Speed, const float* Ramp) {
    NamedAxis axis;
    double goal = 0;
    if (const Status status = findAxis(task, MecUnit, Axis, Purpose::Move, axis)) return status;
    if (const Status status = readPosition(task, axis, ToAbsPos, ToAbsNum, goal)) return status;
    return orderMove(task, axis, false, goal, Speed, Ramp);
}

/// The sign of the speed is the direction.
Status rt_IndCMove(TaskCore* task, Handle* MecUnit, float Axis, float Speed, const float* Ramp) {
    NamedAxis axis;
    if (const Status status = findAxis(task, MecUnit, Axis, Purpose::Move, axis)) return status;
    return orderMove(task, axis, true, 0, Speed, Ramp);
}

/// From where the axis is; a movement in progress is replaced.
Status rt_IndDMove(TaskCore* task, Handle* MecUnit, float Axis, float Delta, float Speed, const float* Ramp) {
    NamedAxis axis;
    if (const Status status = findAxis(task, MecUnit, Axis, Purpose::Move, axis)) return status;
    const double from = positionOf(lib::motionSystemOf(task), axis.axis);
    return orderMove(task, axis, false, from + static_cast<double>(Delta), Speed, Ramp);
}

Status rt_IndRMove(TaskCore* task, Handle* MecUnit, float Axis, const data::Robtarget* ToRelPos,
                   const float* ToRelNum, bool Short, bool Fwd, bool Bwd, float Speed, const float* Ramp) {
    NamedAxis axis;
    double angle = 0;
    if (const Status status = findAxis(task, MecUnit, Axis, Purpose::Move, axis)) return status;
    if (const Status status = requireRotating(task, axis)) return status;
    if (const Status status = readPosition(task, axis, ToRelPos, ToRelNum, angle)) return status;
    if (const Status status = checkOneDirection(task, Short + Fwd + Bwd)) return status;
    const double from = positionOf(lib::motionSystemOf(task), axis.axis);
    return orderMove(task, axis, false, sameAngle(angle, from, Fwd, Bwd), Speed, Ramp);
}

Status rt_IndReset(TaskCore* task, Handle* MecUnit, float Axis, const data::Robtarget* RefPos,
                   const float* RefNum, bool Short, bool Fwd, bool Bwd, bool Old) {
    NamedAxis axis;
    double reference = 0;
    const bool moves = (RefPos != nullptr || RefNum != nullptr) && !Old; // the logical range
    if (const Status status = findAxis(task, MecUnit, Axis, Purpose::Reset, axis)) return status;
    if (RefPos != nullptr || RefNum != nullptr)
        if (const Status status = readPosition(task, axis, RefPos, RefNum, reference)) return status;
    if (const Status status = checkOneDirection(task, Short + Fwd + Bwd + Old)) return status;
    if (const Status status = moves ? requireRotating(task, axis) : kOk) return status;
    MotionDriver& driver = lib::motionOf(task);
    if (const Status status = driver.waitIdle(taskOf(task))) return status;
    if (const Status status = driver.waitZeroSpeed(taskOf(task))) return status;
    motion::MotionSystem& arm = driver.system();
    if (arm.independent(axis.axis) != nullptr && !isResting(arm, axis.axis))
        return lib::fail(task, err::ERR_AXIS_MOVING,
                         "the axis moves: wait until it is in position (IndInpos)");
    double position = positionOf(arm, axis.axis);
    // Forward: on the positive side of the reference.
    if (moves) position = sameAngle(position, reference, Fwd, Bwd);
    arm.setIndependent(axis.axis, motion::AxisCourse(secondsNow(arm), {position, 0}));
    if (!arm.endIndependent(axis.axis, position))
        return lib::fail(task, err::ERR_AXIS_MOVING,
                         "the robot moves: wait until it has reached a stop point");
    driver.refresh();
    return kOk;
}

/// FALSE for an axis that turns for ever.
Status rt_IndInpos(TaskCore* task, bool* result, Handle* MecUnit, float Axis) {
    NamedAxis axis;
    if (const Status status = checkIndependent(task, MecUnit, Axis, axis)) return status;
    const IndependentOrder& order = lib::motionOf(task).service<IndependentAxes>().order(axis.axis);
    const motion::MotionSystem& arm = lib::motionSystemOf(task);
    *result = !order.endless && isResting(arm, axis.axis) && momentOf(arm, axis.axis).position == order.goal;
    return kOk;
}

Status rt_IndSpeed(TaskCore* task, bool* result, Handle* MecUnit, float Axis, bool InSpeed, bool ZeroSpeed) {
    NamedAxis axis;
    if (const Status status = checkIndependent(task, MecUnit, Axis, axis)) return status;
    if (InSpeed == ZeroSpeed)
        return lib::fail(task, err::ERR_ARGVALERR, "IndSpeed needs one of \\InSpeed and \\ZeroSpeed");
    const IndependentOrder& order = lib::motionOf(task).service<IndependentAxes>().order(axis.axis);
    const motion::MotionSystem& arm = lib::motionSystemOf(task);
    const double speed = momentOf(arm, axis.axis).speed;
    constexpr double kExact = 1e-6; // deg/s
    *result =
        ZeroSpeed ? isResting(arm, axis.axis) : std::fabs(std::fabs(speed) - std::fabs(order.speed)) < kExact;
    return kOk;
}
}

// Manual 1.8, 2.2.4: independent axes. Axis 6 of the robot is the one that may be independent. Where the manual is silent:
// IndRMove without a direction takes the short way; IndReset without a reference keeps the position; it waits until the robot
// stands at a stop point. VelSet and the speed override count as they are when a movement is ordered or the program started.
// WaitRob looks at the path of the arm only; WZLimSup stops a turning axis in the zone, not before. Independent mode ends with the process.

#include "stdlib/impl/motion/independent_axes.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/motion/world_zones.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace rt;

namespace {

constexpr std::size_t kAxis = 5; // axis 6, from 0
constexpr double kTurn = 360;

/// What the axis is to do; kept while the program is stopped.
struct IndependentOrder {
    bool endless = false;
    double goal = 0;  ///< deg
    double speed = 0; ///< deg/s as programmed; endless: with its direction
    double ramp = 1;  ///< share of the acceleration
};

class IndependentAxis {
  public:
    void order(MotionDriver& motion, const IndependentOrder& order) {
        if (!std::exchange(listening_, true))
            motion.addListener([this, &motion](ArmNews news) { take(motion, news); });
        order_ = order;
        carryOut(motion);
    }
    const IndependentOrder& order() const { return order_; }
    /// The speed in force.
    static double speedOf(MotionDriver& motion, const IndependentOrder& order) {
        const double share = motion.service<lib::MotionState>().settings.velocityPercent *
                             motion.system().speedOverride() * 1e-4;
        return order.speed * std::clamp(share, 1e-3, 1.0);
    }

  private:
    void carryOut(MotionDriver& motion) {
        motion::MotionSystem& arm = motion.system();
        const double now = toSeconds(arm.now());
        const motion::MotionState state = arm.current();
        const motion::AxisCourse course =
            arm.independent() != nullptr
                ? *arm.independent()
                : motion::AxisCourse(now, {state.joints[kAxis], state.jointSpeed[kAxis]});
        const double acceleration = arm.model().maxAcceleration[kAxis] * order_.ramp;
        const double speed = speedOf(motion, order_);
        const double jerk = jerkOf(arm);
        arm.setIndependent(kAxis, order_.endless
                                      ? course.turning(now, speed, acceleration, jerk)
                                      : course.movedTo(now, order_.goal, speed, acceleration, jerk));
        motion.service<lib::WorldZones>().noteMotion();
    }
    /// A program that is stopped stops the axis, too.
    void take(MotionDriver& motion, ArmNews news) {
        motion::MotionSystem& arm = motion.system();
        if (arm.independent() == nullptr) return;
        if (news == ArmNews::Start) carryOut(motion);
        if (news == ArmNews::StopOnPath || news == ArmNews::MotorsOff)
            arm.setIndependent(kAxis,
                               arm.independent()->turning(toSeconds(arm.now()), 0,
                                                          arm.model().maxAcceleration[kAxis], jerkOf(arm)));
    }
    /// deg/s^3; 0 = not limited.
    static double jerkOf(const motion::MotionSystem& arm) {
        return arm.planner() == motion::Planner::Optimal ? arm.model().maxJerk[kAxis] : 0;
    }
    static double toSeconds(Time time) { return static_cast<double>(time) * 1e-9; }

    IndependentOrder order_;
    bool listening_ = false;
};

motion::MotionSystem& systemOf(TaskCore* task) {
    return lib::motionOf(task).system();
}

motion::AxisMoment momentOf(const motion::MotionSystem& arm) {
    const double now = static_cast<double>(arm.now()) * 1e-9;
    return arm.independent()->at(now);
}

/// It stands, and is not about to move.
bool isResting(const motion::MotionSystem& arm) {
    return momentOf(arm).speed == 0 &&
           arm.independent()->settledAt() <= static_cast<double>(arm.now()) * 1e-9;
}

Status checkAxis(TaskCore* task, const Handle* unit, float axis) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    const int number = lib::robotAxis(task, unit, axis, status);
    if (number < 0 || number == static_cast<int>(kAxis)) return status;
    return lib::fail(task, err::ERR_AXIS_ACT, "only axis 6 of the robot can be independent");
}

/// The axis is in independent mode; else ERR_AXIS_ACT.
Status checkIndependent(TaskCore* task, const Handle* unit, float axis) {
    if (const Status status = checkAxis(task, unit, axis)) return status;
    if (systemOf(task).independent() != nullptr) return kOk;
    return lib::fail(task, err::ERR_AXIS_ACT, "the axis is not in independent mode (IndAMove ...)");
}

Status orderMove(TaskCore* task, bool endless, double goal, double speed, const float* ramp) {
    if (!endless && !(speed > 0))
        return lib::fail(task, err::ERR_ARGVALERR, "the speed of an independent axis must be above 0");
    if (!std::isfinite(speed) || !std::isfinite(goal))
        return lib::fail(task, err::ERR_ARGVALERR, "an independent axis needs numbers that are finite");
    if (ramp != nullptr && !(*ramp >= 1 && *ramp <= 100))
        return lib::fail(task, err::ERR_ARGVALERR, "\\Ramp must lie between 1 and 100 percent");
    const IndependentOrder order{endless, goal, speed,
                                 ramp == nullptr ? 1.0 : 0.01 * static_cast<double>(*ramp)};
    MotionDriver& motion = lib::motionOf(task);
    motion.service<IndependentAxis>().order(motion, order);
    return kOk;
}

/// The position given as a number: a robtarget has values for additional axes only.
Status checkNumber(TaskCore* task, const data::Robtarget* position, const float* number) {
    if (position == nullptr && number != nullptr) return kOk;
    return lib::fail(
        task, err::ERR_ARGVALERR,
        "a position of axis 6 is given as a number (\\ToAbsNum, \\ToRelNum, \\RefNum): a robtarget "
        "has those of additional axes");
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
    if (arm.independent() == nullptr) return;
    const double position = momentOf(arm).position;
    arm.endIndependent(position - kTurn * std::round(position / kTurn));
    motion.refresh();
}

} // namespace rt::lib

extern "C" {

Status rt_IndAMove(TaskCore* task, Handle* MecUnit, float Axis, const data::Robtarget* ToAbsPos,
                   const float* ToAbsNum, float Speed, const float* Ramp) {
    if (const Status status = checkAxis(task, MecUnit, Axis)) return status;
    if (const Status status = checkNumber(task, ToAbsPos, ToAbsNum)) return status;
    return orderMove(task, false, *ToAbsNum, Speed, Ramp);
}

/// The sign of the speed is the direction.
Status rt_IndCMove(TaskCore* task, Handle* MecUnit, float Axis, float Speed, const float* Ramp) {
    if (const Status status = checkAxis(task, MecUnit, Axis)) return status;
    return orderMove(task, true, 0, Speed, Ramp);
}

/// From where the axis is; a movement in progress is replaced.
Status rt_IndDMove(TaskCore* task, Handle* MecUnit, float Axis, float Delta, float Speed, const float* Ramp) {
    if (const Status status = checkAxis(task, MecUnit, Axis)) return status;
    const double from = systemOf(task).currentJoints().robax[kAxis];
    return orderMove(task, false, from + static_cast<double>(Delta), Speed, Ramp);
}

Status rt_IndRMove(TaskCore* task, Handle* MecUnit, float Axis, const data::Robtarget* ToRelPos,
                   const float* ToRelNum, bool Short, bool Fwd, bool Bwd, float Speed, const float* Ramp) {
    if (const Status status = checkAxis(task, MecUnit, Axis)) return status;
    if (const Status status = checkNumber(task, ToRelPos, ToRelNum)) return status;
    if (const Status status = checkOneDirection(task, Short + Fwd + Bwd)) return status;
    const double from = systemOf(task).currentJoints().robax[kAxis];
    return orderMove(task, false, sameAngle(*ToRelNum, from, Fwd, Bwd), Speed, Ramp);
}

Status rt_IndReset(TaskCore* task, Handle* MecUnit, float Axis, const data::Robtarget* RefPos,
                   const float* RefNum, bool Short, bool Fwd, bool Bwd, bool Old) {
    if (const Status status = checkAxis(task, MecUnit, Axis)) return status;
    if (RefPos != nullptr)
        if (const Status status = checkNumber(task, RefPos, RefNum)) return status;
    if (const Status status = checkOneDirection(task, Short + Fwd + Bwd + Old)) return status;
    MotionDriver& driver = lib::motionOf(task);
    if (const Status status = driver.waitIdle(taskOf(task))) return status;
    if (const Status status = driver.waitZeroSpeed(taskOf(task))) return status;
    motion::MotionSystem& arm = driver.system();
    double position = arm.currentJoints().robax[kAxis];
    if (arm.independent() != nullptr) {
        if (!isResting(arm))
            return lib::fail(task, err::ERR_AXIS_MOVING,
                             "the axis moves: wait until it is in position (IndInpos)");
        position = momentOf(arm).position;
    }
    // Forward: on the positive side of the reference.
    if (RefNum != nullptr && !Old) position = sameAngle(position, *RefNum, Fwd, Bwd);
    arm.setIndependent(kAxis, motion::AxisCourse(static_cast<double>(arm.now()) * 1e-9, {position, 0}));
    if (!arm.endIndependent(position))
        return lib::fail(task, err::ERR_AXIS_MOVING, "the robot moves: wait until it has reached a stop point");
    driver.refresh();
    return kOk;
}

/// FALSE for an axis that turns for ever.
Status rt_IndInpos(TaskCore* task, bool* result, Handle* MecUnit, float Axis) {
    if (const Status status = checkIndependent(task, MecUnit, Axis)) return status;
    const IndependentOrder& order = lib::motionOf(task).service<IndependentAxis>().order();
    const motion::MotionSystem& arm = systemOf(task);
    *result = !order.endless && isResting(arm) && momentOf(arm).position == order.goal;
    return kOk;
}

Status rt_IndSpeed(TaskCore* task, bool* result, Handle* MecUnit, float Axis, bool InSpeed, bool ZeroSpeed) {
    if (const Status status = checkIndependent(task, MecUnit, Axis)) return status;
    if (InSpeed == ZeroSpeed)
        return lib::fail(task, err::ERR_ARGVALERR, "IndSpeed needs one of \\InSpeed and \\ZeroSpeed");
    const IndependentOrder& order = lib::motionOf(task).service<IndependentAxis>().order();
    const double speed = momentOf(systemOf(task)).speed;
    constexpr double kExact = 1e-6; // deg/s
    *result =
        ZeroSpeed ? isResting(systemOf(task)) : std::fabs(std::fabs(speed) - std::fabs(order.speed)) < kExact;
    return kOk;
}
}

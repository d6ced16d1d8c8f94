// Manual 1.7, 1.8: what is read and set of single axes.

#include "runtime/robot/angles.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/torques.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/support/fail.h"

#include "natives/motion_settings.h"
#include "natives/positions.h"
#include "stdlib_constants.h"

#include <cmath>
#include <numbers>

using namespace rt;

namespace {

/// Place of a unit's axis among the external axes of the task's motion group; -1 and ERR_AXIS_PAR raised when it has none.
int externalAxis(TaskCore* task, const MechanicalUnit& unit, float axis, Status& status) {
    const bool isThere = axis == std::floor(axis) && axis >= 1 && axis <= static_cast<float>(unit.own.size());
    if (isThere && unit.group == lib::motionOf(task).group())
        return static_cast<int>(unit.own[static_cast<std::size_t>(axis) - 1].index);
    status = lib::fail(task, err::ERR_AXIS_PAR,
                       isThere ? "the mechanical unit belongs to the motion group of another task"
                               : "the mechanical unit has no such axis");
    return -1;
}

} // namespace

extern "C" {

/// Transmissions are not known: a motor turns as far as its axis, in radians.
Status rt_ReadMotor(TaskCore* task, float* result, Handle* MecUnit, float Axis) {
    Status status = kOk;
    const int axis = lib::robotAxis(task, MecUnit, Axis, status);
    if (axis < 0) return status;
    const motion::MotionSystem& arm = lib::motionSystemOf(task);
    *result = static_cast<float>(arm.currentJoints().robax[static_cast<std::size_t>(axis)] * robot::kDeg);
    return kOk;
}

/// An estimate, as a share of the greatest torque of the axis.
Status rt_GetMotorTorque(TaskCore* task, float* result, Handle* MecUnit, float AxisNo) {
    Status status = kOk;
    const int number = lib::robotAxis(task, MecUnit, AxisNo, status);
    if (number < 0) return status;
    *result =
        static_cast<float>(lib::torqueShare(lib::motionSystemOf(task), static_cast<std::size_t>(number)));
    return kOk;
}

/// Of the task's robot, or of an external unit of its motion group.
Status rt_SpeedLimAxis(TaskCore* task, Handle* MechUnit, float AxisNo, float AxisSpeed) {
    Status status = kOk;
    motion::SpeedLimits limits = lib::motionState(task).speedLimits;
    const MechanicalUnit* unit = lib::unitOf(task, *MechUnit, status);
    if (unit == nullptr) return status;
    double* limit = nullptr;
    if (unit->isRobot) {
        const int axis = lib::robotAxis(task, MechUnit, AxisNo, status);
        if (axis < 0) return status;
        limit = &limits.joints[static_cast<std::size_t>(axis)];
    } else {
        const int axis = externalAxis(task, *unit, AxisNo, status);
        if (axis < 0) return status;
        limit = &limits.external[static_cast<std::size_t>(axis)];
    }
    if (!(AxisSpeed >= 0))
        return lib::fail(task, err::ERR_SPEEDLIM_VALUE, "SpeedLimAxis: the limit must not be negative");
    *limit = AxisSpeed > 0 ? AxisSpeed : motion::SpeedLimits::kNone;
    lib::motionState(task).speedLimits = limits;
    lib::motionOf(task).setSpeedLimits(limits);
    return kOk;
}

Status rt_SpeedLimCheckPoint(TaskCore* task, float RobSpeed) {
    if (!(RobSpeed > 0))
        return lib::fail(task, err::ERR_SPEEDLIM_VALUE, "SpeedLimCheckPoint: the limit must be above 0 mm/s");
    motion::SpeedLimits& limits = lib::motionState(task).speedLimits;
    limits.tcp = RobSpeed;
    lib::motionOf(task).setSpeedLimits(limits);
    return kOk;
}
}

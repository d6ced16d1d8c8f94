#pragma once
// Mechanical units in natives: the unit of a variable, and the axes of the robot.

#include "runtime/host/controller.h"

namespace rt::lib {

/// The unit of a mecunit variable; null, with ERR_REFUNKDAT raised in `status`, when the configuration does not define it.
MechanicalUnit* unitOf(TaskCore* task, Handle handle, Status& status);

/// The axis of the task's robot, from 0, that a native is asked for; `unit` null: the robot. -1 and ERR_AXIS_PAR raised in
/// `status` when the unit is not that robot or has no such axis.
int robotAxis(TaskCore* task, const Handle* unit, float axis, Status& status);

} // namespace rt::lib

#pragma once
// Measured values of one axis, of the robot or of an external unit.

#include "runtime/host/controller.h"

namespace rt::lib {

/// An axis of a mechanical unit.
struct AxisPlace {
    MotionDriver* motion = nullptr; ///< of the unit's group
    bool isRobot = true;
    std::size_t index = 0; ///< of the robot's axes or of ExternalAxes, from 0
};

struct AxisValues {
    double position = 0;       ///< deg or mm
    double speed = 0;          ///< deg/s or mm/s
    double torque = 0;         ///< Nm; 0 for an external axis, whose masses are not known
    double externalTorque = 0; ///< Nm
};

/// `unit` null: the robot of the task. False with the error in `status`: `unitError` for a unit that is not there,
/// ERR_AXIS_PAR for an axis that it has not.
bool axisPlace(TaskCore* task, const Handle* unit, float axis, Status unitError, AxisPlace& place,
               Status& status);
AxisValues axisValues(Controller& controller, const AxisPlace& place);

} // namespace rt::lib

#pragma once
// Mechanical units: the simulated robot, and the units that the configuration names (MOC). Only the robot has axes that
// move; of the others it is known whether they are active.

#include "runtime/host/controller.h"

#include <string>
#include <vector>

namespace rt::lib {

struct MechanicalUnit {
    std::string name;
    bool simulated = false;     ///< the robot of this controller
    bool tcpRobot = false;      ///< has a TCP, and is never deactivated
    int axes = 0;               ///< how many
    bool activeAtStart = false; ///< activate_at_start_up
    bool staysActive = false;   ///< deactivation_forbidden
};

/// In the order of the handles of mecunit data: the first one has handle 1.
std::vector<MechanicalUnit> mechanicalUnits(Controller& controller);

/// The axis of the robot, from 0, that a native is asked for; `unit` null: the robot. -1 and ERR_AXIS_PAR raised in `status`
/// when the unit is not simulated or has no such axis.
int robotAxis(TaskCore* task, const Handle* unit, float axis, Status& status);

} // namespace rt::lib

#pragma once
// Sensor synchronisation: movements whose speed lets the robot be at each target when the sensor is at the position that the target
// names.

#include "runtime/host/controller.h"

namespace rt::lib {

/// Before the order of a movement between SyncToSensor \On and \Off: its duration. Waits while the sensor is at rest.
Status followSensor(TaskCore* task, motion::MoveCommand& command);
/// The program begins again: no synchronisation.
void endSensorSync(Task& task);

} // namespace rt::lib

#pragma once
// Torques of the robot's axes, estimated: what acceleration and gravity need, and what acts from outside.

#include "runtime/host/controller.h"

namespace rt::lib {

/// Greatest torque of an axis, Nm. An estimate from the model's limits of acceleration: twice the rated payload moves, thought
/// in the wrist; for the wrist itself the rated payload, 0.1 m away.
double greatestTorque(const robot::RobotModel& model, std::size_t axis);
/// Torque of the axis now, as a share of the greatest: what its acceleration needs, and what holds axes 2 and 3 against
/// gravity. Loads, friction and the other axes do not count.
double torqueShare(const motion::MotionSystem& arm, std::size_t axis);
/// The torque that acts on an axis from outside, Nm: what the stimulus gave (Surroundings).
double externalTorque(Controller& controller, const MotionDriver& motion, std::size_t axis);
/// Acceleration of the axis now, deg/s2 or mm/s2.
double accelerationOf(const motion::MotionSystem& arm, std::size_t axis);

} // namespace rt::lib

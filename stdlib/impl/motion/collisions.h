#pragma once
// Motion supervision: a torque from outside on an axis that is too large stops the robot (MotionSup). The simulated robot
// collides with nothing by itself: a stimulus gives the torques.

#include "runtime/host/controller.h"

namespace rt::lib {

/// Once for each controller: from now on torques from outside are looked at.
void superviseCollisions(Controller& controller);
/// A movement that looks for contact, or leaves it, begins or ends: what it meets is not a collision.
void allowContact(Controller& controller, MotionDriver& motion, bool allowed);
/// Percent of the greatest torque of its axis that the largest torque from outside has now. `axis`: which one, from 0.
double largestExternalTorque(Controller& controller, const MotionDriver& motion, std::size_t& axis);

} // namespace rt::lib

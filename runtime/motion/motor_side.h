#pragma once
// The position of the motors, which recordings of real controllers show: the elasticity of the gears lies between motor and arm.

#include "runtime/motion/motion_system.h"

namespace motion {

/// Axis angles (deg, mm) as the motors have them at the time of that state, for which sample() has an answer: the arm's, and a
/// deflection in proportion to the torque that accelerates the axis (Dynamics::motorDeflection).
Joints motorSide(const MotionSystem& arm, const MotionState& state, TimeNs time);

} // namespace motion

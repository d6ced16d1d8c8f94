#pragma once
// Measures stretches of a route for the optimal planner: derivatives of axes and TCP by the place, and their limits.

#include "runtime/motion/profile_solver.h"
#include "runtime/motion/route.h"
#include "runtime/robot/dynamics.h"

namespace motion {

/// The limits of the arm itself.
struct ArmLimits {
    const robot::AccelerationMap* accelerations = nullptr;
    Joints jerk{}; ///< deg/s^3
};

/// One stretch as a cell of a profile, at full override.
ProfileCell measuredCell(const Route& route, const RouteStretch& stretch, const ArmLimits& limits);
/// Notes whether accelerations have to change at once between two cells that follow each other.
void joinCells(const ProfileCell& before, ProfileCell& cell);

} // namespace motion

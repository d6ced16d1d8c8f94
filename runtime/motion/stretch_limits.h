#pragma once
// StretchLimits: how fast a route may be passed on one of its stretches, and how the speed may change there.

#include "runtime/motion/route.h"
#include "runtime/robot/dynamics.h"

#include <array>
#include <vector>

namespace motion {

/// One axis, or one other quantity that may not accelerate arbitrarily, on a stretch.
struct AccelerationRow {
    double first = 0, second = 0; ///< derivatives by the place
    double most = 0;              ///< limit, in the unit of the quantity per s^2
};

/// Limits of the speed on one stretch.
struct StretchLimits {
    double width = 0;          ///< mm
    double speed = 0;          ///< mm/s of route at full override
    double ownSpeed = 0;       ///< the same, before dips nearby lower it
    double axisSpeed = 0;      ///< the same, as the axes alone allow on this stretch
    double bendSquare = 0;     ///< (mm/s)^2, as the axes must turn with the path
    double gain = 0, drop = 0; ///< mm/s^2 along the route
    std::array<AccelerationRow, 14> rows{};
    std::size_t rowCount = 0;
    std::vector<AccelerationRow> more; ///< of robots that move together with this one
};

/// The limits of the axes of one robot and of a move.
StretchLimits limitsOn(const RouteStretch& stretch, const MoveLimits& most,
                       const robot::AccelerationMap& accelerations);

} // namespace motion

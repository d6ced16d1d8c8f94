#pragma once
// The path coordinate system around a place (PlannedMoment::pathFrame).

#include "runtime/motion/path_modifier.h"

namespace motion {

/// PlannedMoment::pathFrame() with the mean direction of the path over up to `reach` mm before the place and as far after it:
/// where the path turns, it turns evenly over that way.
Quat meanPathFrame(const PlannedMoment& at, double reach);

} // namespace motion

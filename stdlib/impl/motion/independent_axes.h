#pragma once
// Independent axes (manual 2.2.4): axis 6 of the robot may move for itself.

#include "runtime/host/controller.h"

namespace rt::lib {

/// The program begins anew: the axis is in normal mode again, within half a turn of 0.
void endIndependentMode(MotionDriver& motion);

} // namespace rt::lib

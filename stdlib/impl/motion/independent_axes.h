#pragma once
// Independent axes (manual 2.2.4): axis 6 of the robot and marked external axes may move for themselves.

#include "runtime/host/controller.h"

namespace rt::lib {

/// The program begins again: the axes are in normal mode again, those of the robot within half a turn of 0.
void endIndependentMode(MotionDriver& motion);

} // namespace rt::lib

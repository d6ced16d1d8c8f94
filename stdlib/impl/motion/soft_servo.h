#pragma once
// Soft servo and servo tuning (manual 1.7, 2.2.5).

#include "runtime/host/controller.h"

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// The program begins again: all axes are stiff, and tuned as configured.
void endSoftServo(Controller& controller, MotionDriver& motion);
/// Softness and tuning are kept between two processes (--state).
void keepSoftServo(Controller& controller, StateKeepers& kept);

} // namespace rt::lib

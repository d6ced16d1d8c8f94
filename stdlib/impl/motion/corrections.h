#pragma once
// Correction generators (manual 1.8, CorrCon).

#include "runtime/host/controller.h"

namespace rt::lib {

/// The program begins anew, or CorrClear: no generator is connected.
void endCorrections(MotionDriver& motion);

} // namespace rt::lib

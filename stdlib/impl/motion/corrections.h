#pragma once
// Correction generators (manual 1.8, CorrCon).

#include "runtime/host/controller.h"

namespace rt::lib {

/// The program begins again, or CorrClear: no generator is connected.
void endCorrections(MotionDriver& motion);

/// The movement, displaced by the corrections when `isCorrected` (\Corr).
motion::MoveCommand corrected(TaskCore* task, motion::MoveCommand command, bool isCorrected);

} // namespace rt::lib

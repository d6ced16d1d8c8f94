#pragma once
// Optional parameters that are used where they may be missing. Internal to frontend/lint.

#include "frontend/lint/facts.h"

namespace rapid::lint {

/// Reports the use of an optional parameter where Present has said no, or where a test by Present, which the routine
/// has, is passed by (manual 1.1.5). Routines that never ask are left alone; where an ERROR handler may be the answer, so
/// is what is passed by.
void judgePresence(const sema::RoutineSymbol& routine, Reporter& reporter);

} // namespace rapid::lint

#pragma once
// BACKWARD handlers that do not mirror the body. Internal to frontend/lint.

#include "frontend/lint/facts.h"

namespace rapid::lint {

/// Reports the first movement of a BACKWARD handler that differs from the body, read from its end, in number, kind or
/// order (manual 1.21). Nothing is said where a branch, a loop, a jump or a call of a user's routine leaves open which
/// movements are carried out.
void judgeBackward(const sema::RoutineSymbol& routine, Reporter& reporter);

} // namespace rapid::lint

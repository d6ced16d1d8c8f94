#pragma once
// Warnings worth reading (8xxx): what is correct RAPID and yet probably a mistake. Runs over the checked program.

#include "frontend/lint/warnings.h"
#include "frontend/sema/checked.h"

namespace rapid::lint {

/// Reports the warnings that `levels` has switched on. Routines and modules with errors in `sink` are left out; what
/// depends on the whole program is judged only when the program is whole.
void lint(const sema::CheckedProgram& program, const WarningLevels& levels, diag::Sink& sink);

} // namespace rapid::lint

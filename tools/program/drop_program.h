#pragma once

#include "frontend/source/free_memory.h"
#include "frontend/workspace/compilation.h"

namespace rapidc {

/// Forgets the checked program once nothing needs it but its code: memory for what follows. Diagnostics remain.
inline void dropProgram(rapid::workspace::Compilation& compilation) {
    compilation.program.reset();
    rapid::releaseFreeMemory();
}

} // namespace rapidc

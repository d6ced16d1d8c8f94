#pragma once
// Guesses, from the text alone, which code is executed often enough to be worth more of it.

#include "ir/core/ir.h"

namespace codegen {

/// IR instructions of a routine that is inlined wherever it is called. Larger ones are inlined in loops and in short routines
/// only: elsewhere a call costs little beside them.
inline constexpr size_t kInlinedAnywhere = 40;

/// So short that others may call it in their loops: natives are inlined everywhere in it.
bool isShort(const ir::Routine& routine);
/// Ways back out of error handlers do not count.
bool hasLoop(const ir::Module& module, const ir::Routine& routine);

} // namespace codegen

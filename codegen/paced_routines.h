#pragma once
// Which routines are worth few passes only.

#include "codegen/codegen.h"
#include "ir/core/cfg.h"

namespace codegen {

/// Whether the time of the routine goes into the natives it calls: it moves robots, waits and writes so often, in its loops as well,
/// that better code between these calls would not be noticed. `cfg`, `loops`: without handler edges.
bool isPacedByNatives(const ir::Module& module, const ir::Routine& routine, const ir::Cfg& cfg,
                      const ir::LoopInfo& loops, const NativeBodies& inlined);

/// The same, when nothing is known of the routine's control flow yet.
bool isPacedByNatives(const ir::Module& module, const ir::Routine& routine, const NativeBodies& inlined);

/// Attribute of the LLVM functions of such routines.
inline constexpr const char* kPaced = "rapidc-paced";

} // namespace codegen

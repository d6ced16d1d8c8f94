#pragma once
// Which statements error handlers come from and go back to.

#include <vector>

#include "ir/core/cfg.h"
#include "ir/core/ir.h"

namespace codegen {

/// By block: those of the undo handler.
std::vector<bool> undoBlocks(const ir::Routine& routine);
/// By statement: those that the error handler may come from. Empty: the routine has no error handler.
std::vector<bool> failingStatements(const ir::Module& module, const ir::Routine& routine, const ir::Cfg& cfg);
/// By block: beginnings of statements that RETRY may execute again. Empty: the routine has no RETRY.
std::vector<bool> retriedBlocks(const ir::Routine& routine, const ir::Cfg& cfg,
                                const std::vector<bool>& failing);
/// The block ends with an entry into such a statement other than by RETRY: it has not failed yet, and its RETRYs are counted again.
bool entersRetried(const ir::Routine& routine, ir::BlockId block, const std::vector<bool>& retried);

} // namespace codegen

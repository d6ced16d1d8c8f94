#pragma once
// Immediate dominators of the blocks of a routine.

#include <vector>

#include "ir/core/cfg.h"

namespace ir {

/// By block: the immediate dominator; kNone for roots and for blocks that no root reaches. The time grows little faster than the
/// number of edges, whatever their shape: a chain of a hundred thousand ELSEIFs ends in one block.
std::vector<BlockId> findDominators(const Cfg& cfg, const std::vector<BlockId>& roots);

} // namespace ir

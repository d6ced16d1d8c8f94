#pragma once
// Control flow of a routine: successors, reverse postorder, dominators, loops.

#include <vector>

#include "ir/core/ir.h"

namespace ir {

/// Blocks that the terminator of `block` names. Empty for a block without terminator.
std::vector<BlockId> successors(const Routine& routine, BlockId block);

/// True when the instruction can raise or unwind: column flags of the opcode table, less natives of class
/// Const.
bool mayRaise(const Module& module, const Inst& inst);

struct Cfg {
    std::vector<std::vector<BlockId>> succs, preds;
    std::vector<BlockId> order;     ///< reachable blocks in reverse postorder
    std::vector<uint32_t> position; ///< index into `order`; kNone = unreachable
    std::vector<BlockId> idom;      ///< immediate dominator; kNone for roots and unreachable blocks

    /// Places of a block's subtree in a walk over the tree of dominators; both 0 for unreachable blocks.
    std::vector<uint32_t> enters, leaves;

    bool reachable(BlockId block) const { return position[block] != kNone; }
    bool dominates(BlockId a, BlockId b) const;
};

enum class HandlerEdges : uint8_t {
    No, ///< handlers are further entries
    Yes ///< edges from whatever may raise to the handlers, and back by retry and trynext
};

Cfg buildCfg(const Module& module, const Routine& routine, HandlerEdges handlerEdges);

/// A natural loop: the header dominates every latch.
struct Loop {
    BlockId header = kNone;
    std::vector<BlockId> latches;
    std::vector<BlockId> blocks; ///< the header first
    std::vector<bool> contains;  ///< by block
    uint32_t parent = kNone;     ///< index of the innermost enclosing loop
    bool innermost = true;
};
struct Edge {
    BlockId from = kNone, to = kNone;
};
struct LoopInfo {
    std::vector<Loop> loops;
    std::vector<uint32_t> loopOf;  ///< innermost loop of a block; kNone = none
    std::vector<Edge> irreducible; ///< retreating edges whose target does not dominate the source
};
LoopInfo findLoops(const Cfg& cfg);

/// The only block outside the loop that leads to its header, when it ends in a jump; kNone otherwise.
BlockId entryByJump(const Routine& routine, const Cfg& cfg, const Loop& loop);

/// By local: every address of it is used to load from it, store to it or zero it directly.
std::vector<bool> privateLocals(const Routine& routine);

} // namespace ir

#pragma once
// Control flow of a routine: successors, reverse postorder, dominators, loops.

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "ir/core/ir.h"

namespace ir {

/// A list of blocks; most have one or two, which lie in the object itself: routines may have millions of blocks.
class BlockList {
  public:
    BlockList() = default;
    BlockList(std::initializer_list<BlockId> blocks) {
        for (const BlockId block : blocks)
            push_back(block);
    }
    BlockList(const BlockList& other) {
        for (const BlockId block : other)
            push_back(block);
    }
    BlockList(BlockList&& other) noexcept { swap(other); }
    BlockList& operator=(BlockList other) noexcept {
        swap(other);
        return *this;
    }
    ~BlockList() {
        if (isLong()) delete[] many_;
    }

    size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const BlockId* begin() const { return isLong() ? many_ : few_; }
    const BlockId* end() const { return begin() + size_; }
    BlockId operator[](size_t i) const { return begin()[i]; }
    void push_back(BlockId block) {
        if (size_ == capacity_) grow();
        (isLong() ? many_ : few_)[size_++] = block;
    }

  private:
    static constexpr uint32_t kFew = 2;

    bool isLong() const { return capacity_ > kFew; }
    void grow() {
        BlockId* const more = new BlockId[size_t{2} * capacity_];
        std::copy(begin(), end(), more);
        if (isLong()) delete[] many_;
        many_ = more;
        capacity_ *= 2;
    }
    void swap(BlockList& other) noexcept {
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
        std::swap(content_, other.content_);
    }

    uint32_t size_ = 0, capacity_ = kFew;
    union {
        BlockId few_[kFew];
        BlockId* many_;
        uint64_t content_ = 0;
    };
    static_assert(sizeof(few_) == sizeof(uint64_t) && sizeof(many_) <= sizeof(uint64_t));
};

/// Blocks that the terminator of `block` names. Empty for a block without terminator.
BlockList successors(const Routine& routine, BlockId block);

/// True when the instruction can raise or unwind: column flags of the opcode table, less natives of class
/// Const.
bool mayRaise(const Module& module, const Inst& inst);

struct Cfg {
    std::vector<BlockList> succs, preds;
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

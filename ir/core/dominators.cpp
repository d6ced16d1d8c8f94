// Semi-NCA (Georgiadis: "Linear-time algorithms for dominators and related problems"), without recursion. Roots hang below a
// virtual node, the number 0.

#include "ir/core/dominators.h"

#include <algorithm>

namespace ir {
namespace {

class SemiNca {
  public:
    SemiNca(const Cfg& cfg, const std::vector<BlockId>& roots)
        : cfg_(cfg), number_(cfg.succs.size(), 0), isRoot_(cfg.succs.size(), false) {
        for (const BlockId root : roots)
            isRoot_[root] = true;
        for (const BlockId root : roots)
            numberFrom(root);
    }

    std::vector<BlockId> run() {
        const auto count = static_cast<uint32_t>(blocks_.size());
        label_.resize(count);
        semi_.resize(count);
        for (uint32_t i = 0; i < count; ++i)
            label_[i] = semi_[i] = i;
        idom_ = parent_;
        depth_.assign(count, 0);
        jump_.assign(count, 0);
        for (uint32_t node = count - 1; node > 0; --node)
            semi_[node] = semidominator(node);
        std::vector<BlockId> result(cfg_.succs.size(), kNone);
        for (uint32_t node = 1; node < count; ++node) {
            idom_[node] = ancestor(idom_[node], semi_[node]);
            hang(node);
            result[blocks_[node]] = blocks_[idom_[node]];
        }
        return result;
    }

  private:
    struct Step {
        BlockId block;
        size_t next;
    };

    /// Numbers the blocks that can be reached from the root and have no number yet, in preorder.
    void numberFrom(BlockId root) {
        if (number_[root] != 0) return;
        std::vector<Step> stack;
        const auto enter = [&](BlockId block, uint32_t parent) {
            number_[block] = static_cast<uint32_t>(blocks_.size());
            blocks_.push_back(block);
            parent_.push_back(parent);
            stack.push_back({block, 0});
        };
        enter(root, 0);
        while (!stack.empty()) {
            Step& top = stack.back();
            if (top.next == cfg_.succs[top.block].size()) {
                stack.pop_back();
                continue;
            }
            const BlockId succ = cfg_.succs[top.block][top.next++];
            if (number_[succ] == 0) enter(succ, number_[top.block]);
        }
    }

    /// Nodes after `node` have theirs already.
    uint32_t semidominator(uint32_t node) {
        const BlockId block = blocks_[node];
        uint32_t least = isRoot_[block] ? 0 : parent_[node];
        for (const BlockId pred : cfg_.preds[block])
            if (number_[pred] != 0) least = std::min(least, semi_[best(number_[pred], node)]);
        return least;
    }

    /// The node with the smallest semidominator on the way up from `node`, as far as it lies after `last`. The ways are shortened
    /// (`parent_`): the next search passes each of their nodes in one step.
    uint32_t best(uint32_t node, uint32_t last) {
        if (node <= last) return label_[node];
        std::vector<uint32_t>& way = way_;
        way.clear();
        for (; parent_[node] > last; node = parent_[node])
            way.push_back(node);
        // `node` is the last one on the way; what is above it counts for none below.
        uint32_t above = node;
        for (; !way.empty(); way.pop_back()) {
            const uint32_t below = way.back();
            parent_[below] = parent_[above];
            if (semi_[label_[above]] < semi_[label_[below]]) label_[below] = label_[above];
            above = below;
        }
        return label_[above];
    }

    /// The first node on the way up from `node` in the tree of dominators whose number is at most `most`. Ways are long in chains of
    /// conditions, which is why nodes know others further up.
    uint32_t ancestor(uint32_t node, uint32_t most) const {
        while (node > most)
            node = jump_[node] > most ? jump_[node] : idom_[node];
        return node;
    }

    /// Myers, "An applicative random-access stack": a way up has a logarithm of jumps.
    void hang(uint32_t node) {
        const uint32_t above = idom_[node], far = jump_[above];
        depth_[node] = depth_[above] + 1;
        const bool isEven = depth_[above] - depth_[far] == depth_[far] - depth_[jump_[far]];
        jump_[node] = isEven ? jump_[far] : above;
    }

    const Cfg& cfg_;
    std::vector<uint32_t> number_; ///< by block; 0: not reached
    std::vector<bool> isRoot_;
    std::vector<BlockId> blocks_{kNone}; ///< by number, as the rest
    std::vector<uint32_t> parent_{0}, label_, semi_, idom_, way_, depth_, jump_;
};

} // namespace

std::vector<BlockId> findDominators(const Cfg& cfg, const std::vector<BlockId>& roots) {
    return SemiNca(cfg, roots).run();
}

} // namespace ir

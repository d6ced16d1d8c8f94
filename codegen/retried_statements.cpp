#include "codegen/retried_statements.h"

#include <algorithm>

namespace codegen {
namespace {

bool isEmpty(const ir::Routine& routine, ir::BlockId id) {
    const ir::Block& block = routine.blocks[id];
    return block.insts.size() == 1 && routine.insts[block.insts.back()].op == ir::Op::Br;
}

} // namespace

std::vector<bool> undoBlocks(const ir::Routine& routine) {
    std::vector<bool> result(routine.blocks.size(), false);
    std::vector<ir::BlockId> work{routine.undoHandler};
    while (!work.empty()) {
        const ir::BlockId b = work.back();
        work.pop_back();
        if (b >= result.size() || result[b]) continue;
        result[b] = true;
        for (const ir::BlockId succ : ir::successors(routine, b))
            work.push_back(succ);
    }
    return result;
}

std::vector<bool> failingStatements(const ir::Module& module, const ir::Routine& routine,
                                    const ir::Cfg& cfg) {
    if (routine.errorHandler == ir::kNone) return {};
    // A handler with a list takes errors of interrupt routines, too, which run at safepoints anywhere.
    const bool anywhere = !routine.errorFilter.empty() || !routine.errorFilterGlobals.empty();
    std::vector<bool> result(routine.statements.size(), anywhere);
    for (const ir::BlockId b : cfg.order)
        for (const ir::ValueId id : routine.blocks[b].insts)
            if (const ir::Inst& inst = routine.insts[id]; inst.stmt < result.size())
                result[inst.stmt] = result[inst.stmt] || ir::mayRaise(module, inst);
    return result;
}

std::vector<bool> retriedBlocks(const ir::Routine& routine, const ir::Cfg& cfg,
                                const std::vector<bool>& failing) {
    const auto isRetry = [&](ir::BlockId b) {
        return routine.insts[routine.blocks[b].insts.back()].op == ir::Op::Retry;
    };
    if (std::none_of(cfg.order.begin(), cfg.order.end(), isRetry)) return {};
    std::vector<bool> result(routine.blocks.size(), false);
    for (size_t s = 0; s < failing.size(); ++s) {
        const ir::BlockId start = routine.statements[s].start;
        if (!failing[s] || !routine.statements[s].handled || start == ir::kNone) continue;
        result[start] = true;
        // A loop goes back to the next block.
        if (isEmpty(routine, start)) result[routine.insts[routine.blocks[start].insts[0]].target(0)] = true;
    }
    return result;
}

bool entersRetried(const ir::Routine& routine, ir::BlockId block, const std::vector<bool>& retried) {
    if (retried.empty() || (retried[block] && isEmpty(routine, block))) return false;
    const ir::BlockList next = ir::successors(routine, block);
    return std::any_of(next.begin(), next.end(), [&](ir::BlockId b) { return retried[b]; });
}

} // namespace codegen

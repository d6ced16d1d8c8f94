// Removes unreachable blocks, threads jumps through empty blocks, merges a block into its only predecessor. Statement
// markers are never lost: the debugger and the instruction budget count on them.

#include <algorithm>
#include <functional>

#include "ir/core/cfg.h"
#include "ir/core/op_info.h"
#include "ir/passes/passes.h"

namespace ir {
namespace {

class Simplifier {
  public:
    Simplifier(const Module& module, Routine& routine) : module_(module), routine_(routine) {}

    void run() {
        dropUnusedResumePoints();
        foldEqualTargets();
        threadJumps();
        removeUnreachable();
        mergeChains();
        removeUnreachable();
    }

  private:
    Inst& terminator(BlockId block) { return routine_.insts[routine_.blocks[block].insts.back()]; }

    /// Without retry (trynext) the beginning (the end) of a statement is not needed.
    void dropUnusedResumePoints() {
        bool retries = false, triesNext = false;
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            retries = retries || terminator(b).op == Op::Retry;
            triesNext = triesNext || terminator(b).op == Op::TryNext;
        }
        for (Statement& s : routine_.statements) {
            if (!routine_.stepping && (!retries || !s.handled)) s.start = kNone;
            if (!triesNext || !s.handled) s.next = kNone;
        }
    }

    void foldEqualTargets() {
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            Inst& last = terminator(b);
            if (last.op != Op::CondBr || last.target(0) != last.target(1)) continue;
            last.op = Op::Br;
            last.operands.clear();
        }
    }

    void redirect(const std::function<BlockId(BlockId)>& map) {
        auto apply = [&](BlockId& target) {
            if (target != kNone) target = map(target);
        };
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            routine_.visitTargets(terminator(b), apply);
        }
        for (Statement& s : routine_.statements) {
            apply(s.start);
            apply(s.next);
        }
        apply(routine_.errorHandler);
        apply(routine_.undoHandler);
    }

    void threadJumps() {
        std::vector<BlockId> final(routine_.blocks.size());
        for (BlockId b = 0; b < final.size(); ++b) {
            BlockId target = b;
            // As many steps as there are blocks: an empty endless loop ends the walk.
            for (size_t steps = 0; steps < final.size(); ++steps) {
                if (routine_.blocks[target].insts.size() != 1 || terminator(target).op != Op::Br) break;
                if (target == routine_.errorHandler || target == routine_.undoHandler) break;
                target = terminator(target).target(0);
            }
            final[b] = target;
        }
        BlockId error = routine_.errorHandler, undo = routine_.undoHandler;
        redirect([&](BlockId b) { return final[b]; });
        routine_.errorHandler = error; // a handler keeps a block of its own
        routine_.undoHandler = undo;
    }

    void mergeChains() {
        std::vector<uint32_t> uses(routine_.blocks.size(), 0);
        redirect([&](BlockId b) {
            ++uses[b];
            return b;
        });
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            while (terminator(b).op == Op::Br) {
                BlockId next = terminator(b).target(0);
                if (next == b || next == 0 || uses[next] != 1) break;
                std::vector<ValueId>& insts = routine_.blocks[b].insts;
                std::vector<ValueId>& tail = routine_.blocks[next].insts;
                insts.pop_back();
                insts.insert(insts.end(), tail.begin(), tail.end());
                // The rest of the merged block is unreachable but still well formed.
                Inst end;
                end.op = Op::Unreachable;
                routine_.insts.push_back(end);
                tail = {static_cast<ValueId>(routine_.insts.size() - 1)};
                uses[next] = 0;
            }
        }
    }

    void removeUnreachable() {
        Cfg cfg = buildCfg(module_, routine_, HandlerEdges::Yes);
        std::vector<BlockId> renumbered(routine_.blocks.size(), kNone);
        BlockId kept = 0;
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            if (!cfg.reachable(b)) continue;
            renumbered[b] = kept;
            if (kept != b) routine_.blocks[kept] = std::move(routine_.blocks[b]);
            ++kept;
        }
        if (kept == routine_.blocks.size()) return;
        routine_.blocks.truncate(kept);
        redirect([&](BlockId b) { return renumbered[b]; });
    }

    const Module& module_;
    Routine& routine_;
};

} // namespace

void simplifyCfg(const Module& module, Routine& routine) {
    Simplifier(module, routine).run();
}

} // namespace ir

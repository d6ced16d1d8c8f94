#include "ir/core/cfg.h"

#include <algorithm>

#include "ir/core/dominators.h"
#include "ir/core/op_info.h"

namespace ir {
namespace {

void addEdge(Cfg& cfg, BlockId from, BlockId to) {
    if (to >= cfg.succs.size()) return;
    BlockList& succs = cfg.succs[from];
    if (std::find(succs.begin(), succs.end(), to) != succs.end()) return;
    succs.push_back(to);
    cfg.preds[to].push_back(from);
}

/// Does any block end in `op`?
bool contains(const Routine& routine, Op op) {
    return std::any_of(routine.blocks.begin(), routine.blocks.end(), [&](const Block& block) {
        return !block.insts.empty() && routine.insts[block.insts.back()].op == op;
    });
}

void addHandlerEdges(Cfg& cfg, const Module& module, const Routine& routine) {
    if (routine.errorHandler == kNone) return;
    bool retries = contains(routine, Op::Retry), triesNext = contains(routine, Op::TryNext);
    // A handler with a list takes errors of interrupt routines, too, which run at safepoints anywhere.
    bool anywhere = !routine.errorFilter.empty() || !routine.errorFilterGlobals.empty();
    for (BlockId b = 0; b < routine.blocks.size(); ++b) {
        for (ValueId id : routine.blocks[b].insts) {
            const Inst& inst = routine.insts[id];
            if (inst.stmt >= routine.statements.size() || !(anywhere || mayRaise(module, inst))) continue;
            const Statement& s = routine.statements[inst.stmt];
            if (!s.handled) continue;
            addEdge(cfg, b, routine.errorHandler);
            if (retries && s.start != kNone) addEdge(cfg, b, s.start);
            if (triesNext && s.next != kNone) addEdge(cfg, b, s.next);
        }
    }
}

/// Postorder of what can be reached from `root`, iterative because routines may have very many blocks.
void visit(const Cfg& cfg, BlockId root, std::vector<bool>& seen, std::vector<BlockId>& postorder) {
    struct Step {
        BlockId block;
        size_t next;
    };
    if (root >= seen.size() || seen[root]) return;
    std::vector<Step> stack{{root, 0}};
    seen[root] = true;
    while (!stack.empty()) {
        Step& top = stack.back();
        if (top.next == cfg.succs[top.block].size()) {
            postorder.push_back(top.block);
            stack.pop_back();
            continue;
        }
        BlockId succ = cfg.succs[top.block][top.next++];
        if (seen[succ]) continue;
        seen[succ] = true;
        stack.push_back({succ, 0});
    }
}

} // namespace

BlockList successors(const Routine& routine, BlockId block) {
    BlockList result;
    const std::vector<ValueId>& insts = routine.blocks[block].insts;
    if (insts.empty()) return result;
    const Inst& last = routine.insts[insts.back()];
    if (familyOf(last.op) != Family::End) return result;
    switch (as<EndOp>(last.op)) {
    case EndOp::Br: return {last.target(0)};
    case EndOp::CondBr: return {last.target(0), last.target(1)};
    case EndOp::Switch:
        result.push_back(last.target(0));
        for (const SwitchCase& entry : routine.caseLists[last.index])
            result.push_back(entry.target);
        return result;
    case EndOp::Ret:
    case EndOp::Raise:
    case EndOp::Propagate:
    case EndOp::Retry:
    case EndOp::TryNext:
    case EndOp::HandlerEnd:
    case EndOp::Unreachable: return result; // leaves the routine, or goes where a handler decides
    }
    return result;
}

bool mayRaise(const Module& module, const Inst& inst) {
    if (inst.op == Op::CallNative && inst.index < module.natives.size())
        return module.natives[inst.index].nativeClass == NativeClass::Plain;
    return opInfo(inst.op).mayRaise && inst.op != Op::Safepoint && inst.op != Op::Step;
}

bool Cfg::dominates(BlockId a, BlockId b) const {
    if (a == b) return true;
    return reachable(a) && reachable(b) && enters[a] <= enters[b] && leaves[b] <= leaves[a];
}

namespace {

/// Numbers the tree of dominators: whether one block dominates another is asked very often, and chains are long.
void numberDominators(Cfg& cfg) {
    const size_t count = cfg.succs.size();
    cfg.enters.assign(count, 0);
    cfg.leaves.assign(count, 0);
    // Dominators come first in reverse postorder: sizes from the end, places from the beginning.
    std::vector<uint32_t> size(count, 1), next(count, 0);
    const auto& order = cfg.order;
    for (auto b = order.rbegin(); b != order.rend(); ++b)
        if (cfg.idom[*b] != kNone) size[cfg.idom[*b]] += size[*b];
    uint32_t free = 1;
    for (const BlockId b : order) {
        uint32_t& place = cfg.idom[b] == kNone ? free : next[cfg.idom[b]];
        cfg.enters[b] = place;
        place += size[b];
        cfg.leaves[b] = place - 1;
        next[b] = cfg.enters[b] + 1;
    }
}

} // namespace

Cfg buildCfg(const Module& module, const Routine& routine, HandlerEdges handlerEdges) {
    Cfg cfg;
    size_t count = routine.blocks.size();
    cfg.succs.resize(count);
    cfg.preds.resize(count);
    for (BlockId b = 0; b < count; ++b)
        for (BlockId succ : successors(routine, b))
            addEdge(cfg, b, succ);
    if (handlerEdges == HandlerEdges::Yes) addHandlerEdges(cfg, module, routine);

    std::vector<bool> seen(count, false);
    std::vector<BlockId> postorder, roots;
    // The last root visited comes first in reverse postorder: handlers first, the entry last.
    for (BlockId root : {routine.undoHandler, routine.errorHandler, BlockId{0}}) {
        if (root >= count) continue;
        bool reachedOtherwise = handlerEdges == HandlerEdges::Yes && root == routine.errorHandler;
        if (!reachedOtherwise) roots.push_back(root);
    }
    // `step` may continue with any statement.
    if (routine.stepping)
        for (const Statement& s : routine.statements)
            if (s.start < count) roots.insert(roots.end() - 1, s.start);
    for (BlockId root : roots)
        visit(cfg, root, seen, postorder);
    if (routine.errorHandler < count && !seen[routine.errorHandler]) { // nothing raises: an entry after all
        roots.push_back(routine.errorHandler);
        visit(cfg, routine.errorHandler, seen, postorder);
    }
    cfg.order.assign(postorder.rbegin(), postorder.rend());
    cfg.position.assign(count, kNone);
    for (uint32_t i = 0; i < cfg.order.size(); ++i)
        cfg.position[cfg.order[i]] = i;
    cfg.idom = findDominators(cfg, roots);
    numberDominators(cfg);
    return cfg;
}

namespace {

void collectBody(const Cfg& cfg, Loop& loop) {
    loop.contains.assign(cfg.succs.size(), false);
    loop.contains[loop.header] = true;
    loop.blocks = {loop.header};
    std::vector<BlockId> work = loop.latches;
    while (!work.empty()) {
        BlockId b = work.back();
        work.pop_back();
        if (loop.contains[b]) continue;
        loop.contains[b] = true;
        loop.blocks.push_back(b);
        for (BlockId p : cfg.preds[b])
            if (cfg.reachable(p)) work.push_back(p);
    }
}

} // namespace

LoopInfo findLoops(const Cfg& cfg) {
    LoopInfo info;
    for (BlockId b : cfg.order) {
        for (BlockId succ : cfg.succs[b]) {
            if (cfg.position[succ] > cfg.position[b]) continue;
            if (!cfg.dominates(succ, b)) {
                info.irreducible.push_back({b, succ});
                continue;
            }
            auto same = [&](const Loop& loop) { return loop.header == succ; };
            auto found = std::find_if(info.loops.begin(), info.loops.end(), same);
            if (found == info.loops.end())
                found = info.loops.insert(info.loops.end(), Loop{succ, {}, {}, {}, kNone, true});
            found->latches.push_back(b);
        }
    }
    for (Loop& loop : info.loops)
        collectBody(cfg, loop);
    info.loopOf.assign(cfg.succs.size(), kNone);
    auto smaller = [&](uint32_t a, uint32_t b) {
        return b == kNone || info.loops[a].blocks.size() < info.loops[b].blocks.size();
    };
    for (uint32_t l = 0; l < info.loops.size(); ++l) {
        for (BlockId b : info.loops[l].blocks) {
            uint32_t& innermost = info.loopOf[b];
            if (smaller(l, innermost)) innermost = l;
        }
        for (uint32_t outer = 0; outer < info.loops.size(); ++outer) {
            if (outer == l || !info.loops[outer].contains[info.loops[l].header]) continue;
            if (info.loops[outer].blocks.size() <= info.loops[l].blocks.size()) continue;
            info.loops[outer].innermost = false;
            uint32_t& parent = info.loops[l].parent;
            if (smaller(outer, parent)) parent = outer;
        }
    }
    return info;
}

BlockId entryByJump(const Routine& routine, const Cfg& cfg, const Loop& loop) {
    BlockId entry = kNone;
    for (const BlockId p : cfg.preds[loop.header]) {
        if (loop.contains[p]) continue;
        if (entry != kNone) return kNone;
        entry = p;
    }
    const bool jumps = entry != kNone && routine.insts[routine.blocks[entry].insts.back()].op == Op::Br;
    return jumps ? entry : kNone;
}

std::vector<bool> privateLocals(const Routine& routine) {
    std::vector<bool> result(routine.locals.size(), true);
    for (const Block& block : routine.blocks)
        for (const ValueId id : block.insts) {
            const Inst& user = routine.insts[id];
            for (size_t i = 0; i < user.operands.size(); ++i) {
                const Inst& address = routine.insts[user.operands[i]];
                if (address.op != Op::LocalAddr) continue;
                const bool direct = (user.op == Op::Load && i == 0) || (user.op == Op::Store && i == 1) ||
                                    user.op == Op::Zero;
                if (!direct) result[address.index] = false;
            }
        }
    return result;
}

} // namespace ir

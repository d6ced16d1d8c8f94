// Inserts the safepoints (design chapter 4). The budget counts statements: the routine pays at its entry for those
// outside loops, each loop pays per round for those of its own. An innermost counted loop without calls pays for all
// its rounds ahead of the loop, so that its body stays free of control flow and can be vectorised. What may have caused an
// interrupt is followed by a safepoint without cost: traps run when the next statement is entered.

#include <algorithm>

#include "ir/core/cfg.h"
#include "ir/core/op_info.h"
#include "ir/passes/counted_loop.h"
#include "ir/passes/passes.h"

namespace ir {
namespace {

class Placer {
  public:
    Placer(const Module& module, Routine& routine, bool dataWatched)
        : module_(module), routine_(routine), dataWatched_(dataWatched) {}

    void run(Profile profile) {
        keepEntryFree();
        cfg_ = buildCfg(module_, routine_, HandlerEdges::No);
        info_ = findLoops(cfg_);
        if (!info_.irreducible.empty()) {
            for (const Edge& edge : info_.irreducible)
                payOnEdge(edge);
            cfg_ = buildCfg(module_, routine_, HandlerEdges::No);
            info_ = findLoops(cfg_);
        }
        if (profile == Profile::Stepping)
            step();
        else
            payAtEntry();
        for (uint32_t l = 0; l < info_.loops.size(); ++l)
            placeInLoop(l, profile);
        lookAfterCauses();
    }

  private:
    ValueId add(Inst inst, StmtId stmt) {
        inst.stmt = stmt;
        routine_.insts.push_back(std::move(inst));
        return static_cast<ValueId>(routine_.insts.size() - 1);
    }
    static Inst make(Op op, TypeId type, std::vector<ValueId> operands = {}) {
        Inst inst;
        inst.op = op;
        inst.type = type;
        inst.operands = std::move(operands);
        return inst;
    }
    static Inst makeSafepoint(uint32_t cost) {
        Inst inst = make(Op::Safepoint, kVoid);
        inst.extra = static_cast<int32_t>(cost);
        return inst;
    }
    static Inst makeConst(TypeId type, double number) {
        Inst inst = make(Op::Const, type);
        inst.number = number;
        return inst;
    }
    const Inst& terminator(BlockId b) const { return routine_.insts[routine_.blocks[b].insts.back()]; }

    /// Gives the routine an entry block that nothing jumps to: what is paid there is paid once.
    void keepEntryFree() {
        bool target = false;
        auto note = [&](BlockId b) { target = target || b == 0; };
        for (BlockId b = 0; b < routine_.blocks.size(); ++b)
            for (BlockId succ : successors(routine_, b))
                note(succ);
        for (const Statement& s : routine_.statements) {
            note(s.start);
            note(s.next);
        }
        if (!target) return;
        auto moved = static_cast<BlockId>(routine_.blocks.size());
        retarget(0, moved, kNone);
        for (Statement& s : routine_.statements) {
            if (s.start == 0) s.start = moved;
            if (s.next == 0) s.next = moved;
        }
        routine_.blocks.push_back(std::move(routine_.blocks[0]));
        Inst jump = make(Op::Br, kVoid);
        jump.target[0] = moved;
        routine_.blocks[0] = {"entry", {add(std::move(jump), kNone)}};
    }

    /// Redirects jumps from `from` to `to`: of block `onlyIn`, or of every block when kNone.
    void retarget(BlockId from, BlockId to, BlockId onlyIn) {
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            if (onlyIn != kNone && onlyIn != b) continue;
            Inst& last = routine_.insts[routine_.blocks[b].insts.back()];
            for (BlockId& target : last.target)
                if (target == from) target = to;
            for (SwitchCase& entry : last.cases)
                if (entry.target == from) entry.target = to;
        }
    }

    uint32_t markers(BlockId b) const {
        uint32_t count = 0;
        for (ValueId id : routine_.blocks[b].insts)
            if (routine_.insts[id].op == Op::Stmt) ++count;
        return count;
    }

    void insertBeforeTerminator(BlockId b, Inst inst) {
        StmtId stmt = terminator(b).stmt;
        ValueId id = add(std::move(inst), stmt);
        std::vector<ValueId>& insts = routine_.blocks[b].insts;
        insts.insert(insts.end() - 1, id);
    }

    void payAtEntry() {
        uint32_t cost = 0;
        for (BlockId b : cfg_.order)
            if (info_.loopOf[b] == kNone && (b == 0 || cfg_.dominates(0, b))) cost += markers(b);
        std::vector<ValueId>& insts = routine_.blocks[0].insts;
        StmtId first = kNone;
        for (ValueId id : insts)
            if (first == kNone) first = routine_.insts[id].stmt;
        insts.insert(insts.begin(), add(makeSafepoint(std::max(cost, 1u)), first));
    }

    /// A statement that `step` may come back to asks the controller; one in an undo handler, which is always
    /// executed continuously (manual 1.13), and what belongs to no statement list only pay.
    void step() {
        std::vector<bool> inUndo(routine_.blocks.size(), false);
        std::vector<BlockId> work;
        if (routine_.undoHandler != kNone) work.push_back(routine_.undoHandler);
        while (!work.empty()) {
            BlockId b = work.back();
            work.pop_back();
            if (inUndo[b]) continue;
            inUndo[b] = true;
            for (BlockId succ : successors(routine_, b))
                work.push_back(succ);
        }
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            std::vector<ValueId> insts;
            for (ValueId id : routine_.blocks[b].insts) {
                insts.push_back(id);
                if (routine_.insts[id].op != Op::Stmt) continue;
                const StmtId stmt = routine_.insts[id].index;
                Inst inst = makeSafepoint(1);
                if (routine_.stepping && !inUndo[b] && routine_.statements[stmt].start != kNone) {
                    inst = make(Op::Step, kVoid);
                    inst.index = stmt;
                }
                insts.push_back(add(std::move(inst), stmt));
            }
            routine_.blocks[b].insts = std::move(insts);
        }
    }

    void lookAfterCauses() {
        for (Block& block : routine_.blocks) {
            std::vector<ValueId> insts;
            for (ValueId id : block.insts) {
                insts.push_back(id);
                if (mayCauseInterrupt(routine_.insts[id]))
                    insts.push_back(add(makeSafepoint(0), routine_.insts[id].stmt));
            }
            block.insts = std::move(insts);
        }
    }

    bool mayCauseInterrupt(const Inst& inst) const {
        switch (inst.op) {
        case Op::CallNative: {
            const Native& native = module_.natives[inst.index];
            return native.nativeClass == NativeClass::Plain && native.result == kVoid;
        }
        case Op::Store: return dataWatched_ && mayBePersistent(inst.operands[1]);
        case Op::Copy:
        case Op::CopyDynamic:
        case Op::Zero: return dataWatched_ && mayBePersistent(inst.operands[0]);
        default: return false;
        }
    }

    bool mayBePersistent(ValueId address) const {
        const Inst& inst = routine_.insts[address];
        switch (inst.op) {
        case Op::FieldAddr:
        case Op::ElemAddr: return mayBePersistent(inst.operands[0]);
        case Op::GlobalAddr: return module_.globals[inst.index].kind == GlobalKind::Persistent;
        case Op::LocalAddr:
        case Op::ResultAddr:
        case Op::StackAlloc: return false;
        default: return true; // a parameter: the caller may have passed a persistent
        }
    }

    void placeInLoop(uint32_t l, Profile profile) {
        const Loop& loop = info_.loops[l];
        uint32_t own = 0, all = 0;
        for (BlockId b : loop.blocks) {
            all += markers(b);
            if (info_.loopOf[b] == l) own += markers(b);
        }
        auto counted = recogniseCountedLoop(routine_, loop);
        if (counted) routine_.insts[counted->increment].extra = 1; // no signed wrap
        if (profile == Profile::Stepping) {
            if (all == 0) payAtLatches(loop, 1);
            return;
        }
        uint32_t cost = std::max(own, 1u);
        if (counted && loop.innermost && isFreeOfCalls(module_, routine_, loop))
            payAhead(loop, *counted, cost);
        else
            payAtLatches(loop, cost);
    }

    void payAtLatches(const Loop& loop, uint32_t cost) {
        for (BlockId latch : loop.latches)
            insertBeforeTerminator(latch, makeSafepoint(cost));
    }

    /// The block that enters the loop; made when there is none that only does that.
    BlockId preheader(const Loop& loop) {
        std::vector<BlockId> outside;
        for (BlockId p : cfg_.preds[loop.header])
            if (!loop.contains[p]) outside.push_back(p);
        if (outside.size() == 1 && terminator(outside[0]).op == Op::Br) return outside[0];
        auto block = static_cast<BlockId>(routine_.blocks.size());
        for (BlockId p : outside)
            retarget(loop.header, block, p);
        Inst jump = make(Op::Br, kVoid);
        jump.target[0] = loop.header;
        StmtId stmt = outside.empty() ? kNone : terminator(outside[0]).stmt;
        routine_.blocks.push_back({"preheader", {add(std::move(jump), stmt)}});
        return block;
    }

    void payAhead(const Loop& loop, const CountedLoop& counted, uint32_t cost) {
        BlockId block = preheader(loop);
        StmtId stmt = terminator(block).stmt;
        std::vector<ValueId> code;
        auto emit = [&](Inst inst) {
            code.push_back(add(std::move(inst), stmt));
            return code.back();
        };
        auto loadLocal = [&](uint32_t local) {
            Inst address = make(Op::LocalAddr, kPtr);
            address.index = local;
            return emit(make(Op::Load, kI32, {emit(std::move(address))}));
        };
        ValueId bound = counted.bound;
        const Inst boundInst = routine_.insts[bound];
        if (boundInst.op == Op::Const)
            bound = emit(makeConst(kI32, boundInst.number));
        else if (boundInst.op == Op::Load && routine_.insts[boundInst.operands[0]].op == Op::LocalAddr)
            bound = loadLocal(routine_.insts[boundInst.operands[0]].index);
        ValueId from = emit(make(Op::I32ToI64, kI64, {loadLocal(counted.counter)}));
        ValueId to = emit(make(Op::I32ToI64, kI64, {bound}));
        // Rounds: (distance + step) / step with the bound included, (distance + step - 1) / step without.
        bool up = counted.step > 0;
        bool included = counted.comparison == Op::ILe || counted.comparison == Op::IGe;
        double step = up ? counted.step : -static_cast<double>(counted.step);
        ValueId distance =
            up ? emit(make(Op::ISub, kI64, {to, from})) : emit(make(Op::ISub, kI64, {from, to}));
        ValueId extent =
            emit(make(Op::IAdd, kI64, {distance, emit(makeConst(kI64, included ? step : step - 1))}));
        ValueId rounds =
            step == 1 ? extent : emit(make(Op::IDiv, kI64, {extent, emit(makeConst(kI64, step))}));
        ValueId none = emit(makeConst(kI64, 0));
        ValueId empty = emit(make(Op::ILt, kBool, {rounds, none}));
        ValueId charge = emit(make(Op::Select, kI64, {empty, none, rounds}));
        if (cost > 1) charge = emit(make(Op::IMul, kI64, {charge, emit(makeConst(kI64, cost))}));
        Inst safepoint = makeSafepoint(0);
        safepoint.operands = {charge};
        emit(std::move(safepoint));
        std::vector<ValueId>& insts = routine_.blocks[block].insts;
        insts.insert(insts.end() - 1, code.begin(), code.end());
    }

    /// A jump back that no natural loop explains (GOTO into a loop): a block of its own on that edge.
    void payOnEdge(const Edge& edge) {
        auto block = static_cast<BlockId>(routine_.blocks.size());
        StmtId stmt = terminator(edge.from).stmt;
        retarget(edge.to, block, edge.from);
        Inst jump = make(Op::Br, kVoid);
        jump.target[0] = edge.to;
        uint32_t cost = std::max(markers(edge.to), 1u);
        ValueId safepoint = add(makeSafepoint(cost), stmt);
        routine_.blocks.push_back({"back", {safepoint, add(std::move(jump), stmt)}});
    }

    const Module& module_;
    Routine& routine_;
    bool dataWatched_;
    Cfg cfg_;
    LoopInfo info_;
};

} // namespace

void placeSafepoints(Module& module, Profile profile) {
    const bool dataWatched = std::any_of(module.natives.begin(), module.natives.end(),
                                         [](const Native& native) { return native.watches; });
    for (Routine& routine : module.routines)
        Placer(module, routine, dataWatched).run(profile);
}

} // namespace ir

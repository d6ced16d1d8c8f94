// Inserts the safepoints. The front end has said what execution costs (`charge`); here is decided
// where compiled code looks whether the budget is used up: at each charge, or at each statement in the stepping profile,
// which charges the same. Each cycle gets a safepoint, except counted loops without calls, so that they can be
// vectorised. What may have caused an interrupt is followed by a safepoint without cost: interrupt routines run when the next
// statement is entered.

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
        charged_ = std::any_of(routine_.insts.begin(), routine_.insts.end(),
                               [](const Inst& inst) { return inst.op == Op::Charge; });
        if (profile == Profile::Stepping) {
            markCountedLoops();
            step();
            breakSilentCycles();
        } else {
            placeInLoops();
            payWhereCharged();
        }
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
        jump.target(0) = moved;
        routine_.blocks[0] = {routine_.blockName("entry"), {add(std::move(jump), kNone)}};
    }

    /// Redirects jumps from `from` to `to`: of block `onlyIn`, or of every block when kNone.
    void retarget(BlockId from, BlockId to, BlockId onlyIn) {
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            if (onlyIn != kNone && onlyIn != b) continue;
            routine_.visitTargets(routine_.insts[routine_.blocks[b].insts.back()], [&](BlockId& target) {
                if (target == from) target = to;
            });
        }
    }

    void insertBeforeTerminator(BlockId b, Inst inst) {
        StmtId stmt = terminator(b).stmt;
        ValueId id = add(std::move(inst), stmt);
        std::vector<ValueId>& insts = routine_.blocks[b].insts;
        insts.insert(insts.end() - 1, id);
    }

    /// A cycle that no front end has charged costs one instruction, so that no cycle takes no time.
    uint32_t leastCost() const { return charged_ ? 0 : 1; }

    void payWhereCharged() {
        for (Inst& inst : routine_.insts)
            if (inst.op == Op::Charge) inst.op = Op::Safepoint;
        if (charged_) return;
        std::vector<ValueId>& insts = routine_.blocks[0].insts;
        StmtId first = kNone;
        for (ValueId id : insts)
            if (first == kNone) first = routine_.insts[id].stmt;
        insts.insert(insts.begin(), add(makeSafepoint(leastCost()), first));
    }

    /// A statement that `step` may come back to asks the controller, and looks at the budget; charges only pay. An undo
    /// handler is always executed continuously (manual 1.13): its charges are safepoints, as in the release profile.
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
                if (inUndo[b] && routine_.insts[id].op == Op::Charge) routine_.insts[id].op = Op::Safepoint;
                if (routine_.insts[id].op != Op::Stmt) continue;
                const StmtId stmt = routine_.insts[id].index;
                Inst inst = makeSafepoint(leastCost());
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
        if (inst.op == Op::CallNative) {
            const Native& native = module_.natives[inst.index];
            return native.nativeClass == NativeClass::Plain && native.result == kVoid;
        }
        if (!dataWatched_ || familyOf(inst.op) != Family::Memory) return false;
        switch (as<MemoryOp>(inst.op)) {
        case MemoryOp::Store: return mayBePersistent(inst.operands[1]);
        case MemoryOp::Copy:
        case MemoryOp::CopyDynamic:
        case MemoryOp::Zero: return mayBePersistent(inst.operands[0]);
        case MemoryOp::Load:
        case MemoryOp::StackAlloc:
        case MemoryOp::FieldAddr:
        case MemoryOp::ElemAddr: return false;
        }
        return false;
    }

    /// Unknown addresses are those of parameters: the caller may have passed a persistent.
    bool mayBePersistent(ValueId address) const {
        const Inst& inst = routine_.insts[address];
        if (inst.op == Op::FieldAddr || inst.op == Op::ElemAddr) return mayBePersistent(inst.operands[0]);
        if (inst.op == Op::GlobalAddr) return module_.globals[inst.index].kind == GlobalKind::Persistent;
        return inst.op != Op::LocalAddr && inst.op != Op::ResultAddr && inst.op != Op::StackAlloc;
    }

    /// The step of a counted loop cannot wrap.
    std::optional<CountedLoop> markCounted(const Loop& loop) {
        auto counted = recogniseCountedLoop(routine_, loop);
        if (counted) routine_.insts[counted->increment].extra = 1;
        return counted;
    }

    void markCountedLoops() {
        cfg_ = buildCfg(module_, routine_, HandlerEdges::No);
        info_ = findLoops(cfg_);
        for (const Loop& loop : info_.loops)
            markCounted(loop);
    }

    void placeInLoops() {
        cfg_ = buildCfg(module_, routine_, HandlerEdges::No);
        info_ = findLoops(cfg_);
        if (!info_.irreducible.empty()) {
            for (const Edge& edge : info_.irreducible)
                payOnEdge(edge);
            cfg_ = buildCfg(module_, routine_, HandlerEdges::No);
            info_ = findLoops(cfg_);
        }
        for (uint32_t l = 0; l < info_.loops.size(); ++l) {
            const Loop& loop = info_.loops[l];
            bool pays = false;
            for (BlockId b : loop.blocks)
                for (ValueId id : routine_.blocks[b].insts)
                    pays = pays || (routine_.insts[id].op == Op::Charge && info_.loopOf[b] == l);
            const bool counted = markCounted(loop).has_value();
            const bool endsSoon = counted && loop.innermost && isFreeOfCalls(module_, routine_, loop);
            if (!pays && !endsSoon) payAtLatches(loop, leastCost());
        }
    }

    bool looks(BlockId b) const {
        const std::vector<ValueId>& insts = routine_.blocks[b].insts;
        return std::any_of(insts.begin(), insts.end(), [this](ValueId id) {
            return routine_.insts[id].op == Op::Step || routine_.insts[id].op == Op::Safepoint;
        });
    }

    /// A cycle without a statement (a FOR loop with an empty body) gets a safepoint. Elsewhere there is none between
    /// statements: a task that is interrupted there could not be entered again by a later process.
    void breakSilentCycles() {
        enum class State : uint8_t { New, Open, Done };
        std::vector<State> states(routine_.blocks.size(), State::New);
        std::vector<Edge> back;
        struct Visit {
            BlockId block;
            BlockList successors;
            size_t visited = 0;
        };
        for (BlockId root = 0; root < states.size(); ++root) {
            if (states[root] != State::New || looks(root)) continue;
            std::vector<Visit> open{{root, successors(routine_, root)}};
            states[root] = State::Open;
            while (!open.empty()) {
                Visit& at = open.back();
                if (at.visited == at.successors.size()) {
                    states[at.block] = State::Done;
                    open.pop_back();
                    continue;
                }
                ++at.visited;
                const BlockId to = at.successors[at.successors.size() - at.visited];
                if (looks(to)) continue;
                if (states[to] == State::Open) back.push_back({at.block, to});
                if (states[to] != State::New) continue;
                states[to] = State::Open;
                open.push_back({to, successors(routine_, to)});
            }
        }
        for (const Edge& edge : back)
            payOnEdge(edge);
    }

    void payAtLatches(const Loop& loop, uint32_t cost) {
        for (BlockId latch : loop.latches)
            insertBeforeTerminator(latch, makeSafepoint(cost));
    }

    /// A jump back that no natural loop explains (GOTO into a loop): a block of its own on that edge.
    void payOnEdge(const Edge& edge) {
        auto block = static_cast<BlockId>(routine_.blocks.size());
        StmtId stmt = terminator(edge.from).stmt;
        retarget(edge.to, block, edge.from);
        Inst jump = make(Op::Br, kVoid);
        jump.target(0) = edge.to;
        ValueId safepoint = add(makeSafepoint(leastCost()), stmt);
        routine_.blocks.push_back({routine_.blockName("back"), {safepoint, add(std::move(jump), stmt)}});
    }

    const Module& module_;
    Routine& routine_;
    bool dataWatched_;
    bool charged_ = false; ///< the front end has said what execution costs
    Cfg cfg_;
    LoopInfo info_;
};

} // namespace

void placeSafepoints(const Module& module, Routine& routine, Profile profile) {
    const bool dataWatched = std::any_of(module.natives.begin(), module.natives.end(),
                                         [](const Native& native) { return native.watches; });
    Placer(module, routine, dataWatched).run(profile);
}

} // namespace ir

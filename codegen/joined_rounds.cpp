#include "codegen/joined_rounds.h"

#include <algorithm>

#include "codegen/wide_loop.h"
#include "ir/core/op_info.h"

namespace codegen {

using ir::Inst;
using ir::Op;
using ir::ValueId;

std::optional<JoinedRounds> JoinedRounds::plan(const ir::Module& module, const ir::Routine& routine,
                                               const ir::Cfg& cfg, const ir::Loop& loop) {
    JoinedRounds joined;
    if (!loop.innermost || !joined.read(module, routine, cfg, loop)) return std::nullopt;
    return joined;
}

bool JoinedRounds::read(const ir::Module& module, const ir::Routine& routine, const ir::Cfg& cfg,
                        const ir::Loop& loop) {
    const auto counted = recogniseCountedLoop(routine, loop);
    if (!counted) return false;
    counted_ = *counted;
    header_ = loop.header;
    entry_ = ir::entryByJump(routine, cfg, loop);
    if (entry_ == ir::kNone) return false;
    if (!readBody(module, routine, loop) || checked_.empty()) return false;
    const std::vector<bool> isPrivate = ir::privateLocals(routine);
    for (const uint32_t local : written_)
        if (!isPrivate[local]) return false;
    std::vector<uint32_t> seen; // what a local holds at the end of the round counts
    for (auto id = insts_.rbegin(); id != insts_.rend(); ++id) {
        const Inst& store = routine.insts[*id];
        if (store.op != Op::Store) continue;
        const uint32_t local = routine.insts[store.operands[1]].index;
        if (std::find(seen.begin(), seen.end(), local) != seen.end()) continue;
        seen.push_back(local);
        const ValueId value = store.operands[0];
        const bool isChecked = std::find(checked_.begin(), checked_.end(), value) != checked_.end();
        if (isChecked && reaches(routine, value, local)) kept_.push_back(value);
    }
    return !kept_.empty();
}

/// One way through the loop, block after block.
bool JoinedRounds::readBody(const ir::Module& module, const ir::Routine& routine, const ir::Loop& loop) {
    size_t blocks = 0;
    for (ir::BlockId b = header_;;) {
        if (++blocks > loop.blocks.size()) return false;
        const std::vector<ValueId>& insts = routine.blocks[b].insts;
        const Inst& last = routine.insts[insts.back()];
        for (const ValueId id : insts) {
            const Inst& inst = routine.insts[id];
            if (id == insts.back() || inst.op == Op::Stmt) continue;
            insts_.push_back(id);
            if (inst.op == Op::CheckFinite) {
                checked_.push_back(inst.operands[0]);
            } else if (inst.op == Op::Store) {
                const Inst& address = routine.insts[inst.operands[1]];
                if (address.op != Op::LocalAddr) return false;
                if (std::find(written_.begin(), written_.end(), address.index) == written_.end())
                    written_.push_back(address.index);
            } else if (inst.op != Op::Load && inst.op != Op::Check &&
                       (ir::mayRaise(module, inst) ||
                        (ir::opInfo(inst.op).touchesMemory && inst.op != Op::CallNative))) {
                return false;
            }
        }
        if (b != header_ && last.op != Op::Br) return false;
        b = last.target(0);
        if (b == header_) return blocks == loop.blocks.size();
        if (!loop.contains[b]) return false;
    }
}

/// The value takes over an infinity that the local had at the beginning of the round.
bool JoinedRounds::reaches(const ir::Routine& routine, ValueId value, uint32_t local) const {
    const Inst& inst = routine.insts[value];
    if (inst.op == Op::Load) {
        const Inst& address = routine.insts[inst.operands[0]];
        if (address.op != Op::LocalAddr || address.index != local) return false;
        // Not after the round has stored something else there.
        for (const ValueId id : insts_) {
            if (id == value) return true;
            const Inst& earlier = routine.insts[id];
            if (earlier.op == Op::Store && routine.insts[earlier.operands[1]].index == local) return false;
        }
        return false;
    }
    const bool keeps =
        ir::familyOf(inst.op) == ir::Family::Float && inst.op != Op::FDiv && !ir::dropsDecimals(inst.op);
    return keeps && std::any_of(inst.operands.begin(), inst.operands.end(),
                                [&](ValueId id) { return reaches(routine, id, local); });
}

bool JoinedRounds::isKept(ValueId value) const {
    return std::find(kept_.begin(), kept_.end(), value) != kept_.end();
}

// ---- Emission ------------------------------------------------------------------------------------------------------

void RoutineEmitter::findFastLoops() {
    if (routine_.stepping || !m_.options().optimise || module_.overflowError == 0) return;
    const ir::Cfg cfg = ir::buildCfg(module_, routine_, ir::HandlerEdges::No);
    const ir::LoopInfo info = ir::findLoops(cfg);
    for (const ir::Loop& loop : info.loops) {
        if (auto wide = WideLoop::plan(module_, routine_, cfg, loop))
            wideLoops_.push_back(std::move(*wide));
        else if (auto joined = JoinedRounds::plan(module_, routine_, cfg, loop))
            joinedRounds_.push_back(std::move(*joined));
    }
}

/// At the jump that enters a loop: emits its faster form before it, if there is one.
bool RoutineEmitter::entersFastLoop() {
    for (const WideLoop& wide : wideLoops_)
        if (wide.entry() == current_) return wideLoop(wide), true;
    for (const JoinedRounds& joined : joinedRounds_)
        if (joined.entry() == current_) return joinedRounds(joined), true;
    return false;
}

/// At the header of a counted loop: at least so many rounds are left. Computed in 64 bits, which the sum cannot leave.
llvm::Value* RoutineEmitter::hasRounds(const ir::CountedLoop& counted, unsigned rounds) {
    const Inst& limit = routine_.insts[counted.bound];
    Value* bound = limit.op == Op::Const  ? constant(limit)
                   : limit.op == Op::Load ? load(ir::kI32, locals_[routine_.insts[limit.operands[0]].index])
                                          : value(counted.bound);
    llvm::Type* i64 = b_.getInt64Ty();
    const int64_t distance = static_cast<int64_t>(counted.step) * (rounds - 1);
    Value* last = b_.CreateAdd(b_.CreateSExt(load(ir::kI32, locals_[counted.counter]), i64),
                               llvm::ConstantInt::getSigned(i64, distance));
    Value* to = b_.CreateSExt(bound, i64);
    if (counted.comparison == Op::ILe) return b_.CreateICmpSLE(last, to);
    if (counted.comparison == Op::ILt) return b_.CreateICmpSLT(last, to);
    return counted.comparison == Op::IGe ? b_.CreateICmpSGE(last, to) : b_.CreateICmpSGT(last, to);
}

void RoutineEmitter::joinedRounds(const JoinedRounds& joined) {
    BasicBlock *head = newBlock("rounds"), *body = newBlock("rounds.body"), *back = newBlock("rounds.back");
    BasicBlock* rest = blockOf(joined.header());
    b_.CreateBr(head);
    b_.SetInsertPoint(head);
    b_.CreateCondBr(hasRounds(joined.counted(), JoinedRounds::kRounds), body, rest);
    b_.SetInsertPoint(body);
    std::vector<std::pair<uint32_t, Value*>> before;
    for (const uint32_t local : joined.written())
        before.emplace_back(local, load(routine_.locals[local].type, locals_[local]));
    Value* sums[2] = {nullptr, nullptr};
    for (unsigned round = 1; round <= JoinedRounds::kRounds; ++round)
        oneOfRounds(joined, round == JoinedRounds::kRounds, back, sums);
    Value* fine = nullptr;
    for (Value* sum : sums)
        if (sum) fine = fine ? b_.CreateAnd(fine, isFinite(sum)) : isFinite(sum);
    b_.CreateCondBr(fine, head, back, m_.unlikely());
    b_.SetInsertPoint(back);
    for (const auto& [local, content] : before)
        store(routine_.locals[local].type, content, locals_[local]);
    b_.CreateBr(rest);
    storedStmt_.reset();
}

/// Checks of other things that fail end it as well: the loop itself will report them.
void RoutineEmitter::oneOfRounds(const JoinedRounds& joined, bool isLast, BasicBlock* back,
                                 Value* (&sums)[2]) {
    for (const ValueId id : joined.insts()) {
        const Inst& inst = routine_.insts[id];
        if (inst.op == Op::CheckFinite) {
            if (!isLast && joined.isKept(inst.operands[0])) continue;
            Value* content = operand(inst, 0);
            Value*& sum = sums[content->getType()->isDoubleTy()];
            sum = sum ? b_.CreateFAdd(sum, content) : content;
        } else if (inst.op == Op::Check) {
            BasicBlock* next = newBlock("ok");
            b_.CreateCondBr(operand(inst, 0), next, back, m_.unlikely());
            b_.SetInsertPoint(next);
        } else {
            instruction(id);
        }
    }
}

} // namespace codegen

// The cost of execution (decision 7). A routine is charged at its entry for its statements outside loops, a handler
// when it begins, a loop in each round, a jump back for what it repeats. A FOR loop that counts and calls nothing is
// charged ahead for all its rounds, so that its body stays free of control flow and can be vectorised. All of this
// follows from the source text alone: a program takes the same virtual time in every profile.

#include "ir/lower/routine_lowering.h"

#include "ir/core/op_info.h"

#include <algorithm>

namespace rapid::lower {

using ir::Op;

void RoutineLowering::openCosts(CostScope& scope) {
    scope.id = ++costScopes_;
    scope.outer = costs_;
    costs_ = &scope;
}

void RoutineLowering::closeCosts() {
    costs_ = costs_->outer;
}

/// The statement that a block begins with, or the blocks it always leads to: a trap routine that runs in between was called
/// when that statement is entered, and so an error of it is raised there.
ir::StmtId RoutineLowering::firstStatement(ir::BlockId block) const {
    for (size_t hops = 0; hops < routine_.blocks.size(); ++hops) {
        for (const ValueId id : routine_.blocks[block].insts) {
            const ir::Inst& inst = routine_.insts[id];
            if (inst.op == Op::Stmt) return inst.index;
            if (inst.stmt != ir::kNone) return inst.stmt;
            if (ir::familyOf(inst.op) != ir::Family::End) continue;
            // the choice between the BACKWARD part and the body, whose statements are charged
            if (inst.op != Op::Br && inst.op != Op::CondBr) return ir::kNone;
            block = inst.target(inst.op == Op::Br ? 0 : 1);
        }
    }
    return ir::kNone;
}

void RoutineLowering::chargeAtFront(ir::BlockId block, uint32_t cost) {
    std::vector<ValueId>& insts = routine_.blocks[block].insts;
    ir::Inst charge;
    charge.op = Op::Charge;
    charge.extra = static_cast<int32_t>(cost);
    charge.stmt = firstStatement(block);
    routine_.insts.push_back(std::move(charge));
    insts.insert(insts.begin(), static_cast<ValueId>(routine_.insts.size() - 1));
}

/// A jump to a label that lies before it in the text begins a round of a loop.
void RoutineLowering::chargeJump(const syntax::Node* label) {
    const auto found = labelCosts_.find(label);
    if (found == labelCosts_.end()) return;
    uint32_t cost = 1;
    for (const CostScope* scope = costs_; scope != nullptr; scope = scope->outer)
        if (scope->id == found->second.scope)
            cost = std::max(cost, scope->statements - found->second.statements);
    b_.charge(cost);
}

/// Rounds: (distance + step) / step, and none when that is negative.
void RoutineLowering::chargeRounds(const Counting& counting, uint32_t cost) {
    const auto wide = [this](ValueId value) { return b_.convert(Op::SExt, ir::kI64, value); };
    const ValueId first = wide(counting.first), last = wide(counting.last);
    const bool up = counting.step > 0;
    ValueId distance = up ? b_.binary(Op::ISub, last, first) : b_.binary(Op::ISub, first, last);
    if (counting.upward != ir::kNone)
        distance = b_.select(counting.upward, distance, b_.binary(Op::ISub, first, last));
    const int64_t step = std::abs(static_cast<int64_t>(counting.step));
    ValueId rounds = b_.binary(Op::IAdd, distance, b_.constI64(step));
    if (step != 1) rounds = b_.binary(Op::IDiv, rounds, b_.constI64(step));
    const ValueId none = b_.constI64(0);
    ValueId charge = b_.select(b_.binary(Op::ILt, rounds, none), none, rounds);
    if (cost > 1) charge = b_.binary(Op::IMul, charge, b_.constI64(cost));
    b_.charge(0, charge);
}

/// Nothing lowered since then calls a routine, may wait, or is charged for rounds of its own.
bool RoutineLowering::isFreeOfCalls(size_t firstInst) const {
    return std::none_of(std::as_const(routine_.insts).from(firstInst), std::as_const(routine_.insts).end(),
                        [this](const ir::Inst& inst) {
                            if (inst.op == Op::CallNative)
                                return program_.module().natives[inst.index].nativeClass ==
                                       ir::NativeClass::Plain;
                            return inst.op == Op::Call || inst.op == Op::Charge;
                        });
}

} // namespace rapid::lower

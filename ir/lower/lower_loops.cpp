// FOR (manual 1.5): bounds and step are evaluated once; without STEP the step is 1, or -1 when the start is
// greater than the end. Loops whose start and step are certainly integers count in I32, so that indices need
// no conversion and the optimiser knows the trip count; the variable reads as num.

#include <cmath>

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using ir::Op;

namespace {

/// Integers are exact in num up to here; larger bounds are cut off so that the counter cannot overflow.
constexpr int32_t kMaxBound = 1 << 30;
constexpr int64_t kExact = 1 << 23;

/// True when the list is small and holds no loop, label or jump: cheap enough to be compiled twice.
bool isSmallBody(StmtList list, int& budget) {
    for (const Stmt* stmt : list) {
        if (--budget < 0) return false;
        switch (stmt->kind) {
        case NodeKind::Assign:
        case NodeKind::CallStmt:
        case NodeKind::Empty: break;
        case NodeKind::CompactIf: {
            Stmt* inner = as<CompactIfStmt>(*stmt).body;
            if (!isSmallBody({&inner, 1}, budget)) return false;
            break;
        }
        case NodeKind::If: {
            const auto& node = as<IfStmt>(*stmt);
            for (const IfBranch* branch : node.branches)
                if (!isSmallBody(branch->body, budget)) return false;
            if (!isSmallBody(node.elseBody, budget)) return false;
            break;
        }
        default: return false;
        }
    }
    return true;
}

} // namespace

RoutineLowering::ForPlan RoutineLowering::planFor(const ForStmt& stmt,
                                                  const sema::DataSymbol& variable) const {
    ForPlan plan;
    if (variable.type.type->base()->kind != sema::TypeKind::Num) return plan;
    const auto from = valueRange(*stmt.from);
    if (!from) return plan;
    plan.from = plan.variable = *from;
    const auto to = valueRange(*stmt.to);
    const auto counts = [&](ForPlan::Kind kind, int32_t step) {
        plan.kind = kind;
        plan.step = step;
        // A loop of known direction may not run at all; then the variable has no value.
        if (step >= 0) plan.variable.hi = std::max(step != 0 ? from->lo : from->hi, to ? to->hi : kExact);
        if (step <= 0) plan.variable.lo = std::min(step != 0 ? from->hi : from->lo, to ? to->lo : -kExact);
        return plan;
    };
    if (!stmt.step) {
        if (to && from->hi <= to->lo) return counts(ForPlan::Kind::Counted, 1);
        if (to && from->lo > to->hi) return counts(ForPlan::Kind::Counted, -1);
        return counts(ForPlan::Kind::UnknownDirection, 0);
    }
    const sema::ConstValue* value = info(*stmt.step).constant;
    if (value == nullptr) {
        const auto range = valueRange(*stmt.step);
        if (!range || (range->lo <= 0 && range->hi >= 0)) return plan;
        return counts(ForPlan::Kind::StepValue, range->lo > 0 ? 1 : -1);
    }
    if (value->number == 0 || std::abs(value->number) >= 1e6 || value->number != std::trunc(value->number))
        return plan;
    return counts(ForPlan::Kind::Counted, static_cast<int32_t>(value->number));
}

void RoutineLowering::lowerFor(const ForStmt& stmt) {
    const auto& variables = facts().loopVariables;
    auto found = variables.find(&stmt);
    if (found == variables.end()) return;
    for (const Expr* bound : {stmt.from, stmt.to, stmt.step})
        if (bound && lowerOpenHead(*bound)) return;
    sema::DataSymbol& variable = *found->second;
    // The row is for the head only: the place of an error in a bound.
    startStatement(*stmt.from, ir::StmtKind::Control);
    checkData(stmt);
    const ForPlan plan = planFor(stmt, variable);
    if (plan.kind != ForPlan::Kind::Float) loopRanges_[&variable] = plan.variable;
    // The debugger may change the variable: no conclusion from its bounds holds then.
    if (plan.kind == ForPlan::Kind::Float || program_.stepping()) return lowerFloatLoop(stmt, variable, plan);
    if (plan.kind == ForPlan::Kind::UnknownDirection) return lowerUnknownDirection(stmt, variable, plan);
    const ValueId step = plan.kind == ForPlan::Kind::StepValue ? lowerInt(*stmt.step) : ir::kNone;
    lowerIntLoop(stmt, variable, plan, step);
}

void RoutineLowering::lowerRounds(const ForStmt& stmt, const std::optional<Counting>& counting,
                                  const std::function<ValueId()>& continues,
                                  const std::function<void()>& increment) {
    const ir::BlockId before = b_.addBlock("beforefor");
    const ir::BlockId head = b_.addBlock("for");
    const ir::BlockId body = b_.addBlock("do");
    const ir::BlockId latch = b_.addBlock("step");
    const ir::BlockId end = b_.addBlock("endfor");
    b_.br(before);
    b_.setBlock(head);
    b_.condBr(continues(), body, end);
    b_.setBlock(body);
    loops_.push_back({end, latch});
    CostScope costs;
    openCosts(costs);
    const size_t firstInst = routine_.insts.size();
    lowerList(stmt.body);
    const bool ahead = counting && isFreeOfCalls(firstInst);
    closeCosts();
    loops_.pop_back();
    branchIfOpen(latch);
    b_.setBlock(latch);
    increment();
    if (!ahead) b_.charge(costs.cost());
    b_.br(head);
    b_.setBlock(before);
    if (ahead) chargeRounds(*counting, costs.cost());
    b_.br(head);
    b_.setBlock(end);
}

ir::ValueId RoutineLowering::boundAsInt(ValueId value, bool roundDown) {
    const ValueId whole = b_.unary(Op::FTrunc, value);
    const ValueId number = b_.convert(Op::FloatToSInt, ir::kI32, whole);
    // Toward minus or plus infinity: one further where truncation went the other way.
    const ValueId wrong = b_.binary(roundDown ? Op::FGt : Op::FLt, whole, value);
    const ValueId fixed = b_.binary(roundDown ? Op::ISub : Op::IAdd, number, b_.constI32(1));
    const ValueId rounded = b_.select(wrong, fixed, number);
    const ValueId limit = b_.constI32(roundDown ? kMaxBound : -kMaxBound);
    return b_.select(b_.binary(roundDown ? Op::IGt : Op::ILt, rounded, limit), limit, rounded);
}

void RoutineLowering::lowerIntLoop(const ForStmt& stmt, sema::DataSymbol& variable, const ForPlan& plan,
                                   ValueId stepValue) {
    const ValueId first = lowerInt(*stmt.from);
    const ValueId last = intRange(*stmt.to)
                             ? lowerInt(*stmt.to)
                             : boundAsInt(lowerValueAs(*stmt.to, program_.program().num), plan.step > 0);
    lowerCountedBody(stmt, variable, first, last, plan.step, plan.variable, stepValue);
}

void RoutineLowering::lowerCountedBody(const ForStmt& stmt, sema::DataSymbol& variable, ValueId first,
                                       ValueId last, int32_t step, IntRange range, ValueId stepValue) {
    Slot slot;
    slot.kind = Slot::Kind::IntLoop;
    slot.local = b_.addLocal(variable.name, ir::kI32);
    slot.lo = range.lo;
    slot.hi = range.hi;
    const uint32_t bound = b_.addLocal("", ir::kI32);
    b_.store(ir::kI32, first, b_.localAddr(slot.local));
    b_.store(ir::kI32, last, b_.localAddr(bound));
    slots_[&variable] = slot;
    const uint32_t stepLocal = stepValue == ir::kNone ? ir::kNone : b_.addLocal("", ir::kI32);
    if (stepLocal != ir::kNone) b_.store(ir::kI32, stepValue, b_.localAddr(stepLocal));
    std::optional<Counting> counting;
    if (stepValue == ir::kNone) counting = Counting{first, last, step, ir::kNone};
    lowerRounds(
        stmt, counting,
        [&] {
            const ValueId now = b_.load(ir::kI32, b_.localAddr(slot.local));
            return b_.binary(step > 0 ? Op::ILe : Op::IGe, now, b_.load(ir::kI32, b_.localAddr(bound)));
        },
        [&] {
            const ValueId now = b_.load(ir::kI32, b_.localAddr(slot.local));
            const ValueId increment =
                stepLocal == ir::kNone ? b_.constI32(step) : b_.load(ir::kI32, b_.localAddr(stepLocal));
            b_.store(ir::kI32, b_.binary(Op::IAdd, now, increment), b_.localAddr(slot.local));
        });
}

void RoutineLowering::lowerUnknownDirection(const ForStmt& stmt, sema::DataSymbol& variable,
                                            const ForPlan& plan) {
    const IntRange from = plan.from;
    const ValueId first = lowerInt(*stmt.from);
    const auto to = intRange(*stmt.to);
    const ValueId exact = to ? lowerInt(*stmt.to) : ir::kNone;
    const ValueId to32 =
        to ? b_.convert(Op::SIntToFloat, ir::kF32, exact) : lowerValueAs(*stmt.to, program_.program().num);
    const ValueId up = to ? exact : boundAsInt(to32, true);
    const ValueId down = to ? exact : boundAsInt(to32, false);
    const ValueId forward = b_.binary(Op::FLe, b_.convert(Op::SIntToFloat, ir::kF32, first), to32);
    int budget = 12;
    if (isSmallBody(stmt.body, budget)) {
        const ir::BlockId upward = b_.addBlock("upward");
        const ir::BlockId downward = b_.addBlock("downward");
        const ir::BlockId join = b_.addBlock("join");
        b_.condBr(forward, upward, downward);
        b_.setBlock(upward);
        lowerCountedBody(stmt, variable, first, up, 1, {from.lo, to ? std::max(from.lo, to->hi) : kExact});
        b_.br(join);
        b_.setBlock(downward);
        lowerCountedBody(stmt, variable, first, down, -1,
                         {to ? std::min(from.hi, to->lo) : -kExact, from.hi});
        b_.br(join);
        b_.setBlock(join);
        return;
    }
    // One body: counts the rounds, the variable is start + round * direction.
    const ValueId direction = b_.select(forward, b_.constI32(1), b_.constI32(-1));
    const ValueId span = b_.select(forward, b_.binary(Op::ISub, up, first), b_.binary(Op::ISub, first, down));
    Slot slot;
    slot.kind = Slot::Kind::IntLoop;
    slot.local = b_.addLocal(variable.name, ir::kI32);
    slot.lo = plan.variable.lo;
    slot.hi = plan.variable.hi;
    slots_[&variable] = slot;
    const uint32_t round = b_.addLocal("", ir::kI32);
    const uint32_t rounds = b_.addLocal("", ir::kI32);
    const uint32_t start = b_.addLocal("", ir::kI32);
    const uint32_t stepLocal = b_.addLocal("", ir::kI32);
    b_.store(ir::kI32, b_.constI32(0), b_.localAddr(round));
    b_.store(ir::kI32, span, b_.localAddr(rounds));
    b_.store(ir::kI32, first, b_.localAddr(start));
    b_.store(ir::kI32, direction, b_.localAddr(stepLocal));
    lowerRounds(
        stmt, Counting{b_.constI32(0), span, 1, ir::kNone},
        [&] {
            const ValueId now = b_.load(ir::kI32, b_.localAddr(round));
            const ValueId offset = b_.binary(Op::IMul, now, b_.load(ir::kI32, b_.localAddr(stepLocal)));
            b_.store(ir::kI32, b_.binary(Op::IAdd, b_.load(ir::kI32, b_.localAddr(start)), offset),
                     b_.localAddr(slot.local));
            return b_.binary(Op::ILe, now, b_.load(ir::kI32, b_.localAddr(rounds)));
        },
        [&] {
            const ValueId now = b_.load(ir::kI32, b_.localAddr(round));
            b_.store(ir::kI32, b_.binary(Op::IAdd, now, b_.constI32(1)), b_.localAddr(round));
        });
}

/// The bounds of a loop that counts, of which the variable is kept as num.
std::optional<RoutineLowering::Counting> RoutineLowering::countingOf(const ForPlan& plan, ValueId from,
                                                                     ValueId to) {
    if (plan.kind != ForPlan::Kind::Counted && plan.kind != ForPlan::Kind::UnknownDirection)
        return std::nullopt;
    Counting counting;
    counting.first = b_.convert(Op::FloatToSInt, ir::kI32, from);
    if (plan.kind == ForPlan::Kind::Counted) {
        counting.step = plan.step;
        counting.last = boundAsInt(to, plan.step > 0);
    } else {
        counting.upward = b_.binary(Op::FLe, from, to);
        counting.last = b_.select(counting.upward, boundAsInt(to, true), boundAsInt(to, false));
    }
    return counting;
}

void RoutineLowering::lowerFloatLoop(const ForStmt& stmt, sema::DataSymbol& variable, const ForPlan& plan) {
    const sema::Type* type = variable.type.type;
    const bool isDnum = type->base()->kind == sema::TypeKind::Dnum;
    const ir::TypeId t = program_.irType(type);
    auto constant = [&](double v) { return isDnum ? b_.constF64(v) : b_.constF32(v); };
    Slot slot;
    slot.local = b_.addLocal(variable.name, t);
    describeLocal(slot.local, variable.type);
    const uint32_t to = b_.addLocal("", t);
    const uint32_t step = b_.addLocal("", t);
    if (program_
            .stepping()) { // without a name: they are not visible, but they are part of what the routine is at
        describeLocal(to, variable.type);
        describeLocal(step, variable.type);
    }
    const ValueId fromValue = lowerValueAs(*stmt.from, type);
    b_.store(t, fromValue, b_.localAddr(slot.local));
    const ValueId toValue = lowerValueAs(*stmt.to, type);
    b_.store(t, toValue, b_.localAddr(to));
    if (stmt.step) {
        b_.store(t, lowerValueAs(*stmt.step, type), b_.localAddr(step));
    } else {
        const ValueId down =
            b_.binary(Op::FGt, b_.load(t, b_.localAddr(slot.local)), b_.load(t, b_.localAddr(to)));
        b_.store(t, b_.select(down, constant(-1), constant(1)), b_.localAddr(step));
    }
    slots_[&variable] = slot;
    lowerRounds(
        stmt, countingOf(plan, fromValue, toValue),
        [&] {
            const ValueId now = b_.load(t, b_.localAddr(slot.local));
            const ValueId bound = b_.load(t, b_.localAddr(to));
            const ValueId upward = b_.binary(Op::FGe, b_.load(t, b_.localAddr(step)), constant(0));
            return b_.select(upward, b_.binary(Op::FLe, now, bound), b_.binary(Op::FGe, now, bound));
        },
        [&] {
            const ValueId now = b_.load(t, b_.localAddr(slot.local));
            b_.store(t, b_.binary(Op::FAdd, now, b_.load(t, b_.localAddr(step))), b_.localAddr(slot.local));
        });
}

} // namespace rapid::lower

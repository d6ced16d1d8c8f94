#include "ir/passes/value_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ir/core/cfg.h"
#include "ir/core/op_info.h"

namespace ir {
namespace {

/// Rounds through the routine after which what still grows counts as unlimited; beyond this size locals are not followed.
constexpr unsigned kExactRounds = 5;
constexpr size_t kLongRoutine = 50'000;
constexpr int kWholeBits = 52; ///< of what a native marked `whole` returns

/// Rounded to the type, as the instruction does: rounding is monotone, so a bound stays one.
double rounded(TypeId type, double value) {
    if (std::isnan(value)) return std::numeric_limits<double>::infinity();
    return type == kF32 ? static_cast<double>(static_cast<float>(value)) : value;
}

/// The next power of two, so that few rounds through a loop find what does not grow any more.
double roundedUp(TypeId type, double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return mantissa == 0.5 ? value : std::min(largest(type), std::ldexp(1.0, exponent));
}

/// An infinite operand makes the result infinite or NaN.
bool keepsInfinity(Op op) {
    switch (familyOf(op)) {
    case Family::Float: return !dropsDecimals(op);
    case Family::Convert:
        return conversionOf(op).from == NumberClass::Float && conversionOf(op).to == NumberClass::Float;
    case Family::Logic: return op == Op::Select;
    case Family::Leaf:
    case Family::Memory:
    case Family::Int:
    case Family::Compare:
    case Family::Action:
    case Family::End: return false;
    }
    return false;
}

} // namespace

double largest(TypeId type) {
    return type == kF32 ? static_cast<double>(std::numeric_limits<float>::max())
                        : std::numeric_limits<double>::max();
}

ValueBounds::ValueBounds(const Module& module, const Routine& routine)
    : module_(module), routine_(routine), lossy_(routine.insts.size(), false), local_(routine.locals.size()) {
    for (const Block& block : routine_.blocks)
        for (const ValueId id : block.insts)
            noteUses(inst(id));
    if (routine_.insts.size() <= kLongRoutine) findPrivateLocals();
    std::vector<BlockId> order = buildCfg(module_, routine_, HandlerEdges::Yes).order;
    // After the graph, which needs as much memory, is gone.
    bound_.assign(routine_.insts.size(), {kUnbounded, false});
    known_.resize(routine_.insts.size());
    std::vector<bool> seen(routine_.blocks.size(), false);
    for (const BlockId b : order)
        seen[b] = true;
    // The checks may be what makes the others reachable, by TRYNEXT.
    for (BlockId b = 0; b < routine_.blocks.size(); ++b)
        if (!seen[b]) order.push_back(b);
    bool changed = true;
    for (unsigned round = 0; changed; ++round) {
        changed = false;
        for (const BlockId b : order)
            changed |= visit(b, round >= kExactRounds);
    }
}

/// Data that a debugger, a native that finds data by name, or the detached handler may store to are left out.
void ValueBounds::findPrivateLocals() {
    private_ = privateLocals(routine_);
    for (size_t i = 0; i < private_.size(); ++i)
        if (routine_.locals[i].typeDesc != kNone) private_[i] = false;
    for (const uint32_t local : routine_.sharedLocals)
        private_[local] = false;
}

/// Marks the operands whose infinity would not show in the result.
void ValueBounds::noteUses(const Inst& user) {
    if (user.op == Op::FDiv)
        lossy_[user.operands[1]] = true;
    else if (!keepsInfinity(user.op))
        for (const ValueId operand : user.operands)
            lossy_[operand] = true;
}

/// Bounds that users can rely on: the check comes first.
ValueBounds::Bound ValueBounds::taken(ValueId id) const {
    Bound bound = bound_[id];
    if (needsCheck(id)) bound.magnitude = largest(valueType(inst(id)));
    bound.whole = bound.whole || known_[id].whole == block_;
    return bound;
}

/// True when a local has got another bound.
bool ValueBounds::visit(BlockId block, bool widen) {
    block_ = block;
    bool changed = false;
    for (const ValueId id : routine_.blocks[block].insts) {
        const Inst& at = inst(id);
        if (at.op == Op::Check) noteCheck(at);
        if (at.op == Op::Store) changed |= noteStore(at, widen);
        if (!isFloat(valueType(at))) continue;
        Bound bound = boundOf(at);
        if (!(bound.magnitude <= largest(valueType(at)))) bound.magnitude = kUnbounded;
        bound_[id] = bound;
    }
    return changed;
}

/// A value that is not 0, or has no fraction, from here to the end of the block.
void ValueBounds::noteCheck(const Inst& check) {
    const Inst& condition = inst(check.operands[0]);
    if (condition.op != Op::FNe && condition.op != Op::FEq) return;
    const ValueId a = condition.operands[0], b = condition.operands[1];
    if (condition.op == Op::FNe) {
        if (isZero(a)) known_[b].notZero = block_;
        if (isZero(b)) known_[a].notZero = block_;
    } else if (inst(a).op == Op::FTrunc && inst(a).operands[0] == b) {
        known_[b].whole = block_;
    }
}

bool ValueBounds::noteStore(const Inst& store, bool widen) {
    const uint32_t local = privateLocal(store.operands[1]);
    if (local == kNone || !isFloat(store.type)) return false;
    const Bound value = taken(store.operands[0]);
    Bound& bound = local_[local];
    const bool grows = value.magnitude > bound.magnitude;
    const bool changed = grows || (bound.whole && !value.whole);
    if (grows) bound.magnitude = widen ? largest(store.type) : roundedUp(store.type, value.magnitude);
    bound.whole = bound.whole && value.whole;
    return changed;
}

/// The local at an address, when its stores are known; else kNone.
uint32_t ValueBounds::privateLocal(ValueId address) const {
    const Inst& at = inst(address);
    return at.op == Op::LocalAddr && !private_.empty() && private_[at.index] ? at.index : kNone;
}

ValueBounds::Bound ValueBounds::boundOf(const Inst& value) const {
    const double limit = largest(valueType(value));
    switch (familyOf(value.op)) {
    case Family::Float: return boundOfFloat(value);
    case Family::Convert: return boundOfConversion(value);
    case Family::Leaf: return boundOfLeaf(value);
    case Family::Logic: { // Select: no other gives a floating-point number
        const Bound a = taken(value.operands[1]), b = taken(value.operands[2]);
        return {std::max(a.magnitude, b.magnitude), a.whole && b.whole};
    }
    case Family::Action: return boundOfCall(value);
    case Family::Memory: // memory, parameters and results of routines hold finite values
        if (const uint32_t local = privateLocal(value.operands[0]); local != kNone) return local_[local];
        return {limit, false};
    case Family::Int:
    case Family::Compare:
    case Family::End: return {limit, false};
    }
    return {kUnbounded, false};
}

ValueBounds::Bound ValueBounds::boundOfLeaf(const Inst& value) const {
    if (value.op != Op::Const) return {largest(valueType(value)), false};
    return {rounded(valueType(value), std::abs(value.number())),
            std::trunc(value.number()) == value.number()};
}

/// Sums and products of numbers without fraction have none either: from some size on no number has one.
ValueBounds::Bound ValueBounds::boundOfFloat(const Inst& value) const {
    const TypeId type = valueType(value);
    const Bound a = taken(value.operands[0]);
    const Bound b = value.operands.size() > 1 ? taken(value.operands[1]) : Bound{};
    switch (as<FloatOp>(value.op)) {
    case FloatOp::FAdd: return {rounded(type, a.magnitude + b.magnitude), a.whole && b.whole};
    case FloatOp::FSub: return {rounded(type, a.magnitude + b.magnitude), a.whole && b.whole};
    case FloatOp::FMul: return {rounded(type, a.magnitude * b.magnitude), a.whole && b.whole};
    case FloatOp::FDiv: return {quotient(value), false};
    case FloatOp::FNeg: return a;
    case FloatOp::FTrunc: return {a.magnitude, true};
    case FloatOp::FQuot: return {quotient(value), true};
    case FloatOp::FRem: return {std::min(a.magnitude, b.magnitude), true};
    }
    return {kUnbounded, false};
}

double ValueBounds::quotient(const Inst& division) const {
    const TypeId type = valueType(division);
    const ValueId divisor = division.operands[1];
    const double dividend = taken(division.operands[0]).magnitude;
    if (inst(divisor).op == Op::Const && inst(divisor).number() != 0)
        return rounded(type, dividend / rounded(type, std::abs(inst(divisor).number())));
    return isAtLeastOne(divisor) ? dividend : kUnbounded;
}

bool ValueBounds::isZero(ValueId id) const {
    return inst(id).op == Op::Const && inst(id).number() == 0;
}

bool ValueBounds::isAtLeastOne(ValueId id) const {
    if (inst(id).op == Op::Const) return std::abs(inst(id).number()) >= 1;
    return known_[id].notZero == block_ && taken(id).whole;
}

ValueBounds::Bound ValueBounds::boundOfConversion(const Inst& value) const {
    const TypeId type = valueType(value), from = valueType(inst(value.operands[0]));
    if (isInteger(from)) {
        const int bits = static_cast<int>(bitsOf(from)) - (value.op == Op::SIntToFloat);
        return {rounded(type, std::ldexp(1.0, bits)), true};
    }
    const Bound operand = taken(value.operands[0]);
    return {rounded(type, operand.magnitude), operand.whole}; // exact where it widens
}

ValueBounds::Bound ValueBounds::boundOfCall(const Inst& call) const {
    const double limit = largest(valueType(call));
    if (call.op != Op::CallNative) return {limit, false};
    const Native& native = module_.natives[call.index];
    if (native.whole) return {std::ldexp(1.0, kWholeBits), true};
    const double most = native.finite || native.nativeClass == NativeClass::Const ? limit : kUnbounded;
    if (!native.bounded) return {most, false};
    double given = 0;
    for (const ValueId operand : call.operands)
        if (isFloat(valueType(inst(operand)))) given = std::max(given, taken(operand).magnitude);
    return {std::min(most, rounded(valueType(call), given + 1)), false};
}

} // namespace ir

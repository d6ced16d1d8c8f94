// num expressions that are certainly integers in the exact subdomain: computed in I32, they give the same
// values.

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using ir::Op;

namespace {
constexpr int64_t kExactLimit = 1 << 24;   ///< every integer up to here has an exact binary32
constexpr double kConstantLimit = 1 << 23; ///< a constant leaves room for a sum
constexpr int64_t kMostWhole = 1024;       ///< natives with the trait "whole" and a num give at most this
} // namespace

std::optional<RoutineLowering::IntRange> RoutineLowering::intRange(const Expr& expr) const {
    return rangeOf(expr, false);
}

std::optional<RoutineLowering::IntRange> RoutineLowering::valueRange(const Expr& expr) const {
    return rangeOf(expr, true);
}

std::optional<RoutineLowering::IntRange> RoutineLowering::rangeOf(const Expr& outer, bool ofValue) const {
    const Expr& expr = unparen(outer);
    const sema::ExprInfo& facts = info(expr);
    if (facts.type().isArray() || facts.type().type->base()->kind != sema::TypeKind::Num) return std::nullopt;
    if (facts.constant && facts.constant->kind == sema::ConstValue::Kind::Number) {
        const double v = facts.constant->number;
        if (std::abs(v) > kConstantLimit || v != static_cast<double>(static_cast<int64_t>(v)))
            return std::nullopt;
        return IntRange{static_cast<int64_t>(v), static_cast<int64_t>(v)};
    }
    if (expr.kind == NodeKind::Name) {
        if (!facts.symbol || facts.symbol->kind != sema::SymbolKind::Data) return std::nullopt;
        const auto& symbol = *static_cast<const sema::DataSymbol*>(facts.symbol);
        if (ofValue) {
            const auto found = loopRanges_.find(&symbol);
            return found == loopRanges_.end() ? std::nullopt : std::optional(found->second);
        }
        const Slot* slot = findSlot(symbol);
        if (!slot || slot->kind != Slot::Kind::IntLoop) return std::nullopt;
        return IntRange{slot->lo, slot->hi};
    }
    if (expr.kind == NodeKind::Call) return rangeOfCall(expr);
    if (expr.kind == NodeKind::Unary) {
        const auto& unary = as<UnaryExpr>(expr);
        if (unary.op == UnaryOp::Not) return std::nullopt;
        const auto inner = rangeOf(*unary.operand, ofValue);
        if (!inner || unary.op == UnaryOp::Plus) return inner;
        return IntRange{-inner->hi, -inner->lo};
    }
    if (expr.kind != NodeKind::Binary) return std::nullopt;
    const auto& binary = as<BinaryExpr>(expr);
    const auto a = rangeOf(*binary.left, ofValue);
    const auto b = a ? rangeOf(*binary.right, ofValue) : std::nullopt;
    if (!b) return std::nullopt;
    IntRange r;
    switch (binary.op) {
    case BinaryOp::Add: r = {a->lo + b->lo, a->hi + b->hi}; break;
    case BinaryOp::Sub: r = {a->lo - b->hi, a->hi - b->lo}; break;
    case BinaryOp::Mul: {
        const auto [lo, hi] = std::minmax({a->lo * b->lo, a->lo * b->hi, a->hi * b->lo, a->hi * b->hi});
        r = {lo, hi};
        break;
    }
    case BinaryOp::IntDiv:
        if (b->lo != b->hi || b->lo == 0) return std::nullopt;
        r = {std::min(a->lo / b->lo, a->hi / b->lo), std::max(a->lo / b->lo, a->hi / b->lo)};
        break;
    case BinaryOp::Mod: {
        if (b->lo != b->hi || b->lo == 0) return std::nullopt;
        const int64_t m = std::abs(b->lo) - 1;
        r = {a->lo < 0 ? -m : 0, a->hi > 0 ? m : 0};
        break;
    }
    default: return std::nullopt;
    }
    if (r.lo < -kExactLimit || r.hi > kExactLimit) return std::nullopt;
    return r;
}

/// Lengths, positions and bytes.
std::optional<RoutineLowering::IntRange> RoutineLowering::rangeOfCall(const Expr& call) const {
    const auto found = facts().calls.find(&call);
    const sema::RoutineSymbol* callee = found == facts().calls.end() ? nullptr : found->second.routine;
    if (!callee || !callee->native) return std::nullopt;
    return callee->traits.has(sema::Trait::Whole) ? std::optional(IntRange{0, kMostWhole}) : std::nullopt;
}

ir::ValueId RoutineLowering::lowerInt(const Expr& outer) {
    const Expr& expr = unparen(outer);
    const sema::ExprInfo& facts = info(expr);
    if (facts.constant) return b_.constI32(static_cast<int32_t>(facts.constant->number));
    if (expr.kind == NodeKind::Name) {
        const Slot* slot = findSlot(*static_cast<const sema::DataSymbol*>(facts.symbol));
        return b_.load(ir::kI32, b_.localAddr(slot->local));
    }
    if (expr.kind == NodeKind::Call) return b_.convert(Op::FloatToSInt, ir::kI32, lowerCall(expr, ir::kNone));
    if (expr.kind == NodeKind::Unary) {
        const auto& unary = as<UnaryExpr>(expr);
        const ValueId inner = lowerInt(*unary.operand);
        return unary.op == UnaryOp::Minus ? b_.unary(Op::INeg, inner) : inner;
    }
    const auto& binary = as<BinaryExpr>(expr);
    const ValueId a = lowerInt(*binary.left);
    const ValueId b = lowerInt(*binary.right);
    switch (binary.op) {
    case BinaryOp::Add: return b_.binary(Op::IAdd, a, b);
    case BinaryOp::Sub: return b_.binary(Op::ISub, a, b);
    case BinaryOp::Mul: return b_.binary(Op::IMul, a, b);
    case BinaryOp::IntDiv: return b_.binary(Op::IDiv, a, b);
    default: return b_.binary(Op::IRem, a, b);
    }
}

} // namespace rapid::lower

// Placeholders (manual 1.1.1): an instruction that is not complete raises ERR_EXECPHR when its placeholder is reached.
// Expressions around one have no type, so what would be evaluated before it is evaluated for its effects alone.

#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"
#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using sema::LanguageError;

bool RoutineLowering::containsPlaceholder(const Node& node) const {
    if (!routineHasPlaceholders_) return false;
    for (TokenIndex t = node.first; t <= node.last; ++t)
        if (isPlaceholder(module_->tree->tokens[t].kind)) return true;
    return false;
}

/// Evaluating it always gets to a placeholder. AND, OR and NOT see to their operands themselves.
bool RoutineLowering::isIncomplete(const Expr& outer) const {
    if (!routineHasPlaceholders_) return false;
    const Expr& expr = unparen(outer);
    if (expr.kind == NodeKind::Unary && as<UnaryExpr>(expr).op == UnaryOp::Not) return false;
    if (expr.kind == NodeKind::Binary) {
        const auto& binary = as<BinaryExpr>(expr);
        if (binary.op == BinaryOp::And || binary.op == BinaryOp::Or || binary.op == BinaryOp::Xor)
            return false;
        // A comparison is a bool whatever its operands are.
        if (isIncomplete(*binary.left) || isIncomplete(*binary.right)) return true;
    }
    return info(expr).type().type->kind == sema::TypeKind::Error && containsPlaceholder(expr);
}

/// An argument without which the call cannot be made.
bool RoutineLowering::isIncompleteCall(const Node& node) const {
    if (!containsPlaceholder(node)) return false;
    bool found = facts().calls.find(&node) == facts().calls.end();
    forEachChild(node, [&](const Node& child) {
        if (child.kind != NodeKind::Argument) return;
        const auto& arg = as<Argument>(child);
        found = found || arg.argKind == ArgKind::Placeholder || (arg.value && isIncomplete(*arg.value));
        const TokenIndex end = arg.value ? arg.value->first : arg.last + 1;
        for (TokenIndex t = arg.first; t < end; ++t) // its name
            found = found || isPlaceholder(module_->tree->tokens[t].kind);
    });
    return found;
}

/// Evaluates what comes before the placeholder within `node`, and raises the error.
void RoutineLowering::reachPlaceholder(const Node& node) {
    bool reached = false;
    forEachChild(node, [&](const Node& child) {
        if (reached || isStmt(child.kind)) return;
        if (!isExpr(child.kind)) {
            reached = containsPlaceholder(child);
            if (reached) return reachPlaceholder(child);
            return forEachChild(child, [&](const Node& inner) {
                if (isExpr(inner.kind)) evaluate(static_cast<const Expr&>(inner));
            });
        }
        const auto& expr = static_cast<const Expr&>(child);
        reached = isIncomplete(expr);
        if (reached)
            reachPlaceholder(unparen(expr));
        else
            evaluate(expr);
    });
    if (!reached) b_.raise(b_.constI32(program_.errorNumber(LanguageError::Placeholder)));
}

/// For its effects.
void RoutineLowering::evaluate(const Expr& outer) {
    const Expr& expr = unparen(outer);
    const sema::DataType& type = info(expr).type();
    if (info(expr).constant || (!callsAnything(expr) && !containsPlaceholder(expr))) return;
    const bool logical = expr.kind == NodeKind::Unary || expr.kind == NodeKind::Binary;
    if (type.type->kind == sema::TypeKind::Error) {
        if (logical) lowerValueAs(expr, program_.program().boolean);
        return;
    }
    const ir::TypeId irType = program_.irType(type);
    if (!type.isArray() && program_.module().isScalar(irType) && irType != ir::kI64)
        lowerValue(expr);
    else
        lowerAddr(expr);
}

bool RoutineLowering::callsAnything(const Node& node) const {
    bool calls = node.kind == NodeKind::Call;
    forEachChild(node, [&](const Node& child) { calls = calls || callsAnything(child); });
    return calls;
}

ir::ValueId RoutineLowering::zeroOf(ir::TypeId type) {
    switch (type) {
    case ir::kBool: return b_.constBool(false);
    case ir::kF64: return b_.constF64(0);
    case ir::kF32: return b_.constF32(0);
    default: return b_.nullPtr();
    }
}

} // namespace rapid::lower

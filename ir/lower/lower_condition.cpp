// The condition of SetupCyclicBool: the runtime gets it in postfix notation and evaluates it cyclically. The addresses of data
// are found once, when the instruction is executed.

#include "ir/lower/routine_lowering.h"
#include "runtime/abi/condition_operators.h"

namespace rapid::lower {

using namespace syntax;
using rt::ConditionOperator;
using sema::TypeKind;

namespace {

ConditionOperator operatorOf(BinaryOp op) {
    switch (op) {
    case BinaryOp::Add: return ConditionOperator::Add;
    case BinaryOp::Sub: return ConditionOperator::Subtract;
    case BinaryOp::Mul: return ConditionOperator::Multiply;
    case BinaryOp::Div: return ConditionOperator::Divide;
    case BinaryOp::IntDiv: return ConditionOperator::IntegerDivide;
    case BinaryOp::Mod: return ConditionOperator::Modulo;
    case BinaryOp::Lt: return ConditionOperator::Less;
    case BinaryOp::Le: return ConditionOperator::LessOrEqual;
    case BinaryOp::Eq: return ConditionOperator::Equal;
    case BinaryOp::Ne: return ConditionOperator::NotEqual;
    case BinaryOp::Gt: return ConditionOperator::Greater;
    case BinaryOp::Ge: return ConditionOperator::GreaterOrEqual;
    case BinaryOp::And: return ConditionOperator::And;
    case BinaryOp::Or: return ConditionOperator::Or;
    case BinaryOp::Xor: return ConditionOperator::Xor;
    }
    return ConditionOperator::And;
}

bool isArithmetic(BinaryOp op) {
    return op <= BinaryOp::Mod;
}

} // namespace

void RoutineLowering::lowerCyclicCondition(const sema::BoundCall& call) {
    b_.callNative(program_.support(Support::rt_beginCondition), {});
    lowerOperand(*findArg(call, "Cond")->value, false);
}

/// `asDnum`: a number is wanted as dnum.
void RoutineLowering::lowerOperand(const Expr& outer, bool asDnum) {
    const Expr& expr = unparen(outer);
    const sema::ExprInfo& facts = info(expr);
    if (facts.constant && facts.constant->kind != sema::ConstValue::Kind::Aggregate) {
        const bool isBool = facts.type().type->base()->kind == TypeKind::Bool;
        const double number = isBool ? facts.constant->boolean : facts.constant->number;
        b_.callNative(program_.support(Support::rt_conditionValue),
                      {b_.constF64(asDnum ? number : static_cast<float>(number))});
        return;
    }
    if (namesSignal(expr)) {
        b_.callNative(program_.support(Support::rt_conditionSignal),
                      {reference(expr).addr, b_.constBool(asDnum)});
        return;
    }
    if (expr.kind == NodeKind::Unary) {
        const auto& unary = as<UnaryExpr>(expr);
        lowerOperand(*unary.operand, asDnum);
        if (unary.op == UnaryOp::Plus) return;
        const auto operation = unary.op == UnaryOp::Not ? ConditionOperator::Not : ConditionOperator::Negate;
        b_.callNative(program_.support(Support::rt_conditionOperator),
                      {b_.constI32(static_cast<int32_t>(operation)), b_.constBool(asDnum)});
        return;
    }
    if (expr.kind == NodeKind::Binary) return lowerCondition(as<BinaryExpr>(expr));
    const TypeKind kind = facts.type().type->base()->kind;
    const int32_t form = kind == TypeKind::Bool ? 0 : kind == TypeKind::Dnum ? 2 : 1;
    b_.callNative(program_.support(Support::rt_conditionData), {place(expr).addr, b_.constI32(form)});
}

void RoutineLowering::lowerCondition(const BinaryExpr& expr) {
    const auto isDnum = [&](const Expr& e) { return info(e).type().type->base()->kind == TypeKind::Dnum; };
    const bool asDnum = isArithmetic(expr.op) ? isDnum(expr) : isDnum(*expr.left) || isDnum(*expr.right);
    lowerOperand(*expr.left, asDnum);
    lowerOperand(*expr.right, asDnum);
    b_.callNative(program_.support(Support::rt_conditionOperator),
                  {b_.constI32(static_cast<int32_t>(operatorOf(expr.op))), b_.constBool(asDnum)});
}

} // namespace rapid::lower

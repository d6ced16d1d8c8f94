// Calls that are evaluated instead of compiled: of functions whose result depends on their arguments alone, with constants as
// arguments.

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

bool EvaluatedCalls::covers(const sema::RoutineSymbol& callee) const {
    return evaluate_ && callee.native && callee.routineKind == syntax::RoutineKind::Func &&
           (callee.effects == sema::Effects::Const || callee.effects == sema::Effects::Pure);
}

const sema::ConstValue* EvaluatedCalls::evaluate(const sema::RoutineSymbol& callee,
                                                 std::span<const sema::ConstValue* const> arguments) {
    const auto value = evaluate_(callee, arguments, texts_);
    return value ? &results_.emplace_back(*value) : nullptr;
}

const sema::ConstValue* RoutineLowering::evaluatedCall(const BoundCall& call) {
    static constexpr sema::ConstValue kGiven{};
    std::vector<const sema::ConstValue*> arguments;
    for (const BoundArg& arg : call.args) {
        if (arg.kind == BoundArg::Kind::Conditional) return nullptr;
        const bool isGiven = arg.kind == BoundArg::Kind::Present;
        arguments.push_back(!isGiven ? nullptr : arg.param->isSwitch ? &kGiven : constantOf(*arg.value));
        if (isGiven && !arguments.back()) return nullptr;
    }
    return program_.evaluatedCalls().evaluate(*call.routine, arguments);
}

const sema::ConstValue* RoutineLowering::constantOf(const Expr& outer) {
    const Expr& expr = unparen(outer);
    if (const sema::ConstValue* value = info(expr).constant) return value;
    if (expr.kind != NodeKind::Call) return nullptr;
    const auto call = facts().calls.find(&expr);
    EvaluatedCalls& evaluated = program_.evaluatedCalls();
    if (call == facts().calls.end() || !call->second.routine || !evaluated.covers(*call->second.routine))
        return nullptr;
    if (const auto found = evaluated.known.find(&expr); found != evaluated.known.end()) return found->second;
    const sema::ConstValue* value = evaluatedCall(call->second);
    evaluated.known[&expr] = value;
    return value;
}

ir::ValueId RoutineLowering::lowerEvaluated(const sema::ConstValue& value, const sema::DataType& type,
                                            ValueId resultAddr) {
    const ir::TypeId irType = program_.irType(type);
    if (program_.module().isScalar(irType)) return constantScalar(value, irType);
    b_.copy(irType, resultAddr == ir::kNone ? tempAddr(irType) : resultAddr, constantAddress(value, type));
    return ir::kNone;
}

} // namespace rapid::lower

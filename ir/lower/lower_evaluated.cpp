// Calls that are evaluated instead of compiled: of functions whose result depends on their arguments alone, with constants as
// arguments.

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using sema::BoundArg;
using sema::BoundCall;

bool EvaluatedCalls::covers(const sema::RoutineSymbol& callee) const {
    return evaluate_ && callee.native && callee.routineKind == RoutineKind::Func &&
           (callee.effects == sema::Effects::Const || callee.effects == sema::Effects::Pure);
}

const sema::ConstValue* EvaluatedCalls::evaluate(const sema::RoutineSymbol& callee,
                                                 const ConstArguments& arguments) {
    const auto value = evaluate_(callee, arguments, texts_);
    return value ? &results_.emplace_back(*value) : nullptr;
}

std::optional<ConstArguments> RoutineLowering::constantArguments(const BoundCall& call) {
    static constexpr sema::ConstValue kGiven{};
    ConstArguments arguments;
    for (const BoundArg& arg : call.args) {
        if (arg.kind == BoundArg::Kind::Conditional) return {};
        const bool isGiven = arg.kind == BoundArg::Kind::Present;
        arguments.push_back(!isGiven ? nullptr : arg.param->isSwitch ? &kGiven : constantOf(*arg.value));
        if (isGiven && !arguments.back()) return {};
    }
    return arguments;
}

const sema::ConstValue* RoutineLowering::evaluatedCall(const Node& node, const BoundCall& call) {
    EvaluatedCalls& evaluated = program_.evaluatedCalls();
    if (!call.routine || !evaluated.covers(*call.routine)) return nullptr;
    if (const auto found = evaluated.known.find(&node); found != evaluated.known.end()) return found->second;
    const auto arguments = constantArguments(call);
    const sema::ConstValue* value = arguments ? evaluated.evaluate(*call.routine, *arguments) : nullptr;
    evaluated.known[&node] = value;
    return value;
}

const sema::ConstValue* RoutineLowering::constantOf(const Expr& outer) {
    const Expr& expr = unparen(outer);
    if (const sema::ConstValue* value = info(expr).constant) return value;
    if (expr.kind != NodeKind::Call) return nullptr;
    const auto call = facts().calls.find(&expr);
    return call == facts().calls.end() ? nullptr : evaluatedCall(expr, call->second);
}

ir::ValueId RoutineLowering::lowerEvaluated(const sema::ConstValue& value, const sema::DataType& type,
                                            ValueId resultAddr) {
    const ir::TypeId irType = program_.irType(type);
    if (program_.module().isScalar(irType)) return constantScalar(value, irType);
    b_.copy(irType, resultAddr == ir::kNone ? tempAddr(irType) : resultAddr, constantAddress(value, type));
    return ir::kNone;
}

} // namespace rapid::lower

// SetupCyclicBool: its condition is evaluated when the instruction has been left. It must not refer to what is gone then, and
// the runtime, not compiled code, evaluates it.

#include "frontend/sema/cyclic_condition.h"

#include "frontend/diag/messages/calls.h"
#include "frontend/sema/wording.h"

namespace rapid::sema {

using namespace syntax;

void CyclicCondition::check(const CallStmt& s) {
    const auto found = facts().calls.find(&s);
    if (found == facts().calls.end()) return;
    for (const BoundArg& arg : found->second.args) {
        if (!arg.param->deferred || arg.value == nullptr) continue;
        const Expr* culprit = arg.value;
        if (const std::string what = notCyclic(*arg.value, culprit); !what.empty())
            report(say::ConditionNotCyclic, range(*culprit), {text(s.name), what});
    }
}

/// The part of the expression that cannot be evaluated later, and its place; "" when all of it can.
std::string CyclicCondition::notCyclic(const Expr& e, const Expr*& culprit) {
    const ExprInfo& facts = info(e);
    if (facts.type().type != nullptr && facts.type().type->kind == TypeKind::Error) return ""; // reported
    culprit = &e;
    switch (e.kind) {
    case NodeKind::Paren: return notCyclic(*as<ParenExpr>(e).inner, culprit);
    case NodeKind::Unary: return notCyclic(*as<UnaryExpr>(e).operand, culprit);
    case NodeKind::Binary: {
        std::string what = notCyclic(*as<BinaryExpr>(e).left, culprit);
        return what.empty() ? notCyclic(*as<BinaryExpr>(e).right, culprit) : what;
    }
    case NodeKind::Call: return "the call of a function";
    case NodeKind::Name:
    case NodeKind::Index:
    case NodeKind::Component: return notCyclicData(e);
    case NodeKind::PlaceholderExpr:
    case NodeKind::ErrorExpr: return "";
    default: break;
    }
    const TypeKind kind = facts.type().type->base()->kind;
    return kind == TypeKind::Bool || facts.type().type->isNumeric()
               ? ""
               : "a value of type '" + facts.type().type->name + "'";
}

std::string CyclicCondition::notCyclicData(const Expr& e) {
    const Expr* root = &e;
    while (root->kind == NodeKind::Index || root->kind == NodeKind::Component)
        root = root->kind == NodeKind::Index ? as<IndexExpr>(*root).base : as<ComponentExpr>(*root).base;
    const DataSymbol* data = root->kind == NodeKind::Name ? asData(info(*root).symbol) : nullptr;
    if (data == nullptr || data->type.type->kind == TypeKind::Error) return "";
    if (data->type.type->base()->kind == TypeKind::SemiValue) return "";
    const DataType& type = info(e).type();
    const bool fits = type.rank == 0 && (type.type->base()->kind == TypeKind::Bool || type.type->isNumeric());
    if (!fits) return "'" + data->name + "' of type '" + type.type->name + "'";
    if (info(e).constant != nullptr) return "";
    const bool stays = data->storage == Storage::ModuleData ||
                       (data->storage == Storage::Parameter && data->mode == ParamMode::Pers);
    return stays ? "" : "'" + data->name + "', which is " + describe(*data);
}

} // namespace rapid::sema

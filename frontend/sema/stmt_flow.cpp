// Instructions of control flow that depend on the kind of routine or handler: RETURN, RAISE, CONNECT, UNDO
// (manual 1.1.5, 1.11 to 1.13).

#include "frontend/sema/stmt_flow.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/expressions.h"
#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/names.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

#include <cmath>

namespace rapid::sema {

using namespace syntax;

FlowStatements::FlowStatements(State& state, const Parts& parts)
    : CheckerPart(state), expressions_(parts.expressions), places_(parts.places), remedies_(parts.remedies),
      scopes_(parts.scopes), unknown_(parts.unknown) {}

void FlowStatements::returnStmt(const ReturnStmt& s) {
    const RoutineSymbol& routine = *context_.routine;
    if (routine_.part == Part::Undo) {
        if (s.value) expressions_.visitLoose(*s.value);
        report(say::IgnoredInUndo, range(s.first), {"RETURN"});
        return;
    }
    routine_.returnSeen = true;
    if (routine.routineKind != RoutineKind::Func) {
        if (!s.value) return;
        expressions_.visitLoose(*s.value);
        if (s.value->kind == NodeKind::ErrorExpr) return;
        report(say::ReturnValueUnexpected, range(*s.value),
               {routine.name, routine.routineKind == RoutineKind::Proc ? "procedure" : "trap routine"});
        return;
    }
    if (!s.value) {
        report(say::ReturnWithoutValue, range(s.first), {routine.name, typeName(routine.returnType)});
        return;
    }
    if (routine.returnType.type->kind == TypeKind::Error) {
        expressions_.visitLoose(*s.value);
        return;
    }
    const Typed t = expressions_.expr(*s.value, &routine.returnType);
    if (expressions_.fits(*s.value, t, routine.returnType)) return;
    const auto names = typeNames(t.info->type(), routine.returnType);
    const Remedy remedy = remedies_.remedyFor(*s.value, t.info->type(), routine.returnType);
    remedies_.offer(report(say::ReturnType, range(*s.value), {names[0], names[1], routine.name},
                           {Misfit::Type, *s.value}),
                    *s.value, remedy);
}

void FlowStatements::checkErrorNumber(const Expr& e, const char* what) {
    const Typed t = expressions_.expr(e);
    if (t.isError() || expressions_.fits(e, t, {program_.num, 0, {}})) return;
    report(say::ErrorNumberType, range(e), {what, typeName(*t.info)});
}

void FlowStatements::raiseStmt(const RaiseStmt& s) {
    if (routine_.part == Part::Undo) {
        if (s.value) expressions_.visitLoose(*s.value);
        report(say::IgnoredInUndo, range(s.first), {"RAISE"});
        return;
    }
    if (!s.value) {
        if (routine_.part != Part::Error) report(say::RaiseWithoutNumber, range(s.first));
        return;
    }
    checkErrorNumber(*s.value, "RAISE");
    if (!mayBeErrorNumber(*s.value)) report(say::RaiseRange, range(*s.value), {valueText(*s.value)});
}

// A constant is ERR_..., or a number that programs may raise; of others the value shows at run time.
bool FlowStatements::mayBeErrorNumber(const Expr& e) {
    const ExprInfo& value = info(e);
    if (!value.constant || value.constant->kind != ConstValue::Kind::Number) return true;
    if (value.symbol && value.symbol->predefined) return true;
    const double number = value.constant->number;
    return number >= 1 && number <= 90 && number == std::floor(number);
}

void FlowStatements::checkListedError(const Expr& e) {
    checkErrorNumber(e, "ERROR");
    if (!mayBeErrorNumber(e)) report(say::ListedErrorNumber, range(e), {valueText(e)});
}

// "CONNECT trap WITH interrupt;"
bool FlowStatements::reportConnectSwapped(const ConnectStmt& s) {
    if (!s.target || s.target->kind != NodeKind::Name || !isName(s.trap)) return false;
    const TokenIndex first = as<NameExpr>(*s.target).name;
    const RoutineSymbol* trap = isName(first) ? asRoutine(scopes_.lookup(idOf(first))) : nullptr;
    if (!trap || trap->routineKind != RoutineKind::Trap || !asData(scopes_.lookup(idOf(s.trap))))
        return false;
    report(say::ArgumentsSwapped, range(first), {"interrupt", "trap routine", "CONNECT"})
        .fixes.push_back({"swap them", {{range(first), text(s.trap)}, {range(s.trap), text(first)}}});
    return true;
}

void FlowStatements::connectStmt(const ConnectStmt& s) {
    if (reportConnectSwapped(s)) return;
    if (s.target) connectTarget(*s.target);
    if (!isName(s.trap)) return;
    const NameId name = idOf(s.trap);
    Symbol* symbol = scopes_.lookup(name);
    RoutineSymbol* trap = asRoutine(symbol);
    if (trap && trap->routineKind == RoutineKind::Trap) {
        scopes_.markUsed(*trap);
        facts().references[&s] = trap;
        return;
    }
    if (symbol) {
        noteDeclared(report(say::NotATrap, range(s.trap), {text(s.trap), describe(*symbol)}), *symbol);
        return;
    }
    unknown_.reportUnknown(say::UnknownTrap, s.trap, name, Wanted::Trap);
}

void FlowStatements::connectTarget(const Expr& target) {
    if (!isPlaceExpr(target)) {
        expressions_.visitLoose(target);
        if (target.kind != NodeKind::PlaceholderExpr && target.kind != NodeKind::ErrorExpr)
            report(say::ConnectNotVariable, range(target), {describeExpr(target)});
        return;
    }
    const Place found = places_.place(target);
    if (!found.root) return;
    DataSymbol& root = *found.root;
    const DataType& type = info(target).type();
    const bool isUnknown = type.type->kind == TypeKind::Error; // not declared, which is reported
    const bool declared = program_.typeOf(KnownType::Interrupt) != nullptr;
    bool isInterrupt = type.rank == 0 && (!declared || isUnknown);
    for (const Type* t = type.type; t && type.rank == 0; t = t->aliasOf)
        isInterrupt |= t->known == KnownType::Interrupt;
    if (!isInterrupt) {
        report(say::ConnectNotInterrupt, range(target), {typeName(type)});
        return;
    }
    const bool parameter = root.storage == Storage::Parameter;
    const bool variable = root.storage != Storage::SystemVariable && root.storage != Storage::LoopVariable &&
                          root.dataKind == DataKind::Var;
    if (!variable) {
        noteDeclared(report(say::ConnectNotVariable, range(target), {describe(root)}), root);
        return;
    }
    scopes_.markAssigned(root);
    if (isUnknown) return;
    if (root.storage == Storage::RoutineData || (parameter && root.mode == ParamMode::In))
        noteDeclared(report(say::ConnectRoutineData, range(target), {root.name}), root);
}

// A built-in that orders movement; stopping one is not movement.
bool FlowStatements::movesRobot(const RoutineSymbol& routine) const {
    return routine.effects == Effects::Motion && routine.native && !routine.traits.has(Trait::NoMovement);
}

// Stops, raised errors and movement are not for UNDO handlers (manual 1.13).
void FlowStatements::callInUndo(const RoutineSymbol& routine, TokenIndex name) {
    if (!routine.predefined) return;
    if (movesRobot(routine))
        report(say::MotionInUndo, range(name), {text(name)});
    else if (routine.traits.has(Trait::IgnoredInUndo))
        report(say::IgnoredInUndo, range(name), {text(name)});
}

} // namespace rapid::sema

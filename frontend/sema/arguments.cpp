// One argument against its parameter: type, access mode, optional and conditional forms (manual 1.1.5, 1.3.4).

#include "frontend/sema/arguments.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/sema/argument_order.h"
#include "frontend/sema/call.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/parameters.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

Arguments::Arguments(State& state, const Parts& parts)
    : CheckerPart(state), calls_(parts.calls), expressions_(parts.expressions), places_(parts.places),
      remedies_(parts.remedies), scopes_(parts.scopes) {}

// The type an undeclared name gets as the argument for this parameter.
const Type* Arguments::handleHint(const DataSymbol& param) const {
    const Type& type = *param.type.type;
    const KnownType known = type.base()->known;
    const bool configured = type.kind == TypeKind::SemiValue || known == KnownType::Camera ||
                            (param.predefined && known == KnownType::MechanicalUnit);
    return configured && param.type.rank == 0 ? param.type.type : nullptr;
}

void Arguments::checkArgument(const RoutineSymbol& routine, BoundArg& bound) {
    const DataSymbol& param = *bound.param;
    const Argument& arg = *bound.argument;
    if (arg.argKind == ArgKind::Conditional) {
        checkConditional(routine, bound);
        return;
    }
    if (param.isSwitch) {
        if (!bound.value) return;
        if (arg.argKind == ArgKind::Required)
            return expressions_.visitLoose(*bound.value); // reported where '\\' is missing
        diag::Diagnostic& d = report(say::SwitchWithValue, range(*bound.value), {param.name});
        const bool isTrue =
            bound.value->kind == NodeKind::BoolLiteral && as<BoolLiteralExpr>(*bound.value).value;
        d.fix({range(arg.name).end, range(arg).end}, "", isTrue);
        expressions_.visitLoose(*bound.value);
        return;
    }
    if (!bound.value) {
        report(say::OptionalWithoutValue, range(arg), {param.name, typeName(param.type)});
        return;
    }
    if (routine.role == Role::Present) {
        checkPresent(bound);
        return;
    }
    if (reportEqualAsAssign(bound)) return;
    const bool byReference = param.mode != ParamMode::In || param.type.type->kind == TypeKind::SemiValue;
    if (byReference) {
        // An argument that is absent is something ArgName may be asked about.
        const bool asked = state_.presenceOnly || routine.role == Role::ArgName;
        const bool outer = std::exchange(state_.presenceOnly, asked);
        checkReference(routine, bound);
        state_.presenceOnly = outer;
    } else {
        const bool any = param.type.type->kind == TypeKind::AnyType;
        state_.valueUnused = state_.options.onlyDiagnostics && bound.value->kind == NodeKind::Name;
        const Typed t = expressions_.expr(*bound.value, any ? nullptr : &param.type);
        state_.valueUnused = false;
        judgeValue(routine, bound, t);
    }
}

// A value whose type depends on what is expected of it.
static bool takesTypeFromContext(const Expr& value) {
    const NodeKind kind = bare(value).kind;
    return kind == NodeKind::Aggregate || kind == NodeKind::NumLiteral || kind == NodeKind::Unary;
}

void Arguments::checkSameType(const BoundCall& call, std::vector<const Argument*>& judged) {
    std::vector<const BoundArg*> alike;
    for (const BoundArg& bound : call.args)
        if (bound.param->type.type->kind == TypeKind::AnyType && bound.kind == BoundArg::Kind::Present &&
            bound.value)
            alike.push_back(&bound);
    if (alike.size() < 2) return;
    const auto leads = [](const BoundArg* bound) { return !takesTypeFromContext(*bound->value); };
    const auto lead = std::find_if(alike.begin(), alike.end(), leads);
    if (lead != alike.end()) std::rotate(alike.begin(), lead, lead + 1);
    DataType want;
    for (const BoundArg* bound : alike) {
        judged.push_back(bound->argument);
        const Typed t = expressions_.expr(*bound->value, want.type ? &want : nullptr);
        if (t.isError()) continue;
        if (!checkClass(*call.routine, *bound, t.info->type())) continue;
        if (!want.type) {
            want = t.info->type();
        } else if (!expressions_.fits(*bound->value, t, want)) {
            const auto names = typeNames(t.info->type(), want);
            report(say::ArgumentType, range(*bound->value),
                   {bound->param->name, call.routine->name, names[0], names[1]});
        }
    }
}

// `name = value` as an argument, where `name` is that of the parameter and nothing else.
bool Arguments::reportEqualAsAssign(const BoundArg& bound) {
    if (bound.value->kind != NodeKind::Binary) return false;
    const auto& equal = as<BinaryExpr>(*bound.value);
    if (equal.op != BinaryOp::Eq || equal.left->kind != NodeKind::Name) return false;
    const TokenIndex name = as<NameExpr>(*equal.left).name;
    if (!isName(name) || idOf(name) != bound.param->nameId || scopes_.lookup(idOf(name))) return false;
    report(say::EqualInAssignment, range(equal.opToken)).fix(range(equal.opToken), ":=");
    expressions_.visitLoose(*equal.right);
    return true;
}

// Whether an argument could belong to one of the parameters, which share a place.
bool Arguments::couldBelongTo(const Expr& value, std::span<const BoundArg> params) {
    const DataSymbol* entire =
        value.kind == NodeKind::Name ? asData(scopes_.lookup(idOf(as<NameExpr>(value).name))) : nullptr;
    const DataType& found = info(value).type();
    const bool unknown = !found.type || found.type->kind == TypeKind::Error;
    return std::any_of(params.begin(), params.end(), [&](const BoundArg& bound) {
        const DataSymbol& param = *bound.param;
        const auto suits = [&](const DataType& type) {
            return param.type.type->kind == TypeKind::AnyType ? !missingClass(param.accepts, type)
                                                              : equivalent(type, param.type);
        };
        if (!entire) return unknown || suits(found);
        const bool temporary = entire->storage == Storage::RoutineData ||
                               (entire->storage == Storage::ModuleData && entire->dataKind != DataKind::Pers);
        if (param.mode == ParamMode::Pers && temporary) return false;
        return suits(entire->type) || (!unknown && suits(found));
    });
}

// The place of the required parameter whose argument is missing in the middle: the arguments after it fit the
// parameters after it. `moved`: these arguments.
std::span<const BoundArg> Arguments::leftOut(const BoundCall& call, std::vector<const Expr*>& moved) {
    std::vector<std::span<const BoundArg>> places;
    std::vector<const Expr*> given;
    const RoutineSymbol& routine = *call.routine;
    for (size_t i = nextRequired(routine, 0); i < routine.params.size();) {
        const size_t end = alternativesEnd(routine, i);
        places.push_back(call.args.subspan(i, end - i));
        for (const BoundArg& bound : places.back())
            if (bound.argument && bound.value) given.push_back(bound.value);
        i = nextRequired(routine, end);
    }
    if (places.size() != given.size() + 1) return {};
    size_t out = 0;
    while (out < given.size() && couldBelongTo(*given[out], places[out]))
        ++out;
    for (size_t i = out; i < given.size(); ++i)
        if (!couldBelongTo(*given[i], places[i + 1])) return {};
    moved.assign(given.begin() + static_cast<std::ptrdiff_t>(out), given.end());
    return places[out];
}

// Reports about arguments that are only in the wrong place.
void Arguments::takeBack(const std::vector<const Expr*>& moved) {
    std::vector<diag::CauseId> causes;
    for (const ReportedMisfit& reported : reports_.misfits()) {
        const bool aboutArgument = reported.misfit == Misfit::Access || reported.misfit == Misfit::Kind;
        if (aboutArgument && std::find(moved.begin(), moved.end(), reported.node) != moved.end())
            causes.push_back(reported.cause);
    }
    reports_.collected()->retract([&](const diag::Diagnostic& d) {
        return std::find(causes.begin(), causes.end(), d.cause) != causes.end();
    });
}

// "MoveL p10.v100, fine, tool0;", "Add count.step;": no component is named so, but data is.
bool Arguments::isDotForComma(const Expr& e) {
    if (e.kind != NodeKind::Component) return false;
    const auto& part = as<ComponentExpr>(e);
    return isName(part.name) && info(e).type().type->kind == TypeKind::Error &&
           info(*part.base).type().type->kind != TypeKind::Error && asData(scopes_.lookup(idOf(part.name)));
}

// Arguments of the wrong type, and those that are missing. One that is missing in the middle is one mistake.
void Arguments::reportArguments(const BoundCall& call, TokenIndex name, size_t firstMismatch, bool missing) {
    const std::vector<Mismatch> wrong(mismatches_.begin() + static_cast<std::ptrdiff_t>(firstMismatch),
                                      mismatches_.end());
    mismatches_.resize(firstMismatch);
    const RoutineSymbol& routine = *call.routine;
    const bool dotForComma = std::any_of(call.args.begin(), call.args.end(), [&](const BoundArg& a) {
        return a.argument && a.value && isDotForComma(*a.value);
    });
    if (dotForComma) return; // the arguments after it have moved
    if (std::exchange(shapeReported_, false)) missing = false;
    const bool unknown = std::any_of(call.args.begin(), call.args.end(), [&](const BoundArg& a) {
        return a.argument && a.value && a.value->kind == NodeKind::Name && !info(*a.value).symbol;
    });
    if (unknown) missing = false; // two names that run into one may be one that is not known
    if (missing) {
        std::vector<const Expr*> moved;
        if (const auto lost = leftOut(call, moved); !lost.empty()) {
            takeBack(moved);
            noteDeclared(report(say::MissingArgument, range(name), {text(name), "argument " + namesOf(lost)}),
                         routine);
            return;
        }
    }
    if (missing) calls_.reportMissing(call, name);
    for (const Mismatch& one : wrong) {
        const auto names = typeNames(one.found, one.param->type);
        const Remedy remedy = remedies_.remedyFor(routine, *one.value, one.found, *one.param);
        remedies_.offer(report(say::ArgumentType, range(*one.value),
                               {one.param->name, routine.name, names[0], names[1]},
                               {Misfit::Type, *one.value}),
                        *one.value, remedy);
    }
}

void Arguments::judgeValue(const RoutineSymbol& routine, const BoundArg& bound, Typed t) {
    const DataSymbol& param = *bound.param;
    if (t.isError()) return;
    if (param.type.type->kind == TypeKind::AnyType) {
        checkClass(routine, bound, t.info->type());
        return;
    }
    if (expressions_.fits(*bound.value, t, param.type)) return;
    mismatches_.push_back({&param, bound.value, t.info->type()});
}

void Arguments::checkReference(const RoutineSymbol& routine, const BoundArg& bound) {
    const Expr& e = *bound.value;
    if (isPlaceExpr(e)) {
        judgeReference(routine, bound, places_.place(e, handleHint(*bound.param)));
        return;
    }
    if (bound.param->accepts == ParamClass::SignalOrString) {
        const Typed t = expressions_.expr(e);
        if (!t.isError()) checkClass(routine, bound, t.info->type());
        return;
    }
    if (e.kind == NodeKind::Binary && bound.param->type.type->kind == TypeKind::SemiValue) {
        shapeReported_ =
            true; // "WaitDI di1=1;": misplaced parts in it, and missing arguments after it, are already reported
        reportAccess(routine, bound, nullptr, describeExpr(e));
        return;
    }
    if (e.kind == NodeKind::Paren && isPlaceExpr(bare(e))) {
        places_.place(bare(e), handleHint(*bound.param));
        setType(e, info(bare(e)).type());
        fixParentheses(reportAccess(routine, bound, nullptr, describeExpr(e)), e);
        return;
    }
    expressions_.visitLoose(e);
    if (e.kind == NodeKind::PlaceholderExpr || e.kind == NodeKind::ErrorExpr) return;
    reportAccess(routine, bound, nullptr, describeExpr(e));
}

// "ClkStart(clock1);": data that are passed on unchanged are written without parentheses.
void Arguments::fixParentheses(diag::Diagnostic& d, const Expr& e) {
    const SourceRange whole = range(e), inner = range(bare(e));
    const bool spaced = whole.begin > range(e.first - 1).end;
    d.fixes.push_back({"remove the parentheses",
                       {{{whole.begin, inner.begin}, spaced ? "" : " "}, {{inner.end, whole.end}, ""}}});
}

void Arguments::judgeReference(const RoutineSymbol& routine, const BoundArg& bound, const Place& place) {
    if (!place.root) return;
    const DataSymbol& param = *bound.param;
    const DataType& found = info(*bound.value).type();
    if (found.type->kind == TypeKind::Error) return;
    if (param.type.type->kind == TypeKind::AnyType) {
        if (!checkClass(routine, bound, found)) return;
    } else if (!equivalent(found, param.type)) {
        mismatches_.push_back({&param, bound.value, found});
        return;
    }
    if (param.mode != ParamMode::In && param.mode != ParamMode::Ref) checkAccess(routine, bound, place);
}

diag::Diagnostic& Arguments::reportAccess(const RoutineSymbol& routine, const BoundArg& bound,
                                          const Symbol* symbol, std::string found) {
    const char* expected = "data";
    switch (bound.param->mode) {
    case ParamMode::Var: expected = "a variable"; break;
    case ParamMode::Pers: expected = "an entire persistent"; break;
    case ParamMode::Inout: expected = "a variable or an entire persistent"; break;
    case ParamMode::In:
    case ParamMode::Ref: break;
    }
    if (bound.param->type.type->kind == TypeKind::SemiValue)
        expected = shapeReported_ ? "a signal, and ',' before the next argument" : "a signal";
    auto& d =
        report(say::ArgumentNotVariable, range(*bound.value),
               {bound.param->name, routine.name, std::move(found), expected}, {Misfit::Access, *bound.value});
    if (symbol) noteDeclared(d, *symbol);
    return d;
}

// Whether data may be passed on for the callee to change. An INOUT parameter may refer to a variable or to a persistent:
// which one shows at run time (ERR_ARGNOTVAR, ERR_ARGNOTPER).
void Arguments::checkAccess(const RoutineSymbol& routine, const BoundArg& bound, const Place& place) {
    DataSymbol& root = *place.root;
    const ParamMode mode = bound.param->mode;
    const bool parameter = root.storage == Storage::Parameter;
    if (root.storage == Storage::Signal) {
        if (mode == ParamMode::Pers) reportAccess(routine, bound, &root, describe(root));
        return;
    }
    if (root.storage == Storage::SystemVariable && isHandle(*root.type.type))
        return; // passed on, never changed
    const bool persistent = parameter ? root.mode == ParamMode::Pers : root.dataKind == DataKind::Pers;
    if (!acceptsData(root, mode)) {
        std::string found = parameter && root.mode == ParamMode::In    ? "a parameter of mode IN"
                            : parameter && root.mode == ParamMode::Var ? "a parameter of mode VAR"
                            : parameter && persistent                  ? "a parameter of mode PERS"
                                                                       : describe(root);
        reportAccess(routine, bound, &root, std::move(found));
        return;
    }
    // A parameter for a persistent of any type (IPers, GetSysData) also takes a component or an element of one.
    const bool anyPart = mode == ParamMode::Pers && bound.param->accepts == ParamClass::Value;
    // Instructions of RobotWare change parts of persistents, too: "Incr rack{2}.count" (decision 37).
    const bool mustBeWhole = !anyPart && (mode == ParamMode::Pers ||
                                          (mode == ParamMode::Inout && persistent && !routine.predefined));
    if (mustBeWhole && !place.whole) {
        report(say::ArgumentNotWhole, range(*bound.value),
               {bound.param->name, routine.name, "'" + root.name + "'"}, {Misfit::Kind, *bound.value});
        return;
    }
    if (!routine.traits.has(Trait::Inspects)) scopes_.markAssigned(root); // IsVar and their like only look
}

// The kind of argument that such a parameter needs, or null when `found` is that.
const char* missingClass(ParamClass accepts, const DataType& found) {
    const Type& type = *found.type;
    const bool scalar = found.rank == 0;
    const bool string = type.kind == TypeKind::String;
    const bool signal = type.kind == TypeKind::SemiValue;
    const auto unless = [](bool ok, const char* expected) { return ok ? nullptr : expected; };
    switch (accepts) {
    case ParamClass::Any: break;
    case ParamClass::Value: return unless(isValueType(type), "data of a value type");
    case ParamClass::ValueOrSignal: {
        const bool unit = isKnown(type, KnownType::MechanicalUnit);
        return unless(isValueType(type) || (scalar && (signal || unit)),
                      "data of a value type, or a signal variable");
    }
    case ParamClass::Atomic:
        return unless(scalar && (type.isNumeric() || type.kind == TypeKind::Bool || string),
                      "data of type num, dnum, bool or string");
    case ParamClass::Numeric: return unless(scalar && type.isNumeric(), "data of type num or dnum");
    case ParamClass::Signal: return unless(scalar && signal, "a signal");
    case ParamClass::SignalOrString:
        return unless(scalar && (signal || string), "a signal or its name as string");
    case ParamClass::Array: return unless(found.rank > 0, "an array");
    }
    return nullptr;
}

bool Arguments::checkClass(const RoutineSymbol& routine, const BoundArg& bound, const DataType& found) {
    if (found.type->kind == TypeKind::Error || found.type->kind == TypeKind::AnyType) return true;
    const char* expected = missingClass(bound.param->accepts, found);
    if (!expected) return true;
    report(say::ArgumentClass, range(*bound.value),
           {bound.param->name, routine.name, typeName(found), expected}, {Misfit::Kind, *bound.value});
    return false;
}

// The optional parameter of the current routine that `e` names, or null.
DataSymbol* Arguments::ownParameter(const Expr& e) {
    if (e.kind != NodeKind::Name || !context_.routine) return nullptr;
    DataSymbol* data = asData(scopes_.lookup(idOf(as<NameExpr>(e).name)));
    return data && data->storage == Storage::Parameter ? data : nullptr;
}

DataSymbol* Arguments::ownOptional(const Expr& e) {
    DataSymbol* data = ownParameter(e);
    return data && data->optional ? data : nullptr;
}

// Dim(array, number): which dimensions there are is known (manual 1.1.5).
void Arguments::checkDim(const CallExpr& e, const RoutineSymbol& routine) {
    if (routine.role != Role::Dim || e.args.size() != 2) return;
    const Expr *array = e.args[0]->value, *number = e.args[1]->value;
    if (!array || !number || info(*array).type().rank == 0) return;
    const ConstValue* value = info(*number).constant;
    if (!value || value->kind != ConstValue::Kind::Number) return;
    if (value->number < 1 || value->number > info(*array).type().rank)
        report(say::DimensionNumber, range(*number),
               {text(*number), counted(info(*array).type().rank, "dimension")});
}

void Arguments::checkPresent(const BoundArg& bound) {
    const Expr& e = *bound.value;
    const bool outer = std::exchange(state_.presenceOnly, true);
    const bool known = isPlaceExpr(e) ? places_.place(e).root != nullptr : (expressions_.visitLoose(e), true);
    state_.presenceOnly = outer;
    if (!known || e.kind == NodeKind::PlaceholderExpr) return;
    if (const DataSymbol* own = ownOptional(e))
        routine_.optionalUses[own->index].tested = true;
    else
        report(ownParameter(e) ? say::PresentRequired : say::PresentNotOptional, range(e), {text(e)});
}

// `\Arg?Param`: present if the caller's own optional parameter is.
void Arguments::checkConditional(const RoutineSymbol& routine, BoundArg& bound) {
    if (!bound.value || bound.value->kind == NodeKind::PlaceholderExpr) return;
    const Expr& e = *bound.value;
    const bool outer = std::exchange(state_.presenceOnly, true);
    judgeConditional(routine, bound, e);
    state_.presenceOnly = outer;
}

void Arguments::judgeConditional(const RoutineSymbol& routine, const BoundArg& bound, const Expr& e) {
    if (!isPlaceExpr(e))
        expressions_.visitLoose(e);
    else if (!places_.place(e).root)
        return;
    const DataSymbol* own = ownOptional(e);
    if (!own) {
        report(say::ConditionalNotParameter, range(e), {text(e)});
        return;
    }
    const DataSymbol& param = *bound.param;
    if (own->isSwitch != param.isSwitch) {
        const auto what = [](const DataSymbol& data) {
            return data.isSwitch ? "a switch" : "'" + typeName(data.type) + "'";
        };
        report(say::ConditionalSwitch, range(e), {param.name, own->name, what(*own), what(param)});
        return;
    }
    if (param.isSwitch) return;
    if (param.mode != ParamMode::In || param.type.type->kind == TypeKind::SemiValue)
        judgeReference(routine, bound, places_.place(e));
    else
        judgeValue(routine, bound, expressions_.placeValue(e));
}

} // namespace rapid::sema

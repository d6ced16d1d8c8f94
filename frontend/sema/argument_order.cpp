// Arguments that would fit in a different order, or with one more or one less: one report.

#include "frontend/sema/argument_order.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/sema/arguments.h"
#include "frontend/sema/call.h"
#include "frontend/sema/parameters.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/wording.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

namespace {

constexpr size_t kMostArguments = 16; // of calls that are looked at

} // namespace

/// Whether a parameter of this mode takes the data; the type does not count.
bool acceptsData(const DataSymbol& root, ParamMode mode) {
    const bool parameter = root.storage == Storage::Parameter;
    if (mode == ParamMode::In || mode == ParamMode::Ref) return true;
    if (root.storage == Storage::Signal) return mode != ParamMode::Pers;
    if (root.storage == Storage::SystemVariable || root.storage == Storage::LoopVariable) return false;
    if (root.dataKind == DataKind::Const && !parameter) return false;
    const bool persistent = parameter ? root.mode == ParamMode::Pers : root.dataKind == DataKind::Pers;
    const bool either = parameter && root.mode == ParamMode::Inout;
    return mode == ParamMode::Var ? !persistent : mode == ParamMode::Pers ? persistent || either : true;
}

ArgumentOrder::ArgumentOrder(State& state, const Parts& parts)
    : CheckerPart(state), arguments_(parts.arguments), calls_(parts.calls), remedies_(parts.remedies),
      scopes_(parts.scopes) {}

/// Would the argument, which has been checked, fit this parameter?
bool ArgumentOrder::couldBe(const Expr& e, const DataSymbol& param) {
    const DataSymbol* data = e.kind == NodeKind::Name ? asData(info(e).symbol) : nullptr;
    const DataType& found =
        data ? data->type : info(e).type(); // signals and handles have been taken for values
    const Type& want = *param.type.type;
    if (!found.type || found.type->kind == TypeKind::Error) // a name that nothing declares may be a signal
        return e.kind == NodeKind::Name && arguments_.handleHint(param);
    const Expr* base = &e;
    while (base->kind == NodeKind::Index || base->kind == NodeKind::Component)
        base = base->kind == NodeKind::Index ? as<IndexExpr>(*base).base : as<ComponentExpr>(*base).base;
    const DataSymbol* root = base->kind == NodeKind::Name ? asData(info(*base).symbol) : nullptr;
    const bool byReference = param.mode != ParamMode::In || want.kind == TypeKind::SemiValue;
    if (byReference && (!root || !acceptsData(*root, param.mode))) return false;
    if (want.kind == TypeKind::AnyType) return !missingClass(param.accepts, found);
    const bool numeric = found.rank == 0 && param.type.rank == 0 && want.isNumeric();
    if (!byReference && numeric && found.type->kind == TypeKind::SemiValue) return true;
    if (!byReference && numeric && found.type->isNumeric() && info(e).constant && !root) return true;
    return equivalent(found, param.type);
}

/// Whether all that was reported of the call is about its required arguments.
bool ArgumentOrder::errorsLieIn(const std::vector<const Expr*>& given) const {
    return std::all_of(reports_.collected()->all().begin(), reports_.collected()->all().end(),
                       [&](const diag::Diagnostic& d) {
                           if (d.severity != diag::Severity::Error) return true;
                           return std::any_of(given.begin(), given.end(), [&](const Expr* e) {
                               return range(*e).begin <= d.range.begin && d.range.end <= range(*e).end;
                           });
                       });
}

bool ArgumentOrder::isDeclaredData(TokenIndex name) const {
    const DataSymbol* data = asData(scopes_.lookup(idOf(name)));
    return data && data->index != kNoIndex; // not the stand-in of an undeclared name
}

// "Move p,x;" for "Move p.x;", "NumToStr(frame,trans.x, 1)": no data is named so, but a component of the argument before it.
bool ArgumentOrder::explainComma(std::span<Argument* const> args) {
    for (size_t i = 0; i + 1 < args.size(); ++i) {
        const Expr *whole = args[i]->value, *part = args[i + 1]->value;
        if (!whole || !part || args[i + 1]->argKind != ArgKind::Required || !isName(part->first)) continue;
        const DataType& type = info(*whole).type();
        const TokenIndex component = part->first;
        if (range(component).begin != range(*whole).end + 1 || isDeclaredData(component) || type.rank > 0 ||
            type.type->kind != TypeKind::Record ||
            type.type->findComponent(context_.tree->text(component)) < 0)
            continue;
        reports_.collected()->retract([](const diag::Diagnostic&) { return true; });
        const SourceRange comma{range(*whole).end, range(component).begin};
        report(say::UnexpectedToken, comma, {"','", "'.' before a component"}).fix(comma, ".");
        return true;
    }
    return false;
}

// "Open path, file /Write;": no data is named as the option after the slash.
bool ArgumentOrder::explainSlash(const RoutineSymbol& routine, std::span<Argument* const> args) {
    for (const Argument* arg : args) {
        if (!arg->value || arg->value->kind != NodeKind::Binary) continue;
        const auto& quotient = as<BinaryExpr>(*arg->value);
        const TokenIndex option = quotient.opToken + 1;
        if (quotient.op != BinaryOp::Div || !isName(option) || isDeclaredData(option) ||
            calls_.namedOptional(routine, idOf(option)) >= routine.params.size())
            continue;
        reports_.collected()->retract([](const diag::Diagnostic&) { return true; });
        const SourceRange slash = range(quotient.opToken);
        report(say::UnexpectedToken, slash, {"'/'", "'\\' before an optional argument"}).fix(slash, "\\");
        return true;
    }
    return false;
}

/// Looks for the one mistake that explains all errors of the arguments; then it alone is reported.
bool ArgumentOrder::explainArguments(const BoundCall& call, TokenIndex name,
                                     std::span<Argument* const> args) {
    const RoutineSymbol& routine = *call.routine;
    std::vector<const DataSymbol*> params;
    std::vector<const Expr*> given;
    for (const DataSymbol* param : routine.params) {
        if (param->requiredAlternative) return false;
        if (!param->optional) params.push_back(param);
    }
    for (const Argument* arg : args) {
        if (arg->argKind == ArgKind::Placeholder) return false;
        if (arg->argKind != ArgKind::Required) continue;
        if (arg->name != kNoToken || !arg->value || arg->value->kind == NodeKind::ErrorExpr) return false;
        given.push_back(arg->value);
    }
    if (params.empty() || given.size() < params.size() || params.size() > kMostArguments ||
        given.size() > params.size() + 1 || !calls_.endsWell(name, args) || !errorsLieIn(given))
        return false;
    return params.size() == given.size() ? explainOrder(routine, params, given)
                                         : explainCount(routine, name, params, given);
}

void ArgumentOrder::reportSwapped(const RoutineSymbol& routine, const DataSymbol& one,
                                  const DataSymbol& other, const Expr& first, const Expr& second,
                                  bool certain) {
    report(say::ArgumentsSwapped, range(first), {one.name, other.name, routine.name})
        .fixes.push_back(
            {"swap them",
             {{range(first), remedies_.written(second)}, {range(second), remedies_.written(first)}},
             certain});
}

/// Two are swapped, or one comes too early or too late.
bool ArgumentOrder::explainOrder(const RoutineSymbol& routine, const std::vector<const DataSymbol*>& params,
                                 const std::vector<const Expr*>& given) {
    const size_t count = params.size();
    std::vector<size_t> order(count);
    const auto reset = [&] {
        for (size_t i = 0; i < count; ++i)
            order[i] = i;
    };
    const auto fits = [&] {
        for (size_t i = 0; i < count; ++i)
            if (!couldBe(*given[order[i]], *params[i])) return false;
        return true;
    };
    reset();
    // A name that nothing declares is wrong in any order.
    const auto isInPlace = [&](size_t i) {
        return couldBe(*given[i], *params[i]) || info(*given[i]).type().type->kind == TypeKind::Error;
    };
    bool inOrder = true;
    for (size_t i = 0; i < count; ++i)
        inOrder = inOrder && isInPlace(i);
    if (inOrder) return false; // what is wrong is another thing
    const auto dropErrors = [&] {
        reports_.collected()->retract([](const diag::Diagnostic&) { return true; });
    };
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = i + 1; k < count; ++k) {
            reset();
            std::swap(order[i], order[k]);
            if (!fits()) continue;
            bool only = true; // nothing else given fits either of the two
            for (size_t other = 0; other < count; ++other)
                only = only && (other == i || other == k ||
                                !(couldBe(*given[other], *params[i]) || couldBe(*given[other], *params[k])));
            dropErrors();
            reportSwapped(routine, *params[i], *params[k], *given[i], *given[k], only);
            return true;
        }
    }
    for (size_t from = 0; from < count; ++from) { // the argument given there belongs to parameter `to`
        for (size_t to = 0; to < count; ++to) {
            reset();
            order.erase(order.begin() + static_cast<std::ptrdiff_t>(from));
            order.insert(order.begin() + static_cast<std::ptrdiff_t>(to), from);
            if (from == to || !fits()) continue;
            dropErrors();
            const bool late = to < from; // else the one after it comes too late
            report(say::ArgumentOrder, range(*given[late ? from : from + 1]),
                   {params[late ? to : from]->name, params[late ? from : to]->name});
            return true;
        }
    }
    return false;
}

/// One too many before others.
bool ArgumentOrder::explainCount(const RoutineSymbol& routine, TokenIndex name,
                                 const std::vector<const DataSymbol*>& params,
                                 const std::vector<const Expr*>& given) {
    size_t odd = 0;
    while (odd < params.size() && couldBe(*given[odd], *params[odd]))
        ++odd;
    if (odd == params.size()) return false;
    for (size_t i = odd; i < params.size(); ++i)
        if (!couldBe(*given[i + 1], *params[i])) return false;
    reports_.collected()->take();
    if (given[odd]->kind == NodeKind::Name) { // "MoveAbsJ jp, NoEOffs, v100, ..."
        const TokenIndex option = as<NameExpr>(*given[odd]).name;
        if (isName(option) && calls_.namedOptional(routine, idOf(option)) < routine.params.size()) {
            report(say::OptionalWithoutBackslash, range(option), {routine.name, text(option)})
                .fix({range(option).begin, range(option).begin}, "\\", false);
            return true;
        }
    }
    report(say::TooManyArguments, range(*given[odd]),
           {text(name), counted(params.size(), "required argument"), std::to_string(given.size())});
    return true;
}

/// "SetDO do1 := 1;" and "MoveL p10, v100, fine, tool0WObj:=wobj1;": ',' or '\\' is missing, and no parameter is named so.
bool ArgumentOrder::reportMisspeltSeparator(const RoutineSymbol& routine, const Argument& arg, size_t slot,
                                            bool isLast) {
    const std::string_view written = names_.folded(idOf(arg.name));
    for (const DataSymbol* param : routine.params) {
        const std::string_view option = names_.folded(param->nameId);
        if (!param->optional || written.size() <= option.size() || !written.ends_with(option)) continue;
        const size_t rest = written.size() - option.size();
        if (!asData(scopes_.lookup(names_.intern(written.substr(0, rest))))) continue;
        const uint32_t at = range(arg.name).end - static_cast<uint32_t>(option.size());
        report(say::OptionalWithoutBackslash, {at, range(arg.name).end}, {routine.name, param->name})
            .fix({at, at}, "\\");
        return true;
    }
    const bool another = nextRequired(routine, alternativesEnd(routine, slot)) < routine.params.size();
    const bool isArgument =
        asData(scopes_.lookup(idOf(arg.name))) || arguments_.handleHint(*routine.params[slot]);
    if (!isLast || !another || !isArgument) return false;
    report(say::UnexpectedToken, range(arg.name + 1), {"':='", "',' before the next argument"})
        .fix(range(arg.name + 1), ",");
    return true;
}

} // namespace rapid::sema

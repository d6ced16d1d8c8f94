// Calls: which argument goes to which parameter (manual 1.1.5, 1.3.4).

#include "frontend/sema/call.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/expressions.h"
#include "frontend/diag/messages/names.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/sema/argument_order.h"
#include "frontend/sema/arguments.h"
#include "frontend/sema/availability.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/parameters.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/suggestions.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

#include <algorithm>
#include <optional>

namespace rapid::sema {

using namespace syntax;

namespace {

constexpr size_t kNoParam = static_cast<size_t>(-1);

void give(BoundArg& bound, const Argument& arg) {
    bound.kind = arg.argKind == ArgKind::Conditional ? BoundArg::Kind::Conditional : BoundArg::Kind::Present;
    bound.value = arg.value;
    bound.argument = &arg;
}

/// "WaitTime 0,3;": two whole numbers with nothing but a comma between them. Its place, if so.
std::optional<SourceRange> decimalComma(const syntax::SyntaxTree& tree, const Argument& fraction) {
    const TokenIndex last = fraction.first;
    if (last < 2 || fraction.last != last || tree.tokens[last - 1].kind != TokenKind::Comma) return {};
    const auto isWhole = [&](TokenIndex i) {
        return tree.tokens[i].kind == TokenKind::NumLiteral &&
               tree.text(i).find_first_not_of("0123456789") == std::string_view::npos;
    };
    const SourceRange comma = tree.range(last - 1);
    const bool close = tree.range(last - 2).end == comma.begin && comma.end == tree.range(last).begin;
    return close && isWhole(last) && isWhole(last - 2) ? std::optional(comma) : std::nullopt;
}

} // namespace

CallBinder::CallBinder(State& state, const Parts& parts)
    : CheckerPart(state), order_(parts.order), arguments_(parts.arguments), availability_(parts.availability),
      expressions_(parts.expressions), places_(parts.places), remedies_(parts.remedies),
      scopes_(parts.scopes), suggestions_(parts.suggestions), unknown_(parts.unknown) {}

Typed CallBinder::functionCall(const CallExpr& e) {
    Symbol* symbol = isName(e.name) ? scopes_.lookup(idOf(e.name)) : nullptr;
    RoutineSymbol* routine = asRoutine(symbol);
    if (!routine || routine->routineKind != RoutineKind::Func) {
        if (symbol) {
            reportNotAFunction(e, *symbol);
        } else if (isName(e.name)) {
            unknown_.reportUnknown(say::UnknownFunction, e.name, idOf(e.name), Wanted::Function);
        }
        visitArguments(e.args);
        return expressions_.errorExpr(e);
    }
    scopes_.markUsed(*routine);
    availability_.checkOption(*routine, e.name);
    bindCall(e, *routine, e.name, e.args);
    arguments_.checkDim(e, *routine);
    ExprInfo& out = info(e);
    setType(e, routine->returnType);
    out.symbol = routine;
    return {&out};
}

// Data with arguments: an array with its index in parentheses.
void CallBinder::reportNotAFunction(const CallExpr& e, const Symbol& symbol) {
    diag::Diagnostic& d = report(say::NotAFunction, range(e.name), {text(e.name), describe(symbol)});
    const auto isIndex = [](const Argument* a) {
        return a->argKind == ArgKind::Required && a->name == kNoToken && a->value;
    };
    if (symbol.kind == SymbolKind::Data &&
        e.args.size() == static_cast<const DataSymbol&>(symbol).type.rank && !e.args.empty() &&
        std::all_of(e.args.begin(), e.args.end(), isIndex)) {
        const SourceRange open = range(e.name + 1), whole = range(e);
        d.fixes.push_back(
            {"put the index between '{' and '}'", {{open, "{"}, {{whole.end - 1, whole.end}, "}"}}});
    }
    noteDeclared(d, symbol);
}

// The value of an argument without a parameter to judge it by. `\Arg?Param` asks only whether Param is there.
void CallBinder::visitArgument(const Argument& arg) {
    if (!arg.value) return;
    const bool outer =
        std::exchange(state_.presenceOnly, state_.presenceOnly || arg.argKind == ArgKind::Conditional);
    expressions_.visitLoose(*arg.value);
    state_.presenceOnly = outer;
}

void CallBinder::visitArguments(std::span<Argument* const> args) {
    for (const Argument* a : args)
        visitArgument(*a);
}

void CallBinder::bindCall(const Node& node, RoutineSymbol& routine, TokenIndex name,
                          std::span<Argument* const> args) {
    BoundCall& call = facts().calls[&node];
    call.routine = &routine;
    call.module = context_.module;
    call.args = facts().inner.makeArray<BoundArg>(routine.params.size());
    for (size_t i = 0; i < routine.params.size(); ++i)
        call.args[i].param = routine.params[i];
    if (routine.incomplete) {
        visitArguments(args);
        return;
    }
    if (callDepth_ == callSinks_.size()) callSinks_.emplace_back();
    diag::Sink& own = callSinks_[callDepth_++];
    diag::Sink* outer = reports_.collectIn(&own);
    const size_t judgedBefore = judged_.size();
    const size_t mismatchesBefore = arguments_.mismatchCount();
    const bool complete = matchArguments(call, name, args);
    const bool mayMiss = complete && endsWell(name, args);
    checkExclusive(call);
    if (routine.traits.has(Trait::SameType)) arguments_.checkSameType(call, judged_);
    for (BoundArg& bound : call.args) {
        if (!bound.argument) continue;
        const auto begin = judged_.begin() + static_cast<std::ptrdiff_t>(judgedBefore);
        if (std::find(begin, judged_.end(), bound.argument) == judged_.end())
            arguments_.checkArgument(routine, bound);
    }
    judged_.resize(judgedBefore);
    const bool wrong = own.hasErrors() || arguments_.mismatchCount() > mismatchesBefore;
    if (wrong && (order_.explainComma(args) || order_.explainSlash(routine, args) ||
                  order_.explainArguments(call, name, args)))
        arguments_.forgetMismatches(mismatchesBefore);
    else if ((mayMiss && nextLacking(call, 0) < routine.params.size()) ||
             arguments_.mismatchCount() > mismatchesBefore)
        arguments_.reportArguments(call, name, mismatchesBefore, mayMiss);
    else if (mayMiss)
        arguments_.forgetShape(); // of this call
    dropSurplus(own);
    reports_.collectIn(outer);
    --callDepth_;
    if (own.all().empty()) return;
    (outer ? *outer : state_.sink).absorb(own);
}

/// An argument too many follows from the other mistake in the call, if there is one: a sign that should be another one.
void CallBinder::dropSurplus(diag::Sink& reports) {
    const auto isSurplus = [](const diag::Diagnostic& d) {
        return d.code == diag::say::TooManyArguments.code;
    };
    const bool others = std::any_of(reports.all().begin(), reports.all().end(), [&](const auto& d) {
        return d.severity == diag::Severity::Error && !isSurplus(d);
    });
    if (others) reports.retract(isSurplus);
}

// Whether the arguments were read to their end: after a syntax error in a call nothing is said to be missing.
bool CallBinder::endsWell(TokenIndex name, std::span<Argument* const> args) const {
    const TokenIndex last = args.empty() ? name : args.back()->last;
    const TokenKind next =
        context_.tree->tokens[std::min<size_t>(last + 1, context_.tree->tokens.size() - 1)].kind;
    return next == TokenKind::Semicolon || next == TokenKind::RightParen ||
           (args.empty() && next == TokenKind::LeftParen);
}

bool CallBinder::matchArguments(BoundCall& call, TokenIndex name, std::span<Argument* const> args) {
    const RoutineSymbol& routine = *call.routine;
    size_t slot = nextRequired(routine, 0);
    size_t last = 0;
    const Argument* lastArg = nullptr;
    bool complete = true;
    bool orderReported = false;
    bool tooMany = false;
    for (const Argument* arg : args) {
        size_t index = kNoParam;
        if (arg->value && arg->value->kind == NodeKind::ErrorExpr) complete = false;
        if (arg->argKind == ArgKind::Placeholder) {
            complete = false;
        } else if (arg->argKind != ArgKind::Required) {
            index = matchOptional(call, *arg, name);
            if (index == kNoParam)
                complete = false;
            else if (index == slot)
                slot = nextRequired(routine, alternativesEnd(routine, slot));
        } else if (slot < routine.params.size()) {
            index = matchRequired(call, *arg, slot, args.back() == arg);
            if (index != kNoParam && !routine.params[index]->optional)
                slot = nextRequired(routine, alternativesEnd(routine, slot));
            if (index == kNoParam) complete = false;
        } else if (arg->name != kNoToken && namedOptional(routine, idOf(arg->name)) != kNoParam) {
            index = matchUnmarked(routine, *arg, args.back() == arg);
        } else if (arg->value && arg->value->kind == NodeKind::ErrorExpr) {
            continue;
        } else if (reportMisread(routine, *arg, name)) {
            complete = false;
            continue;
        } else if (!std::exchange(tooMany, true)) {
            reportTooMany(routine, args, *arg, name);
        }
        if (index != kNoParam && call.args[index].argument) {
            report(say::DuplicateArgument, range(*arg), {routine.params[index]->name});
            index = kNoParam;
        }
        if (index == kNoParam) {
            visitArgument(*arg);
            continue;
        }
        if (lastArg && index < last && !std::exchange(orderReported, true)) {
            report(say::ArgumentOrder, range(*arg),
                   {routine.params[index]->name, routine.params[last]->name});
            complete = false;
        }
        const bool misplaced =
            arg->argKind == ArgKind::Required && routine.params[index]->optional; // reported
        if (!misplaced) {
            last = std::max(last, index);
            lastArg = arg;
        }
        give(call.args[index], *arg);
    }
    return complete && !tooMany;
}

/// An argument after the last required one that is something else: an optional one, the next instruction.
bool CallBinder::reportMisread(const RoutineSymbol& routine, const Argument& arg, TokenIndex routineName) {
    if (!namesOptional(routine, arg)) return reportAssignmentBelow(arg);
    const SourceRange at = range(arg);
    const TokenIndex option = as<NameExpr>(*arg.value).name;
    report(say::OptionalWithoutBackslash, at, {text(routineName), text(option)})
        .fix({at.begin, at.begin}, "\\", routine.params[namedOptional(routine, idOf(option))]->isSwitch);
    return true;
}

void CallBinder::reportTooMany(const RoutineSymbol& routine, std::span<Argument* const> args,
                               const Argument& first, TokenIndex routineName) {
    const auto given = std::count_if(args.begin(), args.end(),
                                     [](const Argument* a) { return a->argKind == ArgKind::Required; });
    diag::Diagnostic& d = report(
        say::TooManyArguments, range(first),
        {text(routineName),
         routine.params.empty() ? "no arguments" : counted(requiredSlots(routine), "required argument"),
         std::to_string(given)});
    if (const auto comma = decimalComma(*context_.tree, first);
        comma && requiredSlots(routine) == 1 && given == 2) {
        const std::string number = std::string(text(first.first - 2)) + "." + std::string(text(first.first));
        d.message += didYouMean(number) + " A decimal number has a point";
        d.fix(*comma, ".", false);
        return;
    }
    const std::string hint = first.value ? remedies_.optionalFor(routine, *first.value) : std::string();
    if (hint.empty()) return;
    d.message += didYouMean(hint + text(*first.value));
    d.fix({range(first).begin, range(first).begin}, hint, false);
}

// "routine a, <new line> x := 1;": an assignment below a comma that should have been a semicolon.
bool CallBinder::reportAssignmentBelow(const Argument& arg) {
    if (arg.name == kNoToken || arg.name == 0 || !asData(scopes_.lookup(idOf(arg.name)))) return false;
    const SourceRange comma = range(arg.name - 1);
    const std::string_view between =
        context_.tree->source->text().substr(comma.end, range(arg.name).begin - comma.end);
    if (context_.tree->tokens[arg.name - 1].kind != TokenKind::Comma ||
        between.find('\n') == std::string_view::npos)
        return false;
    report(say::UnexpectedToken, comma, {"','", "';'"}).fix(comma, ";");
    return true;
}

// The parameter of a required argument; its name, if written, must be that of the parameter in turn.
size_t CallBinder::matchRequired(BoundCall& call, const Argument& arg, size_t slot, bool isLast) {
    const RoutineSymbol& routine = *call.routine;
    const size_t end = alternativesEnd(routine, slot);
    if (arg.name == kNoToken)
        return end - slot == 1 || !arg.value ? slot : chooseAlternative(call, arg, slot, end);
    const NameId name = idOf(arg.name);
    for (size_t i = slot; i < end; ++i)
        if (routine.params[i]->nameId == name) return i;
    if (const size_t i = matchUnmarked(routine, arg, isLast); i != kNoParam) return i;
    const Type* type = routine.params[slot]->type.type;
    if (type->kind == TypeKind::Bool && asData(scopes_.lookup(name))) { // "WaitUntil a := 1;"
        report(say::AssignmentInCondition, range(arg.name + 1)).fix(range(arg.name + 1), "=");
        return kNoParam;
    }
    if (reportAssignmentBelow(arg) || order_.reportMisspeltSeparator(routine, arg, slot, isLast))
        return kNoParam;
    report(say::ArgumentName, range(arg.name), {routine.name, text(arg.name), routine.params[slot]->name});
    return slot;
}

// The parameter of a name, or kNoParam.
size_t CallBinder::namedParameter(const RoutineSymbol& routine, NameId name) {
    constexpr size_t kMany = 64;
    if (routine.params.size() < kMany) {
        for (size_t i = 0; i < routine.params.size(); ++i)
            if (routine.params[i]->nameId == name) return i;
        return kNoParam;
    }
    if (routine_.wideRoutine != &routine) {
        routine_.wideRoutine = &routine;
        routine_.wideNames = {};
        for (DataSymbol* param : routine.params)
            if (!routine_.wideNames.find(param->nameId)) routine_.wideNames.set(param->nameId, param);
    }
    const DataSymbol* param = routine_.wideNames.find(name);
    return param ? param->index : kNoParam;
}

// An undeclared name that is that of an optional parameter: "routine a, Switch;".
bool CallBinder::namesOptional(const RoutineSymbol& routine, const Argument& arg) {
    if (arg.name != kNoToken || !arg.value || arg.value->kind != NodeKind::Name) return false;
    const TokenIndex name = as<NameExpr>(*arg.value).name;
    return isName(name) && !scopes_.lookup(idOf(name)) && namedOptional(routine, idOf(name)) != kNoParam;
}

// The optional parameter of a name, or kNoParam.
size_t CallBinder::namedOptional(const RoutineSymbol& routine, NameId name) {
    const size_t i = namedParameter(routine, name);
    return i != kNoParam && routine.params[i]->optional ? i : kNoParam;
}

// An optional argument without its backslash.
size_t CallBinder::matchUnmarked(const RoutineSymbol& routine, const Argument& arg, bool isLast) {
    const size_t i = namedOptional(routine, idOf(arg.name));
    if (i == kNoParam) return i;
    const DataSymbol& param = *routine.params[i];
    diag::Diagnostic& d = report(say::OptionalWithoutBackslash, range(arg.name), {routine.name, param.name});
    if (param.isSwitch && arg.value) { // "grip Open:=TRUE;"
        d.fix(range(arg), "\\" + text(arg.name), false);
    } else {
        const uint32_t begin = range(arg.name).begin;
        d.fix({begin, begin}, "\\", isLast);
    }
    return i;
}

size_t CallBinder::matchOptional(BoundCall& call, const Argument& arg, TokenIndex) {
    const RoutineSymbol& routine = *call.routine;
    if (!isName(arg.name)) return kNoParam;
    const NameId name = idOf(arg.name);
    if (const size_t i = namedParameter(routine, name); i != kNoParam) {
        const DataSymbol& param = *routine.params[i];
        const bool eitherForm = routine.uncertain && param.requiredAlternative && arg.value;
        if (!param.optional && !eitherForm)
            report(arg.argKind == ArgKind::Conditional ? say::ConditionalRequired : say::NotOptional,
                   range(arg.name), {routine.name, param.name});
        return !param.optional && call.args[i].argument ? kNoParam : i; // given once more: one report will do
    }
    const DataSymbol* near = suggestions_.nearOptional(routine, name);
    // "\wobj0" is nearer to "\WObj:=wobj0" than to "\WObj", which lacks its value.
    const bool named = arg.value || (near && near->isSwitch);
    const std::string hint = named ? std::string() : remedies_.optionalFor(routine, name);
    const std::string meant = !hint.empty() ? hint + text(arg.name) : near ? near->name : hint;
    diag::Diagnostic& d = report(say::UnknownParameter, range(arg.name),
                                 {routine.name, text(arg.name), meant.empty() ? meant : didYouMean(meant)});
    if (near && hint.empty()) d.fix(range(arg.name), near->name, false);
    if (!hint.empty()) d.fix({range(arg.name).begin - 1, range(arg.name).begin}, hint, false);
    return kNoParam;
}

// One of several parameters takes the argument (`num Value | dnum Dvalue`): the first one whose type fits.
size_t CallBinder::chooseAlternative(BoundCall& call, const Argument& arg, size_t first, size_t end) {
    const RoutineSymbol& routine = *call.routine;
    const Expr& e = *arg.value;
    const Type* hint = nullptr;
    for (size_t i = first; i < end; ++i)
        if (const Type* handle = arguments_.handleHint(*routine.params[i])) hint = handle;
    Place found;
    Typed t;
    if (isPlaceExpr(e)) {
        found = places_.place(e, hint);
        t = {&info(e)};
        const bool signal = t.info->type().rank == 0 && t.info->type().type->kind == TypeKind::SemiValue;
        if (signal && !hint) t = expressions_.placeValue(e), found = {};
    } else {
        DataType want = routine.params[first]->type;
        t = expressions_.expr(e, e.kind == NodeKind::Aggregate ? &want : nullptr);
    }
    judged_.push_back(&arg);
    if (t.isError()) return first;
    // A literal that needs dnum fits num as well.
    const bool needsDnum = t.flex == Flex::Literal && t.isScalar(TypeKind::Dnum);
    const bool choice =
        needsDnum && std::any_of(routine.params.begin() + static_cast<std::ptrdiff_t>(first),
                                 routine.params.begin() + static_cast<std::ptrdiff_t>(end),
                                 [](const DataSymbol* p) { return p->type.type->kind == TypeKind::Dnum; });
    for (size_t i = first; i < end; ++i) {
        const DataSymbol& param = *routine.params[i];
        if (param.mode != ParamMode::In && !found.root && isPlaceExpr(e)) continue;
        if (choice && param.type.type->kind != TypeKind::Dnum) continue;
        if (param.type.type->kind != TypeKind::AnyType && !expressions_.fits(e, t, param.type)) continue;
        BoundArg bound{routine.params[i], BoundArg::Kind::Present, &e, &arg};
        if (param.mode == ParamMode::In)
            arguments_.judgeValue(routine, bound, t);
        else if (isPlaceExpr(e))
            arguments_.judgeReference(routine, bound, found);
        else
            arguments_.reportAccess(routine, bound, nullptr, describeExpr(e));
        return i;
    }
    std::string expected;
    for (size_t i = first; i < end; ++i)
        expected += (i == first ? "'" : " or '") + typeName(routine.params[i]->type) + "'";
    report(say::ArgumentAlternatives, range(e), {routine.name, typeName(*t.info), expected},
           {Misfit::Kind, e});
    return first;
}

void CallBinder::reportMissing(const BoundCall& call, TokenIndex name) {
    const RoutineSymbol& routine = *call.routine;
    std::string missing;
    size_t count = 0;
    for (size_t i = nextLacking(call, 0); i < routine.params.size();) {
        const size_t end = alternativesEnd(routine, i);
        missing += (count++ == 0 ? "" : ", ") + namesOf(call.args.subspan(i, end - i));
        i = nextLacking(call, end);
    }
    if (missing.empty()) return;
    const std::string what = (count == 1 ? "argument " : "arguments ") + missing;
    noteDeclared(report(say::MissingArgument, range(name), {text(name), what}), routine);
}

void CallBinder::checkExclusive(const BoundCall& call) {
    const BoundArg* previous = nullptr;
    for (const BoundArg& bound : call.args) {
        if (!bound.param->optional || bound.kind != BoundArg::Kind::Present) continue;
        if (previous && previous->param->group == bound.param->group)
            report(say::ExclusiveArguments, range(*bound.argument),
                   {previous->param->name, bound.param->name});
        else
            previous = &bound;
    }
}

// Late binding: the procedure is known at run time only, so arguments are collected as they are (manual 1.1.5). The same for
// a procedure that a module may declare that is not here; its arguments get their type from nothing.
void CallBinder::lateCall(const CallStmt& stmt) {
    if (stmt.lateName) {
        const Typed name = expressions_.expr(*stmt.lateName);
        if (!name.isError() && !name.isScalar(TypeKind::String))
            report(say::LateBindingName, range(*stmt.lateName), {typeName(*name.info)});
    }
    BoundCall& call = facts().calls[&stmt];
    call.module = context_.module;
    call.args = facts().inner.makeArray<BoundArg>(stmt.args.size());
    size_t count = 0;
    for (const Argument* arg : stmt.args) {
        if (arg->argKind == ArgKind::Placeholder) continue;
        BoundArg& bound = call.args[count++];
        give(bound, *arg);
        if (!arg->value) continue;
        if (arg->argKind == ArgKind::Conditional) {
            visitArgument(*arg);
            if (!arguments_.ownOptional(*arg->value))
                report(say::ConditionalNotParameter, range(*arg->value), {text(*arg->value)});
        } else if (isPlaceExpr(*arg->value)) {
            if (DataSymbol* root = places_.place(*arg->value).root)
                scopes_.markAssigned(*root); // the callee may take it as VAR
        } else if (stmt.lateName) {
            expressions_.expr(*arg->value);
        } else {
            expressions_.visitLoose(*arg->value);
        }
    }
    call.args = call.args.first(count);
}

} // namespace rapid::sema

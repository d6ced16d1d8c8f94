// Instructions: assignment, branches, loops, calls (manual 1.4, 1.5).

#include "frontend/sema/stmt.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/expressions.h"
#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/names.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/sema/availability.h"
#include "frontend/sema/call.h"
#include "frontend/sema/cyclic_condition.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/jumps.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/resolve_data.h"
#include "frontend/sema/routine.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/stmt_flow.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/later_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

Statements::Statements(State& state, const Parts& parts)
    : CheckerPart(state), availability_(parts.availability), calls_(parts.calls), data_(parts.data),
      expressions_(parts.expressions), flow_(parts.flow), jumps_(parts.jumps), places_(parts.places),
      remedies_(parts.remedies), routines_(parts.routines), scopes_(parts.scopes), unknown_(parts.unknown) {}

bool Statements::statements(StmtList list) {
    bool reachable = true;
    for (const Stmt* s : list) {
        if (s->kind == NodeKind::Label) reachable = true;
        const bool continues = statement(*s);
        reachable = reachable && continues;
    }
    return reachable;
}

/// Checks one instruction; whether the next one can be reached from it.
bool Statements::statement(const Stmt& s) {
    reports_.mute(s.broken); // instructions that contain others never are
    const bool continues = wholeStatement(s);
    reports_.mute(false);
    return continues;
}

bool Statements::wholeStatement(const Stmt& s) {
    switch (s.kind) {
    case NodeKind::Assign: assign(as<AssignStmt>(s)); return true;
    case NodeKind::CallStmt: return callStmt(as<CallStmt>(s));
    case NodeKind::If: return ifStmt(as<IfStmt>(s));
    case NodeKind::CompactIf: {
        const auto& compact = as<CompactIfStmt>(s);
        if (compact.condition) expressions_.condition(*compact.condition, "IF");
        Stmt* body = compact.body;
        if (body) routines_.block(StmtList(&body, 1));
        return true;
    }
    case NodeKind::For: return forStmt(as<ForStmt>(s));
    case NodeKind::While: return whileStmt(as<WhileStmt>(s));
    case NodeKind::Test: return testStmt(as<TestStmt>(s));
    case NodeKind::Goto: {
        const auto& jump = as<GotoStmt>(s);
        if (isName(jump.label))
            routine_.gotos.push_back({idOf(jump.label), routine_.block, routine_.part, &s, nullptr});
        return false;
    }
    case NodeKind::Label: jumps_.labelStmt(as<LabelStmt>(s)); return true;
    case NodeKind::Return: flow_.returnStmt(as<ReturnStmt>(s)); return false;
    case NodeKind::Raise: flow_.raiseStmt(as<RaiseStmt>(s)); return false;
    case NodeKind::Connect: flow_.connectStmt(as<ConnectStmt>(s)); return true;
    case NodeKind::Retry:
    case NodeKind::TryNext:
        if (routine_.part != Part::Error)
            report(say::OutsideErrorHandler, range(s.first),
                   {s.kind == NodeKind::Retry ? "RETRY" : "TRYNEXT"});
        return false;
    case NodeKind::Exit: return false;
    case NodeKind::Break:
        if (callsOldProcedure(s)) return true;
        loopWord(s, "BREAK");
        routine_.breakSeen = true;
        return false;
    case NodeKind::Continue:
        if (callsOldProcedure(s)) return true;
        loopWord(s, "CONTINUE");
        return false;
    case NodeKind::PlaceholderStmt:
        routine_.broken = true; // it may be the RETURN
        return true;
    case NodeKind::DeclStmt: { // its place was reported by the parser
        const DataDecl* decl = as<DeclStmt>(s).decl;
        if (!decl || !isName(decl->name)) return true;
        routines_.declareRoutineData(*decl);
        data_.ensureValue(*context_.routine->data.back());
        context_.constant = false;
        return true;
    }
    case NodeKind::ErrorStmt: routine_.broken = true; return true;
    default: return true;
    }
}

/// `Continue;` in a file of an older system, for which the word is not reserved, calls the procedure of that name if another
/// file declares one. The parser has dealt with procedures of the same file.
bool Statements::callsOldProcedure(const Stmt& s) {
    if (!SourceFile::isLegacyFileType(context_.tree->source->path())) return false;
    RoutineSymbol* routine = asRoutine(scopes_.lookup(idOf(s.first)));
    if (!routine || routine->routineKind != RoutineKind::Proc) return false;
    report(
        say::LaterReservedWord, range(s.first),
        {s.kind == NodeKind::Break ? "BREAK" : "CONTINUE",
         std::string(reservedSince(s.kind == NodeKind::Break ? TokenKind::KwBreak : TokenKind::KwContinue))});
    scopes_.markUsed(*routine);
    calls_.bindCall(s, *routine, s.first, {});
    return true;
}

void Statements::loopWord(const Stmt& s, const char* word) {
    if (routine_.loopDepth != 0) return;
    diag::Diagnostic& d = report(say::OutsideLoop, range(s.first), {word});
    if (s.kind == NodeKind::Break)
        d.fixes.push_back({"write DebugBreak to stop there for debugging, as BREAK did up to RobotWare 7.0",
                           {{range(s.first), "DebugBreak"}},
                           false});
}

bool Statements::ifStmt(const IfStmt& s) {
    bool completes = !s.hasElse;
    bool first = true;
    for (const IfBranch* branch : s.branches) {
        if (branch->condition) expressions_.condition(*branch->condition, first ? "IF" : "ELSEIF");
        completes |= routines_.block(branch->body);
        first = false;
    }
    if (s.hasElse) completes |= routines_.block(s.elseBody);
    return completes;
}

bool Statements::whileStmt(const WhileStmt& s) {
    bool forever = false;
    if (s.condition) {
        expressions_.condition(*s.condition, "WHILE");
        const ConstValue* value = info(*s.condition).constant;
        forever = value && value->kind == ConstValue::Kind::Bool && value->boolean;
    }
    const bool outerBreak = std::exchange(routine_.breakSeen, false);
    ++routine_.loopDepth;
    routines_.block(s.body);
    --routine_.loopDepth;
    const bool left = std::exchange(routine_.breakSeen, outerBreak);
    return !forever || left;
}

// The loop variable is declared by FOR, read-only, and hides other names inside the loop.
bool Statements::forStmt(const ForStmt& s) {
    const auto bound = [&](const Expr* e, const char* what) {
        if (!e) return;
        const Typed t = expressions_.expr(*e);
        if (t.isError()) return;
        if (!expressions_.fits(*e, t, {program_.num, 0, {}}))
            report(say::ForBoundType, range(*e), {what, typeName(*t.info)}, {Misfit::Type, *e});
    };
    bound(s.from, "start value");
    bound(s.to, "end value");
    bound(s.step, "step");
    const ConstValue* step = s.step ? info(*s.step).constant : nullptr;
    if (step && step->kind == ConstValue::Kind::Number && step->number == 0)
        report(say::ZeroStep, range(*s.step));

    RoutineSymbol& routine = *context_.routine;
    DataSymbol* variable = nullptr;
    Symbol* hidden = nullptr;
    if (isName(s.variable)) {
        variable = &fill(facts().locals.emplace_back(), SymbolKind::Data, s, s.variable, false);
        variable->storage = Storage::LoopVariable;
        variable->type = {program_.num, 0, {}};
        variable->progress = variable->valueProgress = Progress::Done;
        variable->routine = &routine;
        variable->index = static_cast<uint32_t>(routine.params.size() + routine.data.size());
        routine.data.push_back(variable);
        facts().loopVariables[&s] = variable;
        hidden = at(state_.routineNames, variable->nameId);
        put<Symbol>(state_.routineNames, variable->nameId, variable);
    }
    const bool outerBreak = std::exchange(routine_.breakSeen, false);
    ++routine_.loopDepth;
    routines_.block(s.body);
    --routine_.loopDepth;
    routine_.breakSeen = outerBreak;
    if (variable) put(state_.routineNames, variable->nameId, hidden);
    return true;
}

// Values of all cases first: a group signal as subject takes its numeric type from them.
void Statements::testValues(const TestStmt& s, Typed subject) {
    std::vector<std::pair<const Expr*, Typed>> values;
    // The type of the subject changes when a value decides between num and dnum.
    const bool known = !subject.isError();
    for (const TestCase* c : s.cases) {
        for (const Expr* value : c->values) {
            const Typed t = expressions_.expr(*value, &subject.info->type());
            if (t.isError() || !known) continue;
            const bool decides = subject.flex != Flex::None && t.flex == Flex::None &&
                                 t.info->type().rank == 0 && t.info->type().type->isNumeric();
            if (decides) {
                expressions_.settle(*s.subject, t.base());
                subject.flex = Flex::None;
            }
            values.push_back({value, t});
        }
    }
    std::unordered_set<std::string> seen;
    for (const auto& [value, t] : values) {
        if (!expressions_.fits(*value, t, subject.info->type())) {
            const auto names = typeNames(t.info->type(), subject.info->type());
            const Remedy remedy = remedies_.remedyFor(*value, t.info->type(), subject.info->type());
            remedies_.offer(
                report(say::TestValueType, range(*value), {names[0], names[1]}, {Misfit::Type, *value}),
                *value, remedy);
            continue;
        }
        const ConstValue* constant = info(*value).constant;
        if (!constant || constant->kind == ConstValue::Kind::Aggregate ||
            constant->kind == ConstValue::Kind::None)
            continue;
        std::string key = constant->kind == ConstValue::Kind::Number ? fmt::format("{}", constant->number)
                          : constant->kind == ConstValue::Kind::Bool ? (constant->boolean ? "T" : "F")
                                                                     : std::string(constant->text());
        if (!seen.insert(std::move(key)).second) report(say::DuplicateCase, range(*value), {text(*value)});
    }
}

bool Statements::testStmt(const TestStmt& s) {
    Typed subject;
    if (s.subject) {
        subject = expressions_.expr(*s.subject);
        const DataType& type = subject.info->type();
        if (!subject.isError() && (type.rank > 0 || !isValueType(*type.type))) {
            report(say::TestSubjectType, range(*s.subject), {typeName(type)});
            subject = expressions_.errorExpr(*s.subject);
        }
        testValues(s, subject);
    }
    bool completes = !s.hasDefault;
    for (const TestCase* c : s.cases)
        completes |= routines_.block(c->body);
    if (s.hasDefault) completes |= routines_.block(s.defaultBody);
    return completes;
}

void Statements::assign(const AssignStmt& s) {
    if (!s.target || !s.value) return;
    if (!isPlaceExpr(*s.target)) {
        expressions_.visitLoose(*s.target);
        expressions_.visitLoose(*s.value);
        return;
    }
    if (assignsResult(*s.target)) {
        expressions_.visitLoose(*s.value);
        return;
    }
    const Place target = places_.place(*s.target);
    if (!target.root || !assignable(target, *s.target)) {
        expressions_.visitLoose(*s.value);
        return;
    }
    scopes_.markAssigned(*target.root);
    const DataType want = info(*s.target).type();
    const Typed value = expressions_.expr(*s.value, &want);
    if (expressions_.fits(*s.value, value, want)) return;
    const std::string conversion = numDnumRemedy(value, want);
    const auto names = typeNames(value.info->type(), want);
    if (!conversion.empty()) {
        remedies_.fixCall(report(say::NumDnumAssign, range(*s.value), {names[0], names[1], conversion},
                                 {Misfit::Type, *s.value}),
                          *s.value, conversion, conversion == "NumToDnum");
        return;
    }
    const Remedy remedy = remedies_.remedyFor(*s.value, value.info->type(), want);
    diag::Diagnostic& d =
        report(say::AssignType, range(*s.value), {names[0], names[1]}, {Misfit::Type, *s.value});
    remedies_.offer(d, *s.value, remedy);
    noteDeclared(d, *target.root);
}

namespace {

/// Names that other languages use for the result of a function.
bool isWordForResult(std::string_view folded) {
    return folded == "result" || folded == "ret" || folded == "retval" || folded == "returnvalue";
}

/// The instruction that does what an assignment to a signal was meant to do: a variable of the program may have been meant to
/// be connected.
std::string waysToSet(KnownType signal, bool isVariable) {
    const std::string_view connecting = isVariable ? " to set it, AliasIO to connect it" : "";
    switch (signal) {
    case KnownType::DigitalInput:
    case KnownType::GroupInput:
    case KnownType::AnalogInput: return "AliasIO to connect it, inputs are read-only";
    case KnownType::AnalogOutput: return fmt::format("SetAO{}", connecting);
    case KnownType::GroupOutput: return fmt::format("SetGO{}", connecting);
    default: return fmt::format("SetDO{}", connecting);
    }
}

} // namespace

// "Sum := a + b;" in function Sum, as other languages give back a value.
bool Statements::assignsResult(const Expr& target) {
    if (target.kind != NodeKind::Name || !isName(as<NameExpr>(target).name)) return false;
    const TokenIndex token = as<NameExpr>(target).name;
    const NameId name = idOf(token);
    const Symbol* symbol = scopes_.lookup(name);
    if (!context_.routine || context_.routine->routineKind != RoutineKind::Func) return false;
    if (!symbol && isWordForResult(names_.folded(name))) {
        unknown_.reportUnknown(say::UnknownName, token, name, Wanted::Data,
                               "; a function gives its value by RETURN");
        scopes_.declareUnknown(name);
        routine_.broken = true; // as below
        return true;
    }
    if (!symbol || symbol != context_.routine) return false;
    report(say::FunctionAssigned, range(target), {text(target)});
    routine_.broken = true; // the missing RETURN is the same mistake
    return true;
}

bool Statements::assignable(const Place& place, const Expr& target) {
    const DataSymbol& root = *place.root;
    const Type& type = *info(target).type().type;
    const bool parameter = root.storage == Storage::Parameter;
    if (type.kind == TypeKind::Switch) {
        report(say::SwitchAsValue, range(target), {text(target)}); // no value to assign either
    } else if (type.kind == TypeKind::SemiValue) {
        const bool isVariable = root.storage == Storage::ModuleData || root.storage == Storage::RoutineData;
        report(say::AssignSignal, range(target), {text(target), waysToSet(type.base()->known, isVariable)});
    } else if (root.storage == Storage::SystemVariable) {
        report(say::AssignReadOnly, range(target), {root.name});
    } else if (root.storage == Storage::LoopVariable) {
        noteDeclared(report(say::AssignLoopVariable, range(target), {root.name}), root);
    } else if (root.dataKind == DataKind::Const && !parameter) {
        if (root.init) // without a value CONST itself is the mistake
            noteDeclared(report(say::AssignConstant, range(target), {root.name}, {Misfit::Access, target}),
                         root);
    } else if (!isValueType(type) && type.kind != TypeKind::AnyType) {
        report(say::AssignNonValue, range(target), {text(target), type.name});
    } else {
        return true;
    }
    return false;
}

// "CALL name;"
bool Statements::isCallWord(const CallStmt& s) {
    if (names_.folded(idOf(s.name)) != "call" || s.args.size() != 1) return false;
    const Expr* value = s.args[0]->value;
    TokenIndex name = kNoToken; // CALL work; CALL work(1);
    if (value && value->kind == NodeKind::Name) name = as<NameExpr>(*value).name;
    if (value && value->kind == NodeKind::Call) name = as<CallExpr>(*value).name;
    if (!isName(name)) return false;
    const RoutineSymbol* routine = asRoutine(scopes_.lookup(idOf(name)));
    return routine && routine->routineKind == RoutineKind::Proc;
}

// "again;" in a routine with "GOTO again;"
bool Statements::reportLabelWithoutColon(const CallStmt& s) {
    const std::span<const Token> tokens = context_.tree->tokens;
    if (!s.args.empty() || !context_.routine->routineDecl || tokens[s.last].kind != TokenKind::Semicolon)
        return false;
    if (!std::exchange(routine_.jumpNamesKnown, true)) {
        routine_.jumpNames.clear();
        const RoutineDecl& routine = *context_.routine->routineDecl;
        for (TokenIndex i = routine.first; i < routine.last; ++i)
            if (tokens[i].kind == TokenKind::KwGoto && isName(i + 1)) routine_.jumpNames.insert(idOf(i + 1));
    }
    const NameId name = idOf(s.name);
    if (!routine_.jumpNames.contains(name) || routine_.labelNames.find(name)) return false;
    report(say::UnexpectedToken, range(s.last), {"';'", "':' after a label"}).fix(range(s.last), ":");
    LabelSymbol& symbol = fill(facts().labels.emplace_back(), SymbolKind::Label, s, s.name, false);
    symbol.routine = context_.routine;
    routine_.labels.push_back({name, routine_.block, routine_.part, &s, &symbol});
    routine_.labelNames.set(name, &symbol);
    return true;
}

// Words in a line without a semicolon, none of which is known: the parser has missed the semicolon.
bool Statements::isLineOfText(const CallStmt& s) {
    if (context_.tree->tokens[s.last].kind == TokenKind::Semicolon) return false;
    return std::all_of(s.args.begin(), s.args.end(), [&](const Argument* arg) {
        return arg->value && arg->value->kind == NodeKind::Name && isName(as<NameExpr>(*arg->value).name) &&
               !scopes_.lookup(idOf(as<NameExpr>(*arg->value).name));
    });
}

bool Statements::namesProcedure(std::span<Argument* const> args) {
    if (args.size() != 1 || !args[0]->value || args[0]->value->kind != NodeKind::Name) return false;
    const TokenIndex name = as<NameExpr>(*args[0]->value).name;
    const RoutineSymbol* routine = isName(name) ? asRoutine(scopes_.lookup(idOf(name))) : nullptr;
    return routine && routine->routineKind == RoutineKind::Proc;
}

bool Statements::callStmt(const CallStmt& s) {
    if (s.lateName) {
        calls_.lateCall(s);
        return true;
    }
    if (!isName(s.name)) {
        calls_.visitArguments(s.args);
        return true;
    }
    const NameId name = idOf(s.name);
    Symbol* symbol = scopes_.lookup(name);
    RoutineSymbol* routine = asRoutine(symbol);
    if (!routine || routine->routineKind != RoutineKind::Proc) {
        if (!symbol && isParenthesised(s)) reportParentheses(s);
        if (symbol) {
            reportNotCallable(*symbol, s.name);
        } else if (isCallWord(s)) {
            report(say::ForeignSpelling, range(s.name), {text(s.name), "the name of the procedure"})
                .fix({range(s.name).begin, range(s.args[0]->first).begin}, "");
            return true;
        } else if (isLineOfText(s) || reportLabelWithoutColon(s)) {
            return true;
        } else {
            const Meant meant =
                unknown_.reportUnknown(say::UnknownProcedure, s.name, name, Wanted::Procedure);
            if (meant == Meant::Keyword) routine_.broken = true; // and its arguments are none
            if (meant == Meant::Elsewhere) calls_.lateCall(s);   // looked for when it is executed
            if (meant != Meant::Unknown) return true;
        }
        if (!namesProcedure(s.args)) calls_.visitArguments(s.args); // "irq IDelete;"
        return true;
    }
    scopes_.markUsed(*routine);
    availability_.checkOption(*routine, s.name);
    if (isParenthesised(s)) reportParentheses(s);
    calls_.bindCall(s, *routine, s.name, s.args);
    if (routine_.part == Part::Undo) flow_.callInUndo(*routine, s.name);
    if (flow_.movesRobot(*routine) && task_.task->type != "NORMAL")
        report(say::MotionInBackgroundTask, range(s.name),
               {text(s.name), task_.task->name, task_.task->type});
    if (routine->role == Role::RaiseToUser) raiseToUser(s);
    if (routine->role == Role::CyclicBool) CyclicCondition(state_).check(s);
    return !routine->predefined || predefinedCall(*routine, s.name);
}

// Anywhere else, and without a switch, the system handler takes over (manual 1.12).
void Statements::raiseToUser(const CallStmt& s) {
    if (routine_.part != Part::Error || !context_.routine->noStepIn)
        report(say::RaiseToUserPlace, range(s.name), {text(s.name)});
    const auto isSwitch = [](const BoundArg& arg) {
        return arg.param->isSwitch && arg.kind != BoundArg::Kind::Absent;
    };
    const auto args = facts().calls[&s].args;
    if (std::none_of(args.begin(), args.end(), isSwitch))
        report(say::RaiseToUserSwitch, range(s.name), {text(s.name)});
}

// Predefined procedures that belong to the flow of control: RETRY in disguise, and those that do not come back.
bool Statements::predefinedCall(const RoutineSymbol& routine, TokenIndex name) {
    if (routine.flow == Flow::Retries && routine_.part != Part::Error)
        report(say::OutsideErrorHandler, range(name), {text(name)});
    return routine.flow == Flow::Continues || routine.flow == Flow::Stops;
}

/// `name();` and `name(a, b);`: the parentheses are not part of an argument.
bool Statements::isParenthesised(const CallStmt& s) const {
    const TokenIndex open = s.name + 1;
    return context_.tree->tokens[open].kind == TokenKind::LeftParen &&
           (s.args.empty() || s.args.front()->first != open);
}

void Statements::reportParentheses(const CallStmt& s) {
    const SyntaxTree& tree = *context_.tree;
    const TokenIndex open = s.name + 1, close = s.last - 1;
    diag::Diagnostic& d = report(say::CallParentheses, range(open), {text(s.name)});
    if (tree.tokens[s.last].kind != TokenKind::Semicolon || tree.tokens[close].kind != TokenKind::RightParen)
        return;
    const bool spaced = range(open).begin > range(s.name).end || close == open + 1;
    d.fixes.push_back({"remove the parentheses", {{range(open), spaced ? "" : " "}, {range(close), ""}}});
}

// "p;x := 1;" for "p.x := 1;", and "Move p1;v100;" for "Move p1,v100;", where it has been said what is missing.
bool Statements::isCutBySemicolon(const Symbol& symbol, TokenIndex name) {
    DataSymbol* data = asData(const_cast<Symbol*>(&symbol));
    if (!data) return false;
    const auto& all = (reports_.collected() ? *reports_.collected() : state_.sink).all();
    const SourceRange own = range(name);
    if (!all.empty() && all.back().code == say::MissingArgument.code &&
        all.back().file == context_.tree->source && all.back().range.begin < own.begin &&
        context_.tree->tokens[name - 1].kind == TokenKind::Semicolon) {
        const std::string_view between =
            context_.tree->source->text().substr(all.back().range.begin, own.begin - all.back().range.begin);
        if (between.find('\n') == std::string_view::npos) return true;
    }
    data_.ensureData(*data);
    const SourceRange sign = range(name + 1);
    const TokenIndex part = name + 2;
    if (context_.tree->tokens[name + 1].kind != TokenKind::Semicolon || !isName(part) ||
        sign.begin != own.end || range(part).begin != sign.end || data->type.rank > 0 ||
        data->type.type->kind != TypeKind::Record || scopes_.lookup(idOf(part)) ||
        data->type.type->findComponent(context_.tree->text(part)) < 0)
        return false;
    report(say::UnexpectedToken, sign, {"';'", "'.' before a component"}).fix(sign, ".");
    scopes_.declareUnknown(idOf(part));
    return true;
}

void Statements::reportNotCallable(const Symbol& symbol, TokenIndex name) {
    const auto* routine = asRoutine(const_cast<Symbol*>(&symbol));
    if (routine && routine->routineKind == RoutineKind::Func)
        noteDeclared(report(say::FunctionAsInstruction, range(name), {text(name)}), symbol);
    else if (routine)
        noteDeclared(report(say::TrapCalled, range(name), {text(name)}), symbol);
    else if (!isCutBySemicolon(symbol, name))
        noteDeclared(report(say::NotAProcedure, range(name), {text(name), describe(symbol)}), symbol);
}

} // namespace rapid::sema

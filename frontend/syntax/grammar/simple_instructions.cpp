// Assignments, calls, and instructions of one word and an operand (manual 1.1.5, 1.4, 1.5, 1.11, 1.12).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <utility>

namespace rapid::syntax {

Stmt* InstructionParser::parseAssignment(Expr* target, TokenIndex first) {
    auto* node = make<AssignStmt>(NodeKind::Assign);
    const size_t unreadable = reports().unreadable();
    node->first = first;
    node->target = target;
    if (kind() == K::Equal) {
        signs().reportEqual();
        take();
    } else if (!accept(K::Assign) && !panic()) {
        missing("':='");
    }
    const bool valueLost = ahead().beginsInstruction() || (!isName(kind()) && !startsExpression(kind()));
    if (valueLost && foreign().negatesByComment(";")) {
        node->value = expressions().errorExpr();
        node->broken = true;
        return finish(node);
    }
    node->value = panic() ? expressions().errorExpr() : expressions().parseExpression();
    const bool named =
        node->value->kind == NodeKind::Name && kind() != K::Semicolon && startsExpression(kind());
    sync().endInstruction(named ? "';', or '(' before the arguments of a function" : "';'");
    node->broken = reports().unreadable() > unreadable;
    return finish(node);
}

/// `n : = 1;`, `n : 1;`
Stmt* InstructionParser::parseColonAssignment() {
    const TokenIndex name = pos();
    auto* target = makeExpr<NameExpr>(NodeKind::Name);
    target->name = take();
    finish(target);
    recovery().repair(Place::Assignment);
    return parseAssignment(target, name);
}

Stmt* InstructionParser::parseLabel() {
    auto* node = make<LabelStmt>(NodeKind::Label);
    node->name = take();
    names().checkNameLength(node->name);
    take();
    return finish(node);
}

Stmt* InstructionParser::parseProcedureCall() {
    auto* node = make<CallStmt>(NodeKind::CallStmt);
    node->name = take();
    if (ahead().calleeEndsHere(node->name, node->name)) {
        fix(reports().reportUnfinishedLine(node->name), endOf(node->name), ";");
        return finish(node);
    }
    if (kind() == K::LeftParen && parseParenthesisedCall(node)) return finish(node);
    if (kind() == K::Error) { // reported; perhaps no call at all
        sync().skipInstruction();
        return errorStmt(node->name);
    }
    const size_t errorsBefore = reports().errors();
    const size_t unreadable = reports().unreadable();
    node->args = expressions().parseArguments(true);
    if (!panic() && !node->args.empty() && isName(kind()) && peek() == K::Assign && !startsLine(pos())) {
        unexpected("'\\' or ','"); // "Move 1 speed:=2;"
    }
    if (kind() != K::Semicolon && !panic() && reports().errors() == errorsBefore &&
        recovery().repair({.place = Place::AfterCall, .word = node->name}))
        return parseEffectiveInstruction();
    if (node->args.empty() && ahead().atReservedName()) { // an argument
        node->args = {};
        report(say::ReservedWordAsName, pos(), {std::string(tokenText(kind()))});
        startPanic();
    }
    sync().endInstruction(node->args.empty() ? "an argument or ';'" : "',' or ';'");
    node->broken = reports().unreadable() > unreadable;
    return finish(node);
}

/// `name(a, b);` and `name();`, which is wrong; the checker says so, because it knows whether `name` is a procedure.
/// `name(a);` and `name(a), b;` are right, since an argument may be in parentheses.
bool InstructionParser::parseParenthesisedCall(CallStmt* call) {
    constexpr TokenIndex kSearch = 500;
    bool several = peek() == K::RightParen;
    uint32_t depth = 0;
    TokenIndex i = pos();
    for (; i < pos() + kSearch; ++i) {
        const K k = kindAt(i);
        if (k == K::Semicolon || k == K::EndOfFile) return false;
        if (kOpenBrackets.has(k)) ++depth;
        if (kCloseBrackets.has(k) && --depth == 0) break;
        if (depth == 1 && (k == K::Comma || k == K::Backslash)) several = true;
    }
    if (!several || kindAt(i + 1) != K::Semicolon) return false;
    const TokenIndex opening = take();
    call->args = expressions().parseArguments(true);
    sync().expectClosing(K::RightParen, opening, true);
    sync().endInstruction();
    return true;
}

/// `%"proc" + NumToStr(i, 0)% x, y;`
Stmt* InstructionParser::parseLateBoundCall() {
    auto* node = make<CallStmt>(NodeKind::CallStmt);
    const TokenIndex opening = take();
    const bool outer = std::exchange(block().inLateName, true);
    node->lateName = expressions().parseExpression();
    block().inLateName = outer;
    sync().expectClosing(K::Percent, opening, false);
    if (!panic() && !ahead().calleeEndsHere(opening, pos() - 1))
        node->args = expressions().parseArguments(true);
    sync().endInstruction(node->args.empty() ? "an argument or ';'" : "',' or ';'");
    return finish(node);
}

Stmt* InstructionParser::parseGoto() {
    auto* node = make<GotoStmt>(NodeKind::Goto);
    take();
    node->label = names().expectNameHere();
    sync().endInstruction();
    return finish(node);
}

/// RETURN and RAISE with an optional value.
Stmt* InstructionParser::parseReturnOrRaise(bool isReturn) {
    Expr* value = nullptr;
    const size_t unreadable = reports().unreadable();
    const TokenIndex first = take();
    constexpr TokenSet kSigns = {K::Assign, K::Equal, K::Colon};
    if (kSigns.has(kind()) && !startsLine(pos()) && startsExpression(peek()) &&
        !startsLine(pos() + 1)) { // RETURN = x;
        fix(report(say::UnexpectedToken, pos(), {describe(pos()), "a value after " + describe(first)}),
            {range(pos()).begin, range(pos() + 1).begin}, range(first).end == range(pos()).begin ? " " : "");
        take();
    }
    const bool valueBelow =
        isReturn && block().routineEnd == K::KwEndfunc && isName(kind()) && peek() == K::Semicolon;
    if (kind() != K::Semicolon && startsExpression(kind()) &&
        (valueBelow || !ahead().calleeEndsHere(first, first)) &&
        !(startsLine(pos()) && isName(kind()) && (peek() == K::Assign || peek() == K::Colon)))
        value = expressions().parseExpression();
    Stmt* result;
    if (isReturn) {
        auto* node = make<ReturnStmt>(NodeKind::Return);
        node->value = value;
        result = node;
    } else {
        auto* node = make<RaiseStmt>(NodeKind::Raise);
        node->value = value;
        result = node;
    }
    result->first = first;
    if (isReturn && !value && !panic() && kind() == K::KwEndfunc) missing("an expression");
    sync().endInstruction(value ? "';'" : "an expression or ';'");
    const bool unfinished = !value && kindAt(pos() - 1) != K::Semicolon;
    result->broken = unfinished || reports().unreadable() > unreadable;
    return finish(result);
}

Stmt* InstructionParser::parseConnect() {
    auto* node = make<ConnectStmt>(NodeKind::Connect);
    take();
    if (isName(kind())) {
        node->target = expressions().parseVariableOrCall(false);
    } else if (kind() == K::PlaceVar) {
        node->target = expressions().parsePrimary();
    } else {
        missing("an interrupt variable");
        node->target = expressions().errorExpr();
    }
    if (!panic()) {
        if (kind() == K::Identifier && isName(peek()))
            recovery().repair({.place = Place::Word, .expected = K::KwWith});
        if (accept(K::KwWith)) {
            node->trap = names().expectNameHere();
            skipTrapArguments();
        } else {
            missing("WITH");
        }
    }
    sync().endInstruction();
    return finish(node);
}

/// "CONNECT i WITH t();": it is named, not called.
void InstructionParser::skipTrapArguments() {
    if (panic() || kind() != K::LeftParen || startsLine(pos())) return;
    TokenIndex last = pos() + 1;
    constexpr TokenIndex kFarthest = 100;
    while (kindAt(last) != K::RightParen && last < pos() + kFarthest && !startsLine(last))
        ++last;
    if (kindAt(last) != K::RightParen || kindAt(last + 1) != K::Semicolon) return;
    const SourceRange whole{range(pos()).begin, range(last).end};
    fix(report(say::UnexpectedToken, pos(), {"'('", "';': a trap routine is named, not called"}), whole, "");
    moveTo(last + 1);
}

Stmt* InstructionParser::parseWordInstruction(NodeKind nodeKind) {
    auto* node = make<SimpleStmt>(nodeKind);
    take();
    sync().endInstruction();
    return finish(node);
}

} // namespace rapid::syntax

// IF, FOR, WHILE and TEST (manual 1.4.2).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <fmt/format.h>
#include <utility>

namespace rapid::syntax {

Stmt* BlockParser::parseIf() {
    const TokenIndex opening = take();
    const Restore outerCondition(block().inCondition);
    const Restore outerHead(block().inHead);
    block().inCondition = block().inHead = true;
    TokenIndex found = 0;
    const bool hidden = !ahead().findOnLine(pos(), K::KwThen, found) && foreign().negatesByComment("THEN");
    const bool forgotten = !hidden && ahead().missesCondition();
    if (forgotten)
        fix(report(say::UnexpectedToken, pos(), {describe(pos()), "a condition after IF"}),
            {range(opening).begin, range(pos()).begin}, "", false);
    Expr* condition = hidden || forgotten ? expressions().errorExpr() : expressions().parseCondition();
    block().inCondition = outerCondition.saved();
    block().inHead = outerHead.saved();
    if (forgotten) return parseCompactIf(opening, condition);
    if (kind() == K::Identifier && ahead().endsLine(pos()))
        recovery().repair({.place = Place::Word, .expected = K::KwThen});
    if (kind() == K::KwDo && isOtherBlock(opening)) return parseWhileBody(opening, condition, true);
    const bool isBlock = hidden || kind() == K::KwThen || kind() == K::Colon || kind() == K::LeftBrace ||
                         (kind() == K::KwDo && startsLine(pos() + 1));
    if (isBlock || ahead().findOnLine(pos(), K::KwThen, found))
        return parseIfBranches(opening, condition, hidden);
    if (isBlockByMargin(opening)) return parseIfBranches(opening, condition, true);
    if (kind() == K::KwCase && isOtherBlock(opening)) return parseTestCases(opening, condition, true);
    return parseCompactIf(opening, condition);
}

/// Whether the word that began the block was meant as that of another one, and is read so now.
bool BlockParser::isOtherBlock(TokenIndex opening) {
    return recovery().repair({.place = Place::BlockHead, .word = opening});
}

Stmt* BlockParser::parseCompactIf(TokenIndex opening, Expr* condition) {
    auto* node = make<CompactIfStmt>(NodeKind::CompactIf);
    node->first = opening;
    node->condition = condition;
    const TokenIndex bodyFirst = pos();
    if (!panic()) {
        block().compactIf = opening;
        block().compactIfEnd = startsLine(pos()) ? pos() - 1 : kNoToken;
        const K k = kind();
        const bool canStart = k == K::PlaceVar || k == K::PlaceSmt || k == K::Identifier ||
                              (!kListStops.has(k) && k != K::Semicolon);
        if (canStart && (!startsExpression(k) || isName(k) || k == K::PlaceVar)) {
            node->body = instructions().parseInstruction();
            if (kind() == K::KwElse) parseElseOfCompact(opening);
            return finish(node);
        }
        const SourceRange place = startsLine(pos()) && pos() > 0 ? endOf(pos() - 1) : range(pos());
        if (kind() != K::Error)
            reportAt(say::MissingBlockWord, place, {describe(pos()), "THEN or an instruction"});
    }
    if (!kListStops.has(kind())) sync().skipInstruction();
    endPanic();
    node->body = instructions().errorStmt(bodyFirst);
    return finish(node);
}

/// THEN is missing where the line ends with the condition (and perhaps ';'), and what follows further to the right is
/// closed by an ENDIF, ELSE or ELSEIF below the IF.
bool BlockParser::isBlockByMargin(TokenIndex opening) {
    if (panic() || reports().isFull()) return false;
    const TokenIndex first = kind() == K::Semicolon ? pos() + 1 : pos();
    if (!startsLine(first) || startsLine(pos()) != (first == pos()) || !startsLine(opening)) return false;
    block().countEndifs();
    if (first == pos() && block().missingEndifs >= 0) return false; // they are all of other blocks
    const uint32_t margin = columnOf(opening);
    constexpr TokenIndex kSearch = 500;
    for (TokenIndex i = first; i < first + kSearch && i < lastToken(); ++i) {
        if (!startsLine(i) || columnOf(i) > margin) continue;
        if (i == first || columnOf(i) != margin || !kIfWords.has(kindAt(i))) return false;
        ++block().missingEndifs;
        const SourceRange place = first == pos() ? endOf(pos() - 1) : range(pos());
        diag::Diagnostic* diagnostic = reportAt(say::MissingBlockWord, place, {describe(pos()), "THEN"});
        fix(diagnostic, place, " THEN");
        note(diagnostic, i, fmt::format("this {} belongs to a block, which begins with THEN", describe(i)));
        moveTo(first);
        return true;
    }
    return false;
}

/// `IF a b := 1; ELSE b := 2;`: the ELSE is in the line of an IF without THEN, or below it, and in no other IF.
void BlockParser::parseElseOfCompact(TokenIndex opening) {
    const bool below = startsLine(pos());
    if (block().opening != kNoToken && kindAt(block().opening) == K::KwIf) return; // it may be of that one
    if (below && (!startsLine(opening) || columnOf(pos()) != columnOf(opening))) return;
    note(report(say::StrayKeyword, pos(), {describe(pos()), "IF ... THEN"}), opening,
         "this IF has no THEN, so it ends with one instruction");
    if (below) {
        instructions().parseOrphan();
        return;
    }
    take();
    if (!kListStops.has(kind()) || kind() == K::Identifier) instructions().parseInstruction();
    if (kind() == K::KwEndif && !startsLine(pos())) take();
}

Stmt* BlockParser::parseIfBranches(TokenIndex opening, Expr* condition, bool headRead) {
    const Restore restore(block().opening);
    block().opening = opening;
    auto* node = make<IfStmt>(NodeKind::If);
    node->first = opening;
    const size_t bottom = branches_.size();

    auto* branch = make<IfBranch>(NodeKind::IfBranch);
    branch->first = opening;
    branch->condition = condition;
    bool braced = false;
    const std::string bracesOf = "THEN: the instructions of IF end with ENDIF";
    bool allWhole = kind() != K::Colon; // "if a:": a language without END words
    if (!headRead && kind() != K::LeftBrace) sync().expectWord(K::KwThen);
    branch->body = foreign().parseBody(kIfEnds, bracesOf, braced);
    branches_.push_back(finish(branch));
    const TokenIndex outer = restore.saved();
    while (kind() != K::KwEndif && kIfEnds.has(kind())) {
        // A second ELSE below the IF around this one belongs to that: the ENDIF is missing.
        if (node->hasElse && outer != kNoToken && kindAt(outer) == K::KwIf && startsLine(pos()) &&
            columnOf(pos()) == columnOf(outer) && columnOf(pos()) != columnOf(opening))
            break;
        if (node->hasElse) report(say::InstructionAfterElse, pos(), {describe(pos())});
        if (kind() == K::KwElse && isSplitElseif()) {
            typos().readAsKeyword(pos(), pos() + 1, K::KwElseif);
            take();
        }
        if (kind() == K::KwElse) recovery().repair(Place::Branch);
        if (accept(K::KwElse)) {
            signs().takesColonAs("");
            if (kind() == K::KwThen) recovery().repair(Place::ElseBody);
            const StmtList body = foreign().parseBody(kIfEnds, bracesOf, braced);
            if (!node->hasElse) node->elseBody = body;
            node->hasElse = true;
            continue;
        }
        branch = make<IfBranch>(NodeKind::IfBranch);
        if (take(), kindAt(pos() - 1) == K::KwElseif) {
            bool whole = true;
            const bool hidden = foreign().negatesByComment("THEN");
            branch->condition =
                hidden ? expressions().errorExpr() : parseHeadExpr(whole, HeadPart::Condition);
            if (!hidden && kind() != K::LeftBrace)
                allWhole = sync().expectHeadWord(K::KwThen, whole) && allWhole;
        }
        branch->body = foreign().parseBody(kIfEnds, bracesOf, braced);
        branches_.push_back(finish(branch));
    }
    ends().closeBracedBlock(K::KwEndif, opening, allWhole, braced);
    node->branches = drain(branches_, bottom);
    return finish(node);
}

/// "ELSE IF" in one line, in a routine that has fewer ENDIF than this takes: one word is meant.
bool BlockParser::isSplitElseif() {
    if (peek() != K::KwIf || startsLine(pos() + 1)) return false;
    block().countEndifs();
    if (block().missingEndifs <= 0) return false;
    --block().missingEndifs;
    return true;
}

Stmt* BlockParser::parseFor() {
    const Restore restore(block().opening);
    auto* node = make<ForStmt>(NodeKind::For);
    const TokenIndex opening = block().opening = take();
    bool whole = true; // once the head is broken, the rest of it is not missed
    if (foreign().parseForeignFor(node)) return parseForBody(node, opening, false);
    recovery().repair({.place = Place::Counter, .word = opening});
    if (kindAt(opening) == K::KwWhile) return parseWhile(opening);
    if (foreign().parseForIn(node)) return parseForBody(node, opening, false);
    const bool counterless =
        kind() == K::NumLiteral && peek() == K::KwTo && !startsLine(pos()); // FOR 1 TO 3 DO
    if (counterless) {
        report(say::UnexpectedToken, pos(), {describe(pos()), "the name of the loop variable, and FROM"});
        whole = true;
    } else if (kind() == K::KwFrom && peek() != K::KwFrom) {
        report(say::UnexpectedToken, pos(), {describe(pos()), "a name"});
    } else if (ahead().beginsInstruction()) {
        node->variable = names().missingName();
        whole = false;
    } else {
        node->variable = names().expectName();
        names().checkNameLength(node->variable);
    }
    if (!counterless && !recovery().repair(Place::AfterCounter))
        whole = sync().expectHeadWord(K::KwFrom, whole);
    node->from = parseHeadExpr(whole);
    if (whole && !panic() && kind() == K::KwDo) {
        report(say::MissingBlockWord, pos(), {describe(pos()), "TO and the end value"});
        node->to = expressions().errorExpr();
    } else {
        whole = sync().expectHeadWord(K::KwTo, whole);
        node->to = parseHeadExpr(whole);
    }
    if (!panic() && whole && kind() == K::Identifier && !startsLine(pos()))
        recovery().repair({.place = Place::Word, .expected = K::KwStep});
    if (!panic() && whole && accept(K::KwStep)) node->step = parseHeadExpr(whole);
    if (kind() != K::LeftBrace) whole = sync().expectHeadWord(K::KwDo, whole);
    return parseForBody(node, opening, whole);
}

Stmt* BlockParser::parseForBody(ForStmt* node, TokenIndex opening, bool whole) {
    bool braced = !whole; // the head has been reported
    node->body = foreign().parseBody({K::KwEndfor}, "DO: the instructions of FOR end with ENDFOR", braced);
    ends().closeBracedBlock(K::KwEndfor, opening, whole, braced);
    return finish(node);
}

Stmt* BlockParser::parseWhile() {
    return parseWhile(take());
}

Stmt* BlockParser::parseWhile(TokenIndex opening) {
    const Restore restore(block().opening);
    block().opening = opening;
    bool whole = true;
    TokenIndex found = 0;
    const bool hidden = !ahead().findOnLine(pos(), K::KwDo, found) && foreign().negatesByComment("DO");
    Expr* condition = hidden ? expressions().errorExpr() : parseHeadExpr(whole, HeadPart::Condition);
    if (!panic() && kind() == K::Semicolon && foreign().isForeignCloser(opening)) { // DO ... WHILE condition;
        block().foreignCloser = {};
        take();
        return instructions().errorStmt(opening);
    }
    if (kind() == K::KwThen && isOtherBlock(opening)) return parseIfBranches(opening, condition, false);
    if (!hidden && kind() != K::LeftBrace) whole = sync().expectHeadWord(K::KwDo, whole);
    return parseWhileBody(opening, condition, whole);
}

Stmt* BlockParser::parseWhileBody(TokenIndex opening, Expr* condition, bool whole) {
    const Restore restore(block().opening);
    block().opening = opening;
    auto* node = make<WhileStmt>(NodeKind::While);
    node->first = opening;
    node->condition = condition;
    if (kindAt(pos() - 1) != K::KwDo) accept(K::KwDo);
    bool braced = false;
    node->body =
        foreign().parseBody({K::KwEndwhile}, "DO: the instructions of WHILE end with ENDWHILE", braced);
    ends().closeBracedBlock(K::KwEndwhile, opening, whole, braced);
    return finish(node);
}

Stmt* BlockParser::parseTest() {
    const Restore restore(block().opening);
    const TokenIndex opening = block().opening = take();
    bool whole = true;
    Expr* subject = parseHeadExpr(whole);
    return parseTestCases(opening, subject, whole);
}

Stmt* BlockParser::parseTestCases(TokenIndex opening, Expr* subject, bool whole) {
    const Restore restore(block().opening);
    block().opening = opening;
    auto* node = make<TestStmt>(NodeKind::Test);
    node->first = opening;
    node->subject = subject;
    const size_t bottom = cases_.size();
    if (!whole && !kTestEnds.has(kind())) return finish(node);
    if (!panic() && !kTestEnds.has(kind()) && !startsLine(pos()) && startsLine(pos() + 1) &&
        kTestEnds.has(peek())) { // TEST n OF
        if (!reports().joinLastEdit(say::MisspeltKeyword.code, range(pos()), ""))
            fix(report(say::UnexpectedToken, pos(), {describe(pos()), "CASE"}), range(pos()), "");
        take();
    }
    if (panic()) sync().skipInstruction();
    if (!kTestEnds.has(kind()) && kind() != K::EndOfFile) {
        auto* lost = make<TestCase>(NodeKind::TestCase);
        const TokenIndex at = pos();
        const size_t errorsBefore = reports().errors();
        lost->body = instructions().parseInstructions(kTestEnds);
        if (!lost->body.empty()) {
            if (reports().errors() == errorsBefore) report(say::InstructionOutsideCase, at);
            if (kRoutineEnds.has(kind())) whole = false; // nothing of TEST but its first line
            cases_.push_back(finish(lost));
        }
    }
    while (kind() != K::KwEndtest && kTestEnds.has(kind())) {
        if (node->hasDefault) report(say::CaseAfterDefault, pos(), {describe(pos())});
        if (peek() == K::KwElse) recovery().repair(Place::Branch);
        if (kind() != K::KwDefault) {
            cases_.push_back(parseCase());
            continue;
        }
        take();
        signs().expectColonOfDefault();
        const StmtList body = instructions().parseInstructions(kTestEnds);
        if (!node->hasDefault) node->defaultBody = body;
        node->hasDefault = true;
    }
    ends().closeBlock(K::KwEndtest, opening, whole);
    node->cases = drain(cases_, bottom);
    return finish(node);
}

TestCase* BlockParser::parseCase() {
    auto* node = make<TestCase>(NodeKind::TestCase);
    if (take(), kindAt(pos() - 1) == K::KwCase) {
        const size_t bottom = nodes().exprs.size();
        const Restore outer(block().inCaseValue);
        block().inCaseValue = true;
        bool whole = true;
        do
            nodes().exprs.push_back(parseHeadExpr(whole, HeadPart::CaseValue));
        while (whole && !panic() && (accept(K::Comma) || recovery().repair(Place::CaseValue)));
        block().inCaseValue = outer.saved();
        node->values = drain(nodes().exprs, bottom);
        TokenIndex found = 0;
        if (whole && !accept(K::Colon)) {
            const bool later = ahead().findOnLine(pos(), K::Colon, found) && !startsLine(found);
            const bool isForColon = kind() == K::Semicolon || kind() == K::KwThen ||
                                    ((kind() == K::Equal || kind() == K::Assign) && startsLine(pos() + 1));
            if (startsLine(pos()) && pos() > 0) {
                fix(reportAt(say::UnexpectedToken, endOf(pos() - 1), {describe(pos()), "':'"}),
                    endOf(pos() - 1), ":");
            } else if (kind() != K::Error) {
                diag::Diagnostic* d = report(say::UnexpectedToken, pos(), {describe(pos()), "',' or ':'"});
                if (isForColon) fix(d, range(pos()), ":");
            }
            if (later) {
                moveTo(found + 1);
            } else if (isForColon) { // "CASE 1;"
                take();
            } else if (panic()) {
                sync().skipInstruction();
            }
            endPanic();
        }
    }
    node->body = instructions().parseInstructions(kTestEnds);
    return finish(node);
}

/// An expression in the head of a block. It may go over lines, but the next instruction is none.
Expr* BlockParser::parseHeadExpr(bool& whole, HeadPart part) {
    if (!whole) return expressions().errorExpr();
    if (ahead().beginsInstruction(part == HeadPart::CaseValue)) {
        reportAt(say::UnexpectedToken, endOf(pos() - 1), {describe(pos()), "an expression"});
        whole = false;
        return expressions().errorExpr();
    }
    const bool outer = std::exchange(block().inHead, true);
    Expr* expr =
        part == HeadPart::Condition ? expressions().parseCondition() : expressions().parseExpression();
    block().inHead = outer;
    if (panic() && (startsLine(pos()) || kind() == K::EndOfFile)) {
        whole = false;
        endPanic();
    }
    return expr;
}

} // namespace rapid::syntax

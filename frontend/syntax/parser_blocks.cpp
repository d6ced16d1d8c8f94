// IF, FOR, WHILE and TEST (manual 1.4.2).

#include "frontend/syntax/parser_impl.h"

#include <fmt/format.h>

#include <utility>

namespace rapid::syntax {

using diag::Code;

Stmt* Parser::parseIf() {
    const TokenIndex opening = take();
    const Restore outerCondition(inCondition_);
    const Restore outerHead(inHead_);
    inCondition_ = inHead_ = true;
    TokenIndex found = 0;
    const bool hidden = !findOnLine(pos_, K::KwThen, found) && negatesByComment("THEN");
    const bool forgotten = !hidden && missesCondition();
    if (forgotten)
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "a condition after IF"}),
            {tree_.range(opening).begin, tree_.range(pos_).begin}, "", false);
    Expr* condition = hidden || forgotten ? errorExpr() : parseCondition();
    inCondition_ = outerCondition.saved();
    inHead_ = outerHead.saved();
    if (forgotten) return parseCompactIf(opening, condition);
    if (kind() == K::Identifier && endsLine(pos_)) retagIfMeant(K::KwThen);
    if (kind() == K::KwDo && !panic_ &&
        kindAt(unmatchedWord(pos_ + 1)) == K::KwEndwhile) { // IF a DO ... ENDWHILE
        retag(opening, opening, K::KwWhile);
        return parseWhileBody(opening, condition, true);
    }
    const bool isBlock = hidden || kind() == K::KwThen || kind() == K::Colon || kind() == K::LeftBrace ||
                         (kind() == K::KwDo && startsLine(pos_ + 1));
    if (isBlock || findOnLine(pos_, K::KwThen, found)) return parseIfBlocks(opening, condition, hidden);
    if (isBlockByMargin(opening)) return parseIfBlocks(opening, condition, true);
    if (kind() == K::KwCase && startsLine(pos_) && !panic_ && kindAt(opening) == K::KwIf) { // IF n, CASE 1:
        retag(opening, opening, K::KwTest);
        return parseTestCases(opening, condition, true);
    }
    return parseCompactIf(opening, condition);
}

Stmt* Parser::parseCompactIf(TokenIndex opening, Expr* condition) {
    auto* node = make<CompactIfStmt>(NodeKind::CompactIf);
    node->first = opening;
    node->condition = condition;
    const TokenIndex bodyFirst = pos_;
    if (!panic_) {
        compactIf_ = opening;
        compactIfEnd_ = startsLine(pos_) ? pos_ - 1 : kNoToken;
        const K k = kind();
        const bool canStart = k == K::PlaceVar || k == K::PlaceSmt || k == K::Identifier ||
                              (!kListStops.has(k) && k != K::Semicolon);
        if (canStart && (!startsExpr(k) || isName(k) || k == K::PlaceVar)) {
            node->body = parseStmt();
            if (kind() == K::KwElse) parseElseOfCompact(opening);
            return finish(node);
        }
        const SourceRange place = startsLine(pos_) && pos_ > 0 ? endOf(pos_ - 1) : tree_.range(pos_);
        if (kind() != K::Error)
            reportAt(Code::MissingBlockWord, place, {describe(pos_), "THEN or an instruction"});
    }
    if (!kListStops.has(kind())) syncStatement();
    panic_ = false;
    node->body = errorStmt(bodyFirst);
    return finish(node);
}

/// "IF SetDO do1, 1;", "IF TPWrite "a";": an instruction without THEN, and no condition before it.
bool Parser::missesCondition() const {
    constexpr TokenSet kLiterals = {K::NumLiteral, K::StringLiteral, K::KwTrue, K::KwFalse};
    TokenIndex then = 0;
    if (!isName(kind()) || startsLine(pos_) || startsLine(pos_ + 1)) return false;
    const bool call = kLiterals.has(peek()) || (isName(peek()) && peek(2) == K::Comma);
    return call && !findOnLine(pos_, K::KwThen, then);
}

/// THEN is missing where the line ends with the condition (and perhaps ';'), and what follows further to the right is
/// closed by an ENDIF, ELSE or ELSEIF below the IF.
bool Parser::isBlockByMargin(TokenIndex opening) {
    if (panic_ || errors_ > kMaxErrorsPerFile) return false;
    const TokenIndex first = kind() == K::Semicolon ? pos_ + 1 : pos_;
    if (!startsLine(first) || startsLine(pos_) != (first == pos_) || !startsLine(opening)) return false;
    countEndifs();
    if (first == pos_ && missingEndifs_ >= 0) return false; // they are all of other blocks
    const uint32_t margin = columnOf(opening);
    constexpr TokenIndex kSearch = 500;
    for (TokenIndex i = first; i < first + kSearch && i < last_; ++i) {
        if (!startsLine(i) || columnOf(i) > margin) continue;
        constexpr TokenSet kOfIf = {K::KwEndif, K::KwElse, K::KwElseif};
        if (i == first || columnOf(i) != margin || !kOfIf.has(kindAt(i))) return false;
        ++missingEndifs_;
        const SourceRange place = first == pos_ ? endOf(pos_ - 1) : tree_.range(pos_);
        diag::Diagnostic* diagnostic = reportAt(Code::MissingBlockWord, place, {describe(pos_), "THEN"});
        fix(diagnostic, place, " THEN");
        note(diagnostic, i, fmt::format("this {} belongs to a block, which begins with THEN", describe(i)));
        pos_ = first;
        return true;
    }
    return false;
}

/// `IF a b := 1; ELSE b := 2;`: the ELSE stands in the line of an IF without THEN, or below it, and in no other IF.
void Parser::parseElseOfCompact(TokenIndex opening) {
    const bool below = startsLine(pos_);
    if (blockOpening_ != kNoToken && kindAt(blockOpening_) == K::KwIf) return; // it may be of that one
    if (below && (!startsLine(opening) || columnOf(pos_) != columnOf(opening))) return;
    note(report(Code::StrayKeyword, pos_, {describe(pos_), "IF ... THEN"}), opening,
         "this IF has no THEN, so it ends with one instruction");
    if (below) {
        parseOrphan();
        return;
    }
    take();
    if (!kListStops.has(kind()) || kind() == K::Identifier) parseStmt();
    if (kind() == K::KwEndif && !startsLine(pos_)) take();
}

/// `headRead`: THEN has been lost in a comment, or its absence reported.
Stmt* Parser::parseIfBlocks(TokenIndex opening, Expr* condition, bool headRead) {
    const Restore restore(blockOpening_);
    blockOpening_ = opening;
    auto* node = make<IfStmt>(NodeKind::If);
    node->first = opening;
    const size_t mark = branches_.size();

    auto* branch = make<IfBranch>(NodeKind::IfBranch);
    branch->first = opening;
    branch->condition = condition;
    bool braced = false;
    const std::string bracesOf = "THEN: the instructions of IF end with ENDIF";
    bool allWhole = kind() != K::Colon; // "if a:": a language without END words
    if (!headRead && kind() != K::LeftBrace) expectWord(K::KwThen);
    branch->body = parseBody(kIfEnds, bracesOf, braced);
    branches_.push_back(finish(branch));
    const TokenIndex outer = restore.saved();
    while (kind() != K::KwEndif && kIfEnds.has(kind())) {
        // A second ELSE that stands below the IF around this one belongs to that: the ENDIF is missing.
        if (node->hasElse && outer != kNoToken && kindAt(outer) == K::KwIf && startsLine(pos_) &&
            columnOf(pos_) == columnOf(outer) && columnOf(pos_) != columnOf(opening))
            break;
        if (node->hasElse) report(Code::InstructionAfterElse, pos_, {describe(pos_)});
        if (kind() == K::KwElse && isSplitElseif()) {
            retag(pos_, pos_ + 1, K::KwElseif);
            ++pos_;
        }
        if (TokenIndex then = 0; kind() == K::KwElse && !startsLine(pos_ + 1) && peek() != K::KwIf &&
                                 peek() != K::KwThen && findOnLine(pos_ + 1, K::KwThen, then))
            retag(pos_, pos_, K::KwElseif);
        if (accept(K::KwElse)) {
            takesColonAs("");
            if (kind() == K::KwThen && !startsLine(pos_)) {
                fix(report(Code::StrayKeyword, pos_, {"THEN", "IF"}), tree_.range(pos_), "");
                take();
            }
            const StmtList body = parseBody(kIfEnds, bracesOf, braced);
            if (!node->hasElse) node->elseBody = body;
            node->hasElse = true;
            continue;
        }
        branch = make<IfBranch>(NodeKind::IfBranch);
        if (take(), tokens_[pos_ - 1].kind == K::KwElseif) {
            bool whole = true;
            const bool hidden = negatesByComment("THEN");
            branch->condition = hidden ? errorExpr() : parseHeadExpr(whole, HeadPart::Condition);
            if (!hidden && kind() != K::LeftBrace) allWhole = expectHeadWord(K::KwThen, whole) && allWhole;
        }
        branch->body = parseBody(kIfEnds, bracesOf, braced);
        branches_.push_back(finish(branch));
    }
    closeBracedBlock(K::KwEndif, opening, allWhole, braced);
    node->branches = drain(branches_, mark);
    return finish(node);
}

/// How many ENDIF the routine lacks; below 0: it has too many.
void Parser::countEndifs() {
    if (std::exchange(endifsCounted_, true)) return;
    constexpr TokenSet kStop = {K::KwEndproc, K::KwEndfunc,   K::KwEndtrap, K::KwProc,   K::KwFunc,
                                K::KwTrap,    K::KwEndmodule, K::KwModule,  K::EndOfFile};
    missingEndifs_ = 0;
    for (TokenIndex i = routineStart_; !kStop.has(kindAt(i)); ++i) {
        TokenIndex then = 0;
        if (kindAt(i) == K::KwIf && findOnLine(i + 1, K::KwThen, then)) ++missingEndifs_;
        if (kindAt(i) == K::KwEndif) --missingEndifs_;
    }
}

/// "ELSE IF" in one line, in a routine that has fewer ENDIF than this takes: one word is meant.
bool Parser::isSplitElseif() {
    if (peek() != K::KwIf || startsLine(pos_ + 1)) return false;
    countEndifs();
    if (missingEndifs_ <= 0) return false;
    --missingEndifs_;
    return true;
}

Stmt* Parser::parseFor() {
    const Restore restore(blockOpening_);
    auto* node = make<ForStmt>(NodeKind::For);
    const TokenIndex opening = blockOpening_ = take();
    bool whole = true; // once the head is broken, the rest of it is not missed
    if (parseForeignFor(node)) return parseForBody(node, opening, false);
    if (isWhileWrittenFor()) {
        retag(opening, opening, K::KwWhile);
        return parseWhile(opening);
    }
    if (takesForeignCounter(node)) return parseForBody(node, opening, false);
    const bool counterless =
        kind() == K::NumLiteral && peek() == K::KwTo && !startsLine(pos_); // FOR 1 TO 3 DO
    if (counterless) {
        report(Code::UnexpectedToken, pos_, {describe(pos_), "the name of the loop variable, and FROM"});
        whole = true;
    } else if (kind() == K::KwFrom && peek() != K::KwFrom) {
        report(Code::UnexpectedToken, pos_, {describe(pos_), "a name"});
    } else if (beginsInstruction()) {
        node->variable = missingName();
        whole = false;
    } else {
        if (isName(kind()) && isName(peek()) && !startsLine(pos_ + 1) && peek(2) == K::KwFrom) {
            fix(report(Code::UnexpectedToken, pos_,
                       {describe(pos_), "the name of the loop variable, which FOR declares by itself"}),
                {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "");
            take();
        }
        node->variable = expectName();
        checkNameLength(node->variable);
    }
    if (counterless) {
    } else if (!panic_ && (kind() == K::Assign || kind() == K::Equal)) { // FOR i := 1 TO 5 DO
        diag::Diagnostic* diagnostic = report(Code::MissingBlockWord, pos_, {describe(pos_), "FROM"});
        const bool before = tree_.range(pos_ - 1).end < tree_.range(pos_).begin;
        const bool behind = tree_.range(pos_).end < tree_.range(pos_ + 1).begin;
        fix(diagnostic, tree_.range(pos_), std::string(before ? "" : " ") + "FROM" + (behind ? "" : " "));
        take();
    } else {
        whole = expectHeadWord(K::KwFrom, whole);
    }
    node->from = parseHeadExpr(whole);
    if (whole && !panic_ && kind() == K::KwDo) {
        report(Code::MissingBlockWord, pos_, {describe(pos_), "TO and the end value"});
        node->to = errorExpr();
    } else {
        whole = expectHeadWord(K::KwTo, whole);
        node->to = parseHeadExpr(whole);
    }
    if (!panic_ && whole && kind() == K::Identifier && !startsLine(pos_)) retagIfMeant(K::KwStep);
    if (!panic_ && whole && accept(K::KwStep)) node->step = parseHeadExpr(whole);
    if (kind() != K::LeftBrace) whole = expectHeadWord(K::KwDo, whole);
    return parseForBody(node, opening, whole);
}

Stmt* Parser::parseForBody(ForStmt* node, TokenIndex opening, bool whole) {
    bool braced = !whole; // the head has been reported
    node->body = parseBody({K::KwEndfor}, "DO: the instructions of FOR end with ENDFOR", braced);
    closeBracedBlock(K::KwEndfor, opening, whole, braced);
    return finish(node);
}

/// A condition behind FOR, and ENDWHILE below.
bool Parser::isWhileWrittenFor() const {
    constexpr TokenSet kHead = {K::KwFrom, K::Assign, K::KwTo};
    if (panic_ || startsLine(pos_)) return false;
    TokenIndex i = pos_;
    constexpr TokenIndex kLongHead = 200;
    while (!startsLine(i + 1) && kindAt(i) != K::KwDo) {
        if (kHead.has(kindAt(i)) || i > pos_ + kLongHead) return false;
        ++i;
    }
    return kindAt(i) == K::KwDo && i > pos_ && kindAt(unmatchedWord(i)) == K::KwEndwhile;
}

Stmt* Parser::parseWhile() {
    return parseWhile(take());
}

/// Behind the word, which has been read.
Stmt* Parser::parseWhile(TokenIndex opening) {
    const Restore restore(blockOpening_);
    blockOpening_ = opening;
    bool whole = true;
    TokenIndex found = 0;
    const bool hidden = !findOnLine(pos_, K::KwDo, found) && negatesByComment("DO");
    Expr* condition = hidden ? errorExpr() : parseHeadExpr(whole, HeadPart::Condition);
    if (!panic_ && kind() == K::Semicolon && isForeignCloser(opening)) { // DO ... WHILE condition;
        foreignCloser_ = {};
        take();
        return errorStmt(opening);
    }
    if (!panic_ && kind() == K::KwThen &&
        kIfEnds.has(kindAt(unmatchedWord(pos_ + 1)))) { // WHILE a THEN ... ENDIF
        retag(opening, opening, K::KwIf);
        return parseIfBlocks(opening, condition, false);
    }
    if (!hidden && kind() != K::LeftBrace) whole = expectHeadWord(K::KwDo, whole);
    return parseWhileBody(opening, condition, whole);
}

/// From behind DO, or at a DO that has not been read yet.
Stmt* Parser::parseWhileBody(TokenIndex opening, Expr* condition, bool whole) {
    const Restore restore(blockOpening_);
    blockOpening_ = opening;
    auto* node = make<WhileStmt>(NodeKind::While);
    node->first = opening;
    node->condition = condition;
    if (kindAt(pos_ - 1) != K::KwDo) accept(K::KwDo);
    bool braced = false;
    node->body = parseBody({K::KwEndwhile}, "DO: the instructions of WHILE end with ENDWHILE", braced);
    closeBracedBlock(K::KwEndwhile, opening, whole, braced);
    return finish(node);
}

Stmt* Parser::parseTest() {
    const Restore restore(blockOpening_);
    const TokenIndex opening = blockOpening_ = take();
    bool whole = true;
    Expr* subject = parseHeadExpr(whole);
    return parseTestCases(opening, subject, whole);
}

Stmt* Parser::parseTestCases(TokenIndex opening, Expr* subject, bool whole) {
    const Restore restore(blockOpening_);
    blockOpening_ = opening;
    auto* node = make<TestStmt>(NodeKind::Test);
    node->first = opening;
    node->subject = subject;
    const size_t mark = cases_.size();
    if (!whole && !kTestEnds.has(kind())) return finish(node);
    if (!panic_ && !kTestEnds.has(kind()) && !startsLine(pos_) && startsLine(pos_ + 1) &&
        kTestEnds.has(peek())) { // TEST n OF
        if (!joinLastEdit(Code::MisspeltKeyword, tree_.range(pos_), ""))
            fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "CASE"}), tree_.range(pos_), "");
        take();
    }
    if (panic_) syncStatement();
    if (!kTestEnds.has(kind()) && kind() != K::EndOfFile) {
        auto* lost = make<TestCase>(NodeKind::TestCase);
        const TokenIndex at = pos_;
        const size_t errorsBefore = errors_;
        lost->body = parseList(kTestEnds);
        if (!lost->body.empty()) {
            if (errors_ == errorsBefore) report(Code::InstructionOutsideCase, at);
            if (kRoutineEnds.has(kind())) whole = false; // nothing of TEST but its first line
            cases_.push_back(finish(lost));
        }
    }
    while (kind() != K::KwEndtest && kTestEnds.has(kind())) {
        if (node->hasDefault) report(Code::CaseAfterDefault, pos_, {describe(pos_)});
        if (kind() == K::KwCase && peek() == K::KwElse && peek(2) == K::Colon) {
            retag(pos_, pos_ + 1, K::KwDefault);
            ++pos_;
        }
        if (kind() != K::KwDefault) {
            cases_.push_back(parseCase());
            continue;
        }
        take();
        expectColonOfDefault();
        const StmtList body = parseList(kTestEnds);
        if (!node->hasDefault) node->defaultBody = body;
        node->hasDefault = true;
    }
    closeBlock(K::KwEndtest, opening, whole);
    node->cases = drain(cases_, mark);
    return finish(node);
}

void Parser::expectColonOfDefault() {
    const bool given = std::exchange(colonGiven_, false);
    if (accept(K::Colon) || given) return;
    constexpr TokenSet kForColon = {K::KwThen, K::Equal, K::Assign, K::Comma, K::Semicolon, K::Dot};
    const bool other = kForColon.has(kind()) && !startsLine(pos_) && startsLine(pos_ + 1);
    const SourceRange place = startsLine(pos_) ? endOf(pos_ - 1) : tree_.range(pos_);
    fix(reportAt(Code::UnexpectedToken, place, {describe(pos_), "':'"}),
        other && kind() != K::KwThen ? tree_.range(pos_) : endOf(pos_ - 1), ":");
    if (other) take();
}

/// '=' at the end of the line behind a value of CASE, where the colon stands: an instruction follows, and no operand.
bool Parser::isEqualForColon() const {
    constexpr TokenSet kNoOperator = {K::Identifier, K::NumLiteral, K::StringLiteral, K::Assign,
                                      K::Semicolon};
    if (!startsLine(pos_ + 1)) return false;
    return isName(peek()) ? kNoOperator.has(peek(2)) : isKeyword(peek()) && !startsExpr(peek());
}

/// `CASE 1;2:`
bool Parser::takesSemicolonInCase() {
    TokenIndex colon = 0;
    if (kind() != K::Semicolon || startsLine(pos_ + 1) || !startsExpr(peek()) ||
        !findOnLine(pos_ + 1, K::Colon, colon) || !startsLine(colon + 1))
        return false;
    fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "','"}), tree_.range(pos_), ",");
    take();
    return true;
}

TestCase* Parser::parseCase() {
    auto* node = make<TestCase>(NodeKind::TestCase);
    if (take(), tokens_[pos_ - 1].kind == K::KwCase) {
        const size_t mark = exprs_.size();
        const Restore outer(inCaseValue_);
        inCaseValue_ = true;
        bool whole = true;
        do
            exprs_.push_back(parseHeadExpr(whole, HeadPart::CaseValue));
        while (whole && !panic_ && (accept(K::Comma) || takesSemicolonInCase()));
        inCaseValue_ = outer.saved();
        node->values = drain(exprs_, mark);
        TokenIndex found = 0;
        if (whole && !accept(K::Colon)) {
            const bool later = findOnLine(pos_, K::Colon, found) && !startsLine(found);
            const bool isForColon = kind() == K::Semicolon || kind() == K::KwThen ||
                                    ((kind() == K::Equal || kind() == K::Assign) && startsLine(pos_ + 1));
            if (startsLine(pos_) && pos_ > 0) {
                fix(reportAt(Code::UnexpectedToken, endOf(pos_ - 1), {describe(pos_), "':'"}),
                    endOf(pos_ - 1), ":");
            } else if (kind() != K::Error) {
                diag::Diagnostic* d = report(Code::UnexpectedToken, pos_, {describe(pos_), "',' or ':'"});
                if (isForColon) fix(d, tree_.range(pos_), ":");
            }
            if (later) {
                pos_ = found + 1;
            } else if (isForColon) { // "CASE 1;"
                take();
            } else if (panic_) {
                syncStatement();
            }
            panic_ = false;
        }
    }
    node->body = parseList(kTestEnds);
    return finish(node);
}

} // namespace rapid::syntax

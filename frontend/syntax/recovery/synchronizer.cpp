// Finds a place to continue parsing from after a mistake.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <fmt/format.h>

namespace rapid::syntax {

void Synchronizer::endInstruction(std::string_view expected) {
    if (accept(K::Semicolon)) {
        constexpr TokenSet kClosing = {K::RightParen, K::RightBracket, K::RightBrace};
        if (panic() && kClosing.has(kind()) && !startsLine(pos())) return skipInstruction(); // "Abs(n;);"
        endPanic();
        return;
    }
    if (isMarked(Mark::EarlySemicolon) && !panic()) return;
    if (assignmentBelow()) return skipInstruction();
    if (!panic() && kind() != K::Error) {
        if (block().startsAfresh()) {
            diag::Diagnostic* missing = reports().reportUnfinishedLine(pos() - 1);
            const bool twoWords = pos() > 1 && kindAt(pos() - 1) == K::Identifier &&
                                  kindAt(pos() - 2) == K::Identifier && startsLine(pos() - 2);
            fix(missing, endOf(pos() - 1), ";");
            if (twoWords) reports().countUnreadable();
            if (twoWords) note(missing, pos() - 2, "if this is a remark, put '!' before it");
            if (kLineWords.has(kind()) || ahead().looksLikeInstruction(pos())) return;
        } else if (kind() == K::Equal) {
            signs().reportEqual();
        } else if (!signs().reportDecimalComma()) {
            const std::string_view remedy =
                ahead().quoteInText() ? ": a '\"' inside a text is written twice" : "";
            diag::Diagnostic* d = reports().reportAfterExpr(
                say::UnexpectedToken, {describe(pos()), fmt::format("{}{}", expected, remedy)});
            if ((kind() == K::Colon || kind() == K::Comma) && startsLine(pos() + 1))
                fix(d, range(pos()), ";");
        }
    }
    skipInstruction();
}

void Synchronizer::skipInstruction() {
    endPanic();
    for (; kind() != K::EndOfFile; take()) {
        if (accept(K::Semicolon)) return;
        if (kEndWords.has(kind()) || block().continuesBlock()) return;
        if (startsLine(pos()) && (kLineWords.has(kind()) || ahead().looksLikeInstruction(pos()))) return;
        if (isTaskDirective(pos()) && startsLine(pos())) return;
        // "FI a = b THEN" and the like: the block is there, only its head is broken.
        if ((kind() == K::KwThen || kind() == K::KwDo) && startsLine(pos() + 1)) {
            mark(Mark::BrokenHead);
            return;
        }
    }
}

void Synchronizer::expectWord(K word) {
    constexpr TokenSet kForWord = {K::Identifier, K::KwThen, K::KwDo};
    if (kind() == word ||
        (!panic() && kForWord.has(kind()) && recovery().repair({.place = Place::Word, .expected = word}))) {
        take();
        endPanic();
        if (kind() == K::Colon) signs().takesColonAs("");
        return;
    }
    if (signs().takesColonAs(tokenText(word))) return;
    const bool silent = panic() || kind() == K::Error;
    TokenIndex found = 0;
    const bool later = ahead().findOnLine(pos(), word, found);
    if (!silent) {
        const std::string expected(tokenText(word));
        if (!later && startsLine(pos())) {
            fix(reportAt(say::MissingBlockWord, endOf(pos() - 1), {describe(pos()), expected}),
                endOf(pos() - 1), " " + expected);
        } else {
            report(say::MissingBlockWord, pos(), {describe(pos()), expected});
        }
    }
    endPanic();
    if (later) {
        moveTo(found + 1);
    } else if (silent) {
        while (kind() != K::EndOfFile && !startsLine(pos()) && !kEndWords.has(kind()))
            if (take(), kindAt(pos() - 1) == K::Semicolon) return;
    }
}

bool Synchronizer::expectHeadWord(K word, bool whole) {
    TokenIndex found = 0;
    if (whole) {
        whole = kind() == word || ahead().findOnLine(pos(), word, found);
        expectWord(word);
    } else if (ahead().findOnLine(pos(), word, found)) {
        moveTo(found + 1);
        endPanic();
        return true;
    }
    if (!whole && isName(kind()) && !startsLine(pos()) && (startsLine(pos() + 1) || pos() + 1 == lastToken()))
        take();
    endPanic();
    return whole;
}

void Synchronizer::expectClosing(K closing, TokenIndex opening, bool inList) {
    if (accept(closing)) return;
    if (panic() || assignmentBelow()) return;
    const std::string text(tokenText(closing));
    const std::string expected = inList ? fmt::format("',' or '{}'", text) : fmt::format("'{}'", text);
    diag::Diagnostic* diagnostic = nullptr;
    if (kind() == K::Error ||
        reports().isMarkedAfter(Mark::ForeignList,
                                opening)) { // what was reported in it may have taken the bracket
        reports().unmark(Mark::ForeignList);
        startPanic();
        return;
    }
    if (startsLine(pos())) {
        diagnostic = reportAt(say::MissingClosing, endOf(pos() - 1), {describe(pos()), expected});
    } else {
        diagnostic = reports().reportAfterExpr(say::MissingClosing, {describe(pos()), expected});
    }
    note(diagnostic, opening, fmt::format("the '{}' is here", textOf(opening)));
    startPanic();
}

bool Synchronizer::assignmentBelow() {
    if (panic() || kind() != K::Assign) return false;
    TokenIndex first = pos();
    for (uint32_t k = 0; k < kSearchTokens && first > 0 && !startsLine(first); ++k)
        --first;
    if (first == pos() || !isName(kindAt(first)) || !startsLine(first)) return false;
    constexpr TokenSet kBeforeOperand = {
        K::Assign,  K::Equal,  K::NotEqual, K::Less,  K::LessEqual, K::Greater,   K::GreaterEqual, K::Plus,
        K::Minus,   K::Star,   K::Slash,    K::KwDiv, K::KwMod,     K::KwAnd,     K::KwOr,         K::KwXor,
        K::KwNot,   K::Comma,  K::Dot,      K::KwIf,  K::LeftParen, K::LeftBrace, K::LeftBracket,  K::KwFrom,
        K::KwWhile, K::KwStep, K::KwTest,   K::KwTo,  K::KwElseif,  K::KwReturn,  K::KwRaise};
    if (kindAt(first - 1) == K::LeftBrace && block().braces > 0) return false; // of a block
    if (first <= wentBackTo_ || !kBeforeOperand.has(kindAt(first - 1)))
        return false; // never to a place twice
    for (TokenIndex i = first; i < pos(); ++i)
        if (kindAt(i) == K::Comma || kindAt(i) == K::LeftParen || kindAt(i) == K::Backslash) return false;
    wentBackTo_ = first;
    moveTo(first);
    missing("an expression");
    return true;
}

void Synchronizer::abandonRoutine() {
    block().abandoned = true;
    endPanic();
    while (!kRoutineBorders.has(kind()))
        take();
}

} // namespace rapid::syntax

// Punctuation and operators that other languages, or slips, put in the place of those of RAPID.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

void WrongSigns::reportEqual() {
    const bool turned = peek() == K::Colon && range(pos()).end == range(pos() + 1).begin;
    const SourceRange sign{range(pos()).begin, range(turned ? pos() + 1 : pos()).end};
    if (turned || textOf(pos()) == "==") {
        fix(reportAt(say::ForeignSpelling, sign, {turned ? "=:" : "==", "':='"}), sign, ":=");
        if (turned) take();
    } else {
        fix(report(say::EqualInAssignment, pos()), sign, ":=");
    }
}

bool WrongSigns::takesColonAs(std::string_view word) {
    if (panic() || kind() != K::Colon || startsLine(pos()) || !startsLine(pos() + 1)) return false;
    if (word.empty()) {
        fix(report(say::UnexpectedToken, pos(), {describe(pos()), "an instruction"}), range(pos()), "");
    } else {
        const bool spaced = range(pos() - 1).end < range(pos()).begin;
        const std::string meant = (spaced ? "" : " ") + std::string(word);
        constexpr TokenSet kEnds = kIfEnds | TokenSet{K::KwEndfor, K::KwEndwhile};
        const bool closed = kEnds.has(kindAt(block().unmatchedWord(pos() + 1)));
        if (!reports().joinLastEdit(say::ForeignSpelling.code, range(pos()), meant)) // "if a == b:"
            fix(report(say::MissingBlockWord, pos(), {describe(pos()), std::string(word)}), range(pos()),
                meant, closed);
        else if (!closed)
            reports().last()->fixes.front().certain = false;
    }
    take();
    return true;
}

void WrongSigns::reportSlash(TokenIndex slash) {
    fix(report(say::ForeignSpelling, slash, {"/", "'\\' before an optional argument"}), range(slash), "\\");
}

bool WrongSigns::commaWasSemicolon() {
    const TokenIndex semicolon = pos() - 2;
    if (pos() < 3 || kindAt(semicolon) != K::Semicolon || startsLine(pos() - 1) || nodes().stmts.empty())
        return false;
    Stmt* before = nodes().stmts.back();
    if (before->kind != NodeKind::CallStmt || before->last != semicolon) return false;
    fix(report(say::UnexpectedToken, semicolon, {"';'", "','"}), range(semicolon), ",");
    before->broken = true; // the rest of its arguments is here
    startPanic();
    return true;
}

bool WrongSigns::reportDecimalComma() {
    if (kind() != K::Comma || kindAt(pos() - 1) != K::NumLiteral || peek() != K::NumLiteral) return false;
    const SourceRange whole = range(pos() - 1), decimals = range(pos() + 1), comma = range(pos());
    if (whole.end != comma.begin || comma.end != decimals.begin) return false;
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const std::string_view text = textOf(pos() - 1);
    if (!std::all_of(text.begin(), text.end(), isDigit)) return false;
    const std::string_view shown = sourceText().substr(whole.begin, decimals.end - whole.begin);
    fix(reportAt(say::ForeignSpelling, {whole.begin, decimals.end},
                 {std::string(shown), "'.' before decimals"}),
        comma, ".");
    return true;
}

bool WrongSigns::operandAfterSemicolon() {
    constexpr TokenSet kOperands = {K::Identifier, K::NumLiteral, K::StringLiteral, K::KwTrue, K::KwFalse};
    if (panic() || startsLine(pos()) || !kOperands.has(peek()) || startsLine(pos() + 1) ||
        !startsLine(pos() + 2))
        return false;
    if (diag::Diagnostic* d = report(say::UnexpectedToken, pos(), {describe(pos()), "an expression"}))
        d->fixes.push_back({"write ';' after it", {{range(pos()), ""}, {endOf(pos() + 1), ";"}}});
    reports().forgetUnread();
    take();
    mark(Mark::EarlySemicolon, pos() + 1);
    return true;
}

void WrongSigns::dropEmptyParentheses() {
    const SourceRange both{range(pos()).begin, range(pos() + 1).end};
    if (kind() == K::LeftParen)
        fix(reportAt(say::UnexpectedToken, both, {"'()'", "no parentheses after the name of data"}), both,
            "");
    else
        fix(report(say::ForeignSpelling, pos(),
                   {std::string(textOf(pos())), "'(' before the arguments of a function"}),
            both, "()", false);
    take();
    take();
}

void WrongSigns::expectColonOfDefault() {
    const bool given = isMarked(Mark::ColonGiven, pos() - 1);
    if (accept(K::Colon) || given) return;
    constexpr TokenSet kForColon = {K::KwThen, K::Equal, K::Assign, K::Comma, K::Semicolon, K::Dot};
    const bool other = kForColon.has(kind()) && !startsLine(pos()) && startsLine(pos() + 1);
    const SourceRange place = startsLine(pos()) ? endOf(pos() - 1) : range(pos());
    fix(reportAt(say::UnexpectedToken, place, {describe(pos()), "':'"}),
        other && kind() != K::KwThen ? range(pos()) : endOf(pos() - 1), ":");
    if (other) take();
}

} // namespace rapid::syntax

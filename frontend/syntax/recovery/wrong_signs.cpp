// Punctuation and operators that other languages, or slips, put in the place of those of RAPID.

#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

using diag::Code;

void WrongSigns::reportEqual() {
    const bool turned = peek() == K::Colon && range(pos()).end == range(pos() + 1).begin;
    const SourceRange sign{range(pos()).begin, range(turned ? pos() + 1 : pos()).end};
    if (turned || textOf(pos()) == "==") {
        fix(reportAt(Code::ForeignSpelling, sign, {turned ? "=:" : "==", "':='"}), sign, ":=");
        if (turned) take();
    } else {
        fix(report(Code::EqualInAssignment, pos()), sign, ":=");
    }
}

void WrongSigns::takeColonAsAssign() {
    const bool split = peek() == K::Equal;
    const SourceRange sign{range(pos()).begin, range(split ? pos() + 1 : pos()).end};
    const std::string_view shown = sourceText().substr(sign.begin, sign.end - sign.begin);
    fix(reportAt(Code::ForeignSpelling, sign, {std::string(shown), "':='"}), sign, ":=");
    if (split) take();
    readAs(pos(), K::Assign);
}

bool WrongSigns::takesColonAs(std::string_view word) {
    if (panic() || kind() != K::Colon || startsLine(pos()) || !startsLine(pos() + 1)) return false;
    if (word.empty()) {
        fix(report(Code::UnexpectedToken, pos(), {describe(pos()), "an instruction"}), range(pos()), "");
    } else {
        const bool spaced = range(pos() - 1).end < range(pos()).begin;
        const std::string meant = (spaced ? "" : " ") + std::string(word);
        constexpr TokenSet kEnds = kIfEnds | TokenSet{K::KwEndfor, K::KwEndwhile};
        const bool closed = kEnds.has(kindAt(block().unmatchedWord(pos() + 1)));
        if (!reports().joinLastEdit(Code::ForeignSpelling, range(pos()), meant)) // "if a == b:"
            fix(report(Code::MissingBlockWord, pos(), {describe(pos()), std::string(word)}), range(pos()),
                meant, closed);
        else if (!closed)
            reports().last()->fixes.front().certain = false;
    }
    take();
    return true;
}

void WrongSigns::takesSlashAsBackslash() {
    constexpr TokenSet kAfterName = {K::Assign,     K::Semicolon, K::Comma,
                                     K::RightParen, K::Backslash, K::Question};
    if (kind() != K::Slash || !isName(peek()) || !kAfterName.has(peek(2))) return;
    reportSlash(pos());
    readAs(pos(), K::Backslash);
}

void WrongSigns::reportSlash(TokenIndex slash) {
    fix(report(Code::ForeignSpelling, slash, {"/", "'\\' before an optional argument"}), range(slash), "\\");
}

void WrongSigns::takeSlashAsBackslash() {
    if (!isName(peek())) return;
    fix(report(Code::ForeignSpelling, pos(), {"/", "'\\' before an optional parameter"}), range(pos()), "\\");
    readAs(pos(), K::Backslash);
}

bool WrongSigns::takesSemicolonAsComma(K closing) {
    if (panic() || kind() != K::Semicolon || startsLine(pos() + 1) ||
        (!startsExpr(peek()) && peek() != K::Backslash))
        return false;
    uint32_t depth = 0;
    for (TokenIndex i = pos() + 1; i < pos() + kLongLine && !startsLine(i); ++i) {
        const K k = kindAt(i);
        if (kOpenBrackets.has(k)) ++depth;
        if (k == K::Semicolon || (depth == 0 && k == K::Assign && kindAt(pos() + 1) != K::Backslash))
            return false;
        if (!kCloseBrackets.has(k)) continue;
        if (depth == 0) {
            if (k != closing) return false;
            fix(report(Code::UnexpectedToken, pos(), {describe(pos()), "','"}), range(pos()), ",");
            readAs(pos(), K::Comma);
            return true;
        }
        --depth;
    }
    return false;
}

bool WrongSigns::commaWasSemicolon() {
    const TokenIndex semicolon = pos() - 2;
    if (pos() < 3 || kindAt(semicolon) != K::Semicolon || startsLine(pos() - 1) || nodes().stmts.empty())
        return false;
    Stmt* before = nodes().stmts.back();
    if (before->kind != NodeKind::CallStmt || before->last != semicolon) return false;
    fix(report(Code::UnexpectedToken, semicolon, {"';'", "','"}), range(semicolon), ",");
    before->broken = true; // the rest of its arguments stands here
    startPanic();
    return true;
}

bool WrongSigns::instructionAfterComma() {
    constexpr TokenSet kNoArgument = {K::Identifier, K::NumLiteral, K::StringLiteral};
    if (!kNoArgument.has(peek(2)) || !startsLine(pos() + 1) || startsLine(pos() + 2)) return false;
    fix(report(Code::UnexpectedToken, pos(), {"','", "';'"}), range(pos()), ";");
    readAs(pos(), K::Semicolon);
    return true;
}

bool WrongSigns::takesPercentAsMod() {
    TokenIndex then = 0;
    if (block().inLateName || startsLine(pos()) || !startsExpr(peek())) return false;
    if (block().inCondition && !ahead().findOnLine(pos(), K::KwThen, then)) return false;
    const SourceRange sign = range(pos());
    const bool before = range(pos() - 1).end == sign.begin, after = tokenAt(pos() + 1).offset == sign.end;
    fix(report(Code::ForeignSpelling, pos(), {"%", "MOD"}), sign,
        std::string(before ? " " : "") + "MOD" + (after ? " " : ""));
    readAs(pos(), K::KwMod);
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
    fix(reportAt(Code::ForeignSpelling, {whole.begin, decimals.end},
                 {std::string(shown), "'.' before decimals"}),
        comma, ".");
    return true;
}

bool WrongSigns::operandBehindSemicolon() {
    constexpr TokenSet kOperands = {K::Identifier, K::NumLiteral, K::StringLiteral, K::KwTrue, K::KwFalse};
    if (panic() || startsLine(pos()) || !kOperands.has(peek()) || startsLine(pos() + 1) ||
        !startsLine(pos() + 2))
        return false;
    if (diag::Diagnostic* d = report(Code::UnexpectedToken, pos(), {describe(pos()), "an expression"}))
        d->fixes.push_back({"write ';' behind it", {{range(pos()), ""}, {endOf(pos() + 1), ";"}}});
    reports().forgetUnread();
    take();
    mark(Mark::EarlySemicolon, pos() + 1);
    return true;
}

void WrongSigns::dropEmptyParentheses() {
    const SourceRange both{range(pos()).begin, range(pos() + 1).end};
    if (kind() == K::LeftParen)
        fix(reportAt(Code::UnexpectedToken, both, {"'()'", "no parentheses behind the name of data"}), both,
            "");
    else
        fix(report(Code::ForeignSpelling, pos(),
                   {std::string(textOf(pos())), "'(' before the arguments of a function"}),
            both, "()", false);
    take();
    take();
}

bool WrongSigns::takesSemicolonInCase() {
    TokenIndex colon = 0;
    if (kind() != K::Semicolon || startsLine(pos() + 1) || !startsExpr(peek()) ||
        !ahead().findOnLine(pos() + 1, K::Colon, colon) || !startsLine(colon + 1))
        return false;
    fix(report(Code::UnexpectedToken, pos(), {describe(pos()), "','"}), range(pos()), ",");
    take();
    return true;
}

void WrongSigns::expectColonOfDefault() {
    const bool given = isMarked(Mark::ColonGiven, pos() - 1);
    if (accept(K::Colon) || given) return;
    constexpr TokenSet kForColon = {K::KwThen, K::Equal, K::Assign, K::Comma, K::Semicolon, K::Dot};
    const bool other = kForColon.has(kind()) && !startsLine(pos()) && startsLine(pos() + 1);
    const SourceRange place = startsLine(pos()) ? endOf(pos() - 1) : range(pos());
    fix(reportAt(Code::UnexpectedToken, place, {describe(pos()), "':'"}),
        other && kind() != K::KwThen ? range(pos()) : endOf(pos() - 1), ":");
    if (other) take();
}

} // namespace rapid::syntax

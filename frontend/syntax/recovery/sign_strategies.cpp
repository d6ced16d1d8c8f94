// Signs that slips, or other languages, put in the place of those of RAPID, and comments without '!'.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

namespace {

// ---- Lists -----------------------------------------------------------------------------------------------------

/// "(a; b)": in a list that continues in the same line to its closing bracket.
class SemicolonInList : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation& at) const override {
        const bool optional = peek() == K::Backslash;
        if (panic() || startsLine(pos() + 1) || (!startsExpression(peek()) && !optional)) return {};
        uint32_t depth = 0;
        for (TokenIndex i = pos() + 1; i < pos() + kLongLine && !startsLine(i); ++i) {
            const K k = kindAt(i);
            if (kOpenBrackets.has(k)) ++depth;
            if (k == K::Semicolon || (depth == 0 && k == K::Assign && !optional)) return {};
            if (!kCloseBrackets.has(k) || depth-- > 0) continue;
            if (k != at.expected) return {};
            return sign(K::Comma, say::UnexpectedToken, describe(pos()), "','", ",");
        }
        return {};
    }
};

/// `CASE 1;2:`
class SemicolonInCase : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        TokenIndex colon = 0;
        if (kind() != K::Semicolon || startsLine(pos() + 1) || !startsExpression(peek()) ||
            !ahead().findOnLine(pos() + 1, K::Colon, colon) || !startsLine(colon + 1))
            return {};
        Repair repair = leaveOut(pos() + 1, say::UnexpectedToken, {describe(pos()), "','"}, range(pos()));
        repair.edit->replacement = ",";
        return repair;
    }
};

/// "ConfL/Off;", "CRobT(/Tool:=tool1)" and "num a /num b": nothing there begins with '/'.
class SlashForBackslash : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation& at) const override {
        constexpr TokenSet kAfterOption = {K::Assign,     K::Semicolon, K::Comma,
                                           K::RightParen, K::Backslash, K::Question};
        const bool parameter = at.place == Place::Parameter;
        if (kind() != K::Slash || !isName(peek()) || (!parameter && !kAfterOption.has(peek(2)))) return {};
        return sign(K::Backslash, say::ForeignSpelling, "/",
                    parameter ? "'\\' before an optional parameter" : "'\\' before an optional argument",
                    "\\");
    }
};

/// A comma that ends its line: the line below is an instruction of its own, so ';' was meant.
class CommaAfterCall : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        constexpr TokenSet kNoArgument = {K::Identifier, K::NumLiteral, K::StringLiteral};
        if (!kNoArgument.has(peek(2)) || !startsLine(pos() + 1) || startsLine(pos() + 2)) return {};
        return sign(K::Semicolon, say::UnexpectedToken, "','", "';'", ";");
    }
};

/// ':' and ': =' for ':='.
class ColonForAssign : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        const TokenIndex last = peek() == K::Equal ? pos() + 1 : pos();
        const SourceRange both{range(pos()).begin, range(last).end};
        const auto shown = std::string(sourceText().substr(both.begin, both.end - both.begin));
        Repair repair = sign(K::Assign, say::ForeignSpelling, shown, "':='", ":=");
        repair.last = repair.next = last;
        repair.range = repair.edit->range = both;
        return repair;
    }
};

// ---- Comments --------------------------------------------------------------------------------------------------

/// Text up to the end of the line.
class CommentStrategy : public RecoveryStrategy {
  protected:
    using RecoveryStrategy::RecoveryStrategy;
    /// The words `first` to `last` are reported; `edit` makes a comment of the line.
    Repair comment(TokenIndex last, std::string shown, std::string expected, TextEdit edit) const {
        TokenIndex next = pos() + 1;
        while (!startsLine(next))
            ++next;
        Repair repair =
            leaveOut(next, say::ForeignSpelling, {std::move(shown), std::move(expected)}, edit.range);
        repair.range.end = range(last).end;
        repair.edit = std::move(edit);
        return repair;
    }
};

/// Four words or more in a line, and nothing between them that an instruction has.
class Prose : public CommentStrategy {
    using CommentStrategy::CommentStrategy;
    Proposal propose(const Situation&) const override {
        if (kind() != K::Identifier || !ahead().isProse()) return {};
        const SourceRange words{range(pos()).begin, range(pos() + 1).end};
        Repair repair =
            comment(pos() + 1, std::string(sourceText().substr(words.begin, words.end - words.begin)),
                    "an instruction, or '!' before a comment", {{words.begin, words.begin}, "! "});
        repair.certain = false;
        return repair;
    }
};

/// "-- text"
class DashComment : public CommentStrategy {
    using CommentStrategy::CommentStrategy;
    Proposal propose(const Situation&) const override {
        if (kind() != K::Minus || peek() != K::Minus) return {};
        return comment(pos() + 1, "--", "'!' before a comment",
                       {{range(pos()).begin, range(pos() + 1).end}, "!"});
    }
};

/// "REM text"; with a semicolon it is a call.
class RemComment : public CommentStrategy {
    using CommentStrategy::CommentStrategy;
    Proposal propose(const Situation&) const override {
        if (!isContextual(pos(), "REM") || startsLine(pos() + 1) || peek() == K::Semicolon) return {};
        TokenIndex last = pos();
        while (last < pos() + kLongLine && !startsLine(last + 1))
            ++last;
        if (kindAt(last) == K::Semicolon) return {};
        return comment(pos(), "REM", "'!' before a comment", {range(pos()), "!"});
    }
};

/// `{ text }` in one line, without a semicolon.
class BracedComment : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        TokenIndex close = pos() + 1;
        while (close < pos() + kLongLine && !startsLine(close) && kindAt(close) != K::RightBrace &&
               kindAt(close) != K::Semicolon)
            ++close;
        if (panic() || kindAt(close) != K::RightBrace || startsLine(close) || close == pos() + 1) return {};
        Repair repair = leaveOut(close + 1, say::ForeignSpelling, {"{", "'!' before a comment"}, {});
        repair.edit.reset();
        return repair;
    }
};

} // namespace

void addSignStrategies(StrategyTable& table, Parser& parser) {
    table.add<SemicolonInList>(Place::ListSeparator, parser);
    table.add<SemicolonInCase>(Place::CaseValue, parser);
    table.add<SlashForBackslash>(Place::Argument, parser);
    table.add<SlashForBackslash>(Place::Parameter, parser);
    table.add<CommaAfterCall>(Place::ArgumentComma, parser);
    table.add<ColonForAssign>(Place::Assignment, parser);
    table.add<Prose>(Place::Comment, parser);
    table.add<DashComment>(Place::Comment, parser);
    table.add<RemComment>(Place::Comment, parser);
    table.add<BracedComment>(Place::Braces, parser);
}

} // namespace rapid::syntax

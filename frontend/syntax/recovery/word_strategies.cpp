// Names that were meant as keywords, at the beginning of declarations and instructions and in expressions.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

namespace {

// ---- Declarations ----------------------------------------------------------------------------------------------

/// "END" and "END MODULE" at the end of the file.
class LastEnd : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (!isContextual(pos(), "END")) return {};
        if (peek() == K::EndOfFile) return keyword(pos(), pos(), K::KwEndmodule);
        if (peek() != K::KwModule || peek(2) != K::EndOfFile) return {};
        return keyword(pos(), pos() + 1, K::KwEndmodule);
    }
};

/// GLOBAL or PUBLIC before a declaration.
class WordForGlobal : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (!kDeclarations.has(peek()) || startsLine(pos() + 1)) return {};
        if (!isContextual(pos(), "GLOBAL") && !isContextual(pos(), "PUBLIC")) return {};
        return leaveOut(pos() + 1, say::ForeignSpelling,
                        {std::string(textOf(pos())), describe(pos() + 1) + ": what is not LOCAL is global"},
                        {range(pos()).begin, range(pos() + 1).begin});
    }

  public:
    static constexpr TokenSet kDeclarations = {K::KwVar,  K::KwPers, K::KwConst,  K::KwProc,
                                               K::KwFunc, K::KwTrap, K::KwRecord, K::KwAlias};
};

/// "PORC name(", "TARP name", "LOCLA VAR ...", and a misspelt ENDMODULE.
class MisspeltDeclaration : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        const K second = peek(), third = peek(2);
        if (startsLine(pos() + 1) || second == K::EndOfFile) return nearest(pos(), {K::KwEndmodule});
        if (WordForGlobal::kDeclarations.has(second)) return nearest(pos(), {K::KwLocal});
        if (!isName(second)) return {};
        if (startsLine(pos() + 2)) return nearest(pos(), {K::KwTrap, K::KwRecord, K::KwProc});
        if (third == K::LeftParen) return nearest(pos(), {K::KwProc});
        if (!isName(third)) return {};
        if (peek(3) == K::LeftParen) return nearest(pos(), {K::KwFunc});
        return peek(3) == K::Semicolon ? nearest(pos(), {K::KwAlias}) : Proposal();
    }
};

/// "VRA num x;", "PRES num x := 1;": three names in a row are a declaration.
class MisspeltData : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        constexpr TokenSet kAfter = {K::Semicolon, K::Assign, K::LeftBrace, K::Equal};
        if (!isName(peek()) || !isName(peek(2)) || startsLine(pos() + 2) || !kAfter.has(peek(3))) return {};
        return nearest(pos(), {K::KwVar, K::KwPers, K::KwConst});
    }
};

/// The word of a declaration and what follows it, without a space: "PROCMove(", "VARnum x".
class RunTogether : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation& at) const override {
        if (at.place != Place::Declaration && (!isName(peek()) || peek(2) != K::Assign)) return {};
        for (const K word : {K::KwProc, K::KwFunc, K::KwTrap, K::KwVar, K::KwPers, K::KwConst}) {
            const std::string_view spelling = tokenText(word), text = textOf(pos());
            if (text.size() <= spelling.size() || !equalsNoCase(text.substr(0, spelling.size()), spelling) ||
                !fits(word, text.substr(spelling.size())))
                continue;
            const std::string whole = std::string(spelling).append(" ").append(text.substr(spelling.size()));
            Repair repair =
                sign(word, say::UnexpectedToken, describe(pos()), "'" + whole + "': two words", whole);
            repair.unclear = true;
            repair.mark = Mark::RunTogether;
            return repair;
        }
        return {};
    }
    bool fits(K word, std::string_view rest) const {
        if (kStorageWords.has(word)) return isBasicType(rest) && isName(peek()) && !startsLine(pos() + 1);
        if (word == K::KwFunc) return isBasicType(rest) && isName(peek()) && peek(2) == K::LeftParen;
        return word == K::KwTrap ? startsLine(pos() + 1) : peek() == K::LeftParen;
    }
};

/// "END RECORD", "END" and "ENDRECRD" in a record.
class MisspeltEndrecord : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        const bool end = isContextual(pos(), "END");
        if (end && !startsLine(pos() + 1) && ahead().endsLine(pos() + 1) &&
            (peek() == K::KwRecord || typos().foreignCloserIs(pos() + 1)))
            return keyword(pos(), pos() + 1, K::KwEndrecord);
        if (!ahead().endsLine(pos()) && peek() != K::Semicolon) return {};
        return end ? keyword(pos(), pos(), K::KwEndrecord) : nearest(pos(), {K::KwEndrecord});
    }
};

/// "VAR num x;" in a record that is closed by ENDRECORD.
class WordBeforeComponent : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (!kStorageWords.has(kind()) || !isName(peek()) || !isName(peek(2))) return {};
        constexpr TokenIndex kSearch = 200;
        TokenIndex i = pos() + 1;
        while (i < pos() + kSearch && kindAt(i) != K::KwEndrecord && kindAt(i) != K::EndOfFile &&
               !kRoutineEnds.has(kindAt(i)))
            ++i;
        if (kindAt(i) != K::KwEndrecord) return {};
        return leaveOut(pos() + 1, say::ComponentWord, {describe(pos())},
                        {range(pos()).begin, range(pos() + 1).begin});
    }
};

// ---- Instructions ----------------------------------------------------------------------------------------------

/// "FRO i FROM", "CONECT i WITH".
class MisspeltInstruction : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (peek(2) == K::KwFrom) return nearest(pos(), {K::KwFor});
        const bool with = peek(2) == K::KwWith || (peek(2) == K::Identifier && peek(3) == K::Identifier &&
                                                   typos().editsTo(pos() + 2, K::KwWith) != 0);
        return with ? nearest(pos(), {K::KwConnect}) : Proposal();
    }
};

/// "CALL name 1;"
class WordForCall : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        constexpr TokenSet kArgument = {K::Identifier, K::NumLiteral, K::StringLiteral};
        if (!isContextual(pos(), "CALL") || !kArgument.has(peek(2)) || startsLine(pos() + 1) ||
            startsLine(pos() + 2))
            return {};
        return leaveOut(pos() + 1, say::ForeignSpelling,
                        {std::string(textOf(pos())), "the name of the procedure"},
                        {range(pos()).begin, range(pos() + 1).begin});
    }
};

/// "TRY NEXT;"
class TornTrynext : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (peek(2) != K::Semicolon || !isContextual(pos(), "TRY") || !isContextual(pos() + 1, "NEXT"))
            return {};
        return keyword(pos(), pos() + 1, K::KwTrynext);
    }
};

/// A seeming call is followed by THEN, DO or CASE: the callee was meant as IF, WHILE or TEST.
class MisspeltHead : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation& at) const override {
        const bool test = kind() == K::KwCase && startsLine(pos()) && at.word + 1 < pos();
        const K word = kind() == K::KwThen ? K::KwIf : kind() == K::KwDo ? K::KwWhile : K::KwTest;
        if (word == K::KwTest && !test) return {};
        const unsigned edits = typos().editsTo(at.word, word, test ? 1 : 2);
        return edits != 0 ? keyword(at.word, at.word, word, edits) : Proposal();
    }
};

/// A misspelt word where only this one can be, and THEN and DO one for the other.
class MisspeltExpected : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation& at) const override {
        const bool other = (at.expected == K::KwDo && kind() == K::KwThen) ||
                           (at.expected == K::KwThen && kind() == K::KwDo);
        return other ? keyword(pos(), pos(), at.expected) : nearest(pos(), {at.expected});
    }
};

// ---- Operators -------------------------------------------------------------------------------------------------

/// Whether an operator can be in this place: in an IF without THEN a name begins the instruction instead.
class OperatorStrategy : public RecoveryStrategy {
  protected:
    using RecoveryStrategy::RecoveryStrategy;
    bool continues() const {
        TokenIndex then = 0;
        return !block().inCondition || ahead().findOnLine(pos(), K::KwThen, then);
    }
};

/// "NTO ready": what was read as the operand.
class MisspeltNot : public OperatorStrategy {
    using OperatorStrategy::OperatorStrategy;
    Proposal propose(const Situation& at) const override {
        const TokenIndex first = at.left->first;
        if (at.left->kind != NodeKind::Name || startsLine(pos()) || !startsExpression(kind()) ||
            !typos().isShuffled(first, K::KwNot))
            return {};
        const bool bound =
            block().inHead && block().opening != kNoToken && kindAt(block().opening) == K::KwFor;
        return bound || !continues() ? Proposal() : nearest(first, {K::KwNot});
    }
};

/// Between two operands: "ANDD", "DVI".
class MisspeltOperator : public OperatorStrategy {
    using OperatorStrategy::OperatorStrategy;
    Proposal propose(const Situation&) const override {
        if (kind() != K::Identifier || startsLine(pos()) || startsLine(pos() + 1) ||
            !startsExpression(peek()))
            return {};
        const bool isCall = peek() == K::LeftParen && range(pos()).end == range(pos() + 1).begin;
        if (isCall || !continues()) return {};
        Proposal best;
        for (const K word : {K::KwAnd, K::KwOr, K::KwXor, K::KwDiv, K::KwMod}) {
            Proposal one = typos().isShuffled(pos(), word) ? nearest(pos(), {word}) : Proposal();
            if (one && (!best || one->cost < best->cost)) best = std::move(one);
        }
        return best;
    }
};

/// "5 % 3": not the name of a late-bound call.
class PercentForMod : public OperatorStrategy {
    using OperatorStrategy::OperatorStrategy;
    Proposal propose(const Situation&) const override {
        if (kind() != K::Percent || block().inLateName || startsLine(pos()) || !startsExpression(peek()) ||
            !continues())
            return {};
        const bool before = range(pos() - 1).end == range(pos()).begin;
        const bool after = range(pos() + 1).begin == range(pos()).end;
        return sign(K::KwMod, say::ForeignSpelling, "%", "MOD",
                    std::string(before ? " " : "") + "MOD" + (after ? " " : ""));
    }
};

} // namespace

void addWordStrategies(StrategyTable& table, Parser& parser) {
    table.add<LastEnd>(Place::Declaration, parser);
    table.add<WordForGlobal>(Place::Declaration, parser);
    table.add<MisspeltDeclaration>(Place::Declaration, parser);
    table.add<MisspeltData>(Place::Declaration, parser);
    table.add<RunTogether>(Place::Declaration, parser);
    table.add<MisspeltEndrecord>(Place::Component, parser);
    table.add<WordBeforeComponent>(Place::Component, parser);
    table.add<RunTogether>(Place::Data, parser);
    table.add<MisspeltData>(Place::Data, parser);
    table.add<MisspeltInstruction>(Place::Instruction, parser);
    table.add<WordForCall>(Place::Instruction, parser);
    table.add<RunTogether>(Place::Instruction, parser);
    table.add<MisspeltData>(Place::Instruction, parser);
    table.add<TornTrynext>(Place::Instruction, parser);
    table.add<MisspeltHead>(Place::AfterCall, parser);
    table.add<MisspeltExpected>(Place::Word, parser);
    table.add<MisspeltNot>(Place::Operator, parser);
    table.add<MisspeltOperator>(Place::Operator, parser);
    table.add<PercentForMod>(Place::Operator, parser);
}

} // namespace rapid::syntax

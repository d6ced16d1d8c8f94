// Names and signs that were meant as words which continue or end a list of instructions.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

namespace {

/// Names at the beginning of an instruction.
class ListStrategy : public RecoveryStrategy {
  protected:
    using RecoveryStrategy::RecoveryStrategy;

    /// Whether the name cannot be the first word of an instruction of the program.
    bool mayBeWord() const {
        constexpr TokenSet kUsedAsName = {K::Assign, K::Semicolon, K::Dot,
                                          K::Comma,  K::LeftBrace, K::LeftBracket};
        return textOf(pos()).size() > 2 && !kUsedAsName.has(peek());
    }
    /// Does what follows the words up to `last` agree with this keyword of a list?
    bool fits(K word, TokenIndex last) const {
        TokenIndex found = 0;
        const K next = kindAt(last + 1);
        const bool alone = ahead().endsLine(last);
        switch (word) {
        case K::KwElseif: return !alone && ahead().findOnLine(last + 1, K::KwThen, found);
        case K::KwCase:
            return !alone && next != K::Colon && ahead().findOnLine(last + 1, K::Colon, found) &&
                   !startsLine(found);
        case K::KwDefault: return next == K::Colon;
        case K::KwError: // of a call, the semicolon would follow
            if ((textOf(last)[0] | 32) == 'r') return alone && block().isHandledBelow(last + 1);
            return alone || (next == K::LeftParen && ahead().findOnLine(last + 2, K::RightParen, found) &&
                             startsLine(found + 1));
        default: return alone;
        }
    }
    /// A word for END that ends nothing: reported, and read as an instruction that says nothing.
    Repair strayEnd(diag::Message<2> message, std::string expected, unsigned cost) const {
        Repair repair = leaveOut(pos(), message, {describe(pos()), std::move(expected)}, {});
        repair.cost = cost;
        repair.edit.reset();
        repair.mark = Mark::StrayEnd;
        return repair;
    }
};

/// A piece of the END word of the list: before the next routine, or in line with the word that began the block.
class PieceOfEnd : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        constexpr TokenSet kNext = kAfterRoutine | TokenSet{K::KwLocal};
        const K end = block().endOfOwn(at.own);
        if (panic() || !at.own.has(end) || !typos().isPieceOf(pos(), end)) return {};
        const bool inLine = block().opening != kNoToken && startsLine(block().opening) &&
                            columnOf(pos()) == columnOf(block().opening);
        const bool fits = end == block().routineEnd ? kNext.has(peek()) : inLine && block().closesHere(end);
        return fits ? keyword(pos(), pos(), end) : Proposal();
    }
};

/// "ER" of ERROR.
class PieceOfError : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        if (panic() || !at.own.has(K::KwError) || !typos().isPieceOf(pos(), K::KwError) ||
            !block().isHandledBelow(pos() + 1))
            return {};
        return keyword(pos(), pos(), K::KwError);
    }
};

/// "NEXT i"
class NextWithCounter : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        if (!at.own.has(K::KwEndfor) || peek() != K::Identifier || !isContextual(pos(), "NEXT") ||
            !ahead().endsLine(pos() + 1))
            return {};
        return keyword(pos(), pos() + 1, K::KwEndfor);
    }
};

/// "END IF", "END SWITCH", and "END IF b THEN" for ELSEIF.
class EndAndWord : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        if (!isContextual(pos(), "END") || startsLine(pos() + 1) || !mayBeWord()) return {};
        if (peek() == K::KwIf && at.own.has(K::KwElseif) && fits(K::KwElseif, pos() + 1))
            return keyword(pos(), pos() + 1, K::KwElseif);
        for (const K end : {K::KwEndif, K::KwEndfor, K::KwEndwhile, K::KwEndtest, block().routineEnd}) {
            const bool same = isKeyword(peek()) && tokenText(peek()) == tokenText(end).substr(3);
            if (at.own.has(end) && (same || typos().foreignCloserIs(pos() + 1)) && fits(end, pos() + 1))
                return keyword(pos(), pos() + 1, end);
        }
        return {};
    }
};

/// "END" alone in its line.
class LoneEnd : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        const K end = block().endOfOwn(at.own);
        if (!isContextual(pos(), "END") || !startsLine(pos() + 1) || !mayBeWord() || !at.own.has(end))
            return {};
        if (!block().closesHere(end)) return strayEnd(say::StrayKeyword, "a block", 1);
        return fits(end, pos()) && peek() != K::Colon ? keyword(pos(), pos(), end) : Proposal();
    }
};

/// "ENDIFF", "ELSIF", "CSAE 2:"
class MisspeltListWord : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        if (!mayBeWord()) return {};
        Proposal best;
        for (const K word :
             {K::KwEndif, K::KwEndfor, K::KwEndwhile, K::KwEndtest, block().routineEnd, K::KwElseif,
              K::KwElse, K::KwCase, K::KwDefault, K::KwError, K::KwUndo, K::KwBackward}) {
            if (!at.own.has(word)) continue;
            const bool longer = textOf(pos()).size() > tokenText(word).size();
            if (peek() == K::Colon && (word != K::KwDefault || longer)) continue; // a label
            Proposal one = fits(word, pos()) ? nearest(pos(), {word}) : Proposal();
            if (one && (!best || one->cost < best->cost)) best = std::move(one);
        }
        return best;
    }
};

/// "endfunction" in a PROC: its own END word, unless that is still to come.
class OtherRoutineEnd : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        if (!mayBeWord() || !at.own.has(K::KwEndproc) || !fits(K::KwEndproc, pos())) return {};
        Proposal other = nearest(pos(), {K::KwEndproc, K::KwEndfunc, K::KwEndtrap});
        const K own = block().routineEnd;
        if (!other || other->as == own) return {};
        if (block().endOfRoutineBelow() != own) return keyword(pos(), pos(), own, other->cost);
        return strayEnd(say::UnexpectedToken,
                        "an instruction: " + std::string(tokenText(own)) + " is still to come", other->cost);
    }
};

/// '}' alone in a line, where no '{' began the block.
class BraceForEnd : public ListStrategy {
    using ListStrategy::ListStrategy;
    Proposal propose(const Situation& at) const override {
        const K end = block().endOfOwn(at.own);
        if (panic() || !at.own.has(end) || !startsLine(pos()) || !startsLine(pos() + 1) ||
            !block().closesHere(end))
            return {};
        return keyword(pos(), pos(), end);
    }
};

} // namespace

void addListWordStrategies(StrategyTable& table, Parser& parser) {
    table.add<PieceOfEnd>(Place::ListEnd, parser);
    table.add<PieceOfError>(Place::ListWord, parser);
    table.add<NextWithCounter>(Place::ListWord, parser);
    table.add<EndAndWord>(Place::ListWord, parser);
    table.add<LoneEnd>(Place::ListWord, parser);
    table.add<MisspeltListWord>(Place::ListWord, parser);
    table.add<OtherRoutineEnd>(Place::ListWord, parser);
    table.add<BraceForEnd>(Place::ListBrace, parser);
}

} // namespace rapid::syntax

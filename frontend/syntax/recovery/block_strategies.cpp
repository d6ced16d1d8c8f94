// Heads and branches of blocks: one word written for another one, words too many.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

namespace {

/// "IF a DO ... ENDWHILE", "WHILE a THEN ... ENDIF", and "IF n" above "CASE 1:": the rest of the block shows its kind.
class HeadOfOtherBlock : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation& at) const override {
        const K meant = kindMeant(kindAt(at.word));
        if (panic() || meant == K::EndOfFile) return {};
        Repair repair = keyword(at.word, at.word, meant);
        repair.next = pos();
        return repair;
    }
    K kindMeant(K opener) const {
        const bool isIf = opener == K::KwIf;
        if (isIf && kind() == K::KwCase && startsLine(pos())) return K::KwTest;
        if (kind() != (isIf ? K::KwDo : K::KwThen)) return K::EndOfFile;
        const K end = kindAt(block().unmatchedWord(pos() + 1));
        if (isIf) return end == K::KwEndwhile ? K::KwWhile : K::EndOfFile;
        return opener == K::KwWhile && kIfEnds.has(end) ? K::KwIf : K::EndOfFile;
    }
};

/// A condition after FOR, and ENDWHILE below.
class ForWithCondition : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation& at) const override {
        constexpr TokenSet kHead = {K::KwFrom, K::Assign, K::KwTo};
        constexpr TokenIndex kLongHead = 200;
        if (panic() || startsLine(pos())) return {};
        TokenIndex i = pos();
        for (; !startsLine(i + 1) && kindAt(i) != K::KwDo; ++i)
            if (kHead.has(kindAt(i)) || i > pos() + kLongHead) return {};
        if (kindAt(i) != K::KwDo || i == pos() || kindAt(block().unmatchedWord(i)) != K::KwEndwhile)
            return {};
        Repair repair = keyword(at.word, at.word, K::KwWhile);
        repair.next = pos();
        return repair;
    }
};

/// "FOR VAR num i FROM", "FOR num i FROM"
class DeclaredCounter : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        const bool word = kStorageWords.has(kind()) && isName(peek());
        const bool type = isName(kind()) && isName(peek()) && !startsLine(pos() + 1) &&
                          peek(2) == K::KwFrom && !ahead().beginsInstruction();
        if (panic() || (!word && !type)) return {};
        const TokenIndex name = word && isName(peek(2)) ? pos() + 2 : pos() + 1;
        return leaveOut(name, say::UnexpectedToken,
                        {describe(pos()), "the name of the loop variable, which FOR declares by itself"},
                        {range(pos()).begin, range(name).begin});
    }
};

/// "FOR i IN 1 TO 3 DO"
class InForFrom : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        TokenIndex to = 0;
        if (panic() || !isName(kind()) || !isContextual(pos() + 1, "IN") || startsLine(pos() + 1) ||
            !ahead().findOnLine(pos() + 2, K::KwTo, to))
            return {};
        Repair repair = keyword(pos() + 1, pos() + 1, K::KwFrom);
        repair.next = pos();
        return repair;
    }
};

/// "FOR i := 1 TO 5 DO"
class AssignForFrom : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (panic() || (kind() != K::Assign && kind() != K::Equal)) return {};
        const bool before = range(pos() - 1).end < range(pos()).begin;
        const bool after = range(pos()).end < range(pos() + 1).begin;
        Repair repair = leaveOut(pos() + 1, say::MissingBlockWord, {describe(pos()), "FROM"}, range(pos()));
        repair.edit->replacement = std::string(before ? "" : " ") + "FROM" + (after ? "" : " ");
        return repair;
    }
};

/// "ELSE a THEN" for ELSEIF.
class ElseForElseif : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        TokenIndex then = 0;
        if (kind() != K::KwElse || startsLine(pos() + 1) || peek() == K::KwIf || peek() == K::KwThen ||
            !ahead().findOnLine(pos() + 1, K::KwThen, then))
            return {};
        return keyword(pos(), pos(), K::KwElseif);
    }
};

/// "ELSE THEN"
class ThenAfterElse : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (kind() != K::KwThen || startsLine(pos())) return {};
        return leaveOut(pos() + 1, say::StrayKeyword, {"THEN", "IF"}, range(pos()));
    }
};

/// "CASE ELSE:"
class CaseElse : public RecoveryStrategy {
    using RecoveryStrategy::RecoveryStrategy;
    Proposal propose(const Situation&) const override {
        if (kind() != K::KwCase || peek() != K::KwElse || peek(2) != K::Colon) return {};
        return keyword(pos(), pos() + 1, K::KwDefault);
    }
};

} // namespace

void addBlockStrategies(StrategyTable& table, Parser& parser) {
    table.add<HeadOfOtherBlock>(Place::BlockHead, parser);
    table.add<ForWithCondition>(Place::Counter, parser);
    table.add<DeclaredCounter>(Place::Counter, parser);
    table.add<InForFrom>(Place::Counter, parser);
    table.add<AssignForFrom>(Place::AfterCounter, parser);
    table.add<ElseForElseif>(Place::Branch, parser);
    table.add<CaseElse>(Place::Branch, parser);
    table.add<ThenAfterElse>(Place::ElseBody, parser);
}

} // namespace rapid::syntax

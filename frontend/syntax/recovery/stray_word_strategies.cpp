// Words that end a list of instructions, but not the one that is being read.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <fmt/format.h>

namespace rapid::syntax {

namespace {

/// Base of the strategies for stray words.
class StrayStrategy : public RecoveryStrategy {
  protected:
    using RecoveryStrategy::RecoveryStrategy;

    static bool inBlock(const Situation& at) {
        return at.own.has(K::KwEndif) || at.own.has(K::KwEndfor) || at.own.has(K::KwEndwhile) ||
               at.own.has(K::KwEndtest);
    }
    /// The list ends here: the word was meant as its END word, which is missed when the block is closed.
    Repair endsList() const {
        return {.first = pos(),
                .last = pos(),
                .next = pos(),
                .silent = true,
                .endsList = true,
                .mark = Mark::WrongEnd};
    }
    /// The word is read as no instruction.
    Repair isStray(diag::Message<2> message, std::string expected) const {
        return {.first = pos(),
                .last = pos(),
                .next = pos(),
                .code = message.code,
                .range = range(pos()),
                .args = {describe(pos()), std::move(expected)}};
    }
};

/// "CASE n" and "CASE 1:" below it, in no TEST.
class CaseForTest : public StrayStrategy {
    using StrayStrategy::StrayStrategy;
    Proposal propose(const Situation&) const override {
        constexpr TokenIndex kLongHead = 50;
        TokenIndex found = 0, next = pos() + 1;
        if (panic() || kind() != K::KwCase || block().enclosing.has(K::KwCase) ||
            ahead().findOnLine(pos() + 1, K::Colon, found))
            return {};
        while (next < pos() + kLongHead && !startsLine(next))
            ++next;
        return startsLine(next) && kindAt(next) == K::KwCase ? keyword(pos(), pos(), K::KwTest) : Proposal();
    }
};

/// In line with the word that began the block.
class EndInLine : public StrayStrategy {
    using StrayStrategy::StrayStrategy;
    Proposal propose(const Situation& at) const override {
        const bool fits = kEndWords.has(kind()) && inBlock(at) && startsLine(pos()) &&
                          block().opening != kNoToken && columnOf(pos()) == columnOf(block().opening);
        return fits ? endsList() : Proposal();
    }
};

/// ELSE in a TEST.
class ElseForDefault : public StrayStrategy {
    using StrayStrategy::StrayStrategy;
    Proposal propose(const Situation& at) const override {
        if (kind() != K::KwElse || !at.own.has(K::KwDefault)) return {};
        const bool colon = peek() == K::Colon;
        const std::string word = colon ? "DEFAULT" : "DEFAULT:";
        Repair repair = sign(K::KwDefault, say::MisspeltKeyword, describe(pos()), word, word);
        repair.endsList = true;
        if (!colon) repair.mark = Mark::ColonGiven;
        return repair;
    }
};

/// An IF without THEN, its block closed by ENDIF.
class BlockOfCompactIf : public StrayStrategy {
    using StrayStrategy::StrayStrategy;
    Proposal propose(const Situation&) const override {
        const TokenIndex opening = block().compactIf, end = block().compactIfEnd;
        if (!kIfWords.has(kind()) || opening == kNoToken || end == kNoToken ||
            isMarked(Mark::BlockOfCompactIf, opening) || columnOf(pos()) != columnOf(opening))
            return {};
        Repair repair = isStray(say::MissingBlockWord, "THEN");
        repair.range = endOf(end);
        repair.args[0] = describe(end + 1);
        repair.edit = TextEdit{endOf(end), " THEN"};
        repair.noteAt = pos();
        repair.note = fmt::format("this {} belongs to a block, which begins with THEN", describe(pos()));
        repair.mark = Mark::BlockOfCompactIf;
        repair.marked = opening;
        return repair;
    }
};

/// Followed by the next routine: the end of this one was meant.
class EndBeforeRoutine : public StrayStrategy {
    using StrayStrategy::StrayStrategy;
    Proposal propose(const Situation& at) const override {
        constexpr TokenSet kNext = {K::KwProc,      K::KwFunc,  K::KwTrap,
                                    K::KwEndmodule, K::KwLocal, K::EndOfFile};
        const bool fits = kEndWords.has(kind()) && at.own.has(K::KwEndproc) && kNext.has(peek());
        return fits ? endsList() : Proposal();
    }
};

/// ENDPROC in a block of a routine whose own END word is still to come: one too many when that of the block is, too.
class EarlyRoutineEnd : public StrayStrategy {
    using StrayStrategy::StrayStrategy;
    Proposal propose(const Situation& at) const override {
        if (!inBlock(at) || !block().endsRoutineTooEarly()) return {};
        if (!at.own.has(kindAt(block().unmatchedWord(pos() + 1)))) return endsList();
        const std::string end(tokenText(block().endOfOwn(at.own)));
        return isStray(say::UnexpectedToken, "an instruction: " + end + " is still to come");
    }
};

/// A word whose block has not been opened.
class WordWithoutOpener : public StrayStrategy {
    using StrayStrategy::StrayStrategy;
    Proposal propose(const Situation&) const override {
        const TokenIndex compact = block().compactIf;
        Repair repair = isStray(say::StrayKeyword, std::string(opener()));
        repair.cost = 2;
        if (!opener().starts_with("IF") || isMarked(Mark::BlockOfCompactIf, compact)) return repair;
        repair.noteAt = compact;
        repair.note = "this IF has no THEN, so it ends with one instruction";
        return repair;
    }
    std::string_view opener() const {
        switch (kind()) {
        case K::KwEndfor: return "FOR";
        case K::KwEndwhile: return "WHILE";
        case K::KwEndrecord: return "RECORD";
        default: break;
        }
        if (kIfEnds.has(kind())) return "IF ... THEN";
        return kTestEnds.has(kind()) ? "TEST" : "a routine";
    }
};

} // namespace

void addStrayWordStrategies(StrategyTable& table, Parser& parser) {
    table.add<CaseForTest>(Place::StrayWord, parser);
    table.add<EndInLine>(Place::StrayWord, parser);
    table.add<ElseForDefault>(Place::StrayWord, parser);
    table.add<BlockOfCompactIf>(Place::StrayWord, parser);
    table.add<EndBeforeRoutine>(Place::StrayWord, parser);
    table.add<EarlyRoutineEnd>(Place::StrayWord, parser);
    table.add<WordWithoutOpener>(Place::StrayWord, parser);
}

} // namespace rapid::syntax

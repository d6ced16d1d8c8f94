// END words that are missing, misplaced or written in another way.

#include "frontend/syntax/grammar/parts.h"

#include <fmt/format.h>
#include <utility>

namespace rapid::syntax {

using diag::Code;

namespace {

constexpr TokenSet kBlockEnds = {TokenKind::KwEndif, TokenKind::KwEndfor, TokenKind::KwEndwhile,
                                 TokenKind::KwEndtest};

} // namespace

void EndWords::closeBlock(K end, TokenIndex opening, bool whole) {
    if (accept(end)) {
        endPanic();
        return;
    }
    if (block().abandoned) return;
    if (kBlockEnds.has(kind()) && peek() == end &&
        block().enclosing.has(kind())) { // two END words in the wrong order
        note(report(Code::MissingBlockEnd, pos(), {describe(pos()), std::string(tokenText(end))}), opening,
             fmt::format("{} begins here, so its {} comes first", describe(opening), tokenText(end)));
        readAs(pos() + 1, kind());
        readAs(pos(), end);
        take();
        return;
    }
    const std::string opened = describe(opening);
    if (whole && reports().isNewsHere())
        note(report(Code::MissingBlockEnd, pos(), {describe(pos()), std::string(tokenText(end))}), opening,
             fmt::format("{} begins here", opened));
    if (isMarked(Mark::WrongEnd)) take();
}

bool EndWords::handleStray(const TokenSet& own) {
    struct Pair {
        K stray;
        std::string_view opener;
    };
    static constexpr Pair kOpeners[] = {
        {K::KwEndif, "IF ... THEN"},  {K::KwElse, "IF ... THEN"}, {K::KwElseif, "IF ... THEN"},
        {K::PlaceEit, "IF ... THEN"}, {K::KwEndfor, "FOR"},       {K::KwEndwhile, "WHILE"},
        {K::KwEndtest, "TEST"},       {K::KwCase, "TEST"},        {K::KwDefault, "TEST"},
        {K::PlaceCse, "TEST"},        {K::KwEndrecord, "RECORD"},
    };
    const K stray = kind();
    const bool isEnd = kEndWords.has(stray);
    const bool inBlock =
        own.has(K::KwEndif) || own.has(K::KwEndfor) || own.has(K::KwEndwhile) || own.has(K::KwEndtest);
    if (isEnd && inBlock && startsLine(pos()) && block().opening != kNoToken &&
        columnOf(pos()) == columnOf(block().opening)) {
        mark(Mark::WrongEnd);
        return true;
    }
    if (stray == K::KwElse && own.has(K::KwDefault)) { // of TEST
        const std::string word = peek() == K::Colon ? "DEFAULT" : "DEFAULT:";
        fix(report(Code::MisspeltKeyword, pos(), {describe(pos()), word}), range(pos()), word);
        readAs(pos(), K::KwDefault);
        if (peek() != K::Colon) mark(Mark::ColonGiven);
        return true;
    }
    constexpr TokenSet kOfIf = {K::KwEndif, K::KwElse, K::KwElseif};
    if (kOfIf.has(stray) && block().compactIf != kNoToken && block().compactIfEnd != kNoToken &&
        columnOf(pos()) == columnOf(block().compactIf)) { // IF without THEN, its block closed by ENDIF
        const SourceRange place = endOf(block().compactIfEnd);
        diag::Diagnostic* diagnostic =
            reportAt(Code::MissingBlockWord, place, {describe(block().compactIfEnd + 1), "THEN"});
        fix(diagnostic, place, " THEN");
        note(diagnostic, pos(),
             fmt::format("this {} belongs to a block, which begins with THEN", describe(pos())));
        block().compactIf = kNoToken;
        return false;
    }
    // Followed by the next routine: the end of this one was meant.
    constexpr TokenSet kNext = {K::KwProc, K::KwFunc, K::KwTrap, K::KwEndmodule, K::KwLocal, K::EndOfFile};
    if (isEnd && own.has(K::KwEndproc) && kNext.has(peek())) {
        mark(Mark::WrongEnd);
        return true;
    }
    if (inBlock && block().endsRoutineTooEarly() && own.has(kindAt(block().unmatchedWord(pos() + 1)))) {
        report(Code::UnexpectedToken, pos(),
               {describe(pos()),
                "an instruction: " + std::string(tokenText(block().endOfOwn(own))) + " is still to come"});
        return false;
    }
    if (inBlock && block().endsRoutineTooEarly()) {
        mark(Mark::WrongEnd);
        return true;
    }
    std::string_view opener = "a routine";
    for (const Pair& pair : kOpeners)
        if (pair.stray == stray) opener = pair.opener;
    diag::Diagnostic* diagnostic = report(Code::StrayKeyword, pos(), {describe(pos()), std::string(opener)});
    if (opener.starts_with("IF") && block().compactIf != kNoToken)
        note(diagnostic, block().compactIf, "this IF has no THEN, so it ends with one instruction");
    return false;
}

bool EndWords::takesEarlyEndmodule() {
    if (panic() || block().abandoned || !block().endsRoutineTooEarly()) return false;
    const std::string end(tokenText(block().routineEnd));
    if (peek() == block().routineEnd && kindAt(pos() + 2) == K::EndOfFile) { // the two in the wrong order
        report(Code::MissingBlockEnd, pos(), {describe(pos()), end});
        readAs(pos() + 1, K::KwEndmodule);
        readAs(pos(), block().routineEnd);
        return true;
    }
    report(Code::UnexpectedToken, pos(), {describe(pos()), "an instruction: " + end + " is still to come"});
    take();
    return true;
}

bool EndWords::isTestWrittenCase() {
    TokenIndex found = 0, next = pos() + 1;
    if (panic() || kind() != K::KwCase || block().enclosing.has(K::KwCase) ||
        ahead().findOnLine(pos() + 1, K::Colon, found))
        return false;
    constexpr TokenIndex kLongHead = 50;
    while (next < pos() + kLongHead && !startsLine(next))
        ++next;
    if (!startsLine(next) || kindAt(next) != K::KwCase) return false;
    typos().readAsKeyword(pos(), pos(), K::KwTest);
    return true;
}

void EndWords::closeBracedBlock(K end, TokenIndex opening, bool whole, bool braced) {
    if (!braced) return closeBlock(end, opening, whole);
    const bool own = !startsLine(pos()) || columnOf(pos()) == indentOf(opening);
    if (own) accept(end);
    endPanic();
}

} // namespace rapid::syntax

// END words that are missing, misplaced or written in a different way.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <fmt/format.h>
#include <utility>

namespace rapid::syntax {

void EndWords::closeBlock(K end, TokenIndex opening, bool whole) {
    if (accept(end)) {
        endPanic();
        return;
    }
    if (block().abandoned) return;
    if (kBlockEnds.has(kind()) && peek() == end &&
        block().enclosing.has(kind())) { // two END words in the wrong order
        note(report(say::MissingBlockEnd, pos(), {describe(pos()), std::string(tokenText(end))}), opening,
             fmt::format("{} begins here, so its {} comes first", describe(opening), tokenText(end)));
        readAs(pos() + 1, kind());
        readAs(pos(), end);
        take();
        return;
    }
    const std::string opened = describe(opening);
    if (whole && reports().mayReportEnd())
        note(report(say::MissingBlockEnd, pos(), {describe(pos()), std::string(tokenText(end))}), opening,
             fmt::format("{} begins here", opened));
    if (isMarked(Mark::WrongEnd)) take();
}

bool EndWords::takesEarlyEndmodule() {
    if (panic() || block().abandoned || !block().endsRoutineTooEarly()) return false;
    const std::string end(tokenText(block().routineEnd));
    if (peek() == block().routineEnd && kindAt(pos() + 2) == K::EndOfFile) { // the two in the wrong order
        report(say::MissingBlockEnd, pos(), {describe(pos()), end});
        readAs(pos() + 1, K::KwEndmodule);
        readAs(pos(), block().routineEnd);
        return true;
    }
    report(say::UnexpectedToken, pos(), {describe(pos()), "an instruction: " + end + " is still to come"});
    take();
    return true;
}

void EndWords::closeBracedBlock(K end, TokenIndex opening, bool whole, bool braced) {
    if (!braced) return closeBlock(end, opening, whole);
    const bool own = !startsLine(pos()) || columnOf(pos()) == indentOf(opening);
    if (own) accept(end);
    endPanic();
}

} // namespace rapid::syntax

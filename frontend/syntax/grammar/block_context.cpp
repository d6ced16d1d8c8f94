// Which blocks are open around the current token.

#include "frontend/syntax/grammar/parts.h"

#include <algorithm>
#include <utility>

namespace rapid::syntax {

/// The opener of the innermost block around this one that a word belongs to; kNoToken when there is none.
TokenIndex BlockContext::outerOpenerOf(K word) const {
    struct Family {
        TokenSet words;
        K opener, closer;
    };
    static constexpr Family kFamilies[] = {{kIfEnds, K::KwIf, K::KwEndif},
                                           {kTestEnds, K::KwTest, K::KwEndtest},
                                           {{K::KwEndfor}, K::KwFor, K::KwEndfor},
                                           {{K::KwEndwhile}, K::KwWhile, K::KwEndwhile}};
    for (const Family& family : kFamilies) {
        if (!family.words.has(word)) continue;
        uint32_t closed = 0;
        const TokenIndex end = std::max(routineStart, opening - std::min(opening, kFarTokens));
        for (TokenIndex i = opening; i-- > end;) {
            TokenIndex then = 0;
            if (kindAt(i) == family.closer) ++closed;
            if (kindAt(i) != family.opener ||
                (family.opener == K::KwIf && !ahead().findOnLine(i + 1, K::KwThen, then)))
                continue;
            if (closed-- == 0) return i;
        }
    }
    return kNoToken;
}

bool BlockContext::isInside() const {
    if (opening == kNoToken || !startsLine(pos()) || !startsLine(opening)) return false;
    if (reports().isFull()) return false;
    const TokenIndex outer = outerOpenerOf(kind());
    if (outer == kNoToken || !startsLine(outer)) return false;
    const uint32_t margin = columnOf(outer);
    if (columnOf(pos()) < columnOf(opening) || columnOf(opening) <= margin) return false;
    const TokenSet family = kIfEnds.has(kind())     ? kIfEnds
                            : kTestEnds.has(kind()) ? kTestEnds
                                                    : TokenSet{kind()};
    for (TokenIndex i = pos() + 1; i < lastToken() && i < pos() + kFarTokens; ++i)
        if (startsLine(i) && columnOf(i) <= margin) return columnOf(i) == margin && family.has(kindAt(i));
    return false;
}

TokenIndex BlockContext::unmatchedWord(TokenIndex from) const {
    if (reports().isFull()) return lastToken();
    constexpr TokenSet kBranches = {K::KwElse, K::KwElseif, K::KwCase, K::KwDefault};
    uint32_t open = 0;
    TokenIndex i = from;
    for (; i < from + kFarTokens && i < lastToken(); ++i) {
        const K k = kindAt(i);
        if (kRoutineEnds.has(k)) return i;
        TokenIndex then = 0;
        if (k == K::KwFor || k == K::KwWhile || k == K::KwTest ||
            (k == K::KwIf && ahead().findOnLine(i + 1, K::KwThen, then)))
            ++open;
        if (open == 0 && (kBranches.has(k) || kBlockEnds.has(k))) return i;
        if (kBlockEnds.has(k)) --open;
    }
    return i;
}

TokenKind BlockContext::endOfOwn(const TokenSet& own) const {
    for (const K end : {K::KwEndif, K::KwEndfor, K::KwEndwhile, K::KwEndtest})
        if (own.has(end)) return end;
    return routineEnd;
}

bool BlockContext::closesHere(K end) const {
    if (end == routineEnd && !reports().isFull() && endOfRoutineBelow() == end) return false;
    if (reports().isFull() || kindAt(unmatchedWord(pos() + 1)) != end) return true;
    return end != routineEnd && opening != kNoToken && startsLine(opening) &&
           columnOf(pos()) == columnOf(opening);
}

bool BlockContext::endsRoutineTooEarly() const {
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap, K::KwEndmodule};
    if (!kEnds.has(kind()) || reports().isFull()) return false;
    TokenIndex i = pos() + 1;
    while (kindAt(i) != routineEnd && !kAfterRoutine.has(kindAt(i)))
        ++i;
    return kindAt(i) == routineEnd;
}

TokenKind BlockContext::endOfRoutineBelow() const {
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    TokenIndex& i = routineEndBelow_.found;
    if (pos() < routineEndBelow_.from || pos() > i) i = routineEndBelow_.from = pos();
    while (!kEnds.has(kindAt(i)) && !kAfterRoutine.has(kindAt(i)))
        ++i;
    return kEnds.has(kindAt(i)) ? kindAt(i) : K::EndOfFile;
}

void BlockContext::countEndifs() {
    if (std::exchange(endifsCounted, true)) return;
    missingEndifs = 0;
    for (TokenIndex i = routineStart; !kRoutineBorders.has(kindAt(i)); ++i) {
        TokenIndex then = 0;
        if (kindAt(i) == K::KwIf && ahead().findOnLine(i + 1, K::KwThen, then)) ++missingEndifs;
        if (kindAt(i) == K::KwEndif) --missingEndifs;
    }
}

bool BlockContext::isHandledBelow(TokenIndex from) const {
    if (reports().isFull()) return false;
    for (TokenIndex i = from;
         i < from + kFarTokens && !kRoutineEnds.has(kindAt(i)) && kindAt(i) != K::EndOfFile; ++i)
        if (kindAt(i) == K::KwTrynext || kindAt(i) == K::KwRetry) return true;
    return false;
}

bool BlockContext::continuesBlock() const {
    constexpr TokenSet kBranches = {K::KwElse, K::KwElseif, K::KwCase};
    return (kBranches.has(kind()) || (kind() == K::KwDefault && peek() == K::Colon)) && enclosing.has(kind());
}

bool BlockContext::startsAfresh() const {
    if (kEndWords.has(kind()) || startsLine(pos()) || continuesBlock()) return true;
    return (isName(kind()) && peek() == K::Assign) || ahead().opensBlock(pos());
}

bool BlockContext::isBlockBrace() const {
    if (kind() != K::LeftBrace || !inHead || !startsLine(pos() + 1)) return false;
    // An index extends to its '}', with ':=' only in the arguments of a call.
    constexpr TokenSet kBlock = {K::Semicolon, K::KwIf,    K::KwFor,  K::KwWhile, K::KwTest,
                                 K::KwReturn,  K::KwRaise, K::KwGoto, K::KwExit,  K::EndOfFile};
    uint32_t depth = 0;
    TokenIndex i = pos() + 1;
    for (; kindAt(i) != K::RightBrace && !kBlock.has(kindAt(i)); ++i) {
        if (kindAt(i) == K::LeftParen) ++depth;
        if (kindAt(i) == K::RightParen && depth > 0) --depth;
        if (kindAt(i) == K::Assign && depth == 0) return true;
    }
    return kindAt(i) != K::RightBrace || i == pos() + 1;
}

} // namespace rapid::syntax

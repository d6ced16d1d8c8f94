// Questions about the tokens to come.

#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

bool Lookahead::looksLikeInstruction(TokenIndex i) const {
    if (!isName(kindAt(i))) return kindAt(i) == K::Percent;
    switch (kindAt(i + 1)) {
    case K::Assign:
    case K::Colon:
    case K::Semicolon:
    case K::Identifier:
    case K::NumLiteral:
    case K::StringLiteral:
    case K::Backslash:
    case K::LeftParen:
    case K::LeftBracket:
    case K::KwTrue:
    case K::KwFalse:
    case K::PlaceId:
    case K::PlaceArg: return true;
    case K::Dot:
    case K::LeftBrace: break;
    default: return false;
    }
    for (TokenIndex k = i + 2; k < i + kSearchTokens; ++k) {
        if (kindAt(k) == K::Assign) return true;
        if (kSearchEnd.has(kindAt(k))) return false;
    }
    return false;
}

bool Lookahead::opensBlock(TokenIndex i) const {
    TokenIndex found = 0;
    switch (kindAt(i)) {
    case K::KwIf: return findOnLine(i + 1, K::KwThen, found);
    case K::KwWhile: return findOnLine(i + 1, K::KwDo, found);
    case K::KwFor: return findOnLine(i + 1, K::KwFrom, found);
    case K::KwTest: return findOnLine(i + 1, K::KwCase, found);
    case K::KwProc: return isName(kindAt(i + 1)) && kindAt(i + 2) == K::LeftParen;
    case K::KwVar:
    case K::KwPers:
    case K::KwConst:
    case K::KwFunc: return isName(kindAt(i + 1)) && isName(kindAt(i + 2));
    default: return false;
    }
}

bool Lookahead::findOnLine(TokenIndex from, K wanted, TokenIndex& found) const {
    for (TokenIndex i = from; i < from + kSearchTokens; ++i) {
        if (kindAt(i) == wanted) {
            found = i;
            return true;
        }
        if (kSearchEnd.has(kindAt(i))) return false;
        if (startsLine(i) && looksLikeInstruction(i)) return false;
    }
    return false;
}

bool Lookahead::calleeEndsHere(TokenIndex callee, TokenIndex calleeEnd) const {
    const TokenIndex next = calleeEnd + 1;
    if (!isName(kindAt(next)) || !startsLine(next)) return false;
    if (!startsLine(callee)) { // "IF diStop = 1 Halt"
        TokenIndex head = callee;
        while (head > 0 && !startsLine(head))
            --head;
        if (kindAt(head) != K::KwIf || columnOf(next) > columnOf(head)) return false;
    }
    switch (kindAt(next + 1)) {
    case K::Identifier:
    case K::NumLiteral:
    case K::StringLiteral:
    case K::Colon: return true; // no argument continues like this
    default: return columnOf(next) <= columnOf(callee) && looksLikeInstruction(next);
    }
}

bool Lookahead::endsLine(TokenIndex last) const {
    const K next = kindAt(last + 1);
    return startsLine(last + 1) && (isName(next) || (!startsExpression(next) && next != K::Backslash));
}

bool Lookahead::quoteInText() const {
    TokenIndex last = pos();
    while (isName(kindAt(last)) && kindAt(last + 1) != K::StringLiteral && !startsLine(last + 1))
        ++last;
    return kindAt(pos() - 1) == K::StringLiteral && kindAt(last + 1) == K::StringLiteral &&
           range(pos() - 1).end == range(pos()).begin && range(last).end == range(last + 1).begin;
}

bool Lookahead::beginsInstruction(bool inCase) const {
    constexpr TokenSet kNoOperator = {K::Identifier, K::NumLiteral, K::StringLiteral, K::Assign, K::Colon};
    if (!startsLine(pos()) || !isName(kind())) return false;
    if (inCase && peek() == K::Colon) return false; // the last value of CASE, no label
    if (peek() == K::Dot || peek() == K::LeftBrace) return looksLikeInstruction(pos());
    return kNoOperator.has(peek()) && !(peek() == K::Identifier && startsLine(pos() + 1));
}

bool Lookahead::startsDeclaration(TokenIndex i) const {
    return kDeclWords.has(kindAt(i)) || isTaskDirective(i);
}

bool Lookahead::isWordlessData() const {
    constexpr TokenSet kAfter = {K::Semicolon, K::Assign, K::LeftBrace, K::Equal};
    const TokenIndex name =
        kStorageWords.has(peek()) && !startsLine(pos() + 1) ? pos() + 2 : pos() + 1; // "num VAR x;"
    return kind() == K::Identifier && isBasicType(textOf(pos())) && isName(kindAt(name)) &&
           !startsLine(name) && kAfter.has(kindAt(name + 1));
}

bool Lookahead::isBracketTarget() const {
    uint32_t depth = 0;
    constexpr TokenIndex kSearch = 500;
    for (TokenIndex i = pos() + 1; i < pos() + kSearch; ++i) {
        const K k = kindAt(i);
        if (k == K::Semicolon || k == K::EndOfFile || k == K::Assign) return false;
        if (kOpenBrackets.has(k)) ++depth;
        if (kCloseBrackets.has(k) && --depth == 0)
            return kindAt(i + 1) == K::Assign || kindAt(i + 1) == K::Dot;
    }
    return false;
}

/// Calls visit(i) for each token that is in the bracket at `opening` itself, not in one inside it. Ends at the sign that closes
/// it or at a semicolon and returns that token; kNoToken: neither is near.
template <class Visit> TokenIndex Lookahead::walkBracket(TokenIndex opening, Visit&& visit) const {
    constexpr TokenIndex kSearch = 200;
    uint32_t depth = 0;
    for (TokenIndex i = opening; i < opening + kSearch && kindAt(i) != K::EndOfFile; ++i) {
        if (kindAt(i) == K::Semicolon) return i;
        if (kOpenBrackets.has(kindAt(i))) ++depth;
        if (kCloseBrackets.has(kindAt(i)) && --depth == 0) return i;
        if (depth == 1) visit(i);
    }
    return kNoToken;
}

TokenKind Lookahead::closingOf(TokenIndex opening) const {
    const TokenIndex end = walkBracket(opening, [](TokenIndex) {});
    if (end != kNoToken && kindAt(end) != K::Semicolon) return kindAt(end);
    return kindAt(opening) == K::LeftBracket ? K::RightBracket
           : kindAt(opening) == K::LeftParen ? K::RightParen
                                             : K::RightBrace;
}

bool Lookahead::hasOption(TokenIndex opening) const {
    bool found = false;
    walkBracket(opening, [&](TokenIndex i) { found |= kindAt(i) == K::Backslash; });
    return found;
}

bool Lookahead::isDoubled(TokenIndex opening) const {
    if (opening == 0 || kindAt(opening - 1) != kindAt(opening)) return false;
    bool innerClosed = false;
    const TokenIndex end = walkBracket(opening - 1, [&](TokenIndex i) { innerClosed |= i > opening; });
    return innerClosed && end != kNoToken && kindAt(end) == K::Semicolon;
}

bool Lookahead::atReservedName() const {
    constexpr TokenSet kAfter = {K::Semicolon,    K::Comma,     K::RightParen, K::RightBrace, K::Dot,
                                 K::RightBracket, K::LeftBrace, K::Plus,       K::Minus,      K::Star,
                                 K::Slash,        K::Equal,     K::Less,       K::Greater,    K::LessEqual,
                                 K::GreaterEqual, K::NotEqual};
    return isKeyword(kind()) && !startsLine(pos()) && !startsLine(pos() + 1) && kAfter.has(peek());
}

bool Lookahead::isShownPosition() const {
    constexpr TokenSet kAfter = {K::Comma, K::Semicolon, K::RightParen, K::Backslash};
    return kind() == K::Star && kAfter.has(peek());
}

bool Lookahead::isEqualForColon() const {
    constexpr TokenSet kNoOperator = {K::Identifier, K::NumLiteral, K::StringLiteral, K::Assign,
                                      K::Semicolon};
    if (!startsLine(pos() + 1)) return false;
    return isName(peek()) ? kNoOperator.has(peek(2)) : isKeyword(peek()) && !startsExpression(peek());
}

bool Lookahead::missesCondition() const {
    TokenIndex then = 0;
    if (!isName(kind()) || startsLine(pos()) || startsLine(pos() + 1)) return false;
    const bool call = kLiterals.has(peek()) || (isName(peek()) && peek(2) == K::Comma);
    return call && !findOnLine(pos(), K::KwThen, then);
}

bool Lookahead::endsBeforeLocalData() const {
    constexpr TokenIndex kFarthest = 300;
    constexpr TokenSet kData = {K::KwLocal, K::KwVar, K::KwPers, K::KwConst};
    if (!startsLine(pos())) return false;
    TokenIndex i = pos();
    while (i < pos() + kFarthest) {
        const K k = kindAt(i);
        if (kModuleLevel.has(k) || k == K::KwEndmodule) return true;
        if (k == K::KwLocal && kModuleLevel.has(kindAt(i + 1))) return true;
        if (!kData.has(k) || !startsLine(i)) return false;
        while (i < pos() + kFarthest && kindAt(i) != K::Semicolon && kindAt(i) != K::EndOfFile)
            ++i;
        ++i;
    }
    return false;
}

bool Lookahead::isNative() const {
    constexpr TokenSet kNext = {K::KwProc,  K::KwFunc,   K::KwTrap,      K::KwLocal,  K::KwRecord,
                                K::KwAlias, K::KwModule, K::KwEndmodule, K::EndOfFile};
    return kNext.has(kind()) || isTaskDirective(pos());
}

bool Lookahead::isProse() const {
    constexpr TokenSet kOfBlocks = {K::KwThen, K::KwDo, K::KwFrom, K::KwWith, K::KwEndif, K::KwElse};
    constexpr TokenIndex kFewest = 4;
    if (!startsLine(pos()) || isBasicType(textOf(pos() + 1))) return false;
    TokenIndex i = pos();
    while (i < lastToken() && (i == pos() || !startsLine(i)) &&
           (kindAt(i) == K::Identifier || (isKeyword(kindAt(i)) && !kOfBlocks.has(kindAt(i)))))
        ++i;
    const bool ends =
        startsLine(i) || ((kindAt(i) == K::Dot || kindAt(i) == K::Question) && startsLine(i + 1));
    return ends && i - pos() >= kFewest;
}

} // namespace rapid::syntax

// Questions about lists to come: values, parameters.

#include "frontend/syntax/grammar/parts.h"
#include "frontend/syntax/tree_walk.h"

namespace rapid::syntax {

bool Lookahead::valueWithoutSign(DataKind dataKind) const {
    constexpr TokenSet kDimension = {K::NumLiteral, K::Identifier};
    constexpr TokenIndex kMost = 6; // "[n, 2, 3]"
    bool dimensions = true;
    TokenIndex i = pos() + 1;
    for (uint32_t open = 1; open > 0; ++i) {
        const K one = kindAt(i);
        if (one == K::EndOfFile || one == K::Semicolon) return false;
        if (one == K::LeftBracket) ++open;
        if (one == K::RightBracket) --open;
        const bool element = (i - pos()) % 2 == 1;
        dimensions = dimensions && i - pos() <= kMost &&
                     (element ? kDimension.has(one) && textOf(i).find('.') == std::string_view::npos
                              : one == K::Comma || open == 0);
    }
    if (kindAt(i) == K::Assign || kindAt(i) == K::Equal) return false;
    return !dimensions || dataKind == DataKind::Const;
}

/// Whether a ')' without '(' comes before anything that no list of parameters has.
bool Lookahead::listClosesBelow(TokenIndex from) const {
    constexpr TokenIndex kSearch = 100;
    constexpr TokenSet kOfParameters = {K::Identifier, K::Comma,     K::Semicolon,  K::Backslash,
                                        K::Bar,        K::LeftBrace, K::RightBrace, K::Star,
                                        K::KwVar,      K::KwPers,    K::KwInout};
    for (TokenIndex i = from; i < from + kSearch; ++i) {
        if (kindAt(i) == K::RightParen) return true;
        if (!kOfParameters.has(kindAt(i))) return false;
    }
    return false;
}

/// A line that ends with ';' and has what no list of parameters has: a value, a name alone between commas.
bool Lookahead::isInstructionLine() const {
    constexpr TokenSet kValues = {K::NumLiteral, K::StringLiteral, K::Assign, K::LeftBracket};
    constexpr TokenSet kAlone = {K::Comma, K::Semicolon};
    bool instruction = peek() == K::Backslash || // or "Incr count;"
                       (isName(peek()) && peek(2) == K::Semicolon && !isBasicType(textOf(pos())) &&
                        !listClosesBelow(pos() + 3));
    TokenIndex i = pos();
    uint32_t depth = 0;
    for (; i < pos() + kLongLine && !startsLine(i + 1); ++i) {
        if (kindAt(i) == K::LeftParen) ++depth;
        if (kindAt(i) == K::RightParen && depth-- == 0) return false;
        instruction = instruction || kValues.has(kindAt(i)) || depth > 0 ||
                      (kindAt(i) == K::Comma && isName(kindAt(i + 1)) && kAlone.has(kindAt(i + 2)));
    }
    return instruction && kindAt(i) == K::Semicolon;
}

bool Lookahead::bodyBeginsHere() const {
    constexpr TokenSet kNoParameter = {K::Assign, K::Semicolon, K::NumLiteral, K::StringLiteral};
    constexpr TokenSet kEndOfData = {K::Semicolon, K::Assign};
    if (isName(kind())) return kNoParameter.has(peek()) || isInstructionLine();
    if (kind() == K::KwVar || kind() == K::KwPers) return kEndOfData.has(peek(3));
    return isKeyword(kind()) && kind() != K::KwInout;
}

bool Lookahead::lacksParenthesis(TokenIndex name) const {
    constexpr TokenSet kAfterFirst = {K::RightParen, K::Comma, K::Backslash, K::Bar, K::LeftBrace};
    if (!isName(kindAt(name)) || !isName(kindAt(name + 1)) || startsLine(name + 1) ||
        !kAfterFirst.has(kindAt(name + 2)))
        return false;
    const std::string_view word = textOf(name);
    for (size_t i = 1; i < word.size(); ++i)
        if (isBasicType(word.substr(i))) return true;
    return false;
}

bool Lookahead::mayBeIndex(const Expr& index) const {
    const Expr& inner = bare(index);
    if (inner.kind == NodeKind::NumLiteral) {
        const std::string_view digits = textOf(inner.first);
        return digits[0] != '0' && digits.find('.') == std::string_view::npos;
    }
    return inner.kind == NodeKind::Name || inner.kind == NodeKind::Binary || inner.kind == NodeKind::Index ||
           inner.kind == NodeKind::Component || inner.kind == NodeKind::Call;
}

} // namespace rapid::syntax

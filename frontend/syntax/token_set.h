#pragma once
// Facts about token kinds: sets of them, groups, spelling.

#include "config/letter_case.h"
#include "frontend/syntax/ast.h"

#include <string>

namespace rapid::syntax {

/// A set of token kinds in two machine words.
class TokenSet {
  public:
    constexpr TokenSet() = default;
    constexpr TokenSet(std::initializer_list<TokenKind> kinds) {
        for (const TokenKind kind : kinds)
            words_[index(kind) / 64] |= uint64_t{1} << (index(kind) % 64);
    }
    constexpr bool has(TokenKind kind) const { return (words_[index(kind) / 64] >> (index(kind) % 64)) & 1; }
    constexpr TokenSet operator|(const TokenSet& other) const {
        TokenSet result;
        result.words_[0] = words_[0] | other.words_[0];
        result.words_[1] = words_[1] | other.words_[1];
        return result;
    }

  private:
    static constexpr unsigned index(TokenKind kind) { return static_cast<unsigned>(kind); }
    uint64_t words_[2] = {0, 0};
};
static_assert(static_cast<unsigned>(TokenKind::PlaceId) < 128, "TokenSet holds 128 kinds");

constexpr bool isKeyword(TokenKind kind) {
    return kind >= TokenKind::KwAlias && kind <= TokenKind::KwXor;
}
constexpr bool isPlaceholder(TokenKind kind) {
    return kind >= TokenKind::PlaceTdn && kind <= TokenKind::PlaceId;
}

/// Spelling of keywords (upper case), punctuation and placeholders; a word such as "name" for the other kinds.
std::string_view tokenText(TokenKind kind);
/// "KwIf", "Semicolon", ...
std::string_view tokenKindName(TokenKind kind);

/// The keyword that `word` is, in any case; Identifier when it is none.
TokenKind keywordKind(std::string_view word);

using config::upperCase;

/// Equal without regard to case.
inline bool equalsNoCase(std::string_view a, std::string_view b) {
    return config::sameName(a, b);
}

} // namespace rapid::syntax

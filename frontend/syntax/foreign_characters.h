#pragma once
// Characters that word processors and other keyboards put where RAPID has one of ASCII.

#include "frontend/syntax/ast.h"

#include <string>
#include <string_view>

namespace rapid::syntax {

struct ForeignCharacter {
    std::string_view utf8;
    std::string_view meant; ///< what RAPID writes: a sign, a space, or a quotation mark
    TokenKind kind = TokenKind::Error;
};

/// The one at the beginning of `text`; null when there is none.
const ForeignCharacter* foreignCharacter(std::string_view text);

/// Bytes of the quotation mark of any kind at the beginning of `text`; 0: there is none.
size_t quoteLength(std::string_view text);

/// The first character for people: itself and its number.
std::string showCharacter(std::string_view text);

} // namespace rapid::syntax

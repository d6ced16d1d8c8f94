#pragma once
// The words of the language: what each does, in a sentence.

#include "frontend/syntax/ast.h"

namespace rapid::query {

/// Empty: not a keyword that is explained.
std::string_view keywordHelp(syntax::TokenKind kind);
/// The spelling of a keyword.
std::string_view tokenTextOf(syntax::TokenKind kind);

} // namespace rapid::query

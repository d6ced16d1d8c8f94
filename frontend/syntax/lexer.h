#pragma once
// Source text -> tokens (manual 1.1.2). White space and comments are the gaps between tokens.

#include "frontend/diag/diagnostic.h"
#include "frontend/syntax/ast.h"

#include <optional>

namespace rapid::syntax {

/// A mistake found in the characters of a file. Whether it is shown is the parser's decision.
struct LexError {
    diag::Code code{};
    SourceRange range;
    std::vector<std::string> args;
    std::optional<std::string> fix; ///< what certainly belongs in the place of `range`
};

struct LexResult {
    std::vector<Token> tokens;    ///< the last one is EndOfFile
    std::vector<LexError> errors; ///< at most kMaxLexErrors
    bool hasModule = false;       ///< the word MODULE occurs
};

inline constexpr size_t kMaxLexErrors = 64;

/// Splits a text; what cannot be read becomes an Error token with one LexError a line. A NUL must follow the text, as
/// it does in the text of a SourceFile.
LexResult lex(std::string_view text);

/// Value of a number token. `valid` is false when the text is not a number, `inRange` when binary64 cannot hold it.
struct NumberValue {
    double value = 0;
    bool isInteger = false;
    bool valid = true;
    bool inRange = true;
};
NumberValue numberValue(std::string_view text);

} // namespace rapid::syntax

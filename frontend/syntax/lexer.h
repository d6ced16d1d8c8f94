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

/// An aggregate that is one token.
struct WholeAggregate {
    TokenIndex token = 0;
    uint8_t shape = 0; ///< place in LexResult::shapes
};

struct LexResult {
    std::vector<Token> tokens;              ///< the last one is EndOfFile
    std::vector<LexError> errors;           ///< at most kMaxLexErrors
    bool hasModule = false;                 ///< the word MODULE occurs
    std::vector<WholeAggregate> aggregates; ///< of `tokens`, in order; without those of many pieces
    std::vector<std::vector<PlainPiece>> shapes;
};

inline constexpr size_t kMaxLexErrors = 64;

/// Splits a text; what cannot be read becomes an Error token with one LexError a line. A NUL must follow the text, as
/// it does in the text of a SourceFile. `wholeAggregates`: see ParseOptions.
LexResult lex(std::string_view text, bool wholeAggregates = false);

/// The tokens of a text that begin at `from` or after it and before `to`, which both are starts of lines; with the
/// EndOfFile when the text ends before `to`. `before` is the kind of the token before them.
LexResult lexPart(std::string_view text, size_t from, size_t to, TokenKind before);

/// Gives `tree`, whose source is known, its tokens from those of an earlier version of the file: lines that are the same
/// at the beginning and at the end are not read again. False: nothing was done, because no line is the same or a
/// token of the earlier version is not what the text alone says.
bool relex(SyntaxTree& tree, const SyntaxTree& earlier, LexResult& lexed);

/// Value of a number token. `valid` is false when the text is not a number, `inRange` when binary64 cannot hold it.
struct NumberValue {
    double value = 0;
    bool isInteger = false;
    bool valid = true;
    bool inRange = true;
};
NumberValue numberValue(std::string_view text);
/// Written without decimal point and exponent, in any base.
bool isWholeLiteral(std::string_view text);

} // namespace rapid::syntax

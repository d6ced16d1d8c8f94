#pragma once
// Mistakes of the lexer.

#include "frontend/diag/diagnostic.h"
#include "frontend/syntax/grammar/token_cursor.h"
#include "frontend/syntax/lexer.h"

#include <vector>

namespace rapid::syntax {

class Reports;

/// Reports what the lexer has found, and knows what follows from it. Strings that do not end are reported last: where a
/// quote may be missing shows only when the lines before have been read.
class LexicalMistakes {
  public:
    LexicalMistakes(TokenCursor& in, diag::Sink& sink) : in_(in), sink_(sink) {}

    /// Everything but strings that do not end.
    void report(const LexResult& lexed, Reports& reports);
    /// Those; call it when the file has been read.
    void reportBrokenStrings();
    /// Whether a mistake at this place follows from one of these. A string without end keeps the first such place.
    bool covers(SourceRange range);
    /// Some numbers could not be read.
    bool hasBadNumbers() const { return badNumbers_; }

  private:
    bool endsBrokenString(const LexError& error, const LexError* before) const;
    static bool isInBrokenString(const LexResult& lexed, const LexError& escape);
    void fixEscapes(diag::Diagnostic& diagnostic) const;
    void hideBetween(SourceRange first, SourceRange second);

    /// A string that ends with its line, and the place before it where the line could not be read.
    struct BrokenString {
        SourceRange range;
        SourceRange doubtful;
    };
    TokenCursor& in_;
    diag::Sink& sink_;
    std::vector<BrokenString> brokenStrings_;
    std::vector<uint32_t> reported_; ///< where what has been reported begins
    bool badNumbers_ = false;
};

} // namespace rapid::syntax

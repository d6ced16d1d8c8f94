#pragma once
// Names, and reserved words in their place.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Reads names. A reserved word in the place of one is reported; once data is declared with it, its uses are names.
class NameReader : public ParserPart {
  public:
    using ParserPart::ParserPart;

    TokenIndex expectName(bool newerKeywords = false);
    /// A name, unless the next line begins an instruction.
    TokenIndex expectNameHere();
    TokenIndex missingName();
    /// The same reserved word twice in a row.
    void skipSecond(TokenIndex word);
    /// A reserved word in the place of a name. One that data was declared with is meant as that name from then on.
    TokenIndex takeReservedName();
    /// Data with the name of a reserved word, which has been reported: its uses are not reported again.
    void declareReserved(TokenIndex name);
    void checkNameLength(TokenIndex name);

    /// Whether data was declared with this reserved word.
    bool isReadAsName(TokenKind word) const { return reservedNames_.has(word); }

  private:
    void laterUsesAreNames(TokenIndex declared);

    TokenSet reservedNames_; ///< words that data was declared with, which is reported
};

} // namespace rapid::syntax

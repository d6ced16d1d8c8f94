#pragma once
// Misspelt keywords.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// How near names are to keywords, and how one is read as the other.
class MisspeltWords : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// How many edits make this keyword of the name; a word of another language for it counts one. 0: it was not meant.
    /// Short words have many neighbours, so they allow one edit; `limit` allows that many.
    unsigned editsTo(TokenIndex i, K word, unsigned limit = 0) const;
    /// Letters of the word in a different order, or one too many or too few: "Dim" is not meant as DIV.
    bool isShuffled(TokenIndex i, K word) const;
    /// A piece of a word, alone in its line, that was cut off or written into another one: "EN", "ENDPENDPROC".
    bool isPieceOf(TokenIndex i, K word) const;
    /// Reports the words `first` to `last` and reads the last one as the keyword they mean. A word of another
    /// language brings its END word with it: both are one mistake.
    void readAsKeyword(TokenIndex first, TokenIndex last, K word);
    /// Is it the END word of a block whose opening word has been reported?
    bool foreignCloserIs(TokenIndex i) const;

  private:
    TokenIndex foreignCloser(TokenIndex opening, K closer) const;
    void noteForeignCloser(diag::Diagnostic* diagnostic, TokenIndex opening, K word);

    std::vector<TokenIndex>
        foreignClosers_; ///< END words of other languages whose opening word has been reported
};

} // namespace rapid::syntax

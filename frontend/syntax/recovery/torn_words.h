#pragma once
// Names torn in two, and words that ran together.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// The meant name is looked for among the words of the file, kMostWords in all searches together.
class TornWords : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// Is this name declared in the file with dimensions, "num name{3}"?
    bool isArrayOfFile(TokenIndex name);
    /// Two words in one line, with nothing but blanks between them: the one name they were meant as, if there is such a name.
    std::string tornName(TokenIndex second);
    /// At a word that is not possible here: it and the word before it, or the two before it, are one name.
    diag::Diagnostic* reportTornName();
    /// After the first word of a name that is being declared: takes the others, "n Rows", "my-name". `after`: what follows a
    /// name there. At the end of a line the name must be used elsewhere, too.
    bool takeTornName(TokenIndex name, const TokenSet& after, bool endsLine = false);
    /// At the first word of a condition that THEN follows: "reg1 = 1 THEN" and "IFreg1 = 1 THEN".
    void reportMissingIf();

  private:
    std::string_view spellingInFile(std::string_view wanted, TokenIndex exceptFirst, TokenIndex exceptLast);
    bool isOnlyHere(TokenIndex second);
    diag::Diagnostic* reportWord(TokenIndex first, TokenIndex last, const std::string& whole, bool certain);

    size_t searched_ = 0; ///< words of the file
};

} // namespace rapid::syntax

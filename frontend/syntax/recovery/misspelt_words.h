#pragma once
// Misspelt keywords.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Names that were meant as keywords. A name is taken for one only where no name can be, or where what follows proves it.
class MisspeltWords : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// Could the name have been meant as this keyword? Short words have many neighbours, so they allow one edit.
    bool meant(TokenIndex i, K word, unsigned limit = 0) const;
    /// Reports the word and reads it as the keyword it stands for. `last` is the last token of the word. A word of another
    /// language brings its END word with it: both are one mistake.
    void retag(TokenIndex first, TokenIndex last, K word);
    bool retagIfMeant(K word);
    /// "ENDIFF", "END IF", "ELSIF", "CSAE 2:": names at the beginning of an instruction that stand for a word this list
    /// waits for.
    bool retagMisspelt(const TokenSet& own);
    /// "VRA num x;", "PRES num x := 1;": three names in a row are a declaration.
    bool retagData();
    /// A name that begins an instruction and is no callee.
    bool retagOpener();
    /// What was read as a call goes on with THEN, DO or CASE: the callee was meant as IF, WHILE or TEST.
    bool retagCallee(TokenIndex callee);
    /// At module level, where only a declaration or ENDMODULE can stand.
    bool retagDecl();
    /// A misspelt operator at the current token, or a misspelt NOT before it; the parser then stands there.
    bool isMisspeltOperator(const Expr* left);
    /// Is it the END word of a block whose opening word has been reported?
    bool foreignCloserIs(TokenIndex i) const;

  private:
    bool isShuffled(TokenIndex i, K word) const;
    bool fitsAsListWord(K word, TokenIndex last) const;
    bool retagOperator();
    TokenIndex foreignCloser(TokenIndex opening, K closer) const;
    void noteForeignCloser(diag::Diagnostic* diagnostic, TokenIndex opening, K word);

    std::vector<TokenIndex>
        foreignClosers_; ///< END words of other languages whose opening word has been reported
};

} // namespace rapid::syntax

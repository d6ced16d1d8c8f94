#pragma once
// Punctuation and operators that other languages, or slips, put in the place of those of RAPID.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// One sign written for another: reported, and read as the one that was meant.
class WrongSigns : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// `=`, `==` or `=:` where `:=` belongs; the parser then is at the last token of it.
    void reportEqual();
    /// `:` in place of THEN or DO, or after a word that takes none.
    bool takesColonAs(std::string_view word);
    void reportSlash(TokenIndex slash);
    /// "MoveL p10; v100, fine, tool0;": the semicolon before the name was meant as a comma. No instruction begins with a name
    /// and a comma.
    bool commaWasSemicolon();
    /// "1,5" where a value ends.
    bool reportDecimalComma();
    /// "x := a + ;b": the operand of one word after the semicolon ends the line. The parser then is at it.
    bool operandAfterSemicolon();
    /// `VAR num x();`, `x() := 1;`
    void dropEmptyParentheses();
    void expectColonOfDefault();
};

} // namespace rapid::syntax

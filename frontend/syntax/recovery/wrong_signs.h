#pragma once
// Punctuation and operators that other languages, or slips, put in the place of those of RAPID.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// One sign written for another: reported, and read as the one that was meant.
class WrongSigns : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// `=`, `==` or `=:` where `:=` belongs; the parser then stands at the last token of it.
    void reportEqual();
    /// ':' or ': =' is to be read as ':='; the parser then stands at that.
    void takeColonAsAssign();
    /// `:` in place of THEN or DO, or behind a word that takes none.
    bool takesColonAs(std::string_view word);
    /// "ConfL/Off;" and "CRobT(/Tool:=tool1)": no argument begins with '/'.
    void takesSlashAsBackslash();
    void reportSlash(TokenIndex slash);
    /// `num a /num b`
    void takeSlashAsBackslash();
    /// "(a; b)": in a list that goes on in the same line to its closing bracket.
    bool takesSemicolonAsComma(K closing);
    /// "MoveL p10; v100, fine, tool0;": the semicolon before the name was meant as a comma. No instruction begins with a name
    /// and a comma.
    bool commaWasSemicolon();
    /// At a comma that ends its line: what stands below is an instruction of its own, so ';' was meant.
    bool instructionAfterComma();
    /// "5 % 3": not the name of a late-bound call, nor one that begins behind the condition of an IF.
    bool takesPercentAsMod();
    /// "1,5" where a value ends.
    bool reportDecimalComma();
    /// "x := a + ;b": the operand of one word behind the semicolon ends the line. The parser then stands at it.
    bool operandBehindSemicolon();
    /// `VAR num x();`, `x() := 1;`
    void dropEmptyParentheses();
    /// `CASE 1;2:`
    bool takesSemicolonInCase();
    void expectColonOfDefault();

  private:
};

} // namespace rapid::syntax

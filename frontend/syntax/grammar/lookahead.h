#pragma once
// Questions about the tokens to come.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Questions about the next tokens. Every answer is found within a bounded number of tokens; nothing is read or reported.
class Lookahead : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// Is this the beginning of an instruction, if a line begins here?
    bool looksLikeInstruction(TokenIndex i) const;
    /// Does the word really begin a block or a declaration, or is it part of a sentence?
    bool opensBlock(TokenIndex i) const;
    /// Looks for a word before the statement can end; an expression may go over several lines.
    bool findOnLine(TokenIndex from, K wanted, TokenIndex& found) const;
    /// A name that ends its line, followed by a line at the same margin that is an instruction of its own: the
    /// semicolon is missing, although the second name could be read as an argument.
    bool calleeEndsHere(TokenIndex callee, TokenIndex calleeEnd) const;
    /// Names up to `last` that end their line and are not followed by an argument below. It does not matter where they begin:
    /// formatting gives each instruction a line, but keeps the lines within one.
    bool endsLine(TokenIndex last) const;
    /// After the text "say " of `"say "hi" now"`: a word between two texts without a space.
    bool quoteInText() const;
    /// An instruction on a line of its own, where something else should continue.
    bool beginsInstruction(bool inCase = false) const;
    bool startsDeclaration(TokenIndex i) const;
    /// `num x;`, `num x := 1;`: a word is missing before the data type.
    bool isWordlessData() const;
    /// `name(1) := ...`, `name[1].x := ...`
    bool isBracketTarget() const;
    /// The sign that closes the bracket at `opening`, which another language writes: of its own kind, or the one RAPID has there.
    K closingOf(TokenIndex opening) const;
    /// An optional argument is between this bracket and the one that closes it.
    bool hasOption(TokenIndex opening) const;
    /// "x{{1, 2}": the bracket before this one is the same, and nothing closes it.
    bool isDoubled(TokenIndex opening) const;
    /// A reserved word in the place of an operand, followed by what can follow an operand.
    bool atReservedName() const;
    /// "MoveL *, v100, fine, tool0;"
    bool isShownPosition() const;
    /// '=' at the end of the line after a value of CASE, in the place of the colon: an instruction follows, and no operand.
    bool isEqualForColon() const;
    /// "IF SetDO do1, 1;", "IF TPWrite "a";": an instruction without THEN, and no condition before it.
    bool missesCondition() const;
    /// At LOCAL and a declaration of data in a routine: whether nothing but declarations lies between it and the next routine,
    /// so that it is the END word that is missing.
    bool endsBeforeLocalData() const;
    /// After the header of a built-in: true when what follows is the next declaration.
    bool isNative() const;
    /// Four words or more in a line, and nothing between them that an instruction has.
    bool isProse() const;
    /// At '[' after the name of data: the list cannot be dimensions, so ":=" is missing before it.
    bool valueWithoutSign(DataKind kind) const;
    /// In a line below '(': an instruction or a declaration with its semicolon, and no parameter.
    bool bodyBeginsHere() const;
    /// "PROC worknum n)": the name and a data type, from which only '(' is missing.
    bool lacksParenthesis(TokenIndex name) const;
    /// Not a text, a list, a truth value, or a number that cannot be an index.
    bool mayBeIndex(const Expr& index) const;

  private:
    template <class Visit> TokenIndex walkBracket(TokenIndex opening, Visit&& visit) const;
    bool listClosesBelow(TokenIndex from) const;
    bool isInstructionLine() const;
};

} // namespace rapid::syntax

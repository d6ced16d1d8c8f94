#pragma once
// Blocks, heads and declarations in the form of other languages.

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// Blocks, negation and declarations as other languages write them: reported once, and read as meant.
class ForeignForms : public ParserPart {
  public:
    using ParserPart::ParserPart;

    /// LOOP, closed by ENDWHILE.
    bool isEndlessLoop();
    /// REPEAT, LOOP ... at the end of a line: reported; the word that closes the block is then skipped.
    bool startsForeignBlock();
    bool endsForeignBlock();
    /// One of the words that may come next.
    bool isForeignCloser(TokenIndex i) const;
    /// A block in braces: `expected` says how RAPID writes it. The list ends at its '}', or as it should.
    StmtList parseBody(const TokenSet& own, const std::string& expected, bool& braced);
    /// Braces that belong to nothing: a block without a word, or a comment.
    Stmt* parseBareBraces();
    /// "IF !ready THEN": the rest of the line is a comment, which ends with this word, and an operand does not follow.
    bool negatesByComment(std::string_view ending);
    /// `FOR (i = 0; i < 3; i++)`: one report for the head; what is assigned first is the loop variable.
    bool parseForeignFor(ForStmt* node);
    /// `for i in range(3):`: true when the head has been read.
    bool parseForIn(ForStmt* node);
    /// Type and name of data in a different order, or without a type: `x : num`, `x AS num`, `x := 1`.
    bool parseForeignData(DataDecl* node);
    /// A parameter without a data type, or with it after the name; true when it has been read.
    bool parseForeignParameter(ParamDecl* node);
    /// IN, REF, OUT ... before a parameter: reported and left out.
    void dropForeignMode(ParamDecl* node);
    /// `num a num b`, `num a; num b`: another parameter, whose comma is missing.
    bool missesComma();
};

} // namespace rapid::syntax

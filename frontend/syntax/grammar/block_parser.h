#pragma once
// IF, FOR, WHILE and TEST (manual 1.4.2).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// if, compact_if, for, while, test.
class BlockParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    enum class HeadPart : uint8_t { Value, CaseValue, Condition };

    Stmt* parseIf();
    /// `headRead`: THEN has been lost in a comment, or its absence reported.
    Stmt* parseIfBranches(TokenIndex opening, Expr* condition, bool headRead);
    Stmt* parseFor();
    Stmt* parseWhile();
    /// After the word, which has been read.
    Stmt* parseWhile(TokenIndex opening);
    /// From after DO, or at a DO that has not been read yet.
    Stmt* parseWhileBody(TokenIndex opening, Expr* condition, bool whole);
    Stmt* parseTest();

  private:
    Stmt* parseCompactIf(TokenIndex opening, Expr* condition);
    bool isBlockByMargin(TokenIndex opening);
    void parseElseOfCompact(TokenIndex opening);
    bool isSplitElseif();
    Stmt* parseForBody(ForStmt* node, TokenIndex opening, bool whole);
    bool isOtherBlock(TokenIndex opening);
    Stmt* parseTestCases(TokenIndex opening, Expr* subject, bool whole);
    TestCase* parseCase();
    Expr* parseHeadExpr(bool& whole, HeadPart part = HeadPart::Value);

    std::vector<IfBranch*> branches_;
    std::vector<TestCase*> cases_;
};

} // namespace rapid::syntax

#pragma once
// Instructions (manual 1.1.5, 1.4, 1.5, 1.11, 1.12).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// instructions, instruction, assignment, procedure_call, goto, label, return, raise, connect.
class InstructionParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    StmtList parseList(const TokenSet& own, bool braced = false);
    Stmt* parseStmt();
    Stmt* errorStmt(TokenIndex first);
    /// The tail of a block whose head was broken or lost: read as the block it was meant to be, without more reports.
    Stmt* parseOrphan();

  private:
    bool isMisspelt(const TokenSet& own);
    Stmt* parseStmtUnguarded();
    Stmt* parseNamedStmt();
    Stmt* noStmt(TokenIndex first);
    void skipHead();
    Stmt* parseLateMore();
    Stmt* parseLateDecl();
    Stmt* parseAssignment(Expr* target, TokenIndex first);
    Stmt* parseColonAssignment();
    Stmt* parseLabel();
    Stmt* parseCallStmt();
    bool parseParenthesisedCall(CallStmt* call);
    Stmt* parseLateCall();
    Stmt* parseGoto();
    Stmt* parseValueStmt(bool isReturn);
    Stmt* parseConnect();
    void skipTrapArguments();
    Stmt* parseSimple(NodeKind nodeKind);
};

} // namespace rapid::syntax

#pragma once
// Instructions (manual 1.1.5, 1.4, 1.5, 1.11, 1.12).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// instructions, instruction, assignment, procedure_call, goto, label, return, raise, connect.
class InstructionParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    StmtList parseInstructions(const TokenSet& own, bool braced = false);
    Stmt* parseInstruction();
    Stmt* errorStmt(TokenIndex first);
    /// The tail of a block whose head was broken or lost: read as the block it was meant to be, without more reports.
    Stmt* parseOrphan();

  private:
    bool isMisspelt(const TokenSet& own);
    Stmt* parseReservedNamed();
    Stmt* parseEffectiveInstruction();
    Stmt* parseNamedInstruction();
    Stmt* parseNoInstruction(TokenIndex first);
    void skipHead();
    Stmt* parseMoreData();
    Stmt* parseLateDeclaration();
    Stmt* parseAssignment(Expr* target, TokenIndex first);
    Stmt* parseColonAssignment();
    Stmt* parseLabel();
    Stmt* parseProcedureCall();
    bool parseParenthesisedCall(CallStmt* call);
    Stmt* parseLateBoundCall();
    Stmt* parseGoto();
    Stmt* parseReturnOrRaise(bool isReturn);
    Stmt* parseConnect();
    void skipTrapArguments();
    Stmt* parseWordInstruction(NodeKind nodeKind);
};

} // namespace rapid::syntax

#pragma once
// Instructions (manual 1.5 to 1.9).

#include "frontend/sema/part.h"

namespace rapid::sema {

class Statements : CheckerPart {
  public:
    Statements(State& state, const Parts& parts);

    /// Whether the end of the list can be reached.
    bool statements(syntax::StmtList list);

  private:
    bool statement(const syntax::Stmt& s);
    bool isCallWord(const syntax::CallStmt& s);
    bool wholeStatement(const syntax::Stmt& s);
    bool ifStmt(const syntax::IfStmt& s);
    bool testStmt(const syntax::TestStmt& s);
    void testValues(const syntax::TestStmt& s, Typed subject);
    bool forStmt(const syntax::ForStmt& s);
    bool whileStmt(const syntax::WhileStmt& s);
    void assign(const syntax::AssignStmt& s);
    bool assignsResult(const syntax::Expr& target);
    bool assignable(const Place& place, const syntax::Expr& target);
    bool predefinedCall(const RoutineSymbol& routine, syntax::TokenIndex name);
    void raiseToUser(const syntax::CallStmt& s);
    bool callStmt(const syntax::CallStmt& s);
    bool namesProcedure(std::span<syntax::Argument* const> args);
    bool isParenthesised(const syntax::CallStmt& s) const;
    void reportParentheses(const syntax::CallStmt& s);
    bool isCutBySemicolon(const Symbol& symbol, syntax::TokenIndex name);
    void reportNotCallable(const Symbol& symbol, syntax::TokenIndex name);
    bool reportLabelWithoutColon(const syntax::CallStmt& s);
    bool isLineOfText(const syntax::CallStmt& s);
    bool callsOldProcedure(const syntax::Stmt& s);
    void loopWord(const syntax::Stmt& s, const char* word);

    Availability& availability_;
    CallBinder& calls_;
    DataResolver& data_;
    Expressions& expressions_;
    FlowStatements& flow_;
    Jumps& jumps_;
    Places& places_;
    Remedies& remedies_;
    RoutineChecker& routines_;
    Scopes& scopes_;
    UnknownNames& unknown_;
};

} // namespace rapid::sema

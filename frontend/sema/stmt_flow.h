#pragma once
// Instructions of control flow that depend on the kind of routine or handler: RETURN, RAISE, CONNECT, UNDO (manual
// 1.1.5, 1.11 to 1.13).

#include "frontend/sema/part.h"

namespace rapid::sema {

class FlowStatements : CheckerPart {
  public:
    FlowStatements(State& state, const Parts& parts);

    /// A number in ERROR (...).
    void checkListedError(const syntax::Expr& e);
    /// Whether a built-in orders movement; stopping one is not movement.
    bool movesRobot(const RoutineSymbol& routine) const;
    /// Stops, raised errors and movement are not for UNDO handlers (manual 1.13).
    void callInUndo(const RoutineSymbol& routine, syntax::TokenIndex name);
    void returnStmt(const syntax::ReturnStmt& s);
    void raiseStmt(const syntax::RaiseStmt& s);
    void connectStmt(const syntax::ConnectStmt& s);

  private:
    void checkErrorNumber(const syntax::Expr& e, const char* what);
    bool mayBeErrorNumber(const syntax::Expr& e);
    bool reportConnectSwapped(const syntax::ConnectStmt& s);
    void connectTarget(const syntax::Expr& target);

    Expressions& expressions_;
    Places& places_;
    Remedies& remedies_;
    Scopes& scopes_;
    UnknownNames& unknown_;
};

} // namespace rapid::sema

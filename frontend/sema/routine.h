#pragma once
// Bodies of routines: scope of parameters and data, handlers (manual 1.1.5, 1.12, 1.13).

#include "frontend/sema/part.h"

namespace rapid::sema {

class RoutineChecker : CheckerPart {
  public:
    RoutineChecker(State& state, const Parts& parts);

    /// Checks a routine with its handlers. The routine context is that of this routine from now on.
    void checkRoutine(RoutineSymbol& symbol);
    /// Data of the routine of the context.
    void declareRoutineData(const syntax::DataDecl& decl);
    bool block(syntax::StmtList list); ///< a new block; whether its end can be reached

  private:
    void declareInRoutine(Symbol& symbol);
    bool checkPart(Part part, syntax::StmtList list);
    void reportUntestedOptionals();

    Collector& collector_;
    DataResolver& data_;
    Expressions& expressions_;
    FlowStatements& flow_;
    Jumps& jumps_;
    Statements& statements_;
};

} // namespace rapid::sema

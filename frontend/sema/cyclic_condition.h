#pragma once
// The condition of SetupCyclicBool: it is evaluated after the instruction, by the runtime and not by compiled code.

#include "frontend/sema/part.h"

namespace rapid::sema {

class CyclicCondition : CheckerPart {
  public:
    explicit CyclicCondition(State& state) : CheckerPart(state) {}
    /// Reports what of the condition cannot be evaluated after the call.
    void check(const syntax::CallStmt& s);

  private:
    std::string notCyclic(const syntax::Expr& e, const syntax::Expr*& culprit);
    std::string notCyclicData(const syntax::Expr& e);
};

} // namespace rapid::sema

#pragma once
// Built-ins that need a RobotWare option which the controller is known not to have.

#include "frontend/sema/part.h"

namespace rapid::sema {

class Availability : CheckerPart {
  public:
    explicit Availability(State& state);

    /// Reports, once in a task, a built-in whose RobotWare option the controller is known not to have.
    void checkOption(const RoutineSymbol& routine, syntax::TokenIndex name);
};

} // namespace rapid::sema

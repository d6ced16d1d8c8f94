#pragma once
// Built-ins that need a RobotWare option which the controller is known not to have.

#include "frontend/sema/part.h"

namespace rapid::sema {

class Availability : CheckerPart {
  public:
    explicit Availability(State& state);

    /// Reports `code`, or rather that the name is LOCAL elsewhere or may be declared in a module that is missing.
    /// A built-in whose RobotWare option the controller is known not to have.
    void checkOption(const RoutineSymbol& routine, syntax::TokenIndex name);
};

} // namespace rapid::sema

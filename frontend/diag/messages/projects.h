#pragma once
// Messages 6xxx: projects, tasks, configuration.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/projects.def"
#undef DIAG

} // namespace rapid::diag::say

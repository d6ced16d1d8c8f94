#pragma once
// Messages 8xxx: likely mistakes, warnings that can be switched off by name.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/warnings.def"
#undef DIAG

} // namespace rapid::diag::say

#pragma once
// Messages 4xxx: calls and built-ins.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/calls.def"
#undef DIAG

} // namespace rapid::diag::say

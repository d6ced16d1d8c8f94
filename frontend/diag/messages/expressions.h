#pragma once
// Messages 3xxx: expressions and constants.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/expressions.def"
#undef DIAG

} // namespace rapid::diag::say

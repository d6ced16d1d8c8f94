#pragma once
// Messages 1xxx: lexing and parsing.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/syntax.def"
#undef DIAG

} // namespace rapid::diag::say

#pragma once
// Messages 9xxx: internal errors.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/internal.def"
#undef DIAG

} // namespace rapid::diag::say

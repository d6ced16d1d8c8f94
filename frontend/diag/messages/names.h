#pragma once
// Messages 2xxx: names and types.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/names.def"
#undef DIAG

} // namespace rapid::diag::say

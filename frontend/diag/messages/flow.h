#pragma once
// Messages 5xxx: flow and use of data.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/flow.def"
#undef DIAG

} // namespace rapid::diag::say

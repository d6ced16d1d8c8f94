#pragma once
// Messages 7xxx: lowering and linking.

#include "frontend/diag/diagnostic.h"

namespace rapid::diag::say {

#define DIAG(number, name, severity, argCount, text) inline constexpr Message<argCount> name{Code{number}};
#include "frontend/diag/messages/lowering.def"
#undef DIAG

} // namespace rapid::diag::say

#pragma once
// Calls of the standard library that the compiler makes itself.

#include "ir/lower/lower.h"

namespace rapidc {

/// Options::evaluate of the functions linked into this executable (stdlib/constant_calls.h). Results that are not finite are
/// left to the program, which raises the error.
decltype(rapid::lower::Options::evaluate) constantCalls();

} // namespace rapidc

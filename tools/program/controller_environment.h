#pragma once
// The controller and the standard library that rapidc contains, as the front end asks for them.

#include "frontend/workspace/environment.h"

namespace rapidc {

/// One for the whole process; thread-safe.
const rapid::workspace::Environment& controllerEnvironment();

} // namespace rapidc

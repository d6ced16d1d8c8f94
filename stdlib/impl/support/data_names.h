#pragma once
// Module data by name, for what a later process must find again (--state).

#include "runtime/host/controller.h"

#include <string>

namespace rt::lib {

/// "Main:limit": the module data that lie at an address; "" when none do.
std::string nameOfData(const Controller& controller, const void* data);
/// The reverse, as `task` sees it; without data when there are none.
AnyRef dataByName(const Task& task, const std::string& name);

} // namespace rt::lib

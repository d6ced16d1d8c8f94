#pragma once
// Module data by address, and by name for a later process that must find them again (--state).

#include "runtime/host/controller.h"

#include <string>

namespace rt::lib {

/// The module data that lie at the address, or that it is a part of. Null when it is other data (of a routine, for instance).
const GlobalDesc* dataAt(const Controller& controller, const void* address);
/// The same, and they are a persistent.
bool isPersistent(const Controller& controller, const void* address);
/// "Main:limit": the module data that lie at an address; "" when none do.
std::string nameOfData(const Controller& controller, const void* data);
/// The reverse, as `task` sees it; without data when there are none.
AnyRef dataByName(const Task& task, const std::string& name);

} // namespace rt::lib

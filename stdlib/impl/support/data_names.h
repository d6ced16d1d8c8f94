#pragma once
// Module data and their parts by name, for what a later process must find again (--state).

#include "runtime/host/controller.h"

#include <string>

namespace rt::lib {

/// "Main:list{5}.trans.x" (elements count from 0 through all dimensions): the persistent, or the part of one, that lies at an address and has this type; "" when none does.
std::string nameOfData(Controller& controller, const void* data, const TypeDesc* type);
/// The reverse, as `task` sees it; without data when there is none.
AnyRef dataByName(const Task& task, const std::string& name);

} // namespace rt::lib

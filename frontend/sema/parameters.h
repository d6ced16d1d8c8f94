#pragma once
// The parameters of a routine as the arguments of a call meet them.

#include "frontend/sema/checked.h"

namespace rapid::sema {

size_t alternativesEnd(const RoutineSymbol& routine, size_t first);
size_t nextRequired(const RoutineSymbol& routine, size_t from);
size_t requiredSlots(const RoutineSymbol& routine);
/// The next required parameter without an argument; as many as there are parameters when each has its own.
size_t nextLacking(const BoundCall& call, size_t from);
std::string namesOf(std::span<const BoundArg> alternatives);

} // namespace rapid::sema

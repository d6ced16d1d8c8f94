#pragma once
// Routines that only call themselves or each other. Internal to frontend/lint.

#include "frontend/lint/facts.h"

#include <span>

namespace rapid::lint {

using RoutineList = std::vector<const sema::RoutineSymbol*>;

/// The rings among `candidates` that no call from `roots` reaches and no other candidate calls: each with its members
/// in the order of `candidates`. Routines that such a ring calls are not part of a ring.
std::vector<RoutineList> ringsOf(const TaskFacts& facts, const RoutineList& roots, RoutineList candidates);

} // namespace rapid::lint

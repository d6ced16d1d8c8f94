#pragma once
// Optional arguments that can follow.

#include "frontend/query/cursor.h"

namespace rapid::query {

/// The optional parameters that the call can still have at the offset: neither given nor excluded by one that is given, and in the order
/// of the parameters; when that leaves none, those that are not given.
std::vector<const sema::DataSymbol*> optionalChoices(const CallContext& call);

} // namespace rapid::query

#pragma once
// A call chain as JSON, a part of the state file.

#include "runtime/debug/call_chain.h"

#include <nlohmann/json_fwd.hpp>

namespace rt {

nlohmann::json jsonOf(const CallChain& chain);
/// Throws an exception of the JSON library, or std::invalid_argument, when it is not a chain.
CallChain chainFrom(const nlohmann::json& json);

} // namespace rt

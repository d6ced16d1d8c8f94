#pragma once
// The state of a motion group that is kept between two processes (--state).

#include "runtime/debug/state_keepers.h"
#include "runtime/host/controller.h"

#include <nlohmann/json_fwd.hpp>

namespace rt::lib {

/// An array with an entry per group; what an earlier process with a different number of groups left is refused.
StateKeepers::Keeper keptPerGroup(Controller& controller,
                                  std::function<nlohmann::json(MotionDriver&)> saveOne,
                                  std::function<void(MotionDriver&, const nlohmann::json&)> loadOne);

} // namespace rt::lib

#pragma once
// StopKind: the two stops on the path (docs/motion.md).

#include <cstdint>

namespace motion {

enum class StopKind : uint8_t {
    Normal, ///< brakes as for a stop point
    Quick,  ///< reaches the greatest deceleration sooner: only the short window averages it
};

} // namespace motion

#pragma once
// Planner: which of the two rules times the movements (docs/motion.md).

#include <cstdint>

namespace motion {

enum class Planner : uint8_t {
    Measured, ///< as controllers were measured: highest accelerations, averaged in time
    Optimal,  ///< the shortest time that keeps every limit at each moment, also that of the jerk
};

} // namespace motion

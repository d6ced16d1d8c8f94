#pragma once
// The two units of angles: degrees in all interfaces, radians in formulas.

#include <numbers>

namespace robot {

inline constexpr double kDeg = std::numbers::pi / 180.0; ///< radians of one degree
inline constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;

} // namespace robot

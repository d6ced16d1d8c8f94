#pragma once
// The two units of lengths: mm in all interfaces, metres in configuration files and formulas of dynamics.

namespace robot {

inline constexpr double kMmPerMetre = 1000;

} // namespace robot

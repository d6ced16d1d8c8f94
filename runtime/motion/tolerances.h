#pragma once

namespace motion {

/// Below it nothing moves; mm, deg, rad or s.
inline constexpr double kNothing = 1e-9;

/// A speed, an acceleration or the square of one that is not limited.
inline constexpr double kUnlimited = 1e300;

} // namespace motion

#pragma once
// The ranges within which num and dnum hold whole numbers as integers (manual 1.2): up to these, in both directions.

namespace rt {

inline constexpr double kNumInteger = 8388608;
inline constexpr double kDnumInteger = 4503599627370496;

} // namespace rt

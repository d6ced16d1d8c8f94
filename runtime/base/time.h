#pragma once
// Virtual time: nanoseconds since the start of main as a signed 64-bit integer, so that sums never depend on
// rounding.

#include <cstdint>
#include <limits>
#include <string>

namespace rt {

using Time = int64_t; ///< ns of virtual time (or a span of it)

inline constexpr Time kNever = std::numeric_limits<int64_t>::max();
inline constexpr Time kMicrosecond = 1'000;
inline constexpr Time kMillisecond = 1'000'000;
inline constexpr Time kSecond = 1'000'000'000;

/// Rounded to the nearest nanosecond; not-a-number and negative values give 0, what does not fit gives
/// kNever.
Time fromSeconds(double seconds);
inline double toSeconds(Time time) {
    return static_cast<double>(time) / 1e9;
}
/// Sum that stops at kNever instead of overflowing; both operands >= 0.
inline Time addTime(Time a, Time b) {
    return a > kNever - b ? kNever : a + b;
}
/// Seconds with a fixed number of decimals (0 to 9), cut off, not rounded: same digits on every machine.
std::string formatSeconds(Time time, int decimals);

} // namespace rt

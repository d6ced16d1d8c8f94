#include "runtime/base/time.h"

#include <fmt/format.h>

#include <cmath>

namespace rt {

Time fromSeconds(double seconds) {
    if (!(seconds > 0)) return 0;
    if (seconds >= 9.2e9) return kNever;
    return std::llround(seconds * 1e9);
}

std::string formatSeconds(Time time, int decimals) {
    Time unit = kSecond;
    for (int i = 0; i < decimals; ++i)
        unit /= 10;
    const Time whole = time / kSecond;
    if (decimals <= 0) return fmt::format("{}", whole);
    return fmt::format("{}.{:0{}}", whole, time % kSecond / unit, decimals);
}

} // namespace rt

#include "runtime/motion/velocity_ramp.h"

#include <algorithm>
#include <cmath>

namespace motion {

VelocityRamp rampTo(double v, const AxisState& from, double acceleration, double jerk) {
    const double landing =
        from.v + from.a * std::abs(from.a) / (2 * jerk); // when the acceleration is taken away
    const double sign = v < landing ? -1 : 1;
    const double begun = sign * from.a;
    const double change = sign * (v - from.v);
    const double peak = std::sqrt(std::max(0.0, jerk * change + 0.5 * begun * begun));
    VelocityRamp ramp;
    ramp.jerk = sign * jerk;
    const double top = std::min(peak, std::max(acceleration, begun));
    ramp.time[0] = std::max(0.0, (top - begun) / jerk);
    if (peak > top)
        ramp.time[1] = std::max(0.0, (change - (2 * top * top - begun * begun) / (2 * jerk)) / top);
    ramp.time[2] = top / jerk;
    return ramp;
}

} // namespace motion

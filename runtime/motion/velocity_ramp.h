#pragma once
// VelocityRamp: the fastest change of a speed under limits of acceleration and jerk, in closed form: at most three pieces of
// constant jerk.

#include <array>

namespace motion {

struct AxisState {
    double p = 0, v = 0, a = 0; ///< position, speed, acceleration; any length unit and seconds
};

/// After `t` seconds of constant jerk.
inline AxisState advanced(const AxisState& from, double jerk, double t) {
    return {from.p + t * (from.v + t * (from.a / 2 + t * jerk / 6)), from.v + t * (from.a + t * jerk / 2),
            from.a + t * jerk};
}

struct VelocityRamp {
    std::array<double, 3> time{}; ///< s, each at least 0
    double jerk = 0;              ///< in the first piece; in the last one the opposite, in the middle 0
    double duration() const { return time[0] + time[1] + time[2]; }
    double jerkOf(std::size_t piece) const { return piece == 0 ? jerk : piece == 2 ? -jerk : 0; }
    /// State at its end; `from` is where it began.
    AxisState end(AxisState from) const {
        for (std::size_t i = 0; i < 3; ++i)
            from = advanced(from, jerkOf(i), time[i]);
        return from;
    }
};

/// From a speed and an acceleration, at most `acceleration` in size, to the speed `v` with acceleration 0.
VelocityRamp rampTo(double v, const AxisState& from, double acceleration, double jerk);

} // namespace motion

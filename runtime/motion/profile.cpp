// Jerk-limited profiles, put together from speed changes: each speed change is a ramp of acceleration up, a
// plateau and a ramp down (trapezoid or triangle of acceleration).

#include "runtime/motion/profile.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

double decelerationOf(const ProfileLimits& limits) {
    return limits.deceleration > 0 ? limits.deceleration : limits.acceleration;
}

ProfileState advanced(const ProfileState& from, double time) {
    ProfileState state;
    state.j = from.j;
    state.a = from.a + from.j * time;
    state.v = from.v + time * (from.a + time * from.j * 0.5);
    state.s = from.s + time * (from.v + time * (from.a * 0.5 + time * from.j / 6));
    return state;
}

/// Three phases from (v, a) to (target speed, 0).
struct SpeedChange {
    double length[3] = {};
    double jerk[3] = {};

    ProfileState runFrom(ProfileState state) const {
        for (int i = 0; i < 3; ++i) {
            state.j = jerk[i];
            state = advanced(state, length[i]);
        }
        return state;
    }
};

SpeedChange changeSpeed(double v, double a, double target, const ProfileLimits& limits) {
    const double j = limits.jerk;
    // Letting go of the acceleration at once leads to this speed; from there decides which way to push.
    const double coasting = v + a * std::fabs(a) / (2 * j);
    const double sign = target >= coasting ? 1.0 : -1.0;
    const double limit = sign > 0 ? limits.acceleration : decelerationOf(limits);
    const double start = sign * a;
    const double rise = sign * (target - v);
    double peak = std::sqrt(std::max(0.0, j * rise + 0.5 * start * start));
    SpeedChange change;
    double plateau = 0;
    if (peak > limit) {
        peak = limit;
        // Speed gained by the two ramps; a start above the limit (it has just been lowered) is given back
        // first.
        const double ramps = (start > peak ? start * start : 2 * peak * peak - start * start) / (2 * j);
        plateau = std::max(0.0, (rise - ramps) / peak);
    }
    const double first = peak - start;
    change.length[0] = std::fabs(first) / j;
    change.jerk[0] = sign * (first >= 0 ? j : -j);
    change.length[1] = plateau;
    change.length[2] = peak / j;
    change.jerk[2] = -sign * j;
    return change;
}

/// Way covered while speeding up from rest to v (or braking from it) with these bounds.
double rampWay(double v, double acceleration, double jerk) {
    const double time = v * jerk <= acceleration * acceleration ? 2 * std::sqrt(v / jerk)
                                                                : v / acceleration + acceleration / jerk;
    return 0.5 * v * time;
}

/// Highest speed of a rest-to-rest motion over `way`, if the speed itself were not limited.
double reachableSpeed(double way, const ProfileLimits& limits) {
    const double a = limits.acceleration;
    const double d = decelerationOf(limits);
    const double j = limits.jerk;
    if (a == d) {
        const double triangular = std::cbrt(0.25 * way * way * j);
        if (triangular * j <= a * a) return triangular;
        const double lag = a * a / j;
        return 0.5 * (std::sqrt(lag * lag + 4 * a * way) - lag);
    }
    double low = 0;
    double high = std::sqrt(2 * way * std::max(a, d)) + std::cbrt(way * way * j);
    for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
        const double middle = 0.5 * (low + high);
        (rampWay(middle, a, j) + rampWay(middle, d, j) <= way ? low : high) = middle;
    }
    return low;
}

} // namespace

void Profile::append(double length, double jerk) {
    if (!(length > 0) || count_ >= kMaxPhases) return;
    tip_.j = jerk;
    phases_[static_cast<std::size_t>(count_)] = {duration_, tip_};
    ++count_;
    duration_ += length;
    tip_ = advanced(tip_, length);
}

void Profile::finish(double to) {
    end_ = to;
    tip_ = {to, 0, 0, 0};
}

Profile Profile::restToRest(double from, double to, const ProfileLimits& limits) {
    Profile profile;
    profile.tip_.s = from;
    const double way = to - from;
    if (!(way > 0)) {
        profile.finish(from);
        return profile;
    }
    const double speed = std::min(limits.speed, reachableSpeed(way, limits));
    const SpeedChange up = changeSpeed(0, 0, speed, limits);
    const SpeedChange down = changeSpeed(speed, 0, 0, limits);
    const double cruise = way - rampWay(speed, limits.acceleration, limits.jerk) -
                          rampWay(speed, decelerationOf(limits), limits.jerk);
    for (int i = 0; i < 3; ++i)
        profile.append(up.length[i], up.jerk[i]);
    profile.tip_.v = speed; // exact, not the sum of the phases
    profile.tip_.a = 0;
    profile.append(std::max(0.0, cruise) / speed, 0);
    for (int i = 0; i < 3; ++i)
        profile.append(down.length[i], down.jerk[i]);
    profile.finish(to);
    return profile;
}

Profile Profile::withDuration(double from, double to, const ProfileLimits& limits, double duration) {
    Profile fastest = restToRest(from, to, limits);
    const double way = to - from;
    if (!(duration > fastest.duration()) || !(way > 0)) return fastest;
    ProfileLimits slowed = limits;
    double low = way / duration; // at least this speed is needed
    double high = limits.speed;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
        slowed.speed = 0.5 * (low + high);
        (restToRest(from, to, slowed).duration() > duration ? low : high) = slowed.speed;
    }
    slowed.speed = high;
    return restToRest(from, to, slowed);
}

Profile Profile::pause(double duration) {
    Profile profile;
    profile.append(duration, 0);
    return profile;
}

Profile Profile::brake(const ProfileState& start, const ProfileLimits& limits) {
    Profile profile;
    profile.tip_ = start;
    const SpeedChange change = changeSpeed(start.v, start.a, 0, limits);
    for (int i = 0; i < 3; ++i)
        profile.append(change.length[i], change.jerk[i]);
    profile.finish(profile.tip_.s);
    return profile;
}

Profile Profile::continueTo(const ProfileState& start, double to, const ProfileLimits& limits,
                            bool& feasible) {
    const auto endOf = [&](double speed) {
        ProfileState state = changeSpeed(start.v, start.a, speed, limits).runFrom(start);
        state.v = speed;
        state.a = 0;
        return changeSpeed(speed, 0, 0, limits).runFrom(state).s;
    };
    const double slack = 1e-12 * std::max(1.0, std::fabs(to));
    feasible = endOf(0) <= to + slack;
    double speed = limits.speed;
    if (feasible && endOf(speed) > to) {
        double low = 0;
        double high = speed;
        for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
            const double middle = 0.5 * (low + high);
            (endOf(middle) <= to ? low : high) = middle;
        }
        speed = low;
    }
    Profile profile;
    profile.tip_ = start;
    const SpeedChange first = changeSpeed(start.v, start.a, speed, limits);
    for (int i = 0; i < 3; ++i)
        profile.append(first.length[i], first.jerk[i]);
    profile.tip_.v = speed;
    profile.tip_.a = 0;
    const double rest = to - endOf(speed);
    if (speed > 0 && rest > 0) profile.append(rest / speed, 0);
    const SpeedChange down = changeSpeed(speed, 0, 0, limits);
    for (int i = 0; i < 3; ++i)
        profile.append(down.length[i], down.jerk[i]);
    profile.finish(to);
    return profile;
}

double Profile::peakSpeed() const {
    double peak = 0; // speed is highest where a phase begins: the acceleration changes sign there only
    for (int i = 0; i < count_; ++i)
        peak = std::max(peak, phases_[static_cast<std::size_t>(i)].state.v);
    return peak;
}

ProfileState Profile::at(double time) const {
    if (count_ == 0 || time >= duration_) return {end_, 0, 0, 0};
    const double clamped = std::max(0.0, time);
    int i = count_ - 1;
    while (i > 0 && phases_[static_cast<std::size_t>(i)].start > clamped)
        --i;
    const Phase& phase = phases_[static_cast<std::size_t>(i)];
    ProfileState state = advanced(phase.state, clamped - phase.start);
    // The last digits of the sum of phases may lie beyond the end.
    state.s = std::min(state.s, end_);
    state.v = std::max(state.v, 0.0);
    return state;
}

double Profile::timeAt(double s) const {
    if (count_ == 0 || s <= phases_[0].state.s) return 0;
    if (s >= end_) return duration_;
    int i = count_ - 1;
    while (i > 0 && phases_[static_cast<std::size_t>(i)].state.s >= s)
        --i;
    double low = phases_[static_cast<std::size_t>(i)].start;
    double high = i + 1 < count_ ? phases_[static_cast<std::size_t>(i) + 1].start : duration_;
    for (int n = 0; n < 100 && high - low > 1e-13; ++n) {
        const double middle = 0.5 * (low + high);
        (at(middle).s < s ? low : high) = middle;
    }
    return high;
}

} // namespace motion

#include "runtime/motion/axis_profile.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

/// A root of f between a and b, where its values fa and fb have different signs (method of Chandrupatla: inverse quadratic
/// interpolation where that is safe, else bisection). Ends when `isClose(x, f)`.
template <class Function, class Close>
double rootOf(Function f, Close isClose, double a, double fa, double b, double fb) {
    double share = 0.5; // of the way from the newest point to the other side of the root
    double x = a;
    constexpr int kMostSteps = 100;
    for (int i = 0; i < kMostSteps; ++i) {
        x = a + share * (b - a);
        const double fx = f(x);
        if (isClose(x, fx)) return x;
        double c = a, fc = fa; // the point that is given up
        if ((fx > 0) != (fa > 0)) {
            c = b, fc = fb;
            b = a, fb = fa;
        }
        a = x, fa = fx;
        if (std::abs(b - a) <= 4e-16 * (std::abs(a) + std::abs(b))) return x;
        const double xi = (a - b) / (c - b);
        const double phi = (fa - fb) / (fc - fb);
        share = 0.5;
        if (1 - std::sqrt(1 - xi) < phi && phi < std::sqrt(xi))
            share = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
        share = std::clamp(share, 1e-14, 1 - 1e-14);
    }
    return x;
}

} // namespace

/// The profiles between two states: one for each speed in the middle.
class ProfileChoice {
  public:
    static constexpr std::size_t kMost = 8;

    ProfileChoice(const AxisState& from, const AxisState& to, const AxisLimits& limits)
        : from_(from), to_(to), limits_(limits), way_(to.p - from.p) {}

    /// Both changes of speed together, in time and way.
    struct Changes {
        VelocityRamp first, last; // the last one backwards in time
        double time = 0, way = 0;
    };
    Changes changesAt(double speed) const {
        Changes c;
        c.first = rampTo(speed, {0, from_.v, from_.a}, limits_.acceleration, limits_.jerk);
        c.last = rampTo(speed, {0, to_.v, -to_.a}, limits_.acceleration, limits_.jerk);
        c.time = c.first.duration() + c.last.duration();
        c.way = c.first.end({0, from_.v, from_.a}).p + c.last.end({0, to_.v, -to_.a}).p;
        return c;
    }

    struct Candidate {
        double speed = 0, kept = 0, duration = 0; // kept: s at that speed
    };
    /// Those that take no longer than necessary for their direction.
    void findCandidates() {
        const double most = limits_.speed;
        for (const double speed : {most, -most}) { // long ways: the greatest speed is kept for a while
            const Changes c = changesAt(speed);
            const double left = way_ - c.way;
            if (left * speed >= 0) return add(speed, left / speed, c.time);
        }
        const double a = landing(from_.v, from_.a), b = landing(to_.v, -to_.a);
        std::array<double, 5> borders{-most, std::clamp(std::min(a, b), -most, most),
                                      std::clamp(std::max(a, b), -most, most), 0, most};
        std::sort(borders.begin(), borders.end());
        double before = 0;
        for (std::size_t i = 0; i < borders.size(); ++i) {
            if (i > 0 && borders[i] == borders[i - 1]) continue;
            const Changes c = changesAt(borders[i]);
            const double left = way_ - c.way;
            if (i > 0 && (before < 0) != (left < 0)) addRoot(borders[i - 1], before, borders[i], left);
            if (left == 0) add(borders[i], 0, c.time);
            before = left;
        }
        std::sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count),
                  [](const Candidate& x, const Candidate& y) { return x.duration < y.duration; });
    }

    /// The speed with which it takes so long, beginning with one that takes less; nothing when there is none.
    std::optional<Candidate> lasting(double seconds, const Candidate& shorter) const {
        const double spare = seconds - shorter.duration;
        if (spare <= 1e-13 * seconds) return shorter;
        if (std::abs(shorter.speed) <= 1e-14 * limits_.speed)
            return Candidate{shorter.speed, shorter.kept + spare, seconds};
        const auto missAt = [&](double speed) {
            const Changes c = changesAt(speed);
            return c.way + speed * (seconds - c.time) - way_;
        };
        // At the speed of the shorter one it would go too far. In between there is one that fits, unless both changes of
        // speed take longer than the time; bisection finds where that begins.
        double inner = shorter.speed;
        double outer = shorter.speed > 0 ? -limits_.speed : limits_.speed;
        double innerMiss = shorter.speed * spare;
        double outerMiss = 0;
        constexpr int kMostSteps = 60;
        for (int i = 0; i < kMostSteps; ++i) {
            const double speed = i == 0 ? 0 : 0.5 * (inner + outer);
            const Changes c = changesAt(speed);
            const double kept = seconds - c.time;
            const double miss = c.way + speed * kept - way_;
            if (kept < 0 && (i > 0 || shorter.speed != 0)) {
                outer = speed;
                continue;
            }
            if ((miss > 0) == (innerMiss > 0)) {
                inner = speed;
                innerMiss = miss;
                continue;
            }
            outer = speed;
            outerMiss = miss;
            const double found = rootOf(
                missAt, [&](double, double left) { return std::abs(left) <= tolerance(); }, inner, innerMiss,
                outer, outerMiss);
            const double left = seconds - changesAt(found).time;
            if (left < -1e-12 * seconds) return {}; // the two changes of speed leave a gap in between
            return Candidate{found, std::max(0.0, left), seconds};
        }
        return {};
    }

    AxisProfile profile(const Candidate& chosen) const {
        const Changes c = changesAt(chosen.speed);
        AxisProfile result;
        result.from_ = from_;
        result.to_ = to_;
        for (std::size_t i = 0; i < 3; ++i) {
            result.time_[i] = c.first.time[i];
            result.jerk_[i] = c.first.jerkOf(i);
            result.time_[6 - i] = c.last.time[i];
            result.jerk_[6 - i] = c.last.jerkOf(i);
        }
        result.time_[3] = chosen.kept;
        result.duration_ = c.time + chosen.kept;
        return result;
    }

    std::array<Candidate, kMost> candidates{};
    std::size_t count = 0;

  private:
    double landing(double v, double a) const { return v + a * std::abs(a) / (2 * limits_.jerk); }
    double tolerance() const { return 1e-12 * (1 + std::abs(way_)); }
    void add(double speed, double kept, double time) {
        if (count < kMost) candidates[count++] = {speed, kept, time + kept};
    }
    /// Between two speeds without keeping one of them; `left` and `right`: what is missing of the way there.
    void addRoot(double low, double left, double high, double right) {
        const double speed = rootOf([&](double v) { return way_ - changesAt(v).way; },
                                    [&](double, double miss) { return std::abs(miss) <= tolerance(); }, low,
                                    left, high, right);
        add(speed, 0, changesAt(speed).time);
    }

    AxisState from_, to_;
    AxisLimits limits_;
    double way_;
};

AxisProfile AxisProfile::restToRest(double from, double to, const AxisLimits& limits) {
    const double way = std::abs(to - from);
    const double v = limits.speed, a = limits.acceleration, j = limits.jerk;
    double ramp = 0; // s of changing acceleration
    double full = 0; // s of full acceleration
    double kept = 0; // s of full speed
    const bool isFull = v * j >= a * a;
    ramp = isFull ? a / j : std::sqrt(v / j);
    const double rampWay = v * (isFull ? v / a + ramp : 2 * ramp);
    if (way >= rampWay) {
        kept = (way - rampWay) / v;
        full = isFull ? v / a - ramp : 0;
    } else if (isFull && way * j * j >= 2 * a * a * a) {
        const double b = a * ramp;
        full = 0.5 * (std::sqrt(b * b + 4 * a * way) - b) / a - ramp;
    } else {
        ramp = std::cbrt(way / (2 * j));
    }
    AxisProfile profile;
    const double sign = to < from ? -j : j;
    profile.from_.p = from;
    profile.to_.p = to;
    profile.time_ = {ramp, full, ramp, kept, ramp, full, ramp};
    profile.jerk_ = {sign, 0, -sign, 0, -sign, 0, sign};
    profile.duration_ = 4 * ramp + 2 * full + kept;
    return profile;
}

AxisProfile AxisProfile::slowedTo(double seconds) const {
    if (!(duration_ > 0)) {
        AxisProfile result = *this;
        result.time_[3] = result.duration_ = seconds;
        return result;
    }
    AxisProfile result = *this;
    const double factor = seconds / duration_;
    const double slower = 1 / (factor * factor * factor);
    for (std::size_t i = 0; i < kPieces; ++i) {
        result.time_[i] *= factor;
        result.jerk_[i] *= slower;
    }
    result.duration_ = seconds;
    return result;
}

AxisProfile AxisProfile::between(const AxisState& from, const AxisState& to, const AxisLimits& limits) {
    ProfileChoice choice(from, to, limits);
    choice.findCandidates();
    return choice.profile(choice.candidates[0]);
}

std::optional<AxisProfile> AxisProfile::lasting(double seconds, const AxisState& from, const AxisState& to,
                                                const AxisLimits& limits) {
    ProfileChoice choice(from, to, limits);
    choice.findCandidates();
    for (std::size_t i = choice.count; i-- > 0;) {
        if (choice.candidates[i].duration > seconds) continue;
        if (const auto found = choice.lasting(seconds, choice.candidates[i])) return choice.profile(*found);
    }
    return {};
}

AxisState AxisProfile::at(double seconds) const {
    if (seconds <= 0) return {from_.p + from_.v * seconds, from_.v, from_.a};
    if (seconds >= duration_) return {to_.p + to_.v * (seconds - duration_), to_.v, to_.a};
    AxisState state = from_;
    for (std::size_t i = 0; i < kPieces; ++i) {
        if (seconds <= time_[i]) return advanced(state, jerk_[i], seconds);
        state = advanced(state, jerk_[i], time_[i]);
        seconds -= time_[i];
    }
    return state;
}

void restToRestTogether(std::span<const double> from, std::span<const double> to,
                        std::span<const AxisLimits> limits, std::span<AxisProfile> profiles) {
    double longest = 0;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
        profiles[i] = AxisProfile::restToRest(from[i], to[i], limits[i]);
        longest = std::max(longest, profiles[i].duration());
    }
    for (AxisProfile& profile : profiles)
        if (profile.duration() < longest) profile = profile.slowedTo(longest);
}

void betweenTogether(std::span<const AxisState> from, std::span<const AxisState> to,
                     std::span<const AxisLimits> limits, std::span<AxisProfile> profiles) {
    constexpr std::size_t kMostAxes = 16;
    std::array<std::optional<ProfileChoice>, kMostAxes> choices;
    double duration = 0;
    const std::size_t count = std::min(profiles.size(), kMostAxes);
    for (std::size_t i = 0; i < count; ++i) {
        choices[i].emplace(from[i], to[i], limits[i]);
        choices[i]->findCandidates();
        duration = std::max(duration, choices[i]->candidates[0].duration);
    }
    std::array<double, kMostAxes> solved{}; // durations for which the profile is known
    for (std::size_t i = 0; i < count;) {
        if (solved[i] == duration && duration > 0) {
            ++i;
            continue;
        }
        const ProfileChoice& choice = *choices[i];
        std::optional<ProfileChoice::Candidate> found;
        for (std::size_t k = choice.count; k-- > 0 && !found;)
            if (choice.candidates[k].duration <= duration)
                found = choice.lasting(duration, choice.candidates[k]);
        if (found) {
            profiles[i] = choice.profile(*found);
            solved[i] = duration;
            ++i;
            continue;
        }
        // This axis cannot take so long without turning back: the next time it can.
        double next = 1.02 * duration;
        for (std::size_t k = choice.count; k-- > 0;)
            if (choice.candidates[k].duration > duration) next = choice.candidates[k].duration;
        duration = next;
        i = 0;
    }
}

} // namespace motion

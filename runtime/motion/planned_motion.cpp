// Finds the bounds of the profile's parameter and the pace along the path.

#include "runtime/motion/planned_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motion {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kMargin = 0.99; // grid nodes are not the whole path
constexpr double kTcpMargin =
    0.999; // the same for the TCP where its speed is not proportional to the parameter's
constexpr double kBendShare = 0.9;  // share of an axis' acceleration that bends of the path may take at most
constexpr double kUnevenPace = 1.1; // ratio of fastest to slowest place that makes a warp worth it

/// What may be used: limits of the axes, figures of the program. deg, mm, s.
struct Bounds {
    Joints speed, acceleration, jerk;
    double tcpSpeed = kUnlimited, orientationSpeed = kUnlimited;
    double pathAcceleration = kUnlimited, pathDeceleration = kUnlimited, worldAcceleration = kUnlimited;
    ExternalAxes externalSpeed, externalAcceleration, externalJerk;
};

/// Derivatives of everything that moves, by the path parameter, at one place.
struct Rates {
    double s = 0;
    Joints first{}, second{};
    double mm = 0, deg = 0;
    double bend = 0; // 1/radius of an arc, 1/mm
};

struct Candidate {
    Warp warp;
    ProfileLimits limits;
    Limiter limiter = Limiter::None;
    int axis = 0;
    double duration = kUnlimited;
};

double atMost(double bound, double rate) {
    return rate == 0 ? kUnlimited : bound / std::fabs(rate);
}

Bounds boundsFor(const robot::RobotModel& model, const ExternalAxisModels& external,
                 const MoveCommand& command) {
    Bounds bounds;
    const MotionSettings& set = command.settings;
    const double acceleration = 0.01 * std::clamp(set.accelerationPercent, 20.0, 100.0);
    // Ramp scales the rate of change of acceleration; so does Acc, for its ramps take the same time.
    const double jerk = acceleration * 0.01 * std::clamp(set.rampPercent, 10.0, 100.0);
    for (std::size_t i = 0; i < bounds.speed.size(); ++i) {
        bounds.speed[i] = kMargin * model.maxSpeed[i];
        bounds.acceleration[i] = kMargin * acceleration * model.maxAcceleration[i];
        bounds.jerk[i] = kMargin * jerk * model.maxJerk[i];
    }
    const bool isTimed = command.duration > 0; // the time replaces the programmed speeds
    const double share = 0.01 * std::clamp(set.velocityPercent, 0.01, 100.0);
    // A speed of 0 would never arrive; controllers take it as the slowest they can do.
    const auto programmed = [&](double speed) {
        return isTimed ? kUnlimited : share * std::max(speed, 0.01);
    };
    bounds.tcpSpeed =
        std::min(programmed(command.speed.vTcp), isTimed ? kUnlimited : std::max(set.maxTcpSpeed, 0.01));
    bounds.orientationSpeed = programmed(command.speed.vOri);
    for (std::size_t i = 0; i < bounds.externalSpeed.size(); ++i) {
        const ExternalAxisModel& axis = external[i];
        const double wanted = programmed(axis.rotating ? command.speed.vReax : command.speed.vLeax);
        bounds.externalSpeed[i] = std::min(wanted, kMargin * axis.maxSpeed);
        bounds.externalAcceleration[i] = kMargin * acceleration * axis.maxAcceleration;
        bounds.externalJerk[i] = kMargin * jerk * axis.maxJerk;
    }
    if (set.pathAcceleration > 0) bounds.pathAcceleration = 1000 * set.pathAcceleration;
    if (set.pathDeceleration > 0) bounds.pathDeceleration = 1000 * set.pathDeceleration;
    if (set.worldAcceleration > 0) bounds.worldAcceleration = 1000 * set.worldAcceleration;
    return bounds;
}

std::vector<Rates> ratesAlong(const MotionPath& path) {
    std::vector<Rates> rates;
    const auto add = [&](double s) {
        Rates r;
        r.s = s;
        path.derivativesAt(s, r.first, r.second);
        path.tcpRatesAt(s, r.mm, r.deg);
        if (path.isCartesian() && path.curve().isArc()) r.bend = 1 / path.curve().radius();
        rates.push_back(r);
    };
    const auto& nodes = path.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i > 0) add(0.5 * (nodes[i - 1].s + nodes[i].s));
        add(nodes[i].s);
    }
    return rates;
}

ExternalAxes externalTravel(const MotionPath& path) {
    ExternalAxes travel{};
    for (std::size_t i = 0; i < travel.size(); ++i) {
        if (isConnected(path.start().extax[i])) travel[i] = path.end().extax[i] - path.start().extax[i];
    }
    return travel;
}

/// Rates by u instead of s.
Rates warped(const Rates& r, const Warp::Point& w) {
    Rates result = r;
    for (std::size_t i = 0; i < r.first.size(); ++i) {
        result.first[i] = r.first[i] * w.first;
        result.second[i] = r.second[i] * w.first * w.first + r.first[i] * w.second;
    }
    result.mm = r.mm * w.first;
    result.deg = r.deg * w.first;
    return result;
}

/// Constant bounds of u's derivatives for one warp.
class BoundFinder {
  public:
    BoundFinder(const Bounds& bounds, const ExternalAxes& travel, bool isCartesian)
        : bounds_(bounds), travel_(travel), isCartesian_(isCartesian) {}

    /// The warp must be the identity or made from the places of `rates`.
    Candidate find(const std::vector<Rates>& rates, Warp warp) const {
        Candidate best;
        std::vector<Rates> byU;
        std::vector<Warp::Point> points;
        byU.reserve(rates.size());
        points.reserve(rates.size());
        for (std::size_t k = 0; k < rates.size(); ++k) {
            points.push_back(warp.isIdentity() ? Warp::Point{rates[k].s, 1, 0} : warp.atPlace(k));
            byU.push_back(warped(rates[k], points.back()));
        }
        Candidate fastest;
        fastest.limits.speed = kUnlimited;
        const double tcpMargin = warp.isIdentity() && isCartesian_ ? 1 : kTcpMargin;
        for (std::size_t i = 0; i < byU.size(); ++i)
            limitSpeed(byU[i], points[i], tcpMargin, fastest);
        if (fastest.limits.speed == kUnlimited) return best; // nothing moves
        // Going through bends slower leaves more acceleration for starting and stopping: the best trade is
        // tried out.
        for (double share : {1.0, 0.9, 0.8, 0.7, 0.55, 0.4}) {
            Candidate candidate = fastest;
            candidate.limits.speed = share * fastest.limits.speed;
            for (std::size_t i = 0; i < byU.size(); ++i)
                limitAcceleration(byU[i], points[i], candidate.limits);
            candidate.duration = Profile::restToRest(0, 1, candidate.limits).duration();
            if (candidate.duration < best.duration) best = candidate;
        }
        best.warp = std::move(warp);
        return best;
    }

  private:
    void limitSpeed(const Rates& r, const Warp::Point& w, double tcpMargin, Candidate& c) const {
        const auto limit = [&](double speed, Limiter limiter, int axis) {
            if (speed >= c.limits.speed) return;
            c.limits.speed = speed;
            c.limiter = limiter;
            c.axis = axis;
        };
        limit(atMost(tcpMargin * bounds_.tcpSpeed, r.mm), Limiter::TcpSpeed, 0);
        limit(atMost(tcpMargin * bounds_.orientationSpeed, r.deg), Limiter::OrientationSpeed, 0);
        for (std::size_t i = 0; i < r.first.size(); ++i) {
            const int axis = static_cast<int>(i) + 1;
            limit(atMost(bounds_.speed[i], r.first[i]), Limiter::JointSpeed, axis);
            limit(std::sqrt(atMost(kBendShare * bounds_.acceleration[i], r.second[i])), Limiter::JointSpeed,
                  axis);
        }
        for (std::size_t i = 0; i < travel_.size(); ++i) {
            const int axis = static_cast<int>(i) + robot::kFirstExternalAxis;
            limit(atMost(bounds_.externalSpeed[i], travel_[i] * w.first), Limiter::ExternalSpeed, axis);
            const double bend = travel_[i] * w.second;
            limit(std::sqrt(atMost(kBendShare * bounds_.externalAcceleration[i], bend)),
                  Limiter::ExternalSpeed, axis);
        }
        limit(std::sqrt(atMost(0.7 * bounds_.worldAcceleration, r.mm * r.mm * r.bend)), Limiter::TcpSpeed, 0);
    }

    void limitAcceleration(const Rates& r, const Warp::Point& w, ProfileLimits& limits) const {
        const double square = limits.speed * limits.speed;
        double acceleration = limits.acceleration == 0 ? kUnlimited : limits.acceleration;
        double deceleration = limits.deceleration == 0 ? kUnlimited : limits.deceleration;
        double jerk = limits.jerk == 0 ? kUnlimited : limits.jerk;
        const auto limit = [&](double first, double second, double a, double j) {
            const double left = atMost(a - std::fabs(second) * square, first);
            acceleration = std::min(acceleration, left);
            deceleration = std::min(deceleration, left);
            jerk = std::min(jerk, atMost(j, first));
        };
        for (std::size_t i = 0; i < r.first.size(); ++i) {
            limit(r.first[i], r.second[i], bounds_.acceleration[i], bounds_.jerk[i]);
        }
        for (std::size_t i = 0; i < travel_.size(); ++i) {
            limit(travel_[i] * w.first, travel_[i] * w.second, bounds_.externalAcceleration[i],
                  bounds_.externalJerk[i]);
        }
        // On a warped path the TCP's acceleration has a part that comes from the pace; it is small where it
        // matters.
        const double world = 0.7 * bounds_.worldAcceleration;
        const double pace = std::fabs(r.mm / std::max(w.first, 1e-300) * w.second) * square;
        const auto pathBound = [&](double a) { return atMost(std::max(a - pace, 0.05 * a), r.mm); };
        acceleration = std::min({acceleration, pathBound(bounds_.pathAcceleration), pathBound(world)});
        deceleration = std::min({deceleration, pathBound(bounds_.pathDeceleration), pathBound(world)});
        limits.acceleration = acceleration;
        limits.deceleration = deceleration;
        limits.jerk = jerk;
    }

    const Bounds& bounds_;
    const ExternalAxes& travel_;
    bool isCartesian_;
};

/// Slowness (s per unit of path parameter) at each place when every place is run as fast as it allows and
/// speed changes between them are within reach. Shares: of the acceleration for bends and for changes of
/// speed.
std::vector<double> slownessAlong(const std::vector<Rates>& rates, const Bounds& bounds,
                                  const ExternalAxes& travel, double bendShare, double changeShare) {
    const std::size_t n = rates.size();
    std::vector<double> square(n); // of ds/dt
    std::vector<double> change(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Rates& r = rates[k];
        double speed = std::min(atMost(bounds.tcpSpeed, r.mm), atMost(bounds.orientationSpeed, r.deg));
        change[k] = kUnlimited;
        for (std::size_t i = 0; i < r.first.size(); ++i) {
            speed = std::min({speed, atMost(bounds.speed[i], r.first[i]),
                              std::sqrt(atMost(bendShare * bounds.acceleration[i], r.second[i]))});
            change[k] = std::min(change[k], atMost(changeShare * bounds.acceleration[i], r.first[i]));
        }
        for (std::size_t i = 0; i < travel.size(); ++i) {
            speed = std::min(speed, atMost(bounds.externalSpeed[i], travel[i]));
            change[k] = std::min(change[k], atMost(changeShare * bounds.externalAcceleration[i], travel[i]));
        }
        square[k] = speed * speed;
    }
    const auto reach = [&](std::size_t from, std::size_t to) {
        const double way = std::fabs(rates[to].s - rates[from].s);
        square[to] = std::min(square[to], square[from] + 2 * std::min(change[from], change[to]) * way);
    };
    for (std::size_t k = 1; k < n; ++k)
        reach(k - 1, k);
    for (std::size_t k = n; k-- > 1;)
        reach(k, k - 1);
    std::vector<double> slowness(n);
    for (std::size_t k = 0; k < n; ++k)
        slowness[k] = 1 / std::sqrt(square[k]);
    return slowness;
}

/// Rounds the corners off; the result is nowhere below the original.
std::vector<double> smoothed(const std::vector<double>& values) {
    constexpr std::size_t kReach = 4;
    const std::size_t n = values.size();
    const auto window = [&](const std::vector<double>& from, auto&& combine) {
        std::vector<double> result(n);
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t first = k < kReach ? 0 : k - kReach;
            const std::size_t last = std::min(n - 1, k + kReach);
            result[k] = combine(from.begin() + static_cast<std::ptrdiff_t>(first),
                                from.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        }
        return result;
    };
    const auto largest = [](auto from, auto to) { return *std::max_element(from, to); };
    const auto mean = [](auto from, auto to) {
        double sum = 0;
        for (auto it = from; it != to; ++it)
            sum += *it;
        return sum / static_cast<double>(to - from);
    };
    return window(window(window(window(values, largest), largest), mean), mean);
}

bool isUneven(const std::vector<double>& slowness) {
    const auto [least, most] = std::minmax_element(slowness.begin(), slowness.end());
    return *most > kUnevenPace * *least;
}

} // namespace

PlannedMotion PlannedMotion::plan(MotionPath path, const robot::RobotModel& model,
                                  const ExternalAxisModels& external, const MoveCommand& command) {
    PlannedMotion motion;
    motion.programmedDuration_ = command.duration;
    const Bounds bounds = boundsFor(model, external, command);
    const ExternalAxes travel = externalTravel(path);
    if (!path.isEmpty()) {
        const std::vector<Rates> rates = ratesAlong(path);
        const BoundFinder finder(bounds, travel, path.isCartesian());
        Candidate best = finder.find(rates, Warp{});
        std::vector<double> places;
        for (const Rates& r : rates)
            places.push_back(r.s);
        for (const auto& [bendShare, changeShare] : {std::pair{0.3, 0.3}, {0.5, 0.2}, {0.15, 0.15}}) {
            if (!path.isCartesian()) break;
            const auto slowness = slownessAlong(rates, bounds, travel, bendShare, changeShare);
            if (!isUneven(slowness)) break;
            Warp warp = Warp::fromSlowness(places, smoothed(slowness));
            if (warp.isIdentity()) continue;
            Candidate candidate = finder.find(rates, std::move(warp));
            if (candidate.duration < best.duration) best = std::move(candidate);
        }
        motion.warp_ = std::move(best.warp);
        motion.limits_ = best.limits;
        motion.limiter_ = best.limiter;
        motion.limitingAxis_ = best.axis;
    }
    motion.path_ = std::move(path);
    if (command.duration > 0 && motion.limits_.speed > 0) {
        const Profile wanted = Profile::withDuration(0, 1, motion.limits_, command.duration);
        if (wanted.duration() <= command.duration * (1 + 1e-9)) {
            motion.limits_.speed = wanted.peakSpeed();
            motion.limiter_ = Limiter::Duration;
            motion.limitingAxis_ = 0;
        }
    }
    motion.profile_ = motion.profileAt(100);
    return motion;
}

ProfileLimits PlannedMotion::limitsAt(double overridePercent) const {
    ProfileLimits limits = limits_;
    limits.speed *= 0.01 * std::clamp(overridePercent, 0.01, 100.0);
    return limits;
}

Profile PlannedMotion::profileAt(double overridePercent) const {
    if (!(limits_.speed > 0))
        return programmedDuration_ > 0 ? Profile::pause(programmedDuration_) : Profile{};
    return Profile::restToRest(0, 1, limitsAt(overridePercent));
}

MotionState PlannedMotion::sample(double time) const {
    MotionState state = sampleAt(profile_.at(time));
    state.moving = time > 0 && time < profile_.duration();
    return state;
}

MotionState PlannedMotion::sampleAt(const ProfileState& state) const {
    const Warp::Point place = warp_.at(state.s);
    MotionState result;
    result.pathFraction = place.s;
    result.joints = path_.jointsAt(place.s);
    result.extax = path_.externalAt(place.s);
    result.tcp = path_.frames().tcpInWorld(path_.kinematics().forward(result.joints));
    const double pace = place.first * state.v;
    if (pace > 0) {
        Joints second;
        path_.derivativesAt(place.s, result.jointSpeed, second);
        for (double& speed : result.jointSpeed)
            speed *= pace;
        double mm = 0;
        double deg = 0;
        path_.tcpRatesAt(place.s, mm, deg);
        result.tcpSpeed = mm * pace;
    }
    return result;
}

double PlannedMotion::parameterAtDistance(double mm) const {
    return warp_.inverse(path_.parameterAtDistance(mm));
}

} // namespace motion

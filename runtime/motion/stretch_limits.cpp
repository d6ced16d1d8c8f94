#include "runtime/motion/stretch_limits.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kShortestZone = 0.0028; // s: a corner takes at least this long (docs/motion.md)

double atMost(double limit, double rate) {
    const double size = std::abs(rate);
    return size > 1e-12 ? limit / size : kUnlimited;
}

using Pair = double __attribute__((vector_size(16)));

template <class Numbers> Pair pairAt(const Numbers& numbers, std::size_t i) {
    return Pair{numbers[i], numbers[i + 1]};
}

} // namespace

/// On a stretch with squares x0 and x1 at its ends each row accelerates by first * (x1 - x0) / (2 width) + second * (x0 + x1) / 2.
void AccelerationRows::narrow(SquareRange& range, double square, double width, bool towardsEnd) const {
    constexpr double kLeast = 1e-15;
    const double sign = towardsEnd ? 1 : -1;
    Pair low = {range.low, range.low};
    Pair high = {range.high, range.high};
    for (std::size_t i = 0; i < count_; i += 2) {
        const Pair second = pairAt(second_, i), most = pairAt(most_, i);
        const Pair change = sign * pairAt(first_, i) / (2 * width);
        const Pair there = change + 0.5 * second;
        const Pair here = (0.5 * second - change) * square;
        const Pair a = (most - here) / there;
        const Pair b = (-most - here) / there;
        const auto counts = (there >= kLeast) | (there <= -kLeast);
        const Pair larger = counts ? (a < b ? b : a) : high;
        const Pair smaller = counts ? (b < a ? b : a) : low;
        high = larger < high ? larger : high;
        low = low < smaller ? smaller : low;
    }
    range.low = std::max(low[0], low[1]);
    range.high = std::min(high[0], high[1]);
}

SquareRange StretchLimits::reachFrom(double square, double partWidth, bool towardsEnd) const {
    const double most = towardsEnd ? gain : drop;
    const double least = towardsEnd ? drop : gain;
    SquareRange result{square - 2 * partWidth * least, square + 2 * partWidth * most};
    rows.narrow(result, square, partWidth, towardsEnd);
    for (const AccelerationRows& other : more)
        other.narrow(result, square, partWidth, towardsEnd);
    return result;
}

void limitsOn(const RouteStretch& s, const MoveLimits& most, const robot::AccelerationMap& accelerationMap,
              StretchLimits& l) {
    l.width = s.end - s.begin;
    l.speed = std::min({atMost(most.tcpSpeed, s.tcpRate), atMost(most.orientationSpeed, s.turnRate),
                        atMost(most.armAngleSpeed, s.armRate), most.pathSpeed});
    if (s.zoneLength > 0) l.speed = std::min(l.speed, s.zoneLength / kShortestZone);
    l.axisSpeed = l.bendSquare = kUnlimited;
    const auto add = [&](double first, double second, double acceleration) {
        if (std::abs(first) < 1e-12 && std::abs(second) < 1e-12) return;
        l.bendSquare = std::min(l.bendSquare, atMost(acceleration, second));
        l.rows.add(first, second, acceleration);
    };
    Joints accelerations = s.middle.joints;
    accelerationMap.limitsAt(s.middle.joints, accelerations);
    for (std::size_t i = 0; i < s.first.size(); ++i) {
        // The rate at the ends of the stretch may be higher than in its middle.
        const double rate = std::abs(s.first[i]) + 0.5 * l.width * std::abs(s.second[i]);
        l.axisSpeed = std::min(l.axisSpeed, atMost(most.jointSpeed[i], rate));
        add(s.first[i], s.second[i], most.accelerationShare[i] * accelerations[i]);
    }
    for (std::size_t i = 0; i < s.externalFirst.size(); ++i) {
        if (s.externalFirst[i] == 0 && s.externalSecond[i] == 0) continue; // most axes are not connected
        l.speed = std::min(l.speed, atMost(most.externalSpeed[i], s.externalFirst[i]));
        add(s.externalFirst[i], s.externalSecond[i], most.externalAcceleration[i]);
    }
    l.speed = std::min(l.speed, l.axisSpeed);
    if (most.worldAcceleration < kUnlimited) {
        // Along and across the path together: across it at most the same share as along it; along it what the highest
        // speed leaves, all on a straight line.
        constexpr double kWorldShare = 0.7071;
        l.bendSquare = std::min(l.bendSquare, atMost(kWorldShare * most.worldAcceleration, s.curvature));
        const double square = l.speed < 1e100 ? std::min(l.speed * l.speed, l.bendSquare) : l.bendSquare;
        const double across = std::min(square * std::abs(s.curvature) / most.worldAcceleration, kWorldShare);
        add(s.tcpRate, 0, std::sqrt(1 - across * across) * most.worldAcceleration);
    }
    // Where the path turns back on itself the TCP brakes and accelerates although the speed along the route remains: half of the
    // limit for that, half for changes of the speed.
    const double share = s.isReversal ? 0.5 : 1;
    const double braking = std::min(most.pathAcceleration, most.pathDeceleration);
    if (s.isReversal) l.bendSquare = std::min(l.bendSquare, atMost(share * braking, s.curvature));
    l.gain = atMost(share * most.pathAcceleration, s.tcpRate);
    l.drop = atMost(share * most.pathDeceleration, s.tcpRate);
}

} // namespace motion

#include "runtime/motion/weaving.h"

#include "runtime/motion/path_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace motion {

namespace {

constexpr double kTurn = 6.283185307179586;

/// A point of the pattern and the mm of path that are spent there.
struct Corner {
    Vec3 at;
    double dwell = 0;
};
struct Corners {
    std::array<Corner, 4> list;
    std::size_t count = 0;
};

/// Of one cycle, closed.
Corners cornersOf(const WeavePattern& p) {
    const double height = p.shape == WeaveShape::Zigzag ? 0 : p.height;
    const double bias = p.shape == WeaveShape::Zigzag ? p.bias : 0;
    const Corner middle{{0, bias, 0}, p.dwellCenter};
    const Corner left{{0, bias + 0.5 * p.width, height}, p.dwellLeft};
    const Corner right{{0, bias - 0.5 * p.width, height}, p.dwellRight};
    if (p.shape == WeaveShape::Triangle) return {{middle, left, right}, 3};
    return {{middle, left, middle, right}, 4};
}

/// A straight piece of the pattern and the mm of path on which it is covered.
struct Side {
    Vec3 from, to;
    double length = 0;
};
struct Sides {
    std::array<Side, 8> list;
    std::size_t count = 0;
    double length = 0;
    void add(const Side& side) {
        list[count++] = side;
        length += side.length;
    }
};

/// mm across the path in a cycle.
double wayOf(const Corners& corners) {
    double way = 0;
    for (std::size_t i = 0; i < corners.count; ++i)
        way += norm(corners.list[(i + 1) % corners.count].at - corners.list[i].at);
    return way;
}

/// Between the corners the way along the path is in proportion to the way across it.
Sides sidesOf(const WeavePattern& p) {
    const Corners corners = cornersOf(p);
    const double way = wayOf(corners);
    const double perWay = way > 0 ? (p.length - p.dwells()) / way : 0;
    Sides sides;
    for (std::size_t i = 0; i < corners.count; ++i) {
        const Corner& corner = corners.list[i];
        const Vec3& next = corners.list[(i + 1) % corners.count].at;
        sides.add({corner.at, corner.at, corner.dwell});
        sides.add({corner.at, next, norm(next - corner.at) * perWay});
    }
    return sides;
}

/// The sum of the places on the pattern over the mm of path from the beginning of a cycle to `left` mm after it.
Vec3 sumUpTo(const Sides& sides, double left) {
    Vec3 sum;
    const auto add = [&](double until) {
        for (std::size_t i = 0; i < sides.count && until > 0; ++i) {
            const Side& side = sides.list[i];
            const double part = std::min(until, side.length);
            if (part > 0) sum = sum + (side.from + (side.to - side.from) * (0.5 * part / side.length)) * part;
            until -= part;
        }
    };
    const double cycles = std::floor(left / sides.length);
    add(sides.length);
    sum = sum * cycles;
    add(left - cycles * sides.length);
    return sum;
}

Vec3 polygonAt(const WeavePattern& p, double phase) {
    const Sides sides = sidesOf(p);
    double left = phase * p.length;
    if (!(sides.length > 0)) return sides.list[0].from;
    // The mean over a short piece of the path: straight as before between the corners, a parabola at them.
    if (p.rounding > 0)
        return (sumUpTo(sides, left + 0.5 * p.rounding) - sumUpTo(sides, left - 0.5 * p.rounding)) *
               (1 / p.rounding);
    for (std::size_t i = 0; i < sides.count; ++i) {
        const Side& side = sides.list[i];
        if (left < side.length) return side.from + (side.to - side.from) * (left / side.length);
        left -= side.length;
    }
    return sides.list[0].from;
}

} // namespace

double WeavePattern::dwells() const {
    if (shape == WeaveShape::Circle) return 0;
    const double middle = shape == WeaveShape::Triangle ? dwellCenter : 2 * dwellCenter;
    return dwellLeft + middle + dwellRight;
}

void WeavePattern::roundFor(double speed) {
    constexpr double kAcceleration = 10'000; // mm/s^2, about what the axes of an arm give its TCP
    constexpr double kMostOfCycle = 0.25;
    rounding = 0;
    const double straight = length - dwells();
    if (shape == WeaveShape::Circle || !isWeaving() || !(straight > 0)) return;
    const double turn = 2 * wayOf(cornersOf(*this)) / straight; // largest change of mm across by mm of path
    rounding = std::min(speed * speed * turn / kAcceleration, kMostOfCycle * length);
}

Vec3 WeavePattern::at(double phase) const {
    if (!isWeaving()) return {};
    const double inCycle = phase - std::floor(phase);
    Vec3 offset;
    if (shape == WeaveShape::Circle)
        offset = {0, 0.5 * width * std::sin(kTurn * inCycle), 0.5 * height * (1 - std::cos(kTurn * inCycle))};
    else
        offset = polygonAt(*this, inCycle);
    const Quat turn = robot::fromAxisAngle({0, 0, 1}, direction) * robot::fromAxisAngle({0, 1, 0}, tilt) *
                      robot::fromAxisAngle({1, 0, 0}, orientation);
    return rotate(turn, offset);
}

void Weaving::advance(const PlannedMoment& planned) {
    const Weave* weave = isOn_ ? planned.find<Weave>() : nullptr;
    const WeavePattern pattern = weave != nullptr ? weave->pattern : WeavePattern{};
    const Step step = stepTo(planned);
    const bool hasJumped = step.isOtherRun || !(pattern == pattern_);
    pattern_ = pattern;
    Vec3 target;
    if (pattern.isWeaving()) {
        phase_ += step.way / pattern.length;
        blend_ = 0.25 * pattern.length;
        // The path frame has y to the right and z into the workpiece.
        const Vec3 offset = pattern.at(phase_);
        target = rotate(meanPathFrame(planned, 0.5 * blend_), {offset.x, -offset.y, -offset.z});
        if (weave->isLast) { // without a sudden change of its rate
            const double share = std::clamp(planned.toEnd / blend_, 0.0, 1.0);
            target = target * (share * share * (3 - 2 * share));
        }
    }
    if (hasJumped) return shown_.jumpTo(planned.time, target, blend_);
    shown_.advance(planned.time, target, std::fabs(step.way));
}

void Weaving::otherPath(bool) {
    pattern_ = {};
}

} // namespace motion

#include "runtime/motion/weaving.h"

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

/// Between the corners the way along the path is in proportion to the way across it.
Vec3 polygonAt(const WeavePattern& p, double phase) {
    const Corners corners = cornersOf(p);
    const auto next = [&](std::size_t i) { return corners.list[(i + 1) % corners.count].at; };
    double way = 0;
    for (std::size_t i = 0; i < corners.count; ++i)
        way += norm(next(i) - corners.list[i].at);
    if (!(way > 0)) return corners.list[0].at;
    const double perWay = (p.length - p.dwells()) / way;
    double left = phase * p.length;
    for (std::size_t i = 0; i < corners.count; ++i) {
        const Corner& corner = corners.list[i];
        if (left <= corner.dwell) return corner.at;
        left -= corner.dwell;
        const Vec3 side = next(i) - corner.at;
        const double length = norm(side) * perWay;
        if (left < length) return corner.at + side * (left / length);
        left -= length;
    }
    return corners.list[0].at;
}

} // namespace

double WeavePattern::dwells() const {
    if (shape == WeaveShape::Circle) return 0;
    const double middle = shape == WeaveShape::Triangle ? dwellCenter : 2 * dwellCenter;
    return dwellLeft + middle + dwellRight;
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
        target = rotate(planned.pathFrame(), {offset.x, -offset.y, -offset.z});
        if (weave->isLast) target = target * std::min(1.0, planned.toEnd / blend_);
    }
    if (hasJumped) return shown_.jumpTo(planned.time, target, blend_);
    shown_.advance(planned.time, target, std::fabs(step.way));
}

void Weaving::otherPath(bool) {
    pattern_ = {};
}

} // namespace motion

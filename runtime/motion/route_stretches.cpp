// The stretches of a route: where they begin and end, and what planning needs to know of each.

#include "runtime/motion/route.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kLongestStretch = 5; // mm
constexpr int kStretchesInZone = 15;  // odd: the sharpest bend lies inside one
constexpr double kLargestJump = 2;    // deg, between what two neighbouring stretches expect of an axis

/// Derivatives of the axes by place in the middle of a stretch, from points `step` before and after it.
void differentiate(RouteStretch& stretch, const RoutePoint& low, const RoutePoint& high, double step) {
    stretch.first = stretch.second = robot::Joints::zeros(stretch.middle.joints.size());
    for (std::size_t i = 0; i < robot::kMostJoints; ++i) { // axes that the arm does not have stay 0
        stretch.first[i] = (high.joints[i] - low.joints[i]) / (2 * step);
        stretch.second[i] = (high.joints[i] - 2 * stretch.middle.joints[i] + low.joints[i]) / (step * step);
    }
    for (std::size_t i = 0; i < stretch.externalFirst.size(); ++i) {
        if (!isConnected(stretch.middle.extax[i])) continue;
        stretch.externalFirst[i] = (high.extax[i] - low.extax[i]) / (2 * step);
        stretch.externalSecond[i] =
            (high.extax[i] - 2 * stretch.middle.extax[i] + low.extax[i]) / (step * step);
    }
}

/// mm that a point covers a mm of route, on average between two places.
template <class PointAt> double meanRate(double from, double to, const PointAt& pointAt) {
    constexpr int kParts = 8;
    const double part = (to - from) / kParts;
    double covered = 0;
    for (int k = 0; k < kParts; ++k)
        covered += norm(pointAt(from + part * (k + 1)) - pointAt(from + part * k));
    return covered / (to - from);
}

} // namespace

/// Places inside a part of a corner's curve between which it bends no more than a little.
void Route::addBends(const Corner& corner, double from, double to, std::vector<double>& places) const {
    constexpr double kLeastCosine = 0.98;
    constexpr double kLeastPart = 1e-4;
    const auto isBent = [&](const auto& curve) {
        constexpr double kRest =
            1e-12; // of the squares: the point of rest where the path turns back on itself
        const auto first = curve.slopeAt(from), last = curve.slopeAt(to);
        const double a = dot(first, first), b = dot(last, last);
        return std::min(a, b) <= kRest * std::max(a, b) || dot(first, last) < kLeastCosine * std::sqrt(a * b);
    };
    const bool bends = corner.kind == CornerKind::Space ? isBent(corner.space) : isBent(corner.axes);
    if (!bends || to - from < kLeastPart) return;
    const double middle = 0.5 * (from + to);
    addBends(corner, from, middle, places);
    places.push_back(corner.begin + corner.lengths.distanceAt(middle));
    addBends(corner, middle, to, places);
}

/// Places inside a part of a curve of the axes between which these turn at similar rates: where the TCP nearly stops to turn
/// back they turn most for a mm, on a way that is shorter than usual stretches. `distance`: along the curve up to `from`, mm.
void Route::addTurns(const Corner& corner, double from, double distance, double to,
                     std::vector<double>& places) const {
    constexpr double kSimilar = 1.5;
    constexpr double kLeastPart = 2e-3;
    const double middle = 0.5 * (from + to);
    double shortest = corner.length(), longest = 0; // quarters, since halves may be each other's mirror image
    double before = distance;
    for (int k = 1; k <= 4; ++k) {
        const double end = corner.lengths.distanceAt(from + 0.25 * k * (to - from));
        shortest = std::min(shortest, end - before);
        longest = std::max(longest, end - before);
        before = end;
    }
    if (longest < kSimilar * shortest || to - from < kLeastPart) return;
    addTurns(corner, from, distance, middle, places);
    const double there = corner.lengths.distanceAt(middle);
    places.push_back(corner.begin + there);
    addTurns(corner, middle, there, to, places);
}

/// Borders of pieces on which all quantities are smooth, and the nodes of the paths, from a place to the end.
std::vector<double> Route::bordersFrom(double from) const {
    std::vector<double> borders{from};
    const auto add = [&](double place) {
        if (place > from + kNothing && place < length() - kNothing) borders.push_back(place);
    };
    for (std::size_t i = ownLeg(from); i < legCount(); ++i) {
        const Leg& l = leg(i);
        const Corner& c = corner(i);
        add(l.begin);
        const auto inside = [&](double place) {
            if (place > l.begin && place < l.end()) add(place);
        };
        if (l.path->isCartesian()) {
            for (const PathNode& node : l.path->nodes())
                inside(l.pathBegin() + l.length() * node.s);
        } else {
            constexpr int kLeastStretches = 32;
            for (int k = 1; k < kLeastStretches; ++k)
                inside(l.pathBegin() + l.length() * k / kLeastStretches);
        }
        add(l.end());
        if (c.kind == CornerKind::None) continue;
        add(c.end());
        for (int k = 1; k < kStretchesInZone; ++k)
            add(c.begin + c.length() * k / kStretchesInZone);
        std::vector<double> bends;
        for (int k = 0;
             k < kStretchesInZone && (isSmooth_ || c.kind == CornerKind::Joint || c.reversalRate > 0); ++k) {
            const double begin = static_cast<double>(k) / kStretchesInZone,
                         end = static_cast<double>(k + 1) / kStretchesInZone;
            if (isSmooth_)
                addBends(c, begin, end, bends);
            else
                addTurns(c, begin, c.lengths.distanceAt(begin), end, bends);
        }
        for (const double place : bends)
            add(place);
        const auto addZone = [&](double begin, double end) {
            for (int k = 0; k <= kStretchesInZone; ++k)
                add(begin + (end - begin) * k / kStretchesInZone);
        };
        if (c.turn.before > 0) addZone(c.turn.begin, c.turn.end);
        if (c.external.before > 0) addZone(c.external.begin, c.external.end);
    }
    borders.push_back(length());
    std::sort(borders.begin(), borders.end());
    return borders;
}

/// Measures the route from a place on; false if an axis would jump or leave its range in a corner.
bool Route::layStretches(double from) {
    const std::vector<double> borders = bordersFrom(from);
    double begin = from;
    bool wasInZone = false;
    std::optional<int> branch; // of the configuration in the last stretch, where it is known
    for (std::size_t i = 1; i < borders.size(); ++i) {
        const double gap = borders[i] - begin;
        // Borders closer than this add nothing; the last one is kept in any case.
        const double worthwhile = isSmooth_ ? 1e-4 : 0.02;
        const double least = i + 1 == borders.size() ? kNothing : std::min(worthwhile, 1e-3 * length());
        if (gap < least) continue;
        const auto parts = static_cast<int>(std::ceil(gap / kLongestStretch));
        for (int k = 0; k < parts; ++k) {
            const bool isFirst = stretches_.empty();
            const Joints seed = isFirst ? legs_.front().path->start().robax : stretches_.back().middle.joints;
            RouteStretch& stretch = stretches_.grow();
            stretch.begin = begin + gap * k / parts;
            stretch.end = k + 1 == parts ? borders[i] : begin + gap * (k + 1) / parts;
            const double middle = 0.5 * (stretch.begin + stretch.end);
            const std::size_t own = ownLeg(middle);
            const bool isGood = measure(stretch, own, seed);
            const bool isInZone = isShaped(own, middle);
            if (isInZone && !isGood) return false;
            // The first stretch after a zone, too: there the legs' own axes count again, perhaps a turn further.
            if (isFirst || !(isInZone || wasInZone))
                branch.reset();
            else if (!joins(stretches_[stretches_.size() - 2], stretch, branch))
                return false;
            wasInZone = isInZone;
        }
        begin = borders[i];
    }
    if (!stretches_.empty()) stretches_.back().end = length();
    return true;
}

/// Between two neighbouring stretches no axis jumps. `branch`: that of the configuration in the first one, nothing where it is not known yet;
/// afterwards that in the second one.
bool Route::joins(const RouteStretch& before, const RouteStretch& after, std::optional<int>& branch) const {
    const double way = 0.5 * (after.end - before.begin);
    for (std::size_t axis = 0; axis < after.first.size(); ++axis) {
        const double step = after.middle.joints[axis] - before.middle.joints[axis];
        const double expected = 0.5 * (after.first[axis] + before.first[axis]) * way;
        if (std::abs(step - expected) > kLargestJump + 0.5 * std::abs(expected)) return false;
    }
    const robot::Kinematics& kinematics = legs_.front().path->kinematics();
    const int first = branch ? *branch : kinematics.configuration(before.middle.joints).cfx;
    branch = kinematics.configuration(after.middle.joints).cfx;
    return *branch == first || passesSmoothly(before, after, first);
}

/// Between two neighbouring stretches with different configurations the axes pass where these meet, without a detour on a way too short to
/// be seen otherwise.
bool Route::passesSmoothly(const RouteStretch& before, const RouteStretch& after, int branch) const {
    const robot::Kinematics& kinematics = legs_.front().path->kinematics();
    const double from = 0.5 * (before.begin + before.end), to = 0.5 * (after.begin + after.end);
    double low = 0, high = 1;
    for (int i = 0; i < 24; ++i) {
        const double share = 0.5 * (low + high);
        Joints expected = before.middle.joints;
        for (std::size_t axis = 0; axis < expected.size(); ++axis)
            expected[axis] += share * (after.middle.joints[axis] - expected[axis]);
        const RoutePoint point = pointAt(from + share * (to - from), &expected);
        if (!point.isSolved) return false;
        for (std::size_t axis = 0; axis < expected.size(); ++axis) {
            const double step = after.middle.joints[axis] - before.middle.joints[axis];
            if (std::abs(point.joints[axis] - expected[axis]) > kLargestJump + 0.5 * std::abs(step))
                return false;
        }
        (kinematics.configuration(point.joints).cfx == branch ? low : high) = share;
    }
    return true;
}

bool Route::measure(RouteStretch& stretch, std::size_t own, const Joints& seed) const {
    const double middle = 0.5 * (stretch.begin + stretch.end);
    const double step = 0.25 * (stretch.end - stretch.begin);
    const Leg& l = leg(own);
    const bool inCorner = middle > l.end();
    stretch.leg = legBy(own, middle);
    stretch.zoneLength = inCorner ? corner(own).length() : 0;
    stretch.isAxesCorner = inCorner && corner(own).kind == CornerKind::Joint;
    stretch.isReversal = inCorner && corner(own).reversalRate > 0;
    std::array<Sought, 3> sought;
    std::array<robot::InverseTask, 3> tasks;
    seekPoint(own, middle, &seed, sought[0], tasks[0]);
    const Joints& near = sought[0].isTask ? tasks[0].joints : sought[0].point.joints;
    seekPoint(own, middle - step, &near, sought[1], tasks[1]);
    seekPoint(own, middle + step, &near, sought[2], tasks[2]);
    find(sought, tasks);
    stretch.middle = sought[0].point;
    const RoutePoint &low = sought[1].point, &high = sought[2].point;
    const auto &hereTcp = sought[0].tcp, &beforeTcp = sought[1].tcp, &afterTcp = sought[2].tcp;
    differentiate(stretch, low, high, step);
    const robot::Kinematics& kinematics = l.path->kinematics();
    const FrameSetup& frames = leg(inCorner ? own + 1 : own).path->frames();
    const Pose before = beforeTcp ? *beforeTcp : tcpOf(frames, low, middle - step);
    const Pose here = hereTcp ? *hereTcp : tcpOf(frames, stretch.middle, middle);
    const Pose after = afterTcp ? *afterTcp : tcpOf(frames, high, middle + step);
    if (const auto rate = curveRate(own, inCorner)) {
        stretch.tcpRate = *rate;
    } else { // at the middle, since a chord is shorter than the path in a sharp bend
        const double close = std::min(step, 1e-3);
        const auto tcpNear = [&](double place) {
            return tcpOf(frames, pointAt(place, &stretch.middle.joints), place).pos;
        };
        const Vec3 from = tcpNear(middle - close);
        const Vec3 to = tcpNear(middle + close);
        stretch.tcpRate = std::max(norm(to - from) / (2 * close), norm(after.pos - before.pos) / (2 * step));
        if (inCorner) // where the tool turns back, it is slow in the middle and fast beside it
            stretch.tcpRate = std::max(stretch.tcpRate, meanRate(stretch.begin, stretch.end, tcpNear));
        if (stretch.isReversal) { // speed that it allows there only would be averaged over its neighbourhood
            const Corner& c = corner(own);
            stretch.tcpRate = std::max({stretch.tcpRate, meanRate(c.begin, c.begin + close, tcpNear),
                                        meanRate(c.end() - close, c.end(), tcpNear)});
        }
        const FrameSetup& earlier = l.path->frames();
        if (inCorner && !sameTool(earlier, frames)) { // neither tool centre point may be too fast
            const auto place = [&](const RoutePoint& point) {
                return earlier.fromFlange(kinematics.forward(point.joints), point.extax).pos;
            };
            stretch.tcpRate = std::max(stretch.tcpRate, norm(place(high) - place(low)) / (2 * step));
        }
    }
    stretch.turnRate = robot::angleBetween(before.rot, after.rot) / (2 * step);
    const bool isInterpolated = inCorner ? corner(own).kind == CornerKind::Space : l.path->isCartesian();
    if (kinematics.hasArmAngle() && isInterpolated) {
        const double change = kinematics.armAngle(high.joints) - kinematics.armAngle(low.joints);
        stretch.armRate = std::abs(std::remainder(change, 360.0)) / (2 * step);
    }
    stretch.curvature = norm(after.pos - here.pos * 2.0 + before.pos) / (step * step);
    return low.isSolved && high.isSolved && stretch.middle.isSolved &&
           kinematics.jointOutsideLimits(stretch.middle.joints) == 0;
}

} // namespace motion

// The curves of one corner, made of the two legs that meet there.

#include "runtime/motion/route.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

/// Derivative of a quantity along a leg by central differences.
template <class Function> auto slopeOf(Function&& value, double at, double step) {
    return (value(at + step) - value(at - step)) * (1 / (2 * step));
}

/// Second derivative, with the value itself.
template <class Function, class Point>
auto bendOf(Function&& value, double at, double step, const Point& middle) {
    return (value(at + step) + value(at - step) - middle * 2.0) * (1 / (step * step));
}

/// Smooth: the control points that give these changes over the distance between control points, and second changes by its
/// square, at both ends.
template <class Point>
Bezier<Point> smoothCurve(const Point& from, const Point& leaving, const Point& leavingBend, const Point& to,
                          const Point& joining, const Point& joiningBend) {
    constexpr double kBend = 1.25; // the second derivative of the curve is 20 times the second difference
    Bezier<Point> curve;
    curve.isSmooth = true;
    curve.p = {from,
               from + leaving,
               from + leaving * 2.0 + leavingBend * kBend,
               to - joining * 2.0 + joiningBend * kBend,
               to - joining,
               to};
    return curve;
}

/// The curve that leaves the course of the first leg `before` mm of path from its end (at `entry`) and joins that of the
/// second `after` mm from its start. `tension`: of a smooth one; 0 for one that is not.
template <class First, class Second>
auto joiningCurve(First&& first, double entry, double before, Second&& second, double after, double tension) {
    const double step = 1e-3 * std::min(before, after);
    const auto from = first(entry);
    const auto to = second(after);
    if (tension > 0) {
        const double wide = 10 * step; // second differences need more room
        const double leaving = tension * before, joining = tension * after;
        return smoothCurve(from, slopeOf(first, entry, step) * leaving,
                           bendOf(first, entry, wide, from) * (leaving * leaving), to,
                           slopeOf(second, after, step) * joining,
                           bendOf(second, after, wide, to) * (joining * joining));
    }
    Bezier<std::decay_t<decltype(from)>> curve;
    curve.p = {from, from + slopeOf(first, entry, step) * (kCornerTension * before),
               to - slopeOf(second, after, step) * (kCornerTension * after), to};
    return curve;
}

/// From 0 to 1 without a bend at both ends.
double smoothStep(double x) {
    return x * x * x * (10 - x * (15 - 6 * x));
}

/// Tension of a smooth blend: its quantity may not turn back on a route that is shorter than the ways on the legs.
template <class Point> double blendTension(const Corner& corner, const Blend<Point>& blend) {
    if (!corner.isSmooth) return kCornerTension;
    const double length = blend.before - corner.before + corner.lengths.length() + blend.after - corner.after;
    return std::min(kSmoothTension, 0.45 * length / (blend.before + blend.after));
}

/// mm of route on which robots usually brake from the programmed speed.
double brakingWay(const Leg& leg) {
    constexpr double kBraking = 1e4;         // mm/s^2 of the TCP
    constexpr double kTurningBraking = 1300; // deg/s^2 of the wrist
    const double turning = leg.programmed.orientationSpeed, tcp = leg.programmed.tcpSpeed;
    return leg.isTurning ? kMmPerDegree * turning * turning / kTurningBraking : tcp * tcp / kBraking;
}

/// Corner::reversalRate of a curve, with `first` and `last` mm of route per unit of the parameter at its ends. The TCP then brakes evenly
/// up to the place of the reversal and accelerates evenly after it, on about the way that this takes from the programmed speed.
template <class Point>
double reversalRateOf(const Bezier<Point>& curve, double first, double last, const Leg& a, const Leg& b) {
    constexpr double kNearly = -0.866; // cosine, of a turn by 150 degrees
    const Point in = curve.slopeAt(0), out = curve.slopeAt(1);
    const double sizes = std::sqrt(dot(in, in) * dot(out, out));
    if (!(dot(in, out) < kNearly * sizes)) return 0;
    const double ends = 0.5 * (first + last); // falls to 0 on half of the curve
    return std::min(std::sqrt(2 * ends * std::min(brakingWay(a), brakingWay(b))), ends);
}

bool isConnectedAxis(const Leg& leg, std::size_t axis) {
    return isConnected(leg.path->start().extax[axis]);
}

} // namespace

double Corner::routeRate(double parameter, double mm) const {
    if (reversalRate == 0) return mm;
    const double share =
        4 * parameter * (1 - parameter); // none at the ends, so that the speed does not jump there
    return std::hypot(mm, reversalRate * share * share);
}

Pose Route::poseOn(const Leg& leg, double distance) {
    return leg.path->tcpAt(leg.lengths.parameterAt(distance));
}

Pose Route::poseIn(const Leg& from, const Leg& frames, double distance) {
    const Pose pose = poseOn(from, distance);
    if (sameFrames(from.path->frames(), frames.path->frames())) return pose;
    const ExternalAxes axes = from.path->externalAt(from.lengths.parameterAt(distance));
    // A user frame that another robot carries is the same for both, wherever it is.
    const Pose carried;
    const Pose* user = from.path->frames().userCourse != nullptr ? &carried : nullptr;
    return frames.path->frames().fromFlange(from.path->frames().toFlange(pose, axes, user), axes, user);
}

AxisVector Route::axesOn(const Leg& leg, double distance) {
    const double parameter = leg.lengths.parameterAt(distance);
    const Joints joints = leg.path->jointsAt(parameter);
    const ExternalAxes external = leg.path->externalAt(parameter);
    AxisVector result;
    std::copy(joints.begin(), joints.end(), result.v.begin());
    std::copy(external.begin(), external.end(), result.v.end() - kExternalCount);
    return result;
}

double Route::armAngleOn(const Leg& leg, double distance) {
    return leg.path->armAngleAt(leg.lengths.parameterAt(distance));
}

void Route::curveInSpace(Corner& corner, const Leg& a, const Leg& b) {
    corner.space = joiningCurve([&](double d) { return poseIn(a, b, d).pos; }, a.length() - corner.before,
                                corner.before, [&](double d) { return poseOn(b, d).pos; }, corner.after,
                                corner.isSmooth ? kSmoothTension : 0);
    const bool isScaled = corner.isSmooth && (a.perMm != 1 || b.perMm != 1);
    const auto rate = [&](double x) {
        // On a leg where turning counts the unit of the route changes steadily, too.
        const double perMm = isScaled ? a.perMm + (b.perMm - a.perMm) * smoothStep(x) : 1;
        return corner.routeRate(x, perMm * norm(corner.space.slopeAt(x)));
    };
    if (!corner.isSmooth) corner.reversalRate = reversalRateOf(corner.space, rate(0), rate(1), a, b);
    corner.lengths = LengthMap::measured(rate, kCornerPieces, corner.isSmooth);
    corner.halfLength = corner.lengths.distanceAt(0.5);
}

void Route::curveOfAxes(Corner& corner, const Leg& a, const Leg& b) {
    const double step = 1e-3 * std::min(corner.before, corner.after);
    const AxisVector from = axesOn(a, a.length() - corner.before);
    const AxisVector to = axesOn(b, corner.after);
    const AxisVector point = axesOn(b, 0);
    // Joint moves are straight in joint space: towards the point itself.
    const AxisVector leaving = a.path->isCartesian() ? slopeOf([&](double d) { return axesOn(a, d); },
                                                               a.length() - corner.before, step) *
                                                           corner.before
                                                     : point - from;
    const AxisVector joining =
        b.path->isCartesian()
            ? slopeOf([&](double d) { return axesOn(b, d); }, corner.after, step) * corner.after
            : to - point;
    if (corner.isSmooth) {
        const auto bend = [&](const Leg& leg, double at, double size, const AxisVector& middle) {
            if (!leg.path->isCartesian()) return AxisVector{};
            const double way = kSmoothTension * size;
            return bendOf([&](double d) { return axesOn(leg, d); }, at, 10 * step, middle) * (way * way);
        };
        corner.axes = smoothCurve(from, leaving * kSmoothTension,
                                  bend(a, a.length() - corner.before, corner.before, from), to,
                                  joining * kSmoothTension, bend(b, corner.after, corner.after, to));
    } else {
        corner.axes.p = {from, from + leaving * kCornerTension, to - joining * kCornerTension, to};
    }
    measureAxesCurve(corner, a, b);
}

/// The curve of the axes by the path of the TCP; with two tools from that of the first to that of the second.
void Route::measureAxesCurve(Corner& corner, const Leg& a, const Leg& b) {
    const auto rateOf = [&](const Leg& tool, double x) {
        constexpr double kStep = 1e-4;
        const auto poseAt = [&](double place) {
            const AxisVector axes = corner.axes.at(place);
            Joints joints = b.path->start().robax;
            std::copy_n(axes.v.begin(), joints.size(), joints.begin());
            ExternalAxes external = b.path->start().extax;
            takeExternal(axes, external);
            return tool.path->frames().fromFlange(b.path->kinematics().forward(joints), external);
        };
        const Pose low = poseAt(x - kStep);
        const Pose high = poseAt(x + kStep);
        return pathRate(norm(high.pos - low.pos) / (2 * kStep),
                        robot::angleBetween(low.rot, high.rot) / (2 * kStep) +
                            externalRate(corner.axes.slopeAt(x)));
    };
    const bool isShared = corner.isSmooth && !sameTool(a.path->frames(), b.path->frames());
    const auto rate = [&](double x) {
        const double second = rateOf(b, x);
        return corner.routeRate(x,
                                isShared ? second + (1 - smoothStep(x)) * (rateOf(a, x) - second) : second);
    };
    if (!corner.isSmooth) corner.reversalRate = reversalRateOf(corner.axes, rate(0), rate(1), a, b);
    corner.lengths = LengthMap::measured(rate, kAxesPieces, corner.isSmooth);
    corner.halfLength = corner.lengths.distanceAt(0.5);
}

void Route::blendTurn(Corner& corner, const Leg& a, const Leg& b, double before, double after) {
    corner.centre = poseOn(b, 0).rot;
    corner.turn = {};
    corner.turn.before = before;
    corner.turn.after = after;
    corner.turn.tension = blendTension(corner, corner.turn);
    const auto turned = [&](const Quat& rot) {
        return robot::rotationVector(conjugate(corner.centre) * rot);
    };
    const auto curve = joiningCurve(
        [&](double d) { return turned(poseIn(a, b, d).rot); }, a.length() - before, before,
        [&](double d) { return turned(poseOn(b, d).rot); }, after, corner.isSmooth ? corner.turn.tension : 0);
    if (norm(curve.p[0]) < kNothing && norm(curve.p[corner.isSmooth ? 5 : 3]) < kNothing)
        corner.turn = {};
    else
        corner.turn.curve = curve;
}

void Route::blendExternal(Corner& corner, const Leg& a, const Leg& b, double before, double after) {
    corner.external = {};
    corner.armAngle = armAngleOn(b, 0);
    const bool hasArmAngle = b.path->kinematics().hasArmAngle();
    bool moves = hasArmAngle && (a.path->armTravel() != 0 || b.path->armTravel() != 0 ||
                                 !a.path->isCartesian() || !b.path->isCartesian());
    for (std::size_t i = 0; i < static_cast<std::size_t>(kExternalCount); ++i)
        moves = moves || (isConnectedAxis(a, i) && (a.path->start().extax[i] != a.path->end().extax[i] ||
                                                    b.path->start().extax[i] != b.path->end().extax[i]));
    if (!moves) return;
    corner.external.before = before;
    corner.external.after = after;
    corner.external.tension = blendTension(corner, corner.external);
    const auto axes = [&](const Leg& leg, double distance) {
        AxisVector result = axesOn(leg, distance);
        if (hasArmAngle)
            result.v[kArmAnglePlace] =
                corner.armAngle + std::remainder(armAngleOn(leg, distance) - corner.armAngle, 360.0);
        return result;
    };
    corner.external.curve = joiningCurve([&](double d) { return axes(a, d); }, a.length() - before, before,
                                         [&](double d) { return axes(b, d); }, after,
                                         corner.isSmooth ? corner.external.tension : 0);
}

double pathRate(double mm, double degrees) {
    const double turning = kMmPerDegree * degrees;
    return mm >= turning ? mm : std::sqrt(0.5 * (mm * mm + turning * turning));
}

double perMmLeft(double mm, double degrees) {
    const double left = std::max(mm, kMmLeftPerDegree * degrees);
    return left > 0 ? pathRate(mm, degrees) / left : 1;
}

void takeExternal(const AxisVector& axes, ExternalAxes& external) {
    for (std::size_t i = 0; i < external.size(); ++i)
        if (isConnected(external[i])) external[i] = axes.v[axes.v.size() - kExternalCount + i];
}

double externalRate(const AxisVector& slope) {
    double sum = 0;
    for (std::size_t i = slope.v.size() - kExternalCount; i < slope.v.size(); ++i)
        sum += std::abs(slope.v[i]);
    return std::isfinite(sum) ? sum : 0;
}

} // namespace motion

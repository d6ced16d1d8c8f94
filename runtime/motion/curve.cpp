// Lines and arcs of the TCP in the object frame.

#include "runtime/motion/path.h"
#include "runtime/robot/angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace motion {

namespace {

constexpr double kLeastDistance = 0.1; // mm between the points of a circle
constexpr double kLeastAngle = 0.05;   // deg in the triangle of the three points; less is a line
constexpr double kLeastTwist = 1.0;    // deg; below, both ways of twisting are the same
constexpr double kLargestSweep = 240;  // deg

MotionError circleError(MotionErrorKind kind, double value, const Vec3& position) {
    MotionError error;
    error.kind = kind;
    error.value = value;
    error.position = position;
    return error;
}

double angleAt(const Vec3& corner, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - corner;
    const Vec3 v = b - corner;
    return std::atan2(norm(cross(u, v)), dot(u, v)) / robot::kDeg;
}

} // namespace

CartesianCurve CartesianCurve::line(const Pose& start, const Pose& end) {
    CartesianCurve curve;
    curve.start_ = start;
    curve.end_ = end;
    curve.length_ = norm(end.pos - start.pos);
    curve.twist_ = robot::rotationVector(conjugate(start.rot) * end.rot);
    curve.rotationDeg_ = norm(curve.twist_) / robot::kDeg;
    return curve;
}

Expected<CartesianCurve, MotionError> CartesianCurve::arc(const Pose& start, const Pose& via, const Pose& end,
                                                          CircleOrientation orientation) {
    const Vec3 a = via.pos - start.pos;
    const Vec3 b = end.pos - start.pos;
    const double closest = std::min({norm(a), norm(b), norm(end.pos - via.pos)});
    if (!(closest >= kLeastDistance)) {
        return Unexpected{circleError(MotionErrorKind::CirclePointsTooClose, closest, via.pos)};
    }
    const double angle = std::min({angleAt(start.pos, via.pos, end.pos), angleAt(via.pos, start.pos, end.pos),
                                   angleAt(end.pos, start.pos, via.pos)});
    if (angle < kLeastAngle) {
        // Controllers run three points on one line without an error.
        const double share = dot(a, b) / dot(b, b);
        if (share > 0 && share < 1) return line(start, end);
        return Unexpected{circleError(MotionErrorKind::CirclePointsCollinear, angle, via.pos)};
    }
    const Vec3 normal = cross(a, b);
    const double square = dot(normal, normal);
    CartesianCurve curve;
    curve.isArc_ = true;
    curve.start_ = start;
    curve.end_ = end;
    // Centre of the circle through three points, from the first of them.
    const Vec3 toCentre = (cross(normal, a) * dot(b, b) + cross(b, normal) * dot(a, a)) * (0.5 / square);
    curve.centre_ = start.pos + toCentre;
    curve.spoke_ = toCentre * -1.0;
    curve.radius_ = norm(toCentre);
    curve.axis_ = normal * (1 / std::sqrt(square));
    const auto angleOf = [&](const Vec3& point) {
        const Vec3 spoke = point - curve.centre_;
        const double raw =
            std::atan2(dot(cross(curve.spoke_, spoke), curve.axis_), dot(curve.spoke_, spoke)) / robot::kDeg;
        return raw < 0 ? raw + 360 : raw;
    };
    curve.sweepDeg_ = angleOf(end.pos);
    if (curve.sweepDeg_ > kLargestSweep) {
        return Unexpected{circleError(MotionErrorKind::CircleTooLarge, curve.sweepDeg_, end.pos)};
    }
    curve.length_ = curve.radius_ * curve.sweepDeg_ * robot::kDeg;

    if (orientation == CircleOrientation::PathFrame)
        curve.twistOnCircle(via, angleOf(via.pos));
    else
        curve.twistInObject(via, orientation);
    if (orientation == CircleOrientation::CirclePoint) {
        curve.viaShare_ = angleOf(via.pos) / curve.sweepDeg_;
        curve.rotationDeg_ =
            std::max(norm(curve.twist_) / curve.viaShare_, norm(curve.twistAfter_) / (1 - curve.viaShare_)) /
            robot::kDeg;
    }
    return curve;
}

/// Evenly relative to the circle, on the way that is nearer to the orientation of the circle point.
void CartesianCurve::twistOnCircle(const Pose& via, double viaAngle) {
    isCarried_ = true;
    const Quat carried = robot::fromAxisAngle(axis_, sweepDeg_) * start_.rot;
    const Vec3 shortTwist = robot::rotationVector(conjugate(carried) * end_.rot);
    twist_ = shortTwist;
    const double shortAngle = norm(shortTwist);
    if (shortAngle > kLeastTwist * robot::kDeg) {
        const Vec3 longTwist = shortTwist * (1 - 2 * std::numbers::pi / shortAngle);
        const double share = viaAngle / sweepDeg_;
        const Quat there = robot::fromAxisAngle(axis_, viaAngle) * start_.rot;
        const double missShort = robot::angleBetween(robot::turnedBy(there, shortTwist, share), via.rot);
        const double missLong = robot::angleBetween(robot::turnedBy(there, longTwist, share), via.rot);
        if (missLong < missShort - 1e-9) twist_ = longTwist;
    }
    rotationDeg_ = norm(axis_ * (sweepDeg_ * robot::kDeg) + rotate(start_.rot, twist_)) / robot::kDeg;
}

void CartesianCurve::twistInObject(const Pose& via, CircleOrientation orientation) {
    const bool isThroughPoint = orientation == CircleOrientation::CirclePoint;
    const Quat& first = isThroughPoint ? via.rot : end_.rot;
    viaRot_ = via.rot;
    twist_ = robot::rotationVector(conjugate(start_.rot) * first);
    if (isThroughPoint) twistAfter_ = robot::rotationVector(conjugate(via.rot) * end_.rot);
    rotationDeg_ = norm(twist_) / robot::kDeg;
}

Quat CartesianCurve::orientationAt(double s) const {
    if (isCarried_)
        return robot::turnedBy(robot::fromAxisAngle(axis_, sweepDeg_ * s) * start_.rot, twist_, s);
    if (s <= viaShare_) return robot::turnedBy(start_.rot, twist_, s / viaShare_);
    return robot::turnedBy(viaRot_, twistAfter_, (s - viaShare_) / (1 - viaShare_));
}

Pose CartesianCurve::at(double s) const {
    if (!isArc_) return {start_.pos + (end_.pos - start_.pos) * s, robot::turnedBy(start_.rot, twist_, s)};
    return {centre_ + rotate(robot::fromAxisAngle(axis_, sweepDeg_ * s), spoke_), orientationAt(s)};
}

namespace {

/// Triggers of a whole path to its two parts, of these lengths in mm. Triggers timed before the end belong to the second.
void shareOut(const std::vector<PathTrigger>& triggers, double first, double second,
              std::vector<MoveCommand>& halves) {
    halves[0].triggers.clear();
    halves[1].triggers.clear();
    for (PathTrigger trigger : triggers) {
        const bool inDistance = !trigger.inTime && !trigger.nextMove;
        const bool isInFirst = trigger.fromStart ? trigger.amount <= first : trigger.amount > second;
        if (inDistance && isInFirst != trigger.fromStart)
            trigger.amount -= trigger.fromStart ? first : second;
        halves[inDistance && isInFirst ? 0 : 1].triggers.push_back(trigger);
    }
}

/// How far along the arc from `start` a point of it lies, 0 to 1; more when it lies on the other part of the circle.
double partAt(const CartesianCurve& arc, const Pose& start, const Pose& point) {
    const Vec3 from = start.pos - arc.centre(), via = point.pos - arc.centre();
    double angle = std::atan2(dot(arc.axis(), cross(from, via)), dot(from, via)) * robot::kDegreesPerRadian;
    if (angle <= 0) angle += 360;
    return angle / arc.sweepDeg();
}

/// The circle a command means, from `start`.
Expected<CartesianCurve, MotionError> arcOf(const MoveCommand& command, const Pose& start) {
    return CartesianCurve::arc(start, command.circlePoint, command.target.pose, command.circleOrientation);
}

} // namespace

MoveCommand restOfCircle(const MoveCommand& command, const Pose& start, const Pose& here) {
    const auto arc = arcOf(command, start);
    if (!arc) return command;
    if (!arc->isArc()) {
        MoveCommand rest = command;
        rest.kind = MoveKind::Linear;
        return rest;
    }
    const double part = partAt(*arc, start, here);
    MoveCommand rest = command;
    if (!(part > 0 && part < 1)) return rest;
    rest.circlePoint = arc->at((1 + part) / 2);
    constexpr double kShortRest = 8; // degrees; the angle between its points would be too small for a circle
    if ((1 - part) * arc->sweepDeg() < kShortRest) rest.kind = MoveKind::Linear;
    return rest;
}

std::vector<MoveCommand> splitAtCirclePoint(const MoveCommand& command, const RobTarget& begin) {
    const Pose& start = begin.pose;
    const auto arc = arcOf(command, start);
    if (!arc || !arc->isArc()) return {};
    const double part = partAt(*arc, start, command.circlePoint);
    if (!(part > 0 && part < 1)) return {};
    std::vector<MoveCommand> halves{command, command};
    halves[0].target.pose = arc->at(part);
    halves[0].circlePoint = arc->at(part / 2);
    RobTarget& middle = halves[0].target;
    middle.armAngle = begin.armAngle + part * std::remainder(command.target.armAngle - begin.armAngle, 360.0);
    for (std::size_t i = 0; i < middle.extax.size(); ++i)
        if (isConnected(begin.extax[i]) && isConnected(middle.extax[i]))
            middle.extax[i] = begin.extax[i] + part * (middle.extax[i] - begin.extax[i]);
    halves[0].zone = {};
    halves[0].confL = false; // the configuration is programmed for the target
    shareOut(command.triggers, arc->length() * part, arc->length() * (1 - part), halves);
    halves[0].duration = command.duration * part;
    halves[1].circlePoint = arc->at((1 + part) / 2);
    halves[1].duration = command.duration * (1 - part);
    return halves;
}

} // namespace motion

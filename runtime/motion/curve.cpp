// Lines and arcs of the TCP in the object frame.

#include "runtime/motion/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace motion {

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kLeastDistance = 0.1; // mm between the points of a circle
constexpr double kLeastAngle = 1.0;    // deg in the triangle of the three points
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
    return std::atan2(norm(cross(u, v)), dot(u, v)) / kDeg;
}

Quat turn(const Quat& base, const Vec3& rotation, double k) {
    const double angle = norm(rotation);
    if (angle == 0) return base;
    return base * robot::fromAxisAngle(rotation * (1 / angle), k * angle / kDeg);
}

} // namespace

CartesianCurve CartesianCurve::line(const Pose& start, const Pose& end) {
    CartesianCurve curve;
    curve.start_ = start;
    curve.end_ = end;
    curve.length_ = norm(end.pos - start.pos);
    curve.twist_ = robot::rotationVector(conjugate(start.rot) * end.rot);
    curve.rotationDeg_ = norm(curve.twist_) / kDeg;
    return curve;
}

Expected<CartesianCurve, MotionError> CartesianCurve::arc(const Pose& start, const Pose& via,
                                                          const Pose& end) {
    const Vec3 a = via.pos - start.pos;
    const Vec3 b = end.pos - start.pos;
    const double closest = std::min({norm(a), norm(b), norm(end.pos - via.pos)});
    if (!(closest >= kLeastDistance)) {
        return Unexpected{circleError(MotionErrorKind::CirclePointsTooClose, closest, via.pos)};
    }
    const double angle = std::min({angleAt(start.pos, via.pos, end.pos), angleAt(via.pos, start.pos, end.pos),
                                   angleAt(end.pos, start.pos, via.pos)});
    if (angle < kLeastAngle) {
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
            std::atan2(dot(cross(curve.spoke_, spoke), curve.axis_), dot(curve.spoke_, spoke)) / kDeg;
        return raw < 0 ? raw + 360 : raw;
    };
    curve.sweepDeg_ = angleOf(end.pos);
    if (curve.sweepDeg_ > kLargestSweep) {
        return Unexpected{circleError(MotionErrorKind::CircleTooLarge, curve.sweepDeg_, end.pos)};
    }
    curve.length_ = curve.radius_ * curve.sweepDeg_ * kDeg;

    const Quat carried = robot::fromAxisAngle(curve.axis_, curve.sweepDeg_) * start.rot;
    const Vec3 shortTwist = robot::rotationVector(conjugate(carried) * end.rot);
    curve.twist_ = shortTwist;
    const double shortAngle = norm(shortTwist);
    if (shortAngle > kLeastAngle * kDeg) {
        const Vec3 longTwist = shortTwist * (1 - 2 * std::numbers::pi / shortAngle);
        const double share = angleOf(via.pos) / curve.sweepDeg_;
        const Quat there = robot::fromAxisAngle(curve.axis_, angleOf(via.pos)) * start.rot;
        const double missShort = robot::angleBetween(turn(there, shortTwist, share), via.rot);
        const double missLong = robot::angleBetween(turn(there, longTwist, share), via.rot);
        if (missLong < missShort - 1e-9) curve.twist_ = longTwist;
    }
    curve.rotationDeg_ =
        norm(curve.axis_ * (curve.sweepDeg_ * kDeg) + rotate(start.rot, curve.twist_)) / kDeg;
    return curve;
}

Pose CartesianCurve::at(double s) const {
    if (!isArc_) return {start_.pos + (end_.pos - start_.pos) * s, turn(start_.rot, twist_, s)};
    const Quat carry = robot::fromAxisAngle(axis_, sweepDeg_ * s);
    return {centre_ + rotate(carry, spoke_), turn(carry * start_.rot, twist_, s)};
}

namespace {

/// Triggers of a whole path to its two parts, of these lengths in mm. What is timed before the end belongs to the second.
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
    constexpr double kDegrees = 57.29577951308232;
    double angle = std::atan2(dot(arc.axis(), cross(from, via)), dot(from, via)) * kDegrees;
    if (angle <= 0) angle += 360;
    return angle / arc.sweepDeg();
}

} // namespace

MoveCommand restOfCircle(const MoveCommand& command, const Pose& start, const Pose& here) {
    const auto arc = CartesianCurve::arc(start, command.circlePoint, command.target.pose);
    if (!arc) return command;
    const double part = partAt(*arc, start, here);
    MoveCommand rest = command;
    if (!(part > 0 && part < 1)) return rest;
    rest.circlePoint = arc->at((1 + part) / 2);
    constexpr double kShortRest = 8; // degrees; the angle between its points would be too small for a circle
    if ((1 - part) * arc->sweepDeg() < kShortRest) rest.kind = MoveKind::Linear;
    return rest;
}

std::vector<MoveCommand> splitAtCirclePoint(const MoveCommand& command, const Pose& start) {
    const auto arc = CartesianCurve::arc(start, command.circlePoint, command.target.pose);
    if (!arc) return {};
    const double part = partAt(*arc, start, command.circlePoint);
    if (!(part > 0 && part < 1)) return {};
    std::vector<MoveCommand> halves{command, command};
    halves[0].target.pose = arc->at(part);
    halves[0].circlePoint = arc->at(part / 2);
    halves[0].zone = {};
    halves[0].confL = false; // the configuration is programmed for the target
    shareOut(command.triggers, arc->length() * part, arc->length() * (1 - part), halves);
    halves[0].duration = command.duration * part;
    halves[1].circlePoint = arc->at((1 + part) / 2);
    halves[1].duration = command.duration * (1 - part);
    return halves;
}

} // namespace motion

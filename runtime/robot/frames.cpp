// Arithmetic of frames that is too long to be inline.

#include "runtime/robot/frames.h"
#include "runtime/robot/angles.h"
#include "runtime/robot/fast_trig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace robot {

namespace {

/// Without a series for the commonest angle, 0.
HalfAngle halfOf(double deg) {
    if (deg == 0) return {};
    const trig::SineCosine both = trig::sinCosDeg(deg / 2);
    return {both.cosine, both.sine};
}

double sineOfY(const Quat& q) {
    return std::clamp(2 * (q.w * q.y - q.x * q.z), -1.0, 1.0);
}
/// Near +-90 degrees about y only the sum (difference) of the other two is determined: x is then taken as 0.
bool isUpright(double sineOfY) {
    return std::abs(sineOfY) > 1 - 1e-13;
}

} // namespace

Vec3 rotationVector(const Quat& q) {
    // Of the two quaternions of a rotation the one with w >= 0 turns the short way.
    const double sign = q.w < 0 ? -1.0 : 1.0;
    const Vec3 u{q.x * sign, q.y * sign, q.z * sign};
    const double sine = norm(u);
    if (sine < 1e-150) return {};
    return u * (2.0 * std::atan2(sine, q.w * sign) / sine);
}

double angleBetween(const Quat& a, const Quat& b) {
    if (a == b) return 0; // on most paths the tool does not turn
    return norm(rotationVector(conjugate(a) * b)) / kDeg;
}

Quat slerp(const Quat& a, const Quat& b, double k) {
    return turnedBy(a, rotationVector(conjugate(a) * b), k);
}

Quat fromAxisAngle(const Vec3& axis, double angleDeg) {
    const double half = angleDeg * kDeg / 2;
    const double s = std::sin(half);
    return {std::cos(half), axis.x * s, axis.y * s, axis.z * s};
}

Quat turnedBy(const Quat& base, const Vec3& rotation, double share) {
    if (rotation == Vec3{}) return base;
    const double angle = norm(rotation);
    if (angle == 0) return base;
    return base * fromAxisAngle(rotation * (1 / angle), share * angle / kDeg);
}

Quat fromEulerZyx(double zDeg, double yDeg, double xDeg) {
    const HalfAngle z = halfOf(zDeg);
    if (yDeg == 0 && xDeg == 0) return {z.cosine, 0, 0, z.sine}; // as that of a joint
    return fromHalvesZyx(z, halfOf(yDeg), halfOf(xDeg));
}

Vec3 eulerZyx(const Quat& q) {
    return {eulerX(q), eulerY(q), eulerZ(q)};
}

double eulerX(const Quat& q) {
    if (isUpright(sineOfY(q))) return 0;
    return trig::atan2Deg(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y));
}

double eulerY(const Quat& q) {
    const double sine = sineOfY(q);
    return isUpright(sine) ? std::copysign(90.0, sine) : trig::asinDeg(sine);
}

double eulerZ(const Quat& q) {
    const double sine = sineOfY(q);
    if (isUpright(sine)) return -2 * std::copysign(1.0, sine) * trig::atan2Deg(q.x, q.w);
    return trig::atan2Deg(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

Pose offs(const Pose& target, double x, double y, double z) {
    return {target.pos + Vec3{x, y, z}, target.rot};
}

Pose relTool(const Pose& target, double x, double y, double z, double rxDeg, double ryDeg, double rzDeg) {
    // "First about x, then y, then z" of the tool as it has been turned so far: intrinsic rotations.
    const Vec3 pos = apply(target, {x, y, z});
    if (rxDeg == 0 && ryDeg == 0) return {pos, turnedAboutZ(target.rot, halfOf(rzDeg))}; // as a rule
    return {pos, target.rot * fromHalvesXyz(halfOf(rxDeg), halfOf(ryDeg), halfOf(rzDeg))};
}

} // namespace robot

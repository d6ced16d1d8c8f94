#pragma once
// Between the records of RAPID (binary32) and the geometry of the motion system (binary64).

#include "runtime/robot/frames.h"

#include "stdlib_types.h"

#include <cmath>

namespace rt::lib {

inline robot::Vec3 toVec(const data::Pos& p) {
    return {p.x, p.y, p.z};
}
inline data::Pos toPos(const robot::Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline robot::Quat toQuat(const data::Orient& o) {
    return {o.q1, o.q2, o.q3, o.q4};
}
inline data::Orient toOrient(const robot::Quat& q) {
    return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
            static_cast<float>(q.z)};
}
/// By how much the square of the length differs from 1: rounding to binary32 rarely leaves 0.
inline double lengthExcess(const robot::Quat& q) {
    return dot(q, q) - 1;
}
/// Of unit length but for rounding: the reciprocals below are short series, whose next terms are beyond the precision of binary64.
inline bool isNearUnit(double lengthExcess) {
    constexpr double kClose = 1e-6;
    return std::abs(lengthExcess) < kClose;
}
/// 1 / length and 1 / length^2 near the unit.
inline double inverseLength(double lengthExcess) {
    return 1 + lengthExcess * (lengthExcess * 0.375 - 0.5);
}
inline double inverseSquare(double lengthExcess) {
    return 1 - lengthExcess * (1 - lengthExcess);
}
/// A call, because the root and what follows from it would be computed before it is known whether they are needed.
[[gnu::cold, gnu::noinline]] inline double unusualLength(double square) {
    return std::sqrt(square);
}
/// Scaled to unit length.
inline robot::Quat toUnitQuat(const data::Orient& o) {
    const robot::Quat q = toQuat(o);
    const double excess = lengthExcess(q);
    if (!isNearUnit(excess)) [[unlikely]]
        return robot::normalized(q, unusualLength(dot(q, q)));
    const double scale = inverseLength(excess);
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}
inline robot::Pose toFrame(const data::Pose& p) {
    return {toVec(p.trans), toUnitQuat(p.rot)};
}
inline data::Pose toPose(const robot::Pose& p) {
    return {toPos(p.pos), toOrient(p.rot)};
}
inline robot::Pose toFrame(const data::Robtarget& t) {
    return {toVec(t.trans), toUnitQuat(t.rot)};
}

} // namespace rt::lib

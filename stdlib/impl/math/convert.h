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
/// A call, because the root and what follows from it would be computed before it is known whether they are needed.
[[gnu::cold, gnu::noinline]] inline double unusualLength(double square) {
    return std::sqrt(square);
}
/// Scaled to unit length, which binary32 components never have exactly. Close to it the reciprocal of the length is a short
/// series, whose next term is below the precision of binary64.
inline robot::Quat toUnitQuat(const data::Orient& o) {
    const robot::Quat q = toQuat(o);
    const double square = dot(q, q);
    const double excess = square - 1;
    constexpr double kClose = 1e-6;
    if (!(std::abs(excess) < kClose)) [[unlikely]]
        return robot::normalized(q, unusualLength(square));
    const double scale = 1 + excess * (excess * 0.375 - 0.5);
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

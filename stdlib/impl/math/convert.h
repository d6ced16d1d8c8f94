#pragma once
// Between the records of RAPID (binary32) and the geometry of the motion system (binary64).

#include "runtime/robot/frames.h"

#include "stdlib_types.h"

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
/// The quaternion is scaled to unit length, which binary32 components never have exactly.
inline robot::Pose toFrame(const data::Pose& p) {
    return {toVec(p.trans), robot::normalized(toQuat(p.rot))};
}
inline data::Pose toPose(const robot::Pose& p) {
    return {toPos(p.pos), toOrient(p.rot)};
}
inline robot::Pose toFrame(const data::Robtarget& t) {
    return {toVec(t.trans), robot::normalized(toQuat(t.rot))};
}

} // namespace rt::lib

// Manual 1.15 and 1.8: orientations, coordinate systems and vectors.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/finite.h"
#include "stdlib/impl/support/inlined.h"

#include "natives/math.h"
#include "natives/positions.h"
#include "stdlib_constants.h"

using namespace rt;
using namespace rt::lib;

namespace {

/// Rotations are of unit length: only the position can be out of range.
Status givePose(TaskCore* task, data::Pose* result, const robot::Pose& pose) {
    const data::Pose out = toPose(pose);
    if (!isFinite(out.trans)) return tooLarge(task);
    *result = out;
    return kOk;
}

/// As the pose says it: neither converted to unit length nor checked.
robot::Pose toRawFrame(const data::Pose& p) {
    return {toVec(p.trans), toQuat(p.rot)};
}
robot::Pose toUnit(const robot::Pose& p) {
    return {p.pos, robot::normalized(p.rot)};
}
[[gnu::cold, gnu::noinline]] robot::Pose unusualProduct(robot::Pose a, robot::Pose b) {
    return toUnit(a) * toUnit(b);
}
[[gnu::cold, gnu::noinline]] robot::Vec3 unusualPoint(robot::Pose frame, robot::Vec3 point) {
    return robot::apply(toUnit(frame), point);
}

/// `robot::apply` for an orientation that is not scaled: the correction is computed beside the products, not before them.
robot::Vec3 applyNearUnit(const robot::Pose& frame, double lengthExcess, const robot::Vec3& point) {
    const robot::Quat& q = frame.rot;
    const robot::Vec3 u{q.x, q.y, q.z};
    const robot::Vec3 t = robot::cross(u, point);
    return frame.pos + (point + (t * q.w + robot::cross(u, t)) * (2 * inverseSquare(lengthExcess)));
}

robot::Pose multiplied(const robot::Pose& a, const robot::Pose& b) {
    const double excessA = lengthExcess(a.rot), excessB = lengthExcess(b.rot);
    if (!(isNearUnit(excessA) && isNearUnit(excessB))) [[unlikely]]
        return unusualProduct(a, b);
    const robot::Quat rot = a.rot * b.rot;
    const double scale = inverseLength(excessA) * inverseLength(excessB);
    // Frames that only turn are common, and often known when the product is inlined.
    const robot::Vec3 position = b.pos == robot::Vec3{} ? a.pos : applyNearUnit(a, excessA, b.pos);
    return {position, {rot.w * scale, rot.x * scale, rot.y * scale, rot.z * scale}};
}

robot::Vec3 applied(const robot::Pose& frame, const robot::Vec3& point) {
    const double excess = lengthExcess(frame.rot);
    if (!isNearUnit(excess)) [[unlikely]]
        return unusualPoint(frame, point);
    return applyNearUnit(frame, excess, point);
}

} // namespace

extern "C" {

// One of three angles: which one is known when it is inlined, as a rule.
RAPIDC_INLINED Status rt_EulerZYX(TaskCore* task, float* result, bool X, bool Y, bool Z,
                                  const data::Orient* Rotation) {
    if (X + Y + Z != 1) return fail(task, err::ERR_ARGVALERR, "EulerZYX needs one of \\X, \\Y and \\Z");
    const robot::Quat q = robot::normalized(toQuat(*Rotation));
    const double angle = X ? robot::eulerX(q) : Y ? robot::eulerY(q) : robot::eulerZ(q);
    return give(task, result, static_cast<float>(angle));
}

Status rt_OrientZYX(TaskCore*, data::Orient* result, float ZAngle, float YAngle, float XAngle) {
    *result = toOrient(robot::fromEulerZyx(ZAngle, YAngle, XAngle));
    return kOk;
}

RAPIDC_INLINED Status rt_NOrient(TaskCore* task, data::Orient* result, const data::Orient* Rotation) {
    const robot::Quat q = toQuat(*Rotation);
    if (!(dot(q, q) > 1e-12))
        return fail(task, err::ERR_ILLQUAT, "an orientation of length 0 has no direction");
    *result = toOrient(robot::normalized(q));
    return kOk;
}

RAPIDC_INLINED Status rt_PoseInv(TaskCore* task, data::Pose* result, const data::Pose* Pose) {
    return givePose(task, result, robot::inverse(toFrame(*Pose)));
}

RAPIDC_INLINED Status rt_PoseMult(TaskCore* task, data::Pose* result, const data::Pose* Pose1,
                                  const data::Pose* Pose2) {
    return givePose(task, result, multiplied(toRawFrame(*Pose1), toRawFrame(*Pose2)));
}

RAPIDC_INLINED Status rt_PoseVect(TaskCore* task, data::Pos* result, const data::Pose* Pose,
                                  const data::Pos* Pos) {
    return give(task, result, toPos(applied(toRawFrame(*Pose), toVec(*Pos))));
}

Status rt_VectMagn(TaskCore* task, float* result, const data::Pos* Vector) {
    return give(task, result, static_cast<float>(robot::norm(toVec(*Vector))));
}

Status rt_DotProd(TaskCore* task, float* result, const data::Pos* Vector1, const data::Pos* Vector2) {
    return give(task, result, static_cast<float>(robot::dot(toVec(*Vector1), toVec(*Vector2))));
}

Status rt_CrossProd(TaskCore* task, data::Pos* result, const data::Pos* Vector1, const data::Pos* Vector2) {
    return give(task, result, toPos(robot::cross(toVec(*Vector1), toVec(*Vector2))));
}

Status rt_Distance(TaskCore* task, float* result, const data::Pos* Point1, const data::Pos* Point2) {
    return give(task, result, static_cast<float>(robot::norm(toVec(*Point1) - toVec(*Point2))));
}
}

// Manual 1.15 and 1.8: orientations, coordinate systems and vectors.

#include "stdlib/impl/math/angles.h"
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

} // namespace

extern "C" {

// One of three angles: which one is known when it is inlined, as a rule.
RAPIDC_INLINED Status rt_EulerZYX(TaskCore* task, float* result, bool X, bool Y, bool Z,
                                  const data::Orient* Rotation) {
    if (X + Y + Z != 1) return fail(task, err::ERR_ARGVALERR, "EulerZYX needs one of \\X, \\Y and \\Z");
    const robot::Vec3 angles = robot::eulerZyx(robot::normalized(toQuat(*Rotation)));
    return give(task, result, static_cast<float>(X ? angles.x : Y ? angles.y : angles.z));
}

Status rt_OrientZYX(TaskCore*, data::Orient* result, float ZAngle, float YAngle, float XAngle) {
    // By half angles: exact for multiples of 90 degrees.
    const auto half = [](float angle) {
        const SineCosine both = sinCosDeg(angle / 2.0);
        return robot::HalfAngle{both.cosine, both.sine};
    };
    const robot::HalfAngle z = half(ZAngle);
    const bool isOneTurn = YAngle == 0 && XAngle == 0; // as that of a joint
    *result = toOrient(isOneTurn ? robot::Quat{z.cosine, 0, 0, z.sine}
                                 : robot::fromHalvesZyx(z, half(YAngle), half(XAngle)));
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
    return givePose(task, result, toFrame(*Pose1) * toFrame(*Pose2));
}

RAPIDC_INLINED Status rt_PoseVect(TaskCore* task, data::Pos* result, const data::Pose* Pose,
                                  const data::Pos* Pos) {
    return give(task, result, toPos(robot::apply(toFrame(*Pose), toVec(*Pos))));
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

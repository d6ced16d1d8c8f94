// Manual 1.15 and 1.8: orientations, coordinate systems and vectors.

#include "stdlib/impl/math/angles.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;
using namespace rt::lib;

extern "C" {

Status rt_EulerZYX(TaskCore* task, float* result, bool X, bool Y, bool Z, const data::Orient* Rotation) {
    if (X + Y + Z != 1) return fail(task, err::ERR_ARGVALERR, "EulerZYX needs one of \\X, \\Y and \\Z");
    const robot::Vec3 angles = robot::eulerZyx(robot::normalized(toQuat(*Rotation)));
    *result = static_cast<float>(X ? angles.x : Y ? angles.y : angles.z);
    return kOk;
}

Status rt_OrientZYX(TaskCore*, data::Orient* result, float ZAngle, float YAngle, float XAngle) {
    // By half angles: exact for multiples of 90 degrees.
    const robot::Quat z{cosDeg(ZAngle / 2.0), 0, 0, sinDeg(ZAngle / 2.0)};
    const robot::Quat y{cosDeg(YAngle / 2.0), 0, sinDeg(YAngle / 2.0), 0};
    const robot::Quat x{cosDeg(XAngle / 2.0), sinDeg(XAngle / 2.0), 0, 0};
    *result = toOrient(z * y * x);
    return kOk;
}

Status rt_NOrient(TaskCore* task, data::Orient* result, const data::Orient* Rotation) {
    const robot::Quat q = toQuat(*Rotation);
    if (!(robot::norm(q) > 1e-6))
        return fail(task, err::ERR_ILLQUAT, "an orientation of length 0 has no direction");
    *result = toOrient(robot::normalized(q));
    return kOk;
}

Status rt_PoseInv(TaskCore*, data::Pose* result, const data::Pose* Pose) {
    *result = toPose(robot::inverse(toFrame(*Pose)));
    return kOk;
}

Status rt_PoseMult(TaskCore*, data::Pose* result, const data::Pose* Pose1, const data::Pose* Pose2) {
    *result = toPose(toFrame(*Pose1) * toFrame(*Pose2));
    return kOk;
}

Status rt_PoseVect(TaskCore*, data::Pos* result, const data::Pose* Pose, const data::Pos* Pos) {
    *result = toPos(robot::apply(toFrame(*Pose), toVec(*Pos)));
    return kOk;
}

Status rt_VectMagn(TaskCore*, float* result, const data::Pos* Vector) {
    *result = static_cast<float>(robot::norm(toVec(*Vector)));
    return kOk;
}

Status rt_DotProd(TaskCore*, float* result, const data::Pos* Vector1, const data::Pos* Vector2) {
    *result = static_cast<float>(robot::dot(toVec(*Vector1), toVec(*Vector2)));
    return kOk;
}

Status rt_CrossProd(TaskCore*, data::Pos* result, const data::Pos* Vector1, const data::Pos* Vector2) {
    *result = toPos(robot::cross(toVec(*Vector1), toVec(*Vector2)));
    return kOk;
}

Status rt_Distance(TaskCore*, float* result, const data::Pos* Point1, const data::Pos* Point2) {
    *result = static_cast<float>(robot::norm(toVec(*Point1) - toVec(*Point2)));
    return kOk;
}
}

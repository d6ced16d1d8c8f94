// Manual 1.8: displaced positions.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/support/finite.h"

#include "natives/positions.h"

using namespace rt;

extern "C" {

Status rt_Offs(TaskCore* task, data::Robtarget* result, const data::Robtarget* Point, float XOffset,
               float YOffset, float ZOffset) {
    data::Robtarget out = *Point;
    out.trans.x += XOffset;
    out.trans.y += YOffset;
    out.trans.z += ZOffset;
    if (!lib::isFinite(out.trans)) return lib::tooLarge(task);
    *result = out;
    return kOk;
}

Status rt_RelTool(TaskCore* task, data::Robtarget* result, const data::Robtarget* Point, float Dx, float Dy,
                  float Dz, const float* Rx, const float* Ry, const float* Rz) {
    const auto degrees = [](const float* angle) { return angle ? static_cast<double>(*angle) : 0.0; };
    const robot::Pose moved =
        robot::relTool(lib::toFrame(*Point), Dx, Dy, Dz, degrees(Rx), degrees(Ry), degrees(Rz));
    data::Robtarget out = *Point;
    out.trans = lib::toPos(moved.pos);
    out.rot = lib::toOrient(moved.rot);
    if (!lib::isFinite(out.trans)) return lib::tooLarge(task); // the rotation is of unit length
    *result = out;
    return kOk;
}
}

// Manual 1.7 and 1.8: coordinate systems from positions, mirrored positions.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/finite.h"

#include "natives/motion_settings.h"
#include "natives/positions.h"
#include "stdlib_constants.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

using namespace rt;
using namespace rt::lib;
using robot::Vec3;

namespace {

constexpr double kSmallest = 1e-6; // mm; shorter differences have no direction

Vec3 unit(const Vec3& v) {
    return v * (1.0 / robot::norm(v));
}

/// Orientation whose axes point along x, y, z (orthonormal, right-handed).
robot::Quat fromAxes(const Vec3& x, const Vec3& y, const Vec3& z) {
    Eigen::Matrix3d m;
    m << x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z;
    const Eigen::Quaterniond q(m);
    return robot::normalized({q.w(), q.x(), q.y(), q.z()});
}

/// x along p1 to p2, p3 on the side of positive y. False when the points lie on a line.
bool frameOfPoints(const Vec3& p1, const Vec3& p2, const Vec3& p3, int origin, robot::Pose& out) {
    if (!(robot::norm(p2 - p1) > kSmallest)) return false;
    const Vec3 x = unit(p2 - p1);
    const Vec3 foot = p1 + x * robot::dot(p3 - p1, x); // on the line, below p3
    if (!(robot::norm(p3 - foot) > kSmallest)) return false;
    const Vec3 y = unit(p3 - foot);
    out.pos = origin == 1 ? p1 : origin == 2 ? p2 : foot;
    out.rot = fromAxes(x, y, robot::cross(x, y));
    return true;
}

Status noFrame(TaskCore* task, const char* why) {
    return fail(task, err::ERR_FRAME, why);
}

Eigen::Vector3d toEigen(const data::Pos& p) {
    return {p.x, p.y, p.z};
}

/// Rotation and translation that bring the points `from` nearest to `to` (least squares, after Kabsch).
robot::Pose bestFit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, bool& defined) {
    const Eigen::Vector3d fromMean = from.rowwise().mean();
    const Eigen::Vector3d toMean = to.rowwise().mean();
    const Eigen::Matrix3Xd fromOff = from.colwise() - fromMean;
    const Eigen::Matrix3Xd toOff = to.colwise() - toMean;
    const Eigen::Matrix3d h = fromOff.lazyProduct(toOff.transpose());
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
    defined = svd.singularValues()(1) > kSmallest * std::max(1.0, svd.singularValues()(0));
    Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
    flip(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Matrix3d r = svd.matrixV() * flip * svd.matrixU().transpose();
    const Eigen::Vector3d t = toMean - r * fromMean;
    const Eigen::Quaterniond q(r);
    return {{t.x(), t.y(), t.z()}, robot::normalized({q.w(), q.x(), q.y(), q.z()})};
}

robot::Pose objectFrame(const data::Wobjdata& workObject) {
    return toFrame(workObject.uframe) * toFrame(workObject.oframe);
}

/// Mirrored in the plane z = 0.
Vec3 mirrored(const Vec3& v) {
    return {v.x, v.y, -v.z};
}

} // namespace

extern "C" {

Status rt_DefFrame(TaskCore* task, data::Pose* result, const data::Robtarget* NewP1,
                   const data::Robtarget* NewP2, const data::Robtarget* NewP3, const float* Origin) {
    if (Origin && *Origin != 1 && *Origin != 2 && *Origin != 3)
        return noFrame(task, "\\Origin must be 1, 2 or 3");
    robot::Pose frame;
    if (!frameOfPoints(toVec(NewP1->trans), toVec(NewP2->trans), toVec(NewP3->trans),
                       Origin ? static_cast<int>(*Origin) : 1, frame))
        return noFrame(task, "the three positions lie on one line or in one place");
    return give(task, result, toPose(frame));
}

Status rt_DefDFrame(TaskCore* task, data::Pose* result, const data::Robtarget* OldP1,
                    const data::Robtarget* OldP2, const data::Robtarget* OldP3, const data::Robtarget* NewP1,
                    const data::Robtarget* NewP2, const data::Robtarget* NewP3) {
    robot::Pose before;
    robot::Pose after;
    if (!frameOfPoints(toVec(OldP1->trans), toVec(OldP2->trans), toVec(OldP3->trans), 1, before) ||
        !frameOfPoints(toVec(NewP1->trans), toVec(NewP2->trans), toVec(NewP3->trans), 1, after))
        return noFrame(task, "the three positions lie on one line or in one place");
    return give(task, result, toPose(after * robot::inverse(before)));
}

Status rt_DefAccFrame(TaskCore* task, data::Pose* result, const data::Robtarget* TargetListOne,
                      int32_t TargetListOneDim1, const data::Robtarget* TargetListTwo,
                      int32_t TargetListTwoDim1, float TargetsInList, float* MaxErr, float* MeanErr) {
    const int32_t most = std::min(TargetListOneDim1, TargetListTwoDim1);
    if (!(TargetsInList >= 3 && TargetsInList <= static_cast<float>(most)))
        return noFrame(task, "DefAccFrame needs at least 3 positions, and not more than the lists hold");
    const auto count = static_cast<Eigen::Index>(TargetsInList);
    Eigen::Matrix3Xd from(3, count);
    Eigen::Matrix3Xd to(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        from.col(i) = toEigen(TargetListOne[i].trans);
        to.col(i) = toEigen(TargetListTwo[i].trans);
    }
    bool defined = false;
    const robot::Pose frame = bestFit(from, to, defined);
    if (!defined) return noFrame(task, "the positions lie on one line or in one place");
    double largest = 0;
    double sum = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
        const double error =
            robot::norm(robot::apply(frame, toVec(TargetListOne[i].trans)) - toVec(TargetListTwo[i].trans));
        largest = std::max(largest, error);
        sum += error;
    }
    const auto worst = static_cast<float>(largest);
    const auto mean = static_cast<float>(sum / static_cast<double>(count));
    if (!isFinite(worst) || !isFinite(mean)) return tooLarge(task);
    if (const Status status = give(task, result, toPose(frame))) return status;
    *MaxErr = worst;
    *MeanErr = mean;
    return kOk;
}

/// The position is mirrored in the xy plane of the object frame of MirPlane. A mirrored tool would be left-handed: its x
/// and z axes are mirrored (y and z with \MirY), the third axis follows from them.
Status rt_MirPos(TaskCore* task, data::Robtarget* result, const data::Robtarget* Point,
                 const data::Wobjdata* MirPlane, const data::Wobjdata* WObj, bool MirY) {
    const robot::Pose object = WObj ? objectFrame(*WObj) : robot::Pose{};
    const robot::Pose plane = objectFrame(*MirPlane);
    const robot::Pose inPlane = robot::inverse(plane) * object * toFrame(*Point);
    const Vec3 z = mirrored(robot::rotate(inPlane.rot, {0, 0, 1}));
    Vec3 x = mirrored(robot::rotate(inPlane.rot, {1, 0, 0}));
    Vec3 y = mirrored(robot::rotate(inPlane.rot, {0, 1, 0}));
    if (MirY)
        x = robot::cross(y, z);
    else
        y = robot::cross(z, x);
    const robot::Pose image{mirrored(inPlane.pos), fromAxes(x, y, z)};
    const robot::Pose back = robot::inverse(object) * plane * image;
    data::Robtarget out = *Point;
    out.trans = toPos(back.pos);
    out.rot = toOrient(back.rot);
    return give(task, result, out);
}
}

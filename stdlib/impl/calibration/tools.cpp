// Manual 1.18: tools and frames of rotating axes from measured positions, by least squares. Lengths in mm.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/math/matrix.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/finite.h"

#include "natives/calibration.h"
#include "natives/matrix.h"
#include "stdlib_constants.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace rt;
using robot::Pose;
using robot::Vec3;

namespace {

constexpr double kSingular = 1e-6; // relative: below it the orientations are too much alike
constexpr double kSamePoint = 0.1; // mm: nearer points give no direction

/// Flange in the base of the robot: the one place where this folder asks for the arm.
Pose flangeAt(TaskCore* task, const data::Jointtarget& target) {
    const robot::Kinematics& arm = taskOf(task).controller().motion(taskOf(task)).system().kinematics();
    return arm.forward(lib::toJoints(target, arm).robax);
}

struct Tip {
    Vec3 onFlange, fixed; ///< the same tip in the flange, and where it was in all positions
    double maxError = 0, meanError = 0;
};

/// The tip that was at one fixed place in all positions: p + R t = c.
Status fitTip(TaskCore* task, const std::array<Pose, 4>& flanges, Tip& tip) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(12, 6);
    Eigen::VectorXd b(12);
    for (int i = 0; i < 4; ++i) {
        const Pose& flange = flanges[static_cast<std::size_t>(i)];
        const robot::Quat& q = flange.rot;
        a.block<3, 3>(3 * i, 0) = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
        a.block<3, 3>(3 * i, 3) = -Eigen::Matrix3d::Identity();
        b.segment<3>(3 * i) = -Eigen::Vector3d(flange.pos.x, flange.pos.y, flange.pos.z);
    }
    Eigen::VectorXd x;
    if (!lib::leastSquares(a, b, kSingular, x))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the four orientations are too much alike; turn the tool about different axes");
    tip.onFlange = {x(0), x(1), x(2)};
    tip.fixed = {x(3), x(4), x(5)};
    for (const Pose& flange : flanges) {
        const double error = norm(apply(flange, tip.onFlange) - tip.fixed);
        tip.maxError = std::max(tip.maxError, error);
        tip.meanError += error / static_cast<double>(flanges.size());
    }
    return kOk;
}

Status giveTip(TaskCore* task, const Vec3& place, const Tip& tip, data::Tooldata* tool, float* maxErr,
               float* meanErr) {
    if (const Status status = lib::give(task, &tool->tframe.trans, lib::toPos(place))) return status;
    *maxErr = static_cast<float>(tip.maxError);
    *meanErr = static_cast<float>(tip.meanError);
    return kOk;
}

Vec3 unit(const Vec3& v) {
    return v * (1 / norm(v));
}

/// The orientation with this z axis, and x as near to `x` as possible. False when the two are parallel.
bool orientation(const Vec3& zDirection, const Vec3& xDirection, data::Orient& out) {
    const Vec3 z = unit(zDirection);
    const Vec3 across = cross(z, unit(xDirection));
    if (!(norm(across) > kSingular)) return false;
    const Vec3 y = unit(across);
    const Vec3 x = cross(y, z);
    Eigen::Matrix3d m;
    m << x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z;
    Eigen::Quaterniond q(m);
    if (q.w() < 0) q.coeffs() *= -1;
    out = lib::toOrient({q.w(), q.x(), q.y(), q.z()});
    return true;
}

Status noDirection(TaskCore* task) {
    return lib::fail(
        task, err::ERR_ARGVALERR,
        "the positions give no direction: RefTip, ZPos and XPos must be apart, and not in one line");
}

/// Without an x direction the axis of the flange that is most across z takes its place.
Status giveOrientation(TaskCore* task, const Vec3& z, const Vec3* x, data::Orient& out) {
    if (norm(z) < kSamePoint || (x && norm(*x) < kSamePoint)) return noDirection(task);
    const Vec3 across = std::fabs(unit(z).x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return orientation(z, x ? *x : across, out) ? kOk : noDirection(task);
}

/// A circle through measured points.
struct Circle {
    Vec3 centre, normal;
    double maxError = 0, meanError = 0;
};

Status badFrame(TaskCore* task, const char* why) {
    return lib::fail(task, err::ERR_FRAME, std::string("the frame cannot be calculated: ") + why);
}

Status fitCircle(TaskCore* task, const data::Robtarget* targets, int32_t size, float used, Circle& circle) {
    constexpr float kFewest = 4;
    if (!(used >= kFewest && used <= static_cast<float>(size)) || std::trunc(used) != used)
        return badFrame(task, "TargetsInList must be at least 4 and at most the size of TargetList");
    std::vector<data::Pos> points;
    for (int32_t i = 0; i < static_cast<int32_t>(used); ++i)
        points.push_back(targets[i].trans);
    data::Pos centre{}, normal{};
    float radius = 0;
    if (rt_FitCircle(task, nullptr, 0, 0, points.data(), static_cast<int32_t>(points.size()), nullptr,
                     &centre, &radius, &normal, nullptr, nullptr, nullptr) != kOk)
        return badFrame(task, "the positions do not lie on a circle");
    circle.centre = lib::toVec(centre);
    circle.normal = unit(lib::toVec(normal));
    for (const data::Pos& point : points) {
        const Vec3 arm = lib::toVec(point) - circle.centre;
        const double height = dot(arm, circle.normal);
        const double error =
            std::hypot(norm(arm - circle.normal * height) - static_cast<double>(radius), height);
        circle.maxError = std::max(circle.maxError, error);
        circle.meanError += error / static_cast<double>(points.size());
    }
    return kOk;
}

/// By how much the external axis has turned between two targets: that axis whose values differ most.
double axisTurn(const data::Robtarget& from, const data::Robtarget& to) {
    const motion::ExternalAxes before = lib::toAxes(from.extax), after = lib::toAxes(to.extax);
    const auto turn = [&](std::size_t axis) { return after[axis] - before[axis]; };
    std::size_t most = 0;
    for (std::size_t i = 1; i < before.size(); ++i)
        if (std::fabs(turn(i)) > std::fabs(turn(most))) most = i;
    return turn(most);
}

Status giveFrame(TaskCore* task, const Circle& circle, const Vec3& firstPoint, data::Pose* result,
                 float* maxErr, float* meanErr) {
    data::Pose frame{lib::toPos(circle.centre), {}};
    if (!orientation(circle.normal, firstPoint - circle.centre, frame.rot))
        return badFrame(task, "the first position lies on the axis");
    if (const Status status = lib::give(task, result, frame)) return status;
    *maxErr = static_cast<float>(circle.maxError);
    *meanErr = static_cast<float>(circle.meanError);
    return kOk;
}

} // namespace

extern "C" {

Status rt_MToolTCPCalib(TaskCore* task, const data::Jointtarget* Pos1, const data::Jointtarget* Pos2,
                        const data::Jointtarget* Pos3, const data::Jointtarget* Pos4, data::Tooldata* Tool,
                        float* MaxErr, float* MeanErr) {
    Tip tip;
    if (const Status status = fitTip(
            task,
            {flangeAt(task, *Pos1), flangeAt(task, *Pos2), flangeAt(task, *Pos3), flangeAt(task, *Pos4)},
            tip))
        return status;
    return giveTip(task, tip.onFlange, tip, Tool, MaxErr, MeanErr);
}

/// In ZPos and XPos the fixed tip lies on the positive z and x axis of the tool.
Status rt_MToolRotCalib(TaskCore* task, const data::Jointtarget* RefTip, const data::Jointtarget* ZPos,
                        const data::Jointtarget* XPos, data::Tooldata* Tool) {
    const Vec3 tcp = lib::toVec(Tool->tframe.trans);
    const Vec3 fixed = apply(flangeAt(task, *RefTip), tcp);
    const auto seen = [&](const data::Jointtarget& target) {
        return apply(inverse(flangeAt(task, target)), fixed) - tcp;
    };
    Vec3 x;
    if (XPos) x = seen(*XPos);
    return giveOrientation(task, seen(*ZPos), XPos ? &x : nullptr, Tool->tframe.rot);
}

/// The place of the fixed tip, whatever pointer the robot holds.
Status rt_SToolTCPCalib(TaskCore* task, const data::Robtarget* Pos1, const data::Robtarget* Pos2,
                        const data::Robtarget* Pos3, const data::Robtarget* Pos4, data::Tooldata* Tool,
                        float* MaxErr, float* MeanErr) {
    Tip tip;
    if (const Status status = fitTip(
            task, {lib::toFrame(*Pos1), lib::toFrame(*Pos2), lib::toFrame(*Pos3), lib::toFrame(*Pos4)}, tip))
        return status;
    return giveTip(task, tip.fixed, tip, Tool, MaxErr, MeanErr);
}

Status rt_SToolRotCalib(TaskCore* task, const data::Robtarget* RefTip, const data::Robtarget* ZPos,
                        const data::Robtarget* XPos, data::Tooldata* Tool) {
    const Vec3 tip = lib::toVec(RefTip->trans);
    const Vec3 x = lib::toVec(XPos->trans) - tip;
    data::Orient rotation{};
    if (const Status status = giveOrientation(task, lib::toVec(ZPos->trans) - tip, &x, rotation))
        return status;
    Tool->tframe = {RefTip->trans, rotation};
    return kOk;
}

/// z: the targets turn about it in the positive direction while the axis turns in its positive direction. x: to the first
/// target.
Status rt_CalcRotAxisFrame(TaskCore* task, data::Pose* result, Handle*, const float*,
                           const data::Robtarget* TargetList, int32_t TargetListDim1, float TargetsInList,
                           float* MaxErr, float* MeanErr) {
    Circle circle;
    if (const Status status = fitCircle(task, TargetList, TargetListDim1, TargetsInList, circle))
        return status;
    const Vec3 first = lib::toVec(TargetList[0].trans);
    double sense = 0;
    for (int32_t i = 1; i < static_cast<int32_t>(TargetsInList); ++i) {
        const Vec3 from = lib::toVec(TargetList[i - 1].trans) - circle.centre;
        const Vec3 to = lib::toVec(TargetList[i].trans) - circle.centre;
        const double turn = axisTurn(TargetList[i - 1], TargetList[i]);
        sense += dot(cross(from, to), circle.normal) * (turn < 0 ? -1 : 1);
    }
    if (sense < 0) circle.normal = circle.normal * -1;
    return giveFrame(task, circle, first, result, MaxErr, MeanErr);
}

Status rt_CalcRotAxFrameZ(TaskCore* task, data::Pose* result, const data::Robtarget* TargetList,
                          int32_t TargetListDim1, float TargetsInList, const data::Robtarget* PositiveZPoint,
                          float* MaxErr, float* MeanErr) {
    Circle circle;
    if (const Status status = fitCircle(task, TargetList, TargetListDim1, TargetsInList, circle))
        return status;
    const double side = dot(lib::toVec(PositiveZPoint->trans) - circle.centre, circle.normal);
    if (std::fabs(side) < kSamePoint)
        return badFrame(task, "PositiveZPoint lies in the plane of the positions");
    if (side < 0) circle.normal = circle.normal * -1;
    return giveFrame(task, circle, lib::toVec(TargetList[0].trans), result, MaxErr, MeanErr);
}
}

// Delta robot: three arms 120 degrees apart, each with a pair of parallel rods to a platform that stays level, and a
// telescopic axis that turns the flange. See DeltaGeometry for frames and directions.

#include "runtime/robot/fast_trig.h"
#include "runtime/robot/mechanism.h"

#include <algorithm>
#include <cmath>

namespace robot {

namespace {

constexpr double kHalfRoot3 = 0.86602540378443864676;
/// Directions of the three arms.
constexpr double kCosine[3] = {1, -0.5, -0.5};
constexpr double kSine[3] = {0, kHalfRoot3, -kHalfRoot3};

class Delta final : public Mechanism {
  public:
    explicit Delta(const RobotModel& model)
        : Mechanism(model), geometry_(model.delta), flangeRot_(model.flangeRot) {}
    Pose forward(const Joints& joints) const override;
    void inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                    IkBranches& out) const override;
    ConfData configuration(const Joints& joints) const override;
    Singularity singularity(const Joints& joints) const override;
    JacobianMatrix jacobian(const Joints& joints) const override;

  private:
    /// Elbow of an arm, shifted inward by the radius of the platform: the rod is the line to the platform centre.
    Vec3 elbow(const Joints& joints, std::size_t arm) const;

    DeltaGeometry geometry_;
    Quat flangeRot_;
};

Vec3 Delta::elbow(const Joints& joints, std::size_t arm) const {
    const double angle = modelAngle(joints, arm) * kDeg;
    const double out = geometry_.baseRadius - geometry_.platformRadius + geometry_.upperArm * std::cos(angle);
    return {out * kCosine[arm], out * kSine[arm], -geometry_.upperArm * std::sin(angle)};
}

/// The platform centre is at the length of the rods from all three elbows; of the two such points the lower one.
Pose Delta::forward(const Joints& joints) const {
    const Vec3 a = elbow(joints, 0);
    const Vec3 u = elbow(joints, 1) - a;
    const Vec3 v = elbow(joints, 2) - a;
    Vec3 normal = cross(u, v);
    const double square = dot(normal, normal);
    // Centre of the circle through the elbows.
    const Vec3 middle = (cross(v, normal) * dot(u, u) + cross(normal, u) * dot(v, v)) * (0.5 / square);
    normal = normal * (1 / std::sqrt(square));
    if (normal.z > 0) normal = normal * -1.0;
    const double height = geometry_.rod * geometry_.rod - dot(middle, middle);
    Pose flange;
    flange.pos = a + middle + normal * std::sqrt(std::max(height, 0.0));
    flange.pos.z -= geometry_.flangeDown;
    flange.rot = fromAxisAngle({0, 0, 1}, modelAngle(joints, 3)) * flangeRot_;
    return flange;
}

void Delta::inverseAll(const Pose& flange, const Joints&, double /*armAngleDeg*/, IkBranches& out) const {
    out.valid = 0;
    double turn = 0;
    if (!levelTurn(flange.rot, flangeRot_, turn)) return;
    Joints joints = Joints::zeros(4);
    for (std::size_t arm = 0; arm < 3; ++arm) {
        // In the plane of the arm: x outward from its axis to the rod joint of the platform, y across, z up.
        const double x = flange.pos.x * kCosine[arm] + flange.pos.y * kSine[arm] + geometry_.platformRadius -
                         geometry_.baseRadius;
        const double y = flange.pos.y * kCosine[arm] - flange.pos.x * kSine[arm];
        const double z = flange.pos.z + geometry_.flangeDown;
        const double square = x * x + y * y + z * z;
        const double along =
            (square + geometry_.upperArm * geometry_.upperArm - geometry_.rod * geometry_.rod) /
            (2 * geometry_.upperArm);
        const double inPlane = std::hypot(x, z);
        if (!(std::fabs(along) <= inPlane * (1 + 1e-9)) || !(inPlane > 0)) return;
        // The elbow points outward: the smaller of the two angles.
        const double angle = std::atan2(-z, x) - std::acos(std::clamp(along / inPlane, -1.0, 1.0));
        joints[arm] = withinLimits(axisAngle(std::remainder(angle / kDeg, 360.0), arm), arm);
    }
    joints[3] = axisAngle(std::remainder(turn, 360.0), 3);
    out.add(joints);
}

ConfData Delta::configuration(const Joints& joints) const {
    return quarters(joints, 0);
}

Singularity Delta::singularity(const Joints& joints) const {
    Vec3 centre = forward(joints).pos;
    centre.z += geometry_.flangeDown;
    Singularity result;
    for (std::size_t arm = 0; arm < 3; ++arm) {
        const double angle = modelAngle(joints, arm) * kDeg;
        const double out = std::cos(angle);
        const Vec3 link{out * kCosine[arm], out * kSine[arm], -std::sin(angle)};
        const Vec3 rod = centre - elbow(joints, arm);
        const double bend = std::atan2(norm(cross(link, rod)), dot(link, rod)) / kDeg;
        result.elbowDeg = std::min({result.elbowDeg, bend, 180.0 - bend});
    }
    return result;
}

/// The rods keep their length: rod . velocity of the platform = rod . velocity of the elbow, for each arm.
JacobianMatrix Delta::jacobian(const Joints& joints) const {
    Vec3 centre = forward(joints).pos;
    centre.z += geometry_.flangeDown;
    JacobianMatrix result;
    result.columns = 4;
    for (std::size_t moved = 0; moved < 3; ++moved) {
        double a[kMostJoints][kMostJoints];
        double b[kMostJoints];
        for (std::size_t arm = 0; arm < 3; ++arm) {
            const Vec3 rod = (centre - elbow(joints, arm)) * (1 / geometry_.rod);
            a[arm][0] = rod.x;
            a[arm][1] = rod.y;
            a[arm][2] = rod.z;
            const double angle = modelAngle(joints, arm) * kDeg;
            const Vec3 speed{-std::sin(angle) * kCosine[arm], -std::sin(angle) * kSine[arm],
                             -std::cos(angle)};
            b[arm] = arm == moved ? dot(rod, speed) * geometry_.upperArm * signs_[arm] : 0;
        }
        if (!solveLinear(3, a, b)) continue; // two rods in line: the platform is not held
        for (std::size_t row = 0; row < 3; ++row)
            result(row, moved) = b[row];
    }
    result(5, 3) = signs_[3];
    return result;
}

} // namespace

std::shared_ptr<const Mechanism> makeDelta(const RobotModel& model) {
    return std::make_shared<Delta>(model);
}

} // namespace robot

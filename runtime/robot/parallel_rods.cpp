// Four axes with rods that keep the flange level (palletisers): axis 2 counts from the vertical, axis 3 from the
// horizontal whatever axis 2 does, the last axis turns the flange.

#include "runtime/robot/arm_plane.h"
#include "runtime/robot/mechanism.h"

#include <cmath>

namespace robot {

namespace {

class ParallelRods final : public Mechanism {
  public:
    explicit ParallelRods(const RobotModel& model);
    Pose forward(const Joints& joints) const override;
    void inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                    IkBranches& out) const override;
    ConfData configuration(const Joints& joints) const override;
    Singularity singularity(const Joints& joints) const override;
    JacobianMatrix jacobian(const Joints& joints) const override;
    double elbowAngle(const Joints& joints) const override {
        return 90 + modelAngle(joints, 1) - modelAngle(joints, 2);
    }

  private:
    struct Posture; // sines and cosines of one posture
    Posture postureOf(const Joints& joints) const;

    ParallelRodGeometry geometry_;
    ArmPlane plane_; // to the flange axis, at the height of the wrist
    Quat flangeRot_;
};

struct ParallelRods::Posture {
    Vec3 outward;
    double sine2 = 0, cosine2 = 1, sine3 = 0, cosine3 = 1;
    double radius = 0, etaDeg = 0; // distance of the flange from axis 1; from lower arm to upper arm
};

ParallelRods::ParallelRods(const RobotModel& model)
    : Mechanism(model), geometry_(model.parallelRods), flangeRot_(model.flangeRot) {
    OpwParameters plane;
    plane.a1 = geometry_.a1 + geometry_.out;
    plane.c1 = geometry_.c1 - geometry_.down;
    plane.c2 = geometry_.c2;
    plane_ = ArmPlane(plane, 0, geometry_.c3, 0);
    leastElbow_ = geometry_.leastElbowDeg;
    mostElbow_ = geometry_.mostElbowDeg;
    isElbowLimited_ = std::isfinite(leastElbow_) || std::isfinite(mostElbow_);
}

ParallelRods::Posture ParallelRods::postureOf(const Joints& joints) const {
    const double angles[3] = {modelAngle(joints, 0), modelAngle(joints, 1), modelAngle(joints, 2)};
    double s[3];
    double c[3];
    trig::sinCosDeg(angles, s, c);
    return {{c[0], s[0], 0},           s[1], c[1], s[2], c[2], plane_.radius(s[1], s[2], c[2]),
            angles[2] + 90 - angles[1]};
}

Pose ParallelRods::forward(const Joints& joints) const {
    const Posture p = postureOf(joints);
    Pose flange;
    flange.pos = p.outward * p.radius;
    flange.pos.z = plane_.c1 + geometry_.c2 * p.cosine2 - geometry_.c3 * p.sine3;
    flange.rot = fromAxisAngle({0, 0, 1}, modelAngle(joints, 0) - modelAngle(joints, 3)) * flangeRot_;
    return flange;
}

void ParallelRods::inverseAll(const Pose& flange, const Joints& seed, double /*armAngleDeg*/,
                              IkBranches& out) const {
    out.valid = 0;
    double turn = 0;
    ArmTarget target;
    if (!levelTurn(flange.rot, flangeRot_, turn) || !plane_.aim(flange.pos, modelAngle(seed, 0), target))
        return;
    for (int branch = 0; branch < 4; ++branch) {
        ArmBranch arm;
        if (!plane_.solve(target, branch >> 1, branch & 1, arm)) continue;
        const double y[3] = {arm.sine1, arm.sine2, arm.sine23};
        const double x[3] = {arm.cosine1, arm.cosine2, arm.cosine23};
        double angle[3];
        trig::atan2Deg(y, x, angle);
        const Joints model{angle[0], angle[1], angle[2], std::remainder(angle[0] - turn, 360.0)};
        Joints joints = Joints::zeros(4);
        for (std::size_t i = 0; i < 4; ++i)
            joints[i] = axisAngle(model[i], i);
        joints[1] = withinLimits(joints[1], 1);
        joints[2] = withinLimits(joints[2], 2);
        out.add(joints);
    }
}

ConfData ParallelRods::configuration(const Joints& joints) const {
    const Posture p = postureOf(joints);
    int cfx = p.radius < -kFreeArm ? 4 : 0;
    if (std::sin(p.etaDeg * kDeg) < -kNoise * kDeg) cfx |= 2;
    return quarters(joints, cfx);
}

Singularity ParallelRods::singularity(const Joints& joints) const {
    const Posture p = postureOf(joints);
    const double eta = std::fabs(std::remainder(p.etaDeg, 360.0));
    Singularity result;
    result.armMm = std::fabs(p.radius);
    result.elbowDeg = std::min(eta, 180.0 - eta);
    return result;
}

JacobianMatrix ParallelRods::jacobian(const Joints& joints) const {
    const Posture p = postureOf(joints);
    const Vec3 up{0, 0, 1};
    const Vec3 shifts[4] = {Vec3{-p.outward.y, p.outward.x, 0} * p.radius,
                            (p.outward * p.cosine2 - up * p.sine2) * geometry_.c2,
                            (p.outward * p.sine3 + up * p.cosine3) * -geometry_.c3,
                            {}};
    const double turns[4] = {1, 0, 0, -1};
    JacobianMatrix result;
    result.columns = 4;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 shift = shifts[i] * signs_[i];
        result(0, i) = shift.x;
        result(1, i) = shift.y;
        result(2, i) = shift.z;
        result(5, i) = turns[i] * signs_[i];
    }
    return result;
}

} // namespace

std::shared_ptr<const Mechanism> makeParallelRods(const RobotModel& model) {
    return std::make_shared<ParallelRods>(model);
}

} // namespace robot

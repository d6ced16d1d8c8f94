// SCARA: axes 1, 2 and 4 turn about z, axis 3 moves along z (mm, positive up) between them.

#include "runtime/robot/fast_trig.h"
#include "runtime/robot/mechanism.h"

#include <algorithm>
#include <cmath>

namespace robot {

namespace {

class Scara final : public Mechanism {
  public:
    explicit Scara(const RobotModel& model)
        : Mechanism(model), geometry_(model.scara), flangeRot_(model.flangeRot) {
        linear_ = 2;
    }
    Pose forward(const Joints& joints) const override;
    void inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                    IkBranches& out) const override;
    ConfData configuration(const Joints& joints) const override;
    Singularity singularity(const Joints& joints) const override;
    JacobianMatrix jacobian(const Joints& joints) const override;

  private:
    ScaraGeometry geometry_;
    Quat flangeRot_;
};

Pose Scara::forward(const Joints& joints) const {
    const double m1 = modelAngle(joints, 0);
    const double angles[2] = {m1, m1 + modelAngle(joints, 1)};
    double s[2];
    double c[2];
    trig::sinCosDeg(angles, s, c);
    return {{geometry_.upperArm * c[0] + geometry_.forearm * c[1],
             geometry_.upperArm * s[0] + geometry_.forearm * s[1], geometry_.height + modelAngle(joints, 2)},
            fromAxisAngle({0, 0, 1}, angles[1] + modelAngle(joints, 3)) * flangeRot_};
}

void Scara::inverseAll(const Pose& flange, const Joints& seed, double /*armAngleDeg*/,
                       IkBranches& out) const {
    out.valid = 0;
    double turn = 0;
    if (!levelTurn(flange.rot, flangeRot_, turn) || !std::isfinite(flange.pos.z)) return;
    const double x = flange.pos.x;
    const double y = flange.pos.y;
    const double upper = geometry_.upperArm;
    const double fore = geometry_.forearm;
    double cosine = (x * x + y * y - upper * upper - fore * fore) / (2 * upper * fore);
    if (!(std::fabs(cosine) <= 1 + 1e-9)) return;
    cosine = std::clamp(cosine, -1.0, 1.0);
    // If the flange is on axis 1 (equal links, folded), that axis is free.
    const bool isFree = x * x + y * y < 1e-12;
    for (double side : {1.0, -1.0}) {
        const double sine = side * std::sqrt(1 - cosine * cosine);
        const double m2 = std::atan2(sine, cosine) / kDeg;
        const double m1 = isFree ? modelAngle(seed, 0)
                                 : (std::atan2(y, x) - std::atan2(fore * sine, upper + fore * cosine)) / kDeg;
        const Joints model{std::remainder(m1, 360.0), m2, flange.pos.z - geometry_.height,
                           std::remainder(turn - m1 - m2, 360.0)};
        Joints joints = Joints::zeros(4);
        for (std::size_t i = 0; i < 4; ++i)
            joints[i] = axisAngle(model[i], i);
        out.add(joints);
    }
}

ConfData Scara::configuration(const Joints& joints) const {
    return quarters(joints, joints[1] < -kNoise ? 1 : 0);
}

Singularity Scara::singularity(const Joints& joints) const {
    const double bend = std::fabs(std::remainder(modelAngle(joints, 1), 360.0));
    Singularity result;
    result.elbowDeg = std::min(bend, 180.0 - bend);
    return result;
}

JacobianMatrix Scara::jacobian(const Joints& joints) const {
    const double m1 = modelAngle(joints, 0);
    const double angles[2] = {m1, m1 + modelAngle(joints, 1)};
    double s[2];
    double c[2];
    trig::sinCosDeg(angles, s, c);
    const double fore = geometry_.forearm;
    const double columns[4][4] = {
        {-geometry_.upperArm * s[0] - fore * s[1], geometry_.upperArm * c[0] + fore * c[1], 0, 1},
        {-fore * s[1], fore * c[1], 0, 1},
        {0, 0, 1, 0},
        {0, 0, 0, 1}};
    JacobianMatrix result;
    result.columns = 4;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t row = 0; row < 3; ++row)
            result(row, i) = columns[i][row] * signs_[i];
        result(5, i) = columns[i][3] * signs_[i];
    }
    return result;
}

} // namespace

std::shared_ptr<const Mechanism> makeScara(const RobotModel& model) {
    return std::make_shared<Scara>(model);
}

} // namespace robot

// The handle that callers hold: picks the mechanism of a model and passes every question on to it.

#include "runtime/robot/kinematics.h"

#include "runtime/robot/mechanism.h"

#include <fmt/format.h>

#include <algorithm>

namespace robot {

namespace {

std::shared_ptr<const Mechanism> makeMechanism(const RobotModel& model) {
    switch (model.kinematics) {
    case KinematicsKind::SphericalWrist: return makeSphericalWrist(model);
    case KinematicsKind::OffsetWrist: return makeOffsetWrist(model);
    case KinematicsKind::SevenAxes: return makeSevenAxes(model);
    case KinematicsKind::ParallelRods: return makeParallelRods(model);
    case KinematicsKind::Scara: return makeScara(model);
    case KinematicsKind::Delta: return makeDelta(model);
    case KinematicsKind::NoArm: return makeNoArm(model);
    }
    return makeSphericalWrist(model);
}

} // namespace

int quarterRevolution(double angleDeg) {
    if (std::isnan(angleDeg)) return 0;
    constexpr double kMost = 1e9; // an angle beyond any arm's
    return static_cast<int>(std::clamp(std::floor((angleDeg + kNoise) / 90.0), -kMost, kMost));
}

std::string IkError::message() const {
    switch (kind) {
    case IkErrorKind::Unreachable: return "the position is outside the reach of the arm";
    case IkErrorKind::OutOfJointLimits:
        return fmt::format("axis {} would have to be at {:.2f} degrees, outside its range", joint, angleDeg);
    case IkErrorKind::OutOfElbowLimits:
        return fmt::format(
            "lower and upper arm would be at {:.2f} degrees to each other, which the rods do not "
            "let them",
            angleDeg);
    case IkErrorKind::NoSuchConfiguration:
        return joint == 0
                   ? std::string("the position does not have the configuration asked for")
                   : fmt::format(
                         "axis {} would be at {:.2f} degrees, in another quarter than confdata asks for",
                         joint, angleDeg);
    }
    return {};
}

Kinematics::Kinematics() {
    static const std::shared_ptr<const Mechanism> none = makeSphericalWrist(RobotModel{});
    mechanism_ = none;
}

Kinematics::Kinematics(const RobotModel& model) : mechanism_(makeMechanism(model)) {}

std::size_t Kinematics::jointCount() const {
    return mechanism_->jointCount();
}

int Kinematics::axisNumber(std::size_t i) const {
    return i < jointCount() ? mechanism_->axisNumber(i) : 0;
}

bool Kinematics::isLinear(std::size_t i) const {
    return mechanism_->isLinear(i);
}

bool Kinematics::hasArmAngle() const {
    return jointCount() == 7;
}

Pose Kinematics::forward(const Joints& joints) const {
    return mechanism_->forward(joints);
}

double Kinematics::armAngle(const Joints& joints) const {
    return mechanism_->armAngle(joints);
}

void Kinematics::inverseAll(const Pose& flange, const Joints& seed, IkBranches& out,
                            double armAngleDeg) const {
    mechanism_->inverseAll(flange, seed, armAngleDeg, out);
}

Expected<Joints, IkError> Kinematics::inverse(const Pose& flange, const ConfData& conf, const Joints& seed,
                                              double armAngleDeg) const {
    return mechanism_->inverse(flange, conf, seed, armAngleDeg);
}

Expected<Joints, IkError> Kinematics::inverseNear(const Pose& flange, const Joints& seed,
                                                  double armAngleDeg) const {
    return mechanism_->inverseNear(flange, seed, armAngleDeg);
}

bool Kinematics::inverseContinue(const Pose& flange, const Joints& seed, Joints& out,
                                 double armAngleDeg) const {
    return mechanism_->inverseContinue(flange, seed, armAngleDeg, out);
}

void Kinematics::inverseContinueEach(std::span<InverseTask> tasks) const {
    mechanism_->inverseContinueEach(tasks);
}

bool Kinematics::inverseWithWrist(const Vec3& tcp, const Pose& flange_tcp, const Joints& wrist,
                                  const Joints& seed, Joints& out) const {
    return mechanism_->inverseWithWrist(tcp, flange_tcp, wrist, seed, out);
}

bool Kinematics::inverseLockedAxis4(const Pose& base_tcp, const Pose& flange_tcp, double axis4Deg,
                                    const Joints& seed, Joints& out) const {
    return mechanism_->inverseLockedAxis4(base_tcp, flange_tcp, axis4Deg, seed, out);
}

ConfData Kinematics::configuration(const Joints& joints) const {
    return mechanism_->configuration(joints);
}

int Kinematics::jointOutsideLimits(const Joints& joints, double tolerance) const {
    return mechanism_->jointOutsideLimits(joints, tolerance);
}

double Kinematics::elbowAngle(const Joints& joints) const {
    return mechanism_->elbowAngle(joints);
}

IkError Kinematics::limitError(const Joints& joints, int joint) const {
    return joint < 1 || joint > static_cast<int>(jointCount()) ? IkError{}
                                                               : mechanism_->limitError(joints, joint);
}

Singularity Kinematics::singularity(const Joints& joints) const {
    return mechanism_->singularity(joints);
}

JacobianMatrix Kinematics::jacobian(const Joints& joints) const {
    return mechanism_->jacobian(joints);
}

const Joints& Kinematics::lowerDeg() const {
    return mechanism_->lower();
}

const Joints& Kinematics::upperDeg() const {
    return mechanism_->upper();
}

} // namespace robot

// No arm at all: a motion task that moves external units alone. Its flange does not move.

#include "runtime/robot/mechanism.h"

namespace robot {

namespace {

class NoArm final : public Mechanism {
  public:
    explicit NoArm(const RobotModel& model) : Mechanism(model) {}
    Pose forward(const Joints& /*joints*/) const override { return {}; }
    void inverseAll(const Pose& /*flange*/, const Joints& /*seed*/, double /*armAngleDeg*/,
                    IkBranches& out) const override {
        out.valid = 0;
    }
    ConfData configuration(const Joints& /*joints*/) const override { return {}; }
    Singularity singularity(const Joints& /*joints*/) const override { return {}; }
    JacobianMatrix jacobian(const Joints& /*joints*/) const override { return {}; }
};

} // namespace

std::shared_ptr<const Mechanism> makeNoArm(const RobotModel& model) {
    return std::make_shared<const NoArm>(model);
}

RobotModel armlessModel() {
    RobotModel model;
    model.name = "external units";
    model.kinematics = KinematicsKind::NoArm;
    for (Joints* figures : {&model.lowerDeg, &model.upperDeg, &model.maxSpeed, &model.maxAcceleration,
                            &model.maxJerk, &model.geometry.signs, &model.geometry.offsetsDeg})
        *figures = Joints::zeros(0);
    model.dynamics.longWindow = 0.108; // s, of the robot that was measured
    model.dynamics.shortWindow = 0.048;
    return model;
}

} // namespace robot

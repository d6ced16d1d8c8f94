#pragma once
// SoftServo: axes that give way like springs (soft servo, manual 2.2.5). What accelerates an axis bends its spring, and so does a
// torque from outside; the arm is shown beside its planned path by that much.

#include "runtime/motion/path_modifier.h"
#include "runtime/robot/dynamics.h"
#include "runtime/robot/kinematics.h"

#include <array>
#include <deque>

namespace motion {

class SoftServo final : public PathModifier {
  public:
    /// The kinematics outlive it.
    SoftServo(const robot::Kinematics& kinematics, const robot::AccelerationMap& accelerations);

    /// The axis gives way by 0.1 deg (mm) a percent under its greatest torque; the change takes `seconds` from now on.
    void setCompliance(TimeNs now, std::size_t axis, double percent, double seconds);

    /// From now on this torque acts on the axis from outside: a share of its greatest torque, of which 1 and -1 are the most.
    void setOutsideTorque(std::size_t axis, double share);

    bool isActive() const override;
    void advance(const PlannedMoment& planned) override;
    Pose displaced(const PlannedMoment& planned, const Pose& tcp) const override;
    bool movesAtRest() const override;
    void forgetBefore(TimeNs time) override;

  private:
    /// Percent over time, from one to another.
    struct Ramp {
        double from = 0, to = 0;
        TimeNs begin = 0;
        double seconds = 0;
        double at(TimeNs time) const;
        bool isOver(TimeNs time) const;
    };
    struct Sample {
        TimeNs time = 0;
        Joints planned;
        std::array<double, robot::kMostJoints> outside{}; ///< shares of the greatest torques
        Joints deflection;                                ///< deg or mm
    };
    bool isCompliant() const;
    Joints deflectionAt(TimeNs time, std::size_t axes) const;
    Joints deflectionOf(const Sample& now) const;

    const robot::Kinematics& kinematics_;
    robot::AccelerationMap accelerations_;
    std::array<double, robot::kMostJoints> outside_{};
    std::array<Ramp, robot::kMostJoints> ramps_{};
    std::deque<Sample> window_; ///< the latest ones, over which torques are averaged
    std::deque<Sample> shown_;  ///< those that may still be asked for
    int unsettled_ = 0;         ///< periods until the springs are at rest
};

} // namespace motion

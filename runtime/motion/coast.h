#pragma once
// Coast: how the arm comes to rest when the motors go off: each axis brakes for itself, so the arm leaves its path.

#include "runtime/motion/motion_state.h"
#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"

namespace motion {

class Coast {
  public:
    /// From the state of a moving arm. Every axis brakes with its greatest acceleration; it does not pass its limits.
    /// External axes stand at once.
    Coast(const MotionState& from, const robot::RobotModel& model, const FrameSetup& frames);

    double duration() const { return duration_; } ///< s
    /// State after that many seconds.
    MotionState at(double seconds, const robot::Kinematics& kinematics) const;

  private:
    MotionState from_;
    FrameSetup frames_;
    Joints deceleration_{}; ///< deg/s^2
    Joints lower_{}, upper_{};
    double duration_ = 0;
};

} // namespace motion

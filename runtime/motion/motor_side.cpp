#include "runtime/motion/motor_side.h"

#include "runtime/robot/dynamics.h"

namespace motion {

Joints motorSide(const MotionSystem& arm, const MotionState& state, TimeNs time) {
    constexpr TimeNs kApart = 1'000'000;
    constexpr double kSeconds = 1e-9 * static_cast<double>(kApart);
    constexpr double kDegrees = 57.295779513082323e-3; // of a mrad
    const robot::Dynamics& dynamics = arm.model().dynamics;
    Joints motors = state.joints;
    if (!state.moving || dynamics.motorDeflection == decltype(dynamics.motorDeflection){}) return motors;
    Joints most = state.joints;
    robot::AccelerationMap(arm.model()).limitsAt(state.joints, most);
    const MotionState next = arm.sample(time + kApart);
    for (std::size_t i = 0; i < motors.size(); ++i) {
        const double acceleration = (next.jointSpeed[i] - state.jointSpeed[i]) / kSeconds;
        motors[i] += kDegrees * dynamics.motorDeflection[i] * acceleration / most[i];
    }
    return motors;
}

} // namespace motion

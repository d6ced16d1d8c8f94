#include "runtime/motion/coast.h"

#include <algorithm>
#include <cmath>

namespace motion {

Coast::Coast(const MotionState& from, const robot::RobotModel& model, const FrameSetup& frames)
    : from_(from), frames_(frames), deceleration_(model.maxAcceleration), lower_(model.lowerDeg),
      upper_(model.upperDeg) {
    for (std::size_t i = 0; i < deceleration_.size(); ++i)
        if (deceleration_[i] > 0)
            duration_ = std::max(duration_, std::fabs(from_.jointSpeed[i]) / deceleration_[i]);
}

MotionState Coast::at(double seconds, const robot::Kinematics& kinematics) const {
    MotionState state = from_;
    Joints& speed = state.jointSpeed;
    for (std::size_t i = 0; i < speed.size(); ++i) {
        const double start = from_.jointSpeed[i];
        const double rest = deceleration_[i] > 0 ? std::fabs(start) / deceleration_[i] : 0;
        const double t = std::clamp(seconds, 0.0, rest);
        speed[i] = std::copysign(std::max(0.0, std::fabs(start) - deceleration_[i] * t), start);
        const double place = from_.joints[i] + 0.5 * (start + speed[i]) * t;
        state.joints[i] =
            std::clamp(place, std::min(lower_[i], from_.joints[i]), std::max(upper_[i], from_.joints[i]));
        if (state.joints[i] != place) speed[i] = 0;
    }
    state.tcp = frames_.tcpInWorld(kinematics.forward(state.joints), state.extax);
    state.moving = seconds < duration_;
    // The path of the TCP has no closed form: its speed by the difference over a tenth of a millisecond.
    constexpr double kStep = 1e-4;
    Joints next = state.joints;
    for (std::size_t i = 0; i < next.size(); ++i)
        next[i] += speed[i] * kStep;
    const Pose ahead = frames_.tcpInWorld(kinematics.forward(next), state.extax);
    const double dx = ahead.pos.x - state.tcp.pos.x, dy = ahead.pos.y - state.tcp.pos.y,
                 dz = ahead.pos.z - state.tcp.pos.z;
    state.tcpSpeed = std::sqrt(dx * dx + dy * dy + dz * dz) / kStep;
    return state;
}

} // namespace motion

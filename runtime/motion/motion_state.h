#pragma once
// MotionState: what can be seen of an arm at one moment.

#include "runtime/motion/targets.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace motion {

struct MotionState {
    Joints joints{}; ///< deg
    std::array<uint8_t, robot::kMostJoints> axisNumbers{1, 2, 3, 4,
                                                        5, 6, 7}; ///< RAPID's number of each joint
    Joints jointSpeed{};                                          ///< deg/s
    Joints motors = Joints::zeros(0); ///< deg, as the motors have them; empty unless a trace asks for it
    ExternalAxes extax = kNoExternalAxes;
    Pose tcp;            ///< TCP of the active tool in world
    double tcpSpeed = 0; ///< mm/s relative to the work object
    int64_t move = 0;    ///< id of the move in progress or finished last; 0 = none yet
    uint64_t tag = 0;    ///< its tag
    bool moving = false;
    bool toolHeld = true; ///< the robot holds the active tool; a stationary one does not move

    /// The axes as in a jointtarget: rax_1 to rax_6, then eax_a to eax_f (axis 7 of a seven-axis arm is eax_a). 0 for an axis
    /// that the arm does not have, kNotConnected for an external one.
    std::array<double, 6 + kExternalCount> numberedAxes() const;
    friend bool operator==(const MotionState&, const MotionState&) = default;
};

inline std::array<double, 6 + kExternalCount> MotionState::numberedAxes() const {
    std::array<double, 6 + kExternalCount> axes{};
    std::copy(extax.begin(), extax.end(), axes.end() - kExternalCount);
    for (std::size_t i = 0; i < joints.size(); ++i)
        axes[axisNumbers[i] - 1U] = joints[i];
    return axes;
}

} // namespace motion

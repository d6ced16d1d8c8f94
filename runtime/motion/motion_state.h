#pragma once
// MotionState: what can be seen of an arm at one moment.

#include "runtime/motion/targets.h"

#include <cstdint>

namespace motion {

struct MotionState {
    Joints joints{};     ///< deg
    Joints jointSpeed{}; ///< deg/s
    ExternalAxes extax = kNoExternalAxes;
    Pose tcp;            ///< TCP of the active tool in world
    double tcpSpeed = 0; ///< mm/s relative to the work object
    int64_t move = 0;    ///< id of the move in progress or finished last; 0 = none yet
    uint64_t tag = 0;    ///< its tag
    bool moving = false;
    bool toolHeld = true; ///< the robot holds the active tool; a stationary one does not move
};

} // namespace motion

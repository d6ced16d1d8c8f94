#pragma once
// StopFlags: who has stopped the movement of a motion group by StopMove (manual 1.8, IsStopMoveAct).

#include <cstdint>

namespace rt {

enum class StopOrigin : uint8_t { MotionTask, OtherTask };

/// The movement continues when neither flag is set.
struct StopFlags {
    bool byMotionTask = false;
    bool byOtherTask = false;
    bool isSet() const { return byMotionTask || byOtherTask; }
    bool& of(StopOrigin origin) { return origin == StopOrigin::MotionTask ? byMotionTask : byOtherTask; }
    bool of(StopOrigin origin) const { return origin == StopOrigin::MotionTask ? byMotionTask : byOtherTask; }
};

} // namespace rt

#pragma once
// SteppedArm: what the debugger asks of the arm.

#include "runtime/abi/rt_abi.h"
#include "runtime/motion/move_command.h"
#include "runtime/motion/stop_kind.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace rt {

class Task;

/// The movement instruction executed last: its place and its order (manual 1.21).
struct MotionPointer {
    bool valid = false;
    const Frame* frame = nullptr;
    const RoutineDesc* routine = nullptr;
    int32_t statement = -1;
    motion::MoveCommand command;
};

/// Robots between SyncMoveOn and SyncMoveOff.
struct MovingTogether {
    std::vector<Task*> tasks;     ///< none: the robot moves for itself
    std::optional<int64_t> first; ///< \ID of their first movement; none: they have not made one
};

/// The arm of a program that is stepped.
class SteppedArm {
  public:
    /// The controller's stop and start.
    virtual void programStop(motion::StopKind kind = motion::StopKind::Normal) = 0;
    virtual void programStart() = 0;
    /// ClearPath, program pointer moved.
    virtual void clearPath() = 0;
    /// Of the movement ordered last.
    virtual const MotionPointer& pointer() const = 0;
    /// Movements are executed backwards from now on: to their target, with type and speed of the motion pointer's.
    virtual void setBackward(bool backward) = 0;
    virtual MovingTogether together() const = 0;

  protected:
    ~SteppedArm() = default;
};

} // namespace rt

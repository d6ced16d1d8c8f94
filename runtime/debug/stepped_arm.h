#pragma once
// SteppedArm: what the debugger asks of the arm.

#include "runtime/abi/rt_abi.h"
#include "runtime/motion/move_command.h"
#include "runtime/motion/stop_kind.h"

#include <cstdint>
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

/// A statement in progress when robots began or ceased to move together: the instruction itself, or a call that led to it.
struct TogetherChange {
    const Frame* frame = nullptr;
    const RoutineDesc* routine = nullptr;
    int32_t statement = -1;
    const RoutineDesc* callee = nullptr; ///< null: the instruction itself
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
    /// The tasks between SyncMoveOn and SyncMoveOff; none: the robot moves for itself.
    virtual std::vector<Task*> tasksTogether() const = 0;
    /// The statements in progress at the latest SyncMoveOn, SyncMoveOff or SyncMoveUndo, innermost first.
    virtual const std::vector<TogetherChange>& togetherChange() const = 0;

  protected:
    ~SteppedArm() = default;
};

} // namespace rt

#pragma once
// TraceSink: takes what the robot does, as it happens.

#include "runtime/base/source_place.h"
#include "runtime/base/time.h"
#include "runtime/motion/motion_state.h"
#include "runtime/motion/move_command.h"

#include <cstdint>
#include <string_view>

namespace rt {

/// A movement that a program has ordered.
struct MoveOrder {
    uint64_t number = 0; ///< of the move instruction, from 1: the tag of the samples on it
    const motion::MoveCommand& command;
    motion::Pose end;  ///< programmed end of the TCP in world; for a stationary tool, of the tool itself
    SourcePlace place; ///< of the instruction in the user's program; empty when it is not known
};

/// Takes the samples of the robot's motion, in order of time.
class TraceSink {
  public:
    static constexpr Time kPeriod = 4 * kMillisecond; ///< between samples, unless --tick gives another time
    virtual ~TraceSink() = default;
    virtual void sample(Time time, std::string_view unit, const motion::MotionState& state) = 0;
    /// The samples shall have the positions of the motors.
    virtual bool wantsMotors() const { return false; }
    /// Comes before the samples of that movement.
    virtual void ordered(const MoveOrder& /*order*/) {}
};

} // namespace rt

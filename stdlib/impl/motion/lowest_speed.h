#pragma once
// Movements without a programmed speed: they run at the lowest one, which takes long enough to look like a standstill.

#include "runtime/abi/rt_abi.h"
#include "runtime/motion/move_command.h"

namespace rt::lib {

/// Writes an event when the movement, which is about to be ordered, has to cover a way for which its speeddata has 0.
void warnOfNoSpeed(TaskCore* task, const motion::MoveCommand& command);

} // namespace rt::lib

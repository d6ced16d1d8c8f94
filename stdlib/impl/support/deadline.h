#pragma once
// The optional argument that limits how long a communication instruction waits.

#include "runtime/sched/task.h"

#include "stdlib_constants.h"

#include <algorithm>

namespace rt::lib {

/// Absolute virtual time: after \Time seconds, after 60 s when it is left out, never for WAIT_MAX.
inline Time deadlineOf(TaskCore* task, const float* seconds) {
    constexpr double kUsual = 60; // s
    if (seconds != nullptr && *seconds >= k::WAIT_MAX) return kNever;
    return addTime(taskOf(task).now(), fromSeconds(seconds != nullptr ? std::max(*seconds, 0.0F) : kUsual));
}

} // namespace rt::lib

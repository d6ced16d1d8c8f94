#pragma once
// How natives raise errors.

#include "runtime/sched/task.h"

namespace rt::lib {

/// Raises `number` with a sentence for the event log: `return fail(task, err::ERR_ARGVALERR, "why and what to
/// do");` A null task (unit tests of pure functions) just gets the number.
inline Status fail(TaskCore* task, Status number, std::string_view text) {
    return task ? taskOf(task).raise(number, std::string(text)) : number;
}

} // namespace rt::lib

#pragma once
// How natives raise errors. Texts are put together out of line, so that natives stay small enough to be inlined.

#include "runtime/abi/support_natives.h"
#include "runtime/sched/task.h"

extern "C" {
[[gnu::cold]] rt::support::rt_fail_type rt_fail;
[[gnu::cold]] rt::support::rt_failWith_type rt_failWith;
}

namespace rt::lib {

/// Not 0, which the optimiser cannot see: without an error a native must have a result.
inline Status raised(Status status) {
    if (status == kOk) __builtin_unreachable();
    return status;
}

/// Raises `number` with a sentence for the event log: `return fail(task, err::ERR_ARGVALERR, "why and what to
/// do");` A null task (unit tests of pure functions) just gets the number.
inline Status fail(TaskCore* task, Status number, std::string_view text) {
    return raised(rt_fail(task, number, text.data(), static_cast<int64_t>(text.size())));
}

/// The same with numbers in place of the first and the second "{}".
inline Status failWith(TaskCore* task, Status number, const char* text, double first, double second = 0) {
    return raised(rt_failWith(task, number, text, first, second));
}

} // namespace rt::lib

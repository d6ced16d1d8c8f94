#pragma once
// Waits that look again and again at data whose changes are not reported (WaitUntil, WaitTestAndSet). When nothing can
// change the data any more, the run ends with an event: otherwise it would never end.

#include "runtime/sched/task.h"

namespace rt::lib {

/// From this shift of virtual time on a wait without a limit is taken for one that may never end.
inline constexpr Time kShift = 8 * (3600 * kSecond);

/// The wait that began at `since` has lasted a shift, and it is possible to find out whether it can end: the run does not
/// last until a given time, and not at the pace of the wall clock.
bool mayNeverEnd(const Task& task, Time since);

/// Waits until the next look, in which every other such wait looks again as well. `hopeless`: every task waits, and nothing
/// is to happen: what is waited for can only depend on the time now, and no sensible condition waits that long.
Status waitForNextLook(Task& task, bool& hopeless);

/// Stops the task with the event for it. Negative.
Status reportHopeless(Task& task, const char* instruction);

} // namespace rt::lib

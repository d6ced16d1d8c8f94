// Manual 1.6: waiting for a time, a condition, the robot.

#include "runtime/abi/support_natives.h"
#include "runtime/host/controller.h"
#include "stdlib/impl/support/endless_poll.h"
#include "stdlib/impl/support/fail.h"

#include "natives/motion_settings.h"
#include "natives/waiting.h"
#include "stdlib_constants.h"

#include <algorithm>

using namespace rt;

namespace {

constexpr double kPollSeconds = 0.1;
constexpr double kShortestPoll = 0.04; // manual 1.20 for the default; the limit as on a controller

/// Until robot and additional axes stand in the last point; a task without a robot has nothing to wait for.
Status waitInPosition(TaskCore* task) {
    Task& owner = taskOf(task);
    return owner.isMotionTask() ? owner.controller().motion(owner).waitIdle(owner) : kOk;
}

} // namespace

extern "C" {

Status rt_WaitTime(TaskCore* task, bool InPos, float Time) {
    if (!(Time >= 0)) return lib::fail(task, err::ERR_ARGVALERR, "WaitTime: the time must not be negative");
    if (InPos)
        if (const Status status = waitInPosition(task)) return status;
    // The resolution is a millisecond; binary32 does not hold most decimal fractions exactly.
    return taskOf(task).sleepFor(addTime(fromSeconds(Time), kMillisecond / 2) / kMillisecond * kMillisecond);
}

Status rt_WaitRob(TaskCore* task, bool InPos, bool ZeroSpeed) {
    if (InPos == ZeroSpeed)
        return lib::fail(task, err::ERR_ARGVALERR, "WaitRob needs one of \\InPos and \\ZeroSpeed");
    if (InPos) return waitInPosition(task);
    Task& owner = taskOf(task);
    return owner.isMotionTask() ? owner.controller().motion(owner).waitZeroSpeed(owner) : kOk;
}

Status rt_waitInPos(TaskCore* task, bool inPos) {
    return inPos ? waitInPosition(task) : kOk;
}

/// `state` holds the deadline from the first call on; without \MaxTime the negative time of that call less 1. It is never
/// 0 then.
Status rt_waitUntilPoll(TaskCore* task, bool* again, bool, const float* MaxTime, bool* TimeFlag,
                        const float* PollRate, int64_t* state) {
    Task& owner = taskOf(task);
    if (*state == 0)
        *state = MaxTime ? std::max<Time>(1, addTime(owner.now(), fromSeconds(*MaxTime))) : -1 - owner.now();
    const Time deadline = *state > 0 ? *state : kNever;
    *again = owner.now() < deadline;
    if (!*again) {
        if (!TimeFlag)
            return lib::fail(task, err::ERR_WAIT_MAXTIME,
                             "the condition did not become TRUE within \\MaxTime");
        *TimeFlag = true;
        return kOk;
    }
    if (*state < 0 && lib::mayNeverEnd(owner, -1 - *state)) {
        bool hopeless = false;
        const Status status = lib::waitForNextLook(owner, hopeless);
        return hopeless ? lib::reportHopeless(owner, "WaitUntil") : status;
    }
    const double poll = PollRate ? std::max<double>(*PollRate, kShortestPoll) : kPollSeconds;
    // The condition is looked at once more exactly when the time is over.
    return owner.sleepUntil(std::min<Time>(addTime(owner.now(), fromSeconds(poll)), deadline));
}
}

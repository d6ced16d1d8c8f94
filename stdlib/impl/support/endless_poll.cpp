#include "stdlib/impl/support/endless_poll.h"

#include "runtime/host/controller.h"
#include "runtime/sched/wait_queue.h"

#include <algorithm>

namespace rt::lib {

namespace {

constexpr Time kLook = 100 * kMillisecond;

/// The waits of all tasks that have lasted a shift. One event is the next look of all of them: when it happens, whatever
/// else is pending is not theirs.
struct LongWaits {
    WaitQueue queue;
    bool isLookComing = false;
    bool isHopeless = false; // at the last look
};

bool everyTaskWaits(const Scheduler& scheduler) {
    return std::none_of(scheduler.tasks().begin(), scheduler.tasks().end(), [](const Task* task) {
        return task->isExecuting() && task->state() != TaskState::Waiting;
    });
}

} // namespace

bool mayNeverEnd(const Task& task, Time since) {
    const SchedulerOptions& options = task.scheduler().options();
    return task.now() - since >= kShift && !options.realtime && options.maxTime == kNever;
}

Status waitForNextLook(Task& task, bool& hopeless) {
    auto& waits = task.controller().service<LongWaits>();
    Scheduler& scheduler = task.scheduler();
    if (!waits.isLookComing) {
        waits.isLookComing = true;
        scheduler.at(addTime(task.now(), kLook), [&waits, &scheduler] {
            waits.isLookComing = false;
            waits.isHopeless = !scheduler.anythingPending() && everyTaskWaits(scheduler);
            waits.queue.notifyAll();
        });
    }
    WaitSpec spec;
    spec.queues = {&waits.queue};
    WaitResult result{};
    const Status status = task.waitFor(spec, result);
    hopeless = status == kOk && waits.isHopeless;
    return status;
}

Status reportHopeless(Task& task, const char* instruction) {
    return task.fatal(static_cast<int>(EventId::NothingPending),
                      std::string(instruction) +
                          " has looked at its condition for eight hours of virtual time.");
}

} // namespace rt::lib

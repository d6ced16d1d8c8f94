// Manual 1.20: exclusive rights by a persistent bool. Tasks cannot interrupt each other inside a native, so testing and
// setting is one indivisible step.

#include "runtime/host/controller.h"
#include "stdlib/impl/support/endless_poll.h"

#include <algorithm>
#include <deque>
#include <map>

#include "natives/multitasking.h"

using namespace rt;

namespace {

constexpr Time kPoll = 10 * kMillisecond;      // changes of a persistent are not signalled
constexpr Time kLazyPoll = 100 * kMillisecond; // as WaitUntil, after the time that a lock is usually held
constexpr Time kShort = 10 * kSecond;

bool take(bool* object) {
    if (*object) return false;
    *object = true;
    return true;
}

/// Who waits for which object, first come first served: a task that releases and takes again at once does not starve
/// the others.
struct Waiting {
    std::map<const bool*, std::deque<const Task*>> queues;

    /// No earlier task could take it. Halted tasks do not hold up the others.
    bool isFirst(const Task& task, const bool* object) const {
        const std::deque<const Task*>& queue = queues.at(object);
        const auto first =
            std::find_if(queue.begin(), queue.end(), [](const Task* other) { return !other->mustHalt(); });
        return first != queue.end() && *first == &task;
    }
};

class Place {
  public:
    Place(Waiting& waiting, const Task& task, const bool* object)
        : waiting_(waiting), task_(task), object_(object) {
        waiting_.queues[object_].push_back(&task_);
    }
    ~Place() {
        std::deque<const Task*>& queue = waiting_.queues[object_];
        queue.erase(std::find(queue.begin(), queue.end(), &task_));
        if (queue.empty()) waiting_.queues.erase(object_);
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

  private:
    Waiting& waiting_;
    const Task& task_;
    const bool* object_;
};

} // namespace

extern "C" {

Status rt_TestAndSet(TaskCore*, bool* result, bool* Object) {
    *result = take(Object);
    return kOk;
}

Status rt_WaitTestAndSet(TaskCore* task, bool* Object) {
    Task& owner = taskOf(task);
    auto& waiting = owner.controller().service<Waiting>();
    const Place place(waiting, owner, Object);
    const Time since = owner.now();
    const auto isMine = [&] { return waiting.isFirst(owner, Object) && take(Object); };
    for (;;) {
        if (lib::mayNeverEnd(owner, since)) {
            bool hopeless = false;
            if (const Status status = lib::waitForNextLook(owner, hopeless); status != kOk) return status;
            if (isMine()) return kOk;
            if (hopeless) return lib::reportHopeless(owner, "WaitTestAndSet");
            continue;
        }
        const bool isShort = owner.now() - since < kShort;
        WaitSpec spec;
        spec.condition = isMine;
        spec.deadline = addTime(owner.now(), isShort ? kShort : lib::kShift);
        spec.pollPeriod = isShort ? kPoll : kLazyPoll;
        WaitResult result{};
        const Status status = owner.waitFor(spec, result);
        if (status != kOk || result == WaitResult::Done) return status;
    }
}
}

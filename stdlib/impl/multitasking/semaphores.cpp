// Manual 1.20: exclusive rights by a persistent bool. Tasks cannot interrupt each other inside a native, so testing and
// setting is one indivisible step.

#include "runtime/host/controller.h"

#include <algorithm>
#include <deque>
#include <map>

#include "stdlib_natives.h"

using namespace rt;

namespace {

constexpr Time kPoll = 10 * kMillisecond; // changes of a persistent are not signalled

bool take(bool* object) {
    if (*object) return false;
    *object = true;
    return true;
}

/// Who waits for which object, first come first served: a task that releases and takes again at once does not starve
/// the others.
struct Waiting {
    std::map<const bool*, std::deque<const Task*>> queues;

    /// Nobody who came earlier could take it. Tasks that stand still do not hold up the others.
    bool isFirst(const Task& task, const bool* object) const {
        const std::deque<const Task*>& queue = queues.at(object);
        const auto first =
            std::find_if(queue.begin(), queue.end(), [](const Task* other) { return !other->mustStand(); });
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
    WaitSpec spec;
    spec.condition = [&] { return waiting.isFirst(owner, Object) && take(Object); };
    spec.pollPeriod = kPoll;
    WaitResult result = WaitResult::Done;
    return owner.waitFor(spec, result);
}
}

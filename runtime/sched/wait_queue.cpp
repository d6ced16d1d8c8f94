#include "runtime/sched/wait_queue.h"

#include "runtime/sched/task.h"

#include <algorithm>

namespace rt {

WaitQueue::~WaitQueue() {
    for (Task* task : waiting_)
        task->forget(*this);
}

void WaitQueue::notifyAll() {
    // A woken task leaves the queue by itself when it runs; waking twice does no harm.
    for (Task* task : waiting_)
        task->notify();
}

void WaitQueue::remove(Task& task) {
    waiting_.erase(std::remove(waiting_.begin(), waiting_.end(), &task), waiting_.end());
}

} // namespace rt

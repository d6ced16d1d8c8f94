#pragma once
// WaitQueue: tasks that wait for one thing (a signal, a flag, a message) to change. Waking is all it does;
// the woken task looks at its condition again and waits on when it is still false.

#include <vector>

namespace rt {

class Task;

class WaitQueue {
  public:
    WaitQueue() = default;
    WaitQueue(const WaitQueue&) = delete;
    WaitQueue& operator=(const WaitQueue&) = delete;
    /// Tasks still waiting are woken: what they waited for is gone.
    ~WaitQueue();

    /// Makes every waiting task runnable, in the order they began to wait.
    void notifyAll();
    bool empty() const { return waiting_.empty(); }

  private:
    friend class Task;
    void add(Task& task) { waiting_.push_back(&task); }
    void remove(Task& task);
    std::vector<Task*> waiting_;
};

} // namespace rt

#pragma once
// Inbox: how other threads reach the thread of the scheduler. They post commands, which are executed one after the other
// between the tasks, even while virtual time is halted; nothing else of the controller may be touched from another thread.

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>

namespace rt {

class Inbox {
  public:
    using Command = std::function<void()>;

    Inbox();
    ~Inbox();
    Inbox(const Inbox&) = delete;
    Inbox& operator=(const Inbox&) = delete;

    /// From any thread: `command` is executed soon by the thread that owns the inbox.
    void post(Command command);
    /// Whether run() has something to do; costs one load.
    bool hasCommands() const { return waiting_.load(std::memory_order_acquire) > 0; }
    /// Executes what has been posted, in order; for the owning thread. A command may run the scheduler, which calls this
    /// again.
    void run();
    /// Sleeps until something is posted, at most `milliseconds` (-1: for ever).
    void wait(int milliseconds);
    /// Readable (POLLIN) while commands wait.
    int descriptor() const { return descriptor_; }

  private:
    bool take(Command& command);

    std::mutex mutex_;
    std::deque<Command> commands_;
    std::atomic<int> waiting_{0};
    int descriptor_ = -1;
};

} // namespace rt

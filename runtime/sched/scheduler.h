#pragma once
// Scheduler: one thread, one virtual clock, one queue of timed events, tasks on fibres. Deterministic: the
// order of everything follows from times and sequence numbers alone. See README.md for the rules of time.

#include "runtime/base/time.h"
#include "runtime/sched/inbox.h"
#include "runtime/sched/task.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rt {

/// RobotWare 7 documents a limit of 15 simple RAPID instructions per millisecond, to be raised to 42 at most.
inline constexpr int64_t kDefaultRate = 15;
inline constexpr int64_t kMaxControllerRate = 42;
/// "unlimited", for plain computing: an instruction takes a nanosecond, about what native code takes.
inline constexpr int64_t kUnlimitedRate = 1'000'000;

struct SchedulerOptions {
    int64_t rate = kDefaultRate;       ///< instructions per ms of virtual time; > 0
    Time maxTime = kNever;             ///< the run ends here
    bool realtime = false;             ///< virtual time keeps pace with the wall clock
    std::size_t stackBytes = 8u << 20; ///< per task; pages are used as needed
};

enum class RunEnd : uint8_t {
    Over,     ///< the run-over condition became true
    MaxTime,  ///< maxTime reached
    Deadlock, ///< every task waits, and nothing is pending that could wake one
};

using EventToken = uint64_t; ///< 0 = none

class Scheduler {
  public:
    static constexpr Time kSlice = kMillisecond; ///< round robin between tasks that can run

    explicit Scheduler(SchedulerOptions options);
    ~Scheduler();
    Scheduler(const Scheduler&) = delete;
    Scheduler& operator=(const Scheduler&) = delete;

    /// Virtual time, instructions of the running task included.
    Time now() const;
    const SchedulerOptions& options() const { return options_; }
    /// By how much the wall clock is past virtual time, which keeps pace with it; 0 while it does not.
    Time lateness() const { return paced() ? std::max<Time>(0, wallTime() - now_) * 100 / pacePercent_ : 0; }
    /// Virtual time keeps pace with the wall clock (or does not); `percent` of the pace of the wall clock, > 0. At any time.
    void setPace(bool paced, int percent = 100);
    /// The run does not end when nothing is pending: it waits for commands.
    void setResident(bool resident) { resident_ = resident; }
    /// The run may last until then.
    void setMaxTime(Time time) { options_.maxTime = time; }

    // ---- Timed events -------------------------------------------------------------------------------------
    /// Calls `action` at virtual time `time` (at once when past), from the scheduler, never inside a task.
    /// Events of the same time happen in the order they were made.
    EventToken at(Time time, std::function<void()> action);
    EventToken after(Time span, std::function<void()> action) {
        return at(addTime(now(), span), std::move(action));
    }
    /// No effect on an event that has happened.
    void cancel(EventToken token);
    bool anythingPending() const { return !events_.empty(); }
    Time nextEventTime() const { return events_.empty() ? kNever : events_.begin()->first.first; }

    // ---- Tasks --------------------------------------------------------------------------------------------
    /// The task runs when run() is called; it must outlive the scheduler's last use of it.
    void add(Task& task);
    /// The task that is running now; null outside.
    Task* running() const { return running_; }
    const std::vector<Task*>& tasks() const { return tasks_; }

    /// Runs until `isOver()` or another end; isOver is asked whenever the scheduler is between tasks.
    RunEnd run(const std::function<bool()>& isOver);
    /// Called whenever virtual time has moved on (trace, motion).
    void setTimeObserver(std::function<void(Time)> observer) { observers_.time = std::move(observer); }
    /// Called for each error that is raised, at the statement in progress of the task, before a handler is looked for.
    void setErrorObserver(std::function<void(const Task&, int number)> observer) {
        observers_.error = std::move(observer);
    }
    void errorRaised(const Task& task, int number) const {
        if (observers_.error) observers_.error(task, number);
    }
    /// Called before the thread sleeps for the wall clock or for something outside (flush what people look
    /// at).
    void setBeforeSleep(std::function<void()> hook) { observers_.beforeSleep = std::move(hook); }
    /// Commands of other threads, executed between the tasks; null: none come. Must outlive the runs.
    void setInbox(Inbox* inbox) { inbox_ = inbox; }
    /// While `holds` is true nothing executes and virtual time does not pass; only commands are taken. Asked between the tasks.
    void setHold(std::function<bool()> holds) { holds_ = std::move(holds); }
    /// Ends all tasks without UNDO; afterwards none is on a fibre. `run` must not be active.
    void abandonTasks();

    // ---- Data that is watched -----------------------------------------------------------------------------
    /// `look` compares data of the program with what it saw last (IPers). Called at every safepoint and wait of every
    /// task as long as it is there; it may post interrupts and remove itself.
    EventToken watchData(std::function<void()> look);
    void unwatchData(EventToken token);
    bool dataWatched() const { return !watches_.empty(); }
    void lookAtData() {
        if (!watches_.empty()) lookAtAll();
    }

    // ---- Used by Task -------------------------------------------------------------------------------------
    void makeReady(Task& task);
    void switchOut(Task& task); ///< from the task's fibre back to the scheduler
    struct ExternalWait {
        Task* task = nullptr;
        int fd = -1;
        short events = 0;
        bool ready = false;
    };
    void addExternal(ExternalWait& wait);
    void removeExternal(ExternalWait& wait);
    /// As long as something outside takes part (an open connection), virtual time keeps pace with the wall clock also while no task
    /// waits for it. Each hold is to be released.
    void holdPace();
    void releasePace() { --paceHolds_; }

  private:
    using EventKey = std::pair<Time, EventToken>;
    struct Watch {
        EventToken token = 0;
        std::function<void()> look;
    };

    void lookAtAll();
    void fireDueEvents();
    Task* takeRunnable();
    bool anyRunnable() const;
    void runSlice(Task& task);
    int64_t unitsUsed() const;
    void settle(Task& task);
    void moveTo(Time time);
    void jumpTo(Time time);
    void anchorWall();
    Time wallTime() const;
    bool paced() const { return options_.realtime || paceHolds_ > 0 || !externals_.empty(); }
    void sleepOutside(Time until);
    bool holdStill();
    void waitForCommands();

    SchedulerOptions options_;
    Time now_ = 0;
    std::map<EventKey, std::function<void()>> events_;
    std::map<EventToken, Time> eventTimes_;
    EventToken lastToken_ = 0;
    std::vector<std::unique_ptr<Watch>> watches_;
    bool looking_ = false;
    std::vector<Task*> tasks_;
    std::deque<Task*> ready_; // round robin order
    Task* running_ = nullptr;
    // the slice in progress; time in units of 1/rate ns, so that an instruction is exactly 10^6 of them
    int64_t granted_ = 0;
    int64_t debtAtStart_ = 0;
    int64_t sliceUnits_ = 0;
    Time horizon_ = kNever;
    bool resident_ = false;
    std::vector<ExternalWait*> externals_;
    int paceHolds_ = 0;
    Time anchorVirtual_ = 0;
    int64_t anchorWall_ = 0; // ns of the steady clock
    int pacePercent_ = 100;
    struct Observers {
        std::function<void(Time)> time;
        std::function<void()> beforeSleep;
        std::function<void(const Task&, int)> error;
    } observers_;
    Inbox* inbox_ = nullptr;
    std::function<bool()> holds_;
};

} // namespace rt

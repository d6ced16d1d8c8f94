#pragma once
// EventRoutines: the routines that the configuration connects with system events (SYS.cfg, CAB_EXEC_HOOKS), for one task.
// They run on the task's own fibre: before main, or on top of the interrupted code, as traps do.

#include "runtime/abi/rt_abi.h"
#include "runtime/base/time.h"

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <string_view>
#include <vector>

namespace rt {

class Task;

/// Equal to the EVENT_ constants of the language.
enum class SystemEvent : uint8_t { None, PowerOn, Start, Stop, QuickStop, Restart, Reset, Step, Visit };
inline constexpr std::size_t kSystemEvents = 8; ///< without Visit, which belongs to no event of the language

/// POWER_ON, START ... as the configuration spells it; None when it is no such word.
SystemEvent systemEventOf(std::string_view shelf);
const char* nameOf(SystemEvent event);
/// These belong to the system, not to the execution of the program: they run while the program is stopped, no order to
/// stop ends them at once, and an error in one ends it without changing the state of the task.
constexpr bool runsWhileStopped(SystemEvent event) {
    return event == SystemEvent::PowerOn || event == SystemEvent::Stop || event == SystemEvent::QuickStop ||
           event == SystemEvent::Reset || event == SystemEvent::Visit;
}

class EventRoutines {
  public:
    /// An order to stop breaks off an event routine of the system that has run for this long.
    static constexpr Time kPatience = 10 * kSecond;

    /// Code that is executed on the fibre of a task for somebody outside the program; `caller` is its frame record.
    using Visit = std::function<Status(Task& task, Frame* caller)>;

    explicit EventRoutines(Task& task) : task_(task) {}

    /// Calls `visit` on the fibre of the task as soon as it can, even while the task is stopped. What was interrupted does not
    /// see it. One at a time.
    void order(Visit visit);
    /// A visit is ordered or in progress.
    bool isVisited() const { return visit_ != nullptr || running_ == SystemEvent::Visit; }
    /// Ends the visit: in progress, its code is unwound; true. Ordered only, it does not take place; false.
    bool endVisit();
    /// A visit at once, for code on that fibre. Positive: an error that nothing took; negative: the task is being unwound.
    Status visitNow(const Visit& visit);

    /// Called in the order in which they are to run.
    void add(SystemEvent event, EntryFunction routine);
    /// The event happened: its routines run as soon as the task can. Nothing when it has none. START, RESTART and STEP are
    /// skipped while such a routine has not ended: it continues instead.
    void owe(SystemEvent event);
    /// Events that the task has still to deal with in its present state.
    bool owed() const;
    /// Its routines are to run or run now.
    bool concerns(SystemEvent event) const;
    /// Runs them on the present fibre. Negative: the task is being unwound.
    Status runPending();

    /// EventType: of the routine in progress.
    SystemEvent running() const { return running_; }
    /// A routine executes although the program is stopped.
    bool executesStopped() const { return runsWhileStopped(running_); }
    /// An order to stop while executesStopped(): false when it is too early to break the routine off.
    bool breakOff();

  private:
    Status run(SystemEvent event);
    Status runVisit();

    Task& task_;
    std::array<std::vector<EntryFunction>, kSystemEvents> routines_;
    std::deque<SystemEvent> owed_;
    Visit visit_;
    SystemEvent running_ = SystemEvent::None;
    Time since_ = 0;
};

/// Frame records with this routine mark where the system called an event routine: no handler beyond it takes an error.
extern const RoutineDesc kEventBoundary;

} // namespace rt

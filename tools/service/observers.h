#pragma once
// Observers: who wants to know what happens in the controller. All calls come on the controller's thread, between the tasks or in the
// middle of a change: an observer copies what it needs and returns at once; it never calls orders of the controller.

#include "runtime/io/io_system.h"
#include "runtime/log/event.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rt {
class Task;
}

namespace rapidc::service {

/// Kind of a change; the new value is read from the controller.
enum class Change : uint8_t {
    MotorState, ///< PanelState::motors
    OperatingMode,
    SpeedRatio,
    Execution,      ///< running or stopped
    Cycle,          ///< forever or once
    ProgramPointer, ///< of the task
    MotionPointer,  ///< of the task
    Tasks,          ///< a task was activated, deactivated, started or stopped
    Modules,        ///< of the task: something was loaded or unloaded
    Dialog,         ///< an operator dialog was opened or closed, or a message shown
    Display,        ///< a line was written with TPWrite, or the display erased
    Mastership,
    Interval,   ///< 200 ms have passed while clients are served: for states that report no changes
    Restart,    ///< an order to restart was accepted: the sessions of all clients end, and Generation follows
    Generation, ///< restart or program load: core() is another object now; watches of signals and data continue
};

struct Observer {
    std::function<void(Change, const rt::Task*)> changed;
    std::function<void(const rt::Event&)> event;
    /// Every change of every signal; `id` is valid in core().io().
    std::function<void(rt::SignalId, double value)> signal;
    /// Each 4 ms of virtual time while an arm moves, and once when it has come to rest.
    std::function<void()> motion;
};

class Observers {
  public:
    using Token = uint64_t;
    Token add(Observer observer);
    void remove(Token token);

    void changed(Change change, const rt::Task* task = nullptr);
    void event(const rt::Event& event);
    void signal(rt::SignalId id, double value);
    void motion();

  private:
    template <class Call> void each(const Call& call);

    std::map<Token, Observer> observers_;
    Token last_ = 0;
};

} // namespace rapidc::service

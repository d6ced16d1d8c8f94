#pragma once
// StateWatch: compares the state of the controller with what it was at the last look and notifies the observers of what has changed.

#include "runtime/sched/task.h"
#include "tools/service/observers.h"
#include "tools/service/panel_state.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rapidc::service {

class VirtualController;

class StateWatch {
  public:
    explicit StateWatch(VirtualController& controller) : controller_(controller) {}

    /// Between the tasks, often.
    void look();
    /// Everything is looked at again: there is another controller.
    void forget() { tasks_.clear(), dialogs_.clear(); }

  private:
    struct Seen {
        rt::TaskState state = rt::TaskState::Ready;
        rt::StopCause cause = rt::StopCause::None;
        rt::EntryFunction entry = nullptr; ///< where the next start begins when no routine has been entered
        const rt::Frame* frame = nullptr;
        const rt::RoutineDesc* routine = nullptr; ///< of the frame, whose place another one may take
        int32_t statement = -1;
        int32_t move = -1; ///< statement of the motion pointer
    };
    bool lookAt(const rt::Task& task, bool often);
    void lookAtDialogs();

    VirtualController& controller_;
    std::map<const rt::Task*, Seen> tasks_;
    std::vector<uint64_t> dialogs_;
    bool message_ = false, running_ = false;
    MotorState motors_ = MotorState::Init;
    std::chrono::steady_clock::time_point pointers_{}; ///< when those of executing tasks were looked at last
};

} // namespace rapidc::service

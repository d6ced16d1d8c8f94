// Controller: what only a controller needs that serves clients for as long as they like.

#include "runtime/host/controller.h"
#include "runtime/host/panel_switches.h"
#include "runtime/host/saved_state.h"

#include <utility>

namespace rt {

void Controller::setResident(bool programStart, bool motorsOn) {
    resident_ = true;
    programStart_ = programStart;
    motorsOn_ = motorsOn;
    scheduler_.setResident(true);
}

bool Controller::staysAtMain(Task& task) {
    if (!resident_ || task.kind() != TaskKind::Normal) return false;
    log_.write(EventId::ProgramStopped, &task, {task.name(), "end of the cycle"});
    return true;
}

void Controller::setTaskActive(const Task& task, bool active) {
    if (active)
        inactive_.erase(&task);
    else
        inactive_.insert(&task);
}

bool Controller::isTaskActive(const Task& task) const {
    return inactive_.count(&task) == 0;
}

void Controller::actionMotors(bool on) {
    if (on) service<PanelSwitches>().emergencyStop = false;
    if (std::exchange(motorsOn_, on) == on) return;
    log_.write(on ? EventId::MotorsOn : EventId::MotorsOff, nullptr);
    if (on) return;
    const auto executes = [](const auto& task) {
        return task->kind() == TaskKind::Normal && task->isExecuting();
    };
    if (std::any_of(tasks_.begin(), tasks_.end(), executes)) stopTasks("motors off", SystemEvent::Stop);
    for (const auto& motion : motions_)
        motion->emergencyStop(false);
}

void Controller::continueFrom(std::string state, bool powerOn) {
    earlier_ = std::move(state);
    powersOn_ = powerOn;
}

std::string Controller::captureState() const {
    return state_->text();
}

} // namespace rt

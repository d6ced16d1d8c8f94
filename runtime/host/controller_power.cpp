// Controller: motors off, power failure and the return of power (manual 1.2.2, 1.20, 2.2.6, 2.10).

#include "runtime/host/controller.h"
#include "runtime/host/panel_switches.h"
#include "runtime/host/saved_state.h"

namespace rt {

void Controller::actionEmergencyStop() {
    log_.write(EventId::EmergencyStop, nullptr);
    motorsOn_ = false;
    service<PanelSwitches>().emergencyStop = true;
    stopTasks("emergency stop", SystemEvent::QuickStop);
    for (const auto& motion : motions_)
        motion->emergencyStop(false);
}

void Controller::actionPowerFail() {
    if (powerOff_) {
        log_.write(EventId::PowerRefused, nullptr, {"power_fail", "the power has failed already"});
        return;
    }
    log_.write(EventId::PowerFailed, nullptr);
    powerOff_ = true;
    motorsOn_ = false;
    for (const auto& task : tasks_) {
        if (!task->isExecuting()) continue;
        task->stop(StopCause::Order);
        task->noteEnd("power failure");
    }
    for (const auto& task : tasks_)
        loseConnections(*task, "the power failed");
    for (const auto& motion : motions_)
        motion->emergencyStop(true);
    shutDown();
    state_->write();
}

void Controller::actionPowerOn() {
    if (!powerOff_) {
        log_.write(EventId::PowerRefused, nullptr, {"power_on", "the power has not failed"});
        return;
    }
    powerOff_ = false;
    systemFailed_ = false; // a warm start resets it
    log_.write(EventId::SystemRestarted, nullptr);
    io_.powerOn();
    for (const auto& task : tasks_) {
        if (task->state() == TaskState::Finished) continue;
        task->events().owe(SystemEvent::PowerOn);
        if (task->kind() == TaskKind::Normal) continue;
        if (task->kind() == TaskKind::SemiStatic) {
            task->moveToMain();
            task->events().owe(SystemEvent::Reset);
        }
        orderStartEvent(*task);
        task->resume();
    }
}

} // namespace rt

// VirtualController: panel, execution, program pointer.

#include "runtime/base/text_util.h"
#include "runtime/host/panel_switches.h"
#include "tools/service/virtual_controller.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapidc::service {

namespace {

bool isNormal(const rt::Task& task) {
    return task.kind() == rt::TaskKind::Normal;
}

constexpr int kReducedSpeed = 100; // per cent; the limit of 250 mm/s in manual mode is not an override

} // namespace

bool VirtualController::isRunning() const {
    const auto& tasks = core_->tasks();
    return std::any_of(tasks.begin(), tasks.end(), [this](const auto& task) {
        const bool isPointerMoving = cursor_ && cursor_->task == task->name(); // clients take it for stopped
        return isNormal(*task) && task->isExecuting() && !isPointerMoving;
    });
}

// ---- Panel ---------------------------------------------------------------------------------------------------------

Refusal VirtualController::setMotors(bool on) {
    if (on && emergencyStop_) return "the emergency stop is pressed: release it first";
    if (on && safeguardOpen_) return "a safeguard is open: close it first";
    panel_.motors = on ? MotorState::On : MotorState::Off;
    core_->actionMotors(on);
    return {};
}

Refusal VirtualController::setMode(OperatingMode mode) {
    if (panel_.mode == mode) return {};
    panel_.mode = mode;
    core_->service<rt::PanelSwitches>().mode = mode;
    const bool full = mode == OperatingMode::ManualFull;
    if (mode == OperatingMode::Auto)
        core_->log().write(rt::EventId::AutomaticMode, nullptr);
    else
        core_->log().write(rt::EventId::ManualMode, nullptr, {full ? " at full speed" : ""});
    (void)setMotors(false);
    switchCycle(mode == OperatingMode::Auto ? "ManualToAuto" : "AutoToManual");
    observers_.changed(Change::OperatingMode);
    return {};
}

/// RUN_MODE_SETTINGS of SYS.cfg: the cycle after a change of the mode.
void VirtualController::switchCycle(const char* change) {
    for (const rt::CfgInstance* setting : core_->instances("SYS", "RUN_MODE_SETTINGS")) {
        const std::string to = setting->text("SwitchTo");
        if (!rt::sameName(setting->text("Name"), change) || to.empty()) continue;
        if (rt::sameName(to, "Single")) (void)setRunOnce(true);
        if (rt::sameName(to, "Continuous")) (void)setRunOnce(false);
    }
}

Refusal VirtualController::setSpeedRatio(int percent) {
    if (percent < 0 || percent > kReducedSpeed)
        return fmt::format("the speed ratio must be between 0 and 100, not {}", percent);
    panel_.speedRatio = percent;
    applyPanel();
    observers_.changed(Change::SpeedRatio);
    return {};
}

Refusal VirtualController::setRunOnce(bool once) {
    panel_.runOnce = once;
    core_->setRunOnce(once);
    observers_.changed(Change::Cycle);
    return {};
}

void VirtualController::noteBackup(bool inProgress, bool failed) {
    rt::PanelSwitches& switches = core_->service<rt::PanelSwitches>();
    switches.backupInProgress = panel_.backupInProgress = inProgress;
    switches.backupFailed = panel_.backupFailed = failed;
}

void VirtualController::pressEmergencyStop(bool pressed) {
    if (emergencyStop_ == pressed) return;
    emergencyStop_ = pressed;
    panel_.motors = pressed ? MotorState::EmergencyStop : MotorState::EmergencyStopReset;
    if (pressed) core_->actionEmergencyStop();
}

Refusal VirtualController::confirmEmergencyStop() {
    if (emergencyStop_) return "the emergency stop is pressed: release it first";
    if (panel_.motors == MotorState::EmergencyStopReset) panel_.motors = MotorState::Off;
    core_->service<rt::PanelSwitches>().emergencyStop = false;
    return {};
}

void VirtualController::openSafeguard(bool open) {
    if (safeguardOpen_ == open) return;
    safeguardOpen_ = open;
    if (emergencyStop_) return;
    if (open) core_->actionMotors(false);
    panel_.motors = open ? MotorState::GuardStop : MotorState::Off;
}

// ---- Execution -----------------------------------------------------------------------------------------------------

Refusal VirtualController::start(ExecutionMode mode, rt::Task* task) {
    if (panel_.motors != MotorState::On) return "the motors are off: switch them on first";
    if (postponed(true, [=, this] { return start(mode, task); })) return {};
    if (isRunning() && task == nullptr) return "the program is executing already";
    cursor_.reset();
    core_->setRunOnce(panel_.runOnce);
    if (mode == ExecutionMode::Continue && task == nullptr) {
        core_->actionStart();
        return isRunning() ? Refusal() : "no task can be started: the event log says why";
    }
    Refusal refusal = "there is no task to start";
    rt::Debugger& debugger = core_->debugger();
    if (mode == ExecutionMode::StepBack && task == nullptr) {
        std::vector<rt::Task*> stopped;
        for (const auto& one : core_->tasks())
            if (isNormal(*one) && isTaskActive(*one) && one->isStopped()) stopped.push_back(one.get());
        return stopped.empty() ? refusal : debugger.stepBackward(stopped);
    }
    for (const auto& one : core_->tasks()) {
        if (task != nullptr ? one.get() != task : !isNormal(*one) || !isTaskActive(*one)) continue;
        if (!one->isStopped()) {
            refusal = fmt::format("task {} is executing already", one->name());
            continue;
        }
        // A task at main is in no routine yet: every step executes the first instruction.
        const bool begins = one->frame == nullptr && mode != ExecutionMode::Continue &&
                            mode != ExecutionMode::StepMotion && mode != ExecutionMode::StepBack;
        switch (begins ? ExecutionMode::StepIn : mode) {
        case ExecutionMode::Continue: refusal = debugger.runAlone(*one); break;
        case ExecutionMode::StepIn: refusal = debugger.stepIn(*one, true); break;
        case ExecutionMode::StepOver:
        case ExecutionMode::StepLast: refusal = debugger.stepOver(*one, true); break;
        case ExecutionMode::StepOut: refusal = debugger.stepOut(*one, true); break;
        case ExecutionMode::StepBack: refusal = debugger.stepBackward(*one); break;
        case ExecutionMode::StepMotion: refusal = debugger.stepMove(*one, true); break;
        }
        if (!refusal.empty()) return refusal;
    }
    return refusal;
}

Refusal VirtualController::stop(StopMode mode) {
    if (cursor_) std::erase_if(cursor_->next, [](const Cursor::Order& order) { return order.starts; });
    if (!isRunning()) return {}; // it is what was asked for
    switch (mode) {
    case StopMode::Stop: core_->actionStop(); break;
    case StopMode::Quick: core_->actionStop(rt::SystemEvent::QuickStop); break;
    case StopMode::Cycle:
        cycleStop_ = true;
        core_->setRunOnce(true);
        break;
    case StopMode::Instruction:
        for (const auto& task : core_->tasks())
            if (isNormal(*task) && task->isExecuting()) return core_->debugger().pause(*task);
        break;
    }
    return {};
}

Refusal VirtualController::programStopped(const char* order) const {
    for (const auto& task : core_->tasks())
        if (isNormal(*task) && task->isExecuting())
            return fmt::format("{} needs a stopped program, but task {} is executing: stop it first", order,
                               task->name());
    return {};
}

Refusal VirtualController::resetPointers() {
    if (postponed(false, [this] { return resetPointers(); })) return {};
    cursor_.reset();
    return core_->debugger().pointerToMain();
}

Refusal VirtualController::pointerToRoutine(rt::Task& task, const std::string& module,
                                            const std::string& routine) {
    if (postponed(false, [=, this, &task] { return pointerToRoutine(task, module, routine); })) return {};
    cursor_.reset();
    return core_->debugger().pointerToRoutine(task, module.empty() ? routine : module + ":" + routine);
}

/// In another routine than the one in progress the pointer goes to that routine first, which is entered; the rest follows in
/// carryOutCursor().
Refusal VirtualController::pointerToLine(rt::Task& task, const std::string& module, uint32_t line) {
    const rt::RoutineDesc* routine = nullptr;
    for (const rt::RoutineEntry* entry : core_->tables().routines()) {
        const rt::RoutineDesc& desc = *entry->desc;
        const bool isOwn = entry->task < 0 || entry->task == static_cast<int32_t>(task.index());
        if (!isOwn || !rt::sameName(entry->module, module)) continue;
        for (uint32_t s = 0; s < desc.statementCount; ++s)
            if (desc.statements[s].canStart != 0 && desc.statements[s].line == line) routine = &desc;
    }
    if (routine == nullptr) return fmt::format("no instruction begins in line {} of module {}", line, module);
    if (postponed(false, [=, this, &task] { return pointerToLine(task, module, line); })) return {};
    if (!task.isStopped()) return fmt::format("task {} is executing: stop it first", task.name());
    if (task.frame != nullptr && task.frame->routine == routine) {
        if (Refusal refusal = core_->debugger().pointerToLine(task, line); refusal.empty()) return refusal;
    }
    if (panel_.motors != MotorState::On && routine->callable == 0)
        return fmt::format("'{}' is not a procedure without parameters", routine->name);
    if (Refusal refusal = pointerToRoutine(task, module, routine->name); !refusal.empty()) return refusal;
    if (Refusal refusal = core_->debugger().enterRoutine(task); !refusal.empty()) return refusal;
    cursor_ = Cursor{task.name(), module, line, {}};
    return {};
}

std::optional<std::pair<std::string, uint32_t>> VirtualController::destination(const rt::Task& task) const {
    if (!cursor_ || cursor_->task != task.name()) return std::nullopt;
    return std::pair(cursor_->module, cursor_->line);
}

/// The routine of the cursor is being entered, after UNDO handlers and event routines that are still to execute.
bool VirtualController::isCursorOnItsWay() const {
    if (!cursor_) return false;
    const rt::Task* task = core_->findTask(cursor_->task);
    return task != nullptr && (task->isExecuting() || task->hasWorkWhileStopped());
}

void VirtualController::carryOutCursor() {
    rt::Task* task = core_->findTask(cursor_->task);
    if (task == nullptr || task->hasWorkWhileStopped()) return;
    if (!task->isStopped() || task->frame == nullptr) return; // it is being entered
    const Cursor cursor = std::move(*cursor_);
    cursor_.reset();
    const auto report = [&](const char* order, const Refusal& refusal) {
        if (!refusal.empty()) core_->log().write(rt::EventId::StepRefused, task, {order, refusal});
    };
    report("Moving the program pointer", core_->debugger().pointerToLine(*task, cursor.line));
    for (const Cursor::Order& order : cursor.next)
        report(order.starts ? "Starting the program" : "Moving the program pointer", order.carryOut());
}

/// An order waits while the routine of the cursor is being entered, which takes the time of some instructions.
bool VirtualController::postponed(bool starts, std::function<Refusal()> order) {
    if (cursor_) carryOutCursor();
    if (!isCursorOnItsWay()) return false;
    cursor_->next.push_back({starts, std::move(order)});
    return true;
}

Refusal VirtualController::setTaskActive(rt::Task& task, bool active) {
    if (!isNormal(task)) return fmt::format("task {} is not a NORMAL task", task.name());
    if (task.isExecuting()) return fmt::format("task {} is executing: stop it first", task.name());
    if (active)
        inactive_.erase(task.name());
    else
        inactive_.insert(task.name());
    core_->setTaskActive(task, active);
    observers_.changed(Change::Tasks, &task);
    return {};
}

} // namespace rapidc::service

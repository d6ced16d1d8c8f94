// Controller: the run, its actions and its end. Building it: controller_prepare.cpp.

#include "runtime/host/controller.h"

#include "runtime/base/text_util.h"
#include "runtime/host/module_saver.h"
#include "runtime/host/panel_switches.h"
#include "runtime/host/run_files.h"
#include "runtime/host/run_reports.h"
#include "runtime/host/saved_state.h"
#include "runtime/host/stop_signals.h"
#include "runtime/sim/csv_writers.h"
#include "runtime/sim/surroundings.h"
#include "runtime/sim/trace_merger.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <utility>

namespace rt {
namespace {

/// Traps of background tasks have this long after the end of the last NORMAL task.
constexpr Time kTimeForTraps = 10 * kSecond;

SchedulerOptions schedulerOptions(const RunOptions& options) {
    SchedulerOptions result;
    result.rate = options.rate;
    result.maxTime = options.hasMaxTime ? fromSeconds(options.maxTime) : kNever;
    result.realtime = options.realtime;
    result.stackBytes = options.stackBytes;
    return result;
}

bool isNormal(const std::unique_ptr<Task>& task) {
    return task->kind() == TaskKind::Normal;
}

/// The programs are over and their last movements have reached their points: the arms come to rest there.
bool onlySettles(const Controller& controller) {
    const auto isOver = [](const auto& task) {
        return !isNormal(task) || task->state() == TaskState::Finished;
    };
    const auto isThere = [](const auto& motion) {
        return motion->system().isReleased(motion->system().lastOrdered());
    };
    return std::all_of(controller.tasks().begin(), controller.tasks().end(), isOver) &&
           std::all_of(controller.motions().begin(), controller.motions().end(), isThere);
}

} // namespace

Controller::Controller(const RunOptions& options)
    : options_(options), scheduler_(schedulerOptions(options)), io_(scheduler_), random_(options.seed),
      startCalendar_(static_cast<int64_t>(std::time(nullptr))), saver_(std::make_unique<ModuleSaver>(*this)),
      state_(std::make_unique<SavedState>(*this)) {
    log_.setClock([this] { return scheduler_.now(); });
    const auto completeOutputs = [this] {
        panel_.flush();
        log_.flush();
        for (const auto& action : sleepActions_)
            action();
    };
    scheduler_.setBeforeSleep(completeOutputs);
    state_->setBeforeWriting(completeOutputs);
}

Controller::~Controller() {
    scheduler_.abandonTasks();
    shutDown();
    // Interrupts and services may hold listeners and timers of the parts below them.
    tasks_.clear();
    services_.clear();
    for (const auto& motion : motions_)
        motion->dropServices();
}

int64_t Controller::calendarSeconds() const {
    return startCalendar_ + scheduler_.now() / kSecond;
}

void Controller::forEachArm(const std::function<void(SteppedArm&)>& action) {
    for (const auto& motion : motions_)
        action(*motion);
}

// ---- Program -------------------------------------------------------------------------------------------------------

Task* Controller::findTask(std::string_view name) {
    for (const auto& task : tasks_) {
        if (sameName(task->name(), name)) return task.get();
    }
    return nullptr;
}

const GlobalDesc* Controller::findGlobal(std::string_view name, std::string_view module,
                                         const Task& task) const {
    return tables_.findGlobal(name, module, static_cast<int32_t>(task.index()), true);
}

const RoutineEntry* Controller::findRoutine(std::string_view name, std::string_view module,
                                            const Task& task) const {
    return tables_.findRoutine(name, module, "", static_cast<int32_t>(task.index()));
}

// ---- Run -----------------------------------------------------------------------------------------------------------

ExitStatus Controller::run() {
    for (const auto& motion : motions_)
        motion->setCirclePointStop([this](Task& task) { return debugger_.stopInside(task); });
    scheduleStimulus();
    beginTasks();
    if (debugger_.hasClient() || resident_)
        scheduler_.setHold([this] { return timeHeld_ || debugger_.holds(); });
    RunEnd end = scheduler_.run([this] { return runOver(); });
    if (end == RunEnd::MaxTime && onlySettles(*this)) { // no part of a program is cut off
        constexpr Time kLongestSettling = kSecond;
        scheduler_.setMaxTime(addTime(scheduler_.now(), kLongestSettling));
        end = scheduler_.run([this] { return runOver(); });
    }
    return finish(end);
}

/// The controller is switched on, the program loaded and started.
void Controller::beginTasks() {
    for (const auto& task : tasks_) {
        const bool waits = isNormal(task) && !programStart_;
        if (waits) task->stop(StopCause::AtMain);
        scheduler_.add(*task);
        if (powersOn_) task->events().owe(SystemEvent::PowerOn);
        if (!task->keepsVariables()) task->events().owe(SystemEvent::Reset);
        if (waits) continue;
        if (resident_ && isNormal(task) && !task->isReentering())
            log_.write(EventId::ProgramStarted, task.get(), {task->name()});
        task->events().owe(task->isReentering() ? SystemEvent::Restart : SystemEvent::Start);
    }
}

bool Controller::runOver() {
    if (StopSignals::received() != 0) return true;
    if (debugger_.poll()) return true;
    systemSignals_.outputs.update();
    state_->keepFresh();
    panel_.keepVisible();
    for (const auto& action : lookActions_)
        action();
    if (resident_) return endWanted_;
    for (const auto& task : tasks_) {
        if (!isNormal(task) || task->state() == TaskState::Finished) continue;
        const bool stoppedForGood =
            task->isStopped() && !task->hasWorkWhileStopped() && !startToCome() && !debugger_.mayStart();
        if (!stoppedForGood) {
            programsEnded_ = kNever;
            return false;
        }
    }
    return std::all_of(motions_.begin(), motions_.end(),
                       [](const auto& motion) { return motion->isSettled(); }) &&
           !backgroundAtWork();
}

/// What the end of the last program raised in a background task (an error that it logs, a signal) is dealt with before the
/// run ends.
bool Controller::backgroundAtWork() {
    if (programsEnded_ == kNever) programsEnded_ = scheduler_.now();
    if (powerOff_ || scheduler_.now() - programsEnded_ >= kTimeForTraps) return false;
    return std::any_of(tasks_.begin(), tasks_.end(), [](const auto& task) {
        return !isNormal(task) && !task->isStopped() && task->interrupts().isAtWork();
    });
}

bool Controller::stoppedByError() const {
    const auto failed = [](const auto& task) {
        return isNormal(task) && task->stopCause() == StopCause::Error;
    };
    return systemFailed_ || backgroundStopped_ || std::any_of(tasks_.begin(), tasks_.end(), failed);
}

/// "T_ROB1 waits in Main:12, T_IO waits in Io:7." for the tasks that have not finished.
std::string Controller::whereTasksAre(const char* verb) const {
    std::string text;
    for (const auto& task : tasks_) {
        if (task->state() == TaskState::Finished) continue;
        const SourcePlace place = task->place();
        text += fmt::format("{}{} {} ", text.empty() ? "" : ", ", task->name(), verb);
        text += place.module.empty() ? "at main" : fmt::format("in {}:{}", place.module, place.line);
        if (task->isMotionTask() && motion(*task).isStopMoveActive())
            text += " (its robot is stopped by StopMove or a process error; StartMove lets it move)";
    }
    return text.empty() ? text : text + ".";
}

/// Status 0 also when a program did not come to the end of main: then the log says what ended it.
void Controller::reportEnds() {
    std::string text;
    bool isCycleLeft = false;
    for (const auto& task : tasks_) {
        if (!isNormal(task) || task->endReason().empty()) continue;
        const SourcePlace& place = task->endPlace();
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", task->name(), task->endReason());
        if (!place.module.empty()) text += fmt::format(" in {}:{}", place.module, place.line);
        isCycleLeft = isCycleLeft || task->endReason() == "ExitCycle";
    }
    // A server that begins again so is expected to continue; a run has one cycle unless it is asked for more.
    if (isCycleLeft) text += ". It was the last cycle of this run; with --cycles=0 main begins again";
    if (!text.empty()) log_.write(EventId::EndedEarly, nullptr, {text + "."});
}

ExitStatus Controller::finish(RunEnd end) {
    ExitStatus status = stoppedByError() ? ExitStatus::StoppedByError : ExitStatus::Ended;
    if (resident_ && StopSignals::received() == 0) {
        status = ExitStatus::Ended; // as ordered
    } else if (const int signal = StopSignals::received(); signal != 0) {
        log_.write(EventId::RunInterrupted, nullptr, {StopSignals::name(signal), whereTasksAre("is")});
        status = ExitStatus::Interrupted;
    } else if (end == RunEnd::Deadlock && programsEnded_ == kNever) {
        log_.write(EventId::NothingPending, nullptr, {whereTasksAre("waits")});
        status = options_.hasMaxTime ? ExitStatus::MaxTimeReached : ExitStatus::StoppedByError;
    } else if (end == RunEnd::MaxTime) {
        log_.write(EventId::MaxTimeReached, nullptr, {whereTasksAre("is")});
        status = ExitStatus::MaxTimeReached;
    }
    for (const auto& motion : motions_)
        motion->finishTrace();
    if (traceMerger_) traceMerger_->finish();
    bool complete = state_->write();
    scheduler_.abandonTasks();
    if (options_.save) complete = saver_->saveAll() && complete;
    if (status == ExitStatus::Ended && !resident_) reportEnds();
    panel_.flush();
    log_.finish();
    complete = closeOutputs() && complete;
    if (reports_) {
        std::fflush(stdout);
        complete = reports_->finish(scheduler_.now()) && complete;
    }
    return complete || status != ExitStatus::Ended ? status : ExitStatus::BadUsage;
}

/// False when some of a file was lost, which has been reported.
bool Controller::closeOutputs() {
    bool complete = log_.closeJson();
    if (trace_) complete = trace_->close() && complete;
    if (signalsWriter_) complete = signalsWriter_->close() && complete;
    if (errorsWriter_) complete = errorsWriter_->close() && complete;
    return complete;
}

void Controller::shutDown() {
    for (const auto& action : shutDownActions_)
        action();
    io_.devices().restart();
}

bool Controller::cyclesLeft(const Task& task) const {
    if (resident_ && task.kind() == TaskKind::Normal) return !runOnce_;
    if (task.kind() != TaskKind::Normal) return true;
    if (runOnce_) return false;
    if (options_.cycles == 0) return true;
    return task.cyclesDone() < static_cast<uint64_t>(options_.cycles);
}

void Controller::taskStopped(Task& task) {
    debugger_.noteStop(task, StopReason::Stop);
    if (task.isMotionTask()) motion(task).noteStop();
    if (task.kind() != TaskKind::Normal) backgroundStopped(task);
}

void Controller::cycleLeft(Task& task) {
    if (task.isMotionTask()) motion(task).leaveLevels();
}

void Controller::retried(Task& task) {
    if (task.isMotionTask()) motion(task).noteRetry();
}

void Controller::taskExited(Task& task) {
    if (task.isMotionTask())
        motion(task).clearPath(); // the program pointer is lost, and the path with it (1.2.2)
    loseConnections(task, "EXIT was executed");
    if (task.kind() != TaskKind::Normal) backgroundStopped(task);
}

void Controller::loseConnections(Task& task, const char* why) {
    for (const auto& action : lossActions_)
        action(task, why);
}

void Controller::programReset(Task& task) {
    for (const auto& action : resetActions_)
        action(task);
}

void Controller::taskFailed(Task& task) {
    debugger_.noteError(task);
    if (task.kind() != TaskKind::Normal) {
        backgroundStopped(task);
        return;
    }
    stopNormalTasks(StopCause::Order);
    forEachArm([](SteppedArm& arm) { arm.programStop(); });
}

void Controller::stopNormalTasks(StopCause cause) {
    for (const auto& task : tasks_) {
        if (isNormal(task)) task->stop(cause);
    }
}

// ---- Controller actions --------------------------------------------------------------------------------------------

void Controller::stopTasks(const char* order, SystemEvent event) {
    bool any = false;
    for (const auto& task : tasks_) {
        if (!isNormal(task)) continue;
        if (task->isStopped() && task->events().executesStopped()) { // its event routine is to stop as well
            any = true;
            const char* routine = nameOf(task->events().running());
            const EventId told =
                task->events().breakOff() ? EventId::EventRoutineAborted : EventId::EventRoutineContinues;
            log_.write(told, task.get(), {task->name(), routine});
            continue;
        }
        if (!task->isExecuting()) continue;
        any = true;
        log_.write(EventId::ProgramStopped, task.get(), {task->name(), order});
        task->stop(StopCause::Order);
        task->noteEnd(order);
        task->events().owe(event);
        debugger_.noteStop(*task, StopReason::Order);
    }
    if (!any) log_.write(EventId::NothingStopped, nullptr, {"stop", "executing"});
}

void Controller::actionStop(SystemEvent event) {
    stopTasks(event == SystemEvent::QuickStop ? "quick stop order" : "stop order", event);
    const auto kind = event == SystemEvent::QuickStop ? motion::StopKind::Quick : motion::StopKind::Normal;
    forEachArm([kind](SteppedArm& arm) { arm.programStop(kind); });
}

void Controller::orderStartEvent(Task& task) {
    task.events().owe(task.startsAtMain() && !task.isReentering() ? SystemEvent::Start
                                                                  : SystemEvent::Restart);
}

/// Why no task may be started; "" when it may.
std::string Controller::startRefusal(const Task& task) const {
    if (powerOff_) return "the power has failed (power_on first)";
    if (systemFailed_) return "a background task has failed; end the run and repair it";
    if (task.isMotionTask() && motion(task).hasLostIndependentAxis())
        return "an axis was in independent mode when the power failed; move the program pointer to main "
               "first "
               "(pp_to_main)";
    if (task.canResume()) return "";
    return "SystemStopAction \\StopBlock was executed; move the program pointer to main first (pp_to_main)";
}

void Controller::actionStart() {
    bool any = false;
    for (const auto& task : tasks_) {
        if (!isNormal(task) || !task->isStopped() || task->state() == TaskState::Finished ||
            !isTaskActive(*task))
            continue;
        any = true;
        const std::string refusal = startRefusal(*task);
        if (refusal.empty()) continue;
        log_.write(EventId::StartRefused, task.get(), {task->name(), refusal});
        return;
    }
    if (!any) {
        log_.write(EventId::NothingStopped, nullptr, {"start", "stopped"});
        return;
    }
    backgroundStopped_ = false;
    service<PanelSwitches>().emergencyStop = false;
    if (!std::exchange(motorsOn_, true)) log_.write(EventId::MotorsOn, nullptr);
    for (const auto& task : tasks_) {
        if (!isNormal(task) || !task->isStopped() || task->state() == TaskState::Finished ||
            !isTaskActive(*task))
            continue;
        const bool atMain = task->stopCause() == StopCause::AtMain;
        log_.write(atMain ? EventId::ProgramStarted : EventId::ProgramRestarted, task.get(), {task->name()});
        debugger_.continuous(*task);
        orderStartEvent(*task);
        task->resume();
    }
    // The robot continues when the RESTART routines have done their work (StepBwdPath).
    for (const auto& motion : motions_) {
        const auto restarts = [&](const auto& task) {
            return task->motionGroup() == static_cast<int>(motion->group()) && !task->isStopped() &&
                   task->events().concerns(SystemEvent::Restart);
        };
        if (std::none_of(tasks_.begin(), tasks_.end(), restarts)) motion->programStart();
    }
}

void Controller::eventRoutinesEnded(Task& task, SystemEvent event) {
    if (event == SystemEvent::Restart && task.isMotionTask() && !task.isStopped())
        motion(task).programStart();
}

void Controller::actionPpToMain() {
    for (const auto& task : tasks_) {
        if (!isNormal(task) || !task->isExecuting()) continue;
        log_.write(EventId::ActionRefusedRunning, task.get(), {"pp_to_main", task->name()});
        return;
    }
    forEachArm([](SteppedArm& arm) { arm.clearPath(); });
    for (const auto& task : tasks_) {
        if (!isNormal(task) || task->state() == TaskState::Finished) continue;
        task->moveToMain();
        task->events().owe(SystemEvent::Reset);
        log_.write(EventId::ProgramPointerReset, task.get(), {task->name()});
    }
}

void Controller::actionStep(bool forward) {
    for (const auto& task : tasks_) {
        if (!isNormal(task) || !task->isExecuting()) continue;
        log_.write(EventId::ActionRefusedRunning, task.get(),
                   {forward ? "step_forward" : "step_backward", task->name()});
        return;
    }
    if (!debugger_.available()) {
        log_.write(EventId::StepUnavailable, nullptr);
        return;
    }
    std::vector<Task*> stopped;
    for (const auto& task : tasks_)
        if (isNormal(task) && task->isStopped() && task->state() != TaskState::Finished &&
            isTaskActive(*task))
            stopped.push_back(task.get());
    if (forward) {
        for (Task* task : stopped)
            if (const std::string problem = debugger_.stepIn(*task, true); !problem.empty())
                log_.write(EventId::StepRefused, task, {"Stepping forward", problem});
    } else {
        (void)debugger_.stepBackward(stopped); // it reports itself
    }
    if (stopped.empty())
        log_.write(EventId::NothingStopped, nullptr, {forward ? "step_forward" : "step_backward", "stopped"});
}

// ---- Stimulus ------------------------------------------------------------------------------------------------------

void Controller::scheduleStimulus() {
    std::size_t answers = 0;
    for (const StimulusItem& item : stimulus_) {
        answers += item.kind == StimulusKind::Answer ? 1 : 0;
        startsToCome_ += isStart(item) ? 1 : 0;
        scheduler_.at(item.time, [this, &item] { perform(item); });
    }
    panel_.setAnswersToCome(answers);
}

bool Controller::isStart(const StimulusItem& item) const {
    if (item.kind != StimulusKind::Signal)
        return item.kind == StimulusKind::Start || item.kind == StimulusKind::PowerOn ||
               item.kind == StimulusKind::StepForward || item.kind == StimulusKind::StepBackward;
    return item.value != 0 && systemSignals_.inputs.isStart(io_.find(item.target));
}

void Controller::perform(const StimulusItem& item) {
    if (isStart(item)) --startsToCome_;
    switch (item.kind) {
    case StimulusKind::Signal:
        if (io_.force(io_.find(item.target), item.value) != IoResult::Ok) {
            log_.write(EventId::StimulusRefused, nullptr,
                       {std::to_string(item.line), item.target, shortestNumber(item.value)});
        }
        return;
    case StimulusKind::Quantity:
        service<Surroundings>().set(*Surroundings::split(item.target), item.value);
        return;
    case StimulusKind::Answer: panel_.answerCame(item.text); return;
    case StimulusKind::Stop: actionStop(); return;
    case StimulusKind::QuickStop: actionStop(SystemEvent::QuickStop); return;
    case StimulusKind::EmergencyStop: actionEmergencyStop(); return;
    case StimulusKind::PowerFail: actionPowerFail(); return;
    case StimulusKind::PowerOn: actionPowerOn(); return;
    case StimulusKind::Start: actionStart(); return;
    case StimulusKind::PpToMain: actionPpToMain(); return;
    case StimulusKind::StepForward: actionStep(true); return;
    case StimulusKind::StepBackward: actionStep(false); return;
    case StimulusKind::PendantLost:
    case StimulusKind::PendantFound: panel_.setConnected(item.kind == StimulusKind::PendantFound); return;
    case StimulusKind::ViewsFull:
    case StimulusKind::ViewsFree: panel_.setRoomForViews(item.kind == StimulusKind::ViewsFree); return;
    case StimulusKind::DeviceLost:
    case StimulusKind::DeviceFound:
        io_.devices().setContact(item.text, item.kind == StimulusKind::DeviceFound);
        if (io_.devices().isMuted(item.text)) return;
        log_.write(item.kind == StimulusKind::DeviceLost ? EventId::DeviceLost : EventId::DeviceFound,
                   nullptr, {item.text});
        return;
    case StimulusKind::NetworkError:
    case StimulusKind::NetworkOk:
        io_.devices().setNetworkError(item.text, item.kind == StimulusKind::NetworkError);
        log_.write(item.kind == StimulusKind::NetworkError ? EventId::NetworkInError : EventId::NetworkWorks,
                   nullptr, {item.text});
        return;
    case StimulusKind::SignalInvalid: io_.setValid(io_.find(item.text), false); return;
    case StimulusKind::SignalValid: io_.setValid(io_.find(item.text), true); return;
    }
}

int runProgram(const ProgramDesc& program, const RunOptions& options, ControllerSetup setup) {
    rapid::config::OutputGuard guard;
    guard.reads("/proc/self/exe", "this executable");
    guardOutputs(options, guard);
    if (const std::string conflict = guard.conflict(); !conflict.empty()) {
        fmt::print(stderr, "error: {}\n", conflict);
        return static_cast<int>(ExitStatus::BadUsage);
    }
    const StopSignals signals;
    ExitStatus status = ExitStatus::Ended;
    {
        Controller controller(options);
        if (setup != nullptr) setup(controller);
        status = controller.prepare(program);
        if (status == ExitStatus::Ended) status = controller.run();
    }
    StopSignals::endIfReceived();
    return static_cast<int>(status);
}

} // namespace rt

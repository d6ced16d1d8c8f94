// Orders, stops and breakpoints. Looking at data: debugger_data.cpp; stepping backward: debugger_backward.cpp.

#include "runtime/debug/debugger.h"

#include "runtime/base/text_util.h"
#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"
#include "runtime/sched/interrupts.h"

#include <fmt/format.h>

#include <algorithm>

namespace rt {
namespace {

/// The handler of RaiseToUser \Continue is as deep as the routine it belongs to: the first one further out that can be
/// stepped.
std::size_t steppingDepthOf(const Frame* frame) {
    std::size_t depth = 0;
    if (frame != nullptr && frame->routine->isDetachedHandler != 0) do
            frame = frame->caller;
        while (frame != nullptr && frame->routine->noStepIn != 0);
    for (; frame != nullptr; frame = frame->caller)
        ++depth;
    return depth;
}

} // namespace

bool Debugger::available() const {
    const ProgramDesc& program = host_.program();
    for (uint32_t i = 0; i < program.routineCount; ++i)
        if (program.routines[i].desc->stepping != 0) return true;
    return false;
}

void Debugger::setClient(DebugClient* client) {
    client_ = client;
    if (client != nullptr) watch();
}

void Debugger::watch() {
    for (const auto& task : host_.tasks())
        task->askSteps |= 1; // others may ask, too
}

void Debugger::stopAtEntry() {
    watch();
    for (const auto& task : host_.tasks()) {
        if (task->kind() != TaskKind::Normal) continue;
        stateOf(*task).mode = Mode::In;
        stateOf(*task).entry = true;
    }
}

bool Debugger::poll() {
    endMeeting();
    constexpr int kPatience = 3; // looks; a task that executes comes to a statement in each slice
    if (pausing_ != nullptr && stoppedTask_ == nullptr && ++pausePolls_ > kPatience) stopAll(*pausing_);
    const auto isBusy = [](const auto& task) { return task->hasWorkWhileStopped(); };
    while (client_ != nullptr && stoppedTask_ != nullptr && !quit_) {
        // UNDO handlers and event routines run first.
        if (std::any_of(host_.tasks().begin(), host_.tasks().end(), isBusy)) return false;
        Task& task = *stoppedTask_;
        stoppedTask_ = pausing_ = nullptr;
        if (continuesBackward(task)) continue;
        held_ = true;
        client_->stopped(*this, task, stopReason_);
    }
    return quit_;
}

bool Debugger::holds() const {
    const auto isBusy = [](const auto& task) {
        return task->hasWorkWhileStopped() || task->events().isVisited();
    };
    return held_ && !quit_ && stoppedTask_ == nullptr &&
           std::none_of(host_.tasks().begin(), host_.tasks().end(), isBusy);
}

void Debugger::noteStop(Task& task, StopReason reason) {
    if (reason != StopReason::Step)
        together_.tasks.clear(); // those inside of a movement finish it with the next step
    if (stoppedTask_ != nullptr) return;
    stoppedTask_ = &task;
    stopReason_ = reason;
}

// ---- Before every statement ----------------------------------------------------------------------------------------

int32_t Debugger::beforeStatement(Task& task, Frame* at) {
    State& state = stateOf(task);
    const int32_t here = at->statement;
    if (state.jumped) { // the statement chosen begins with a question of its own
        state.jumped = false;
        return here;
    }
    StopReason reason = StopReason::Step;
    const bool isTakenBack = task.claimTakenBack();
    if (state.backwardFrame == at) {
        finishBackward(task, state, at, isTakenBack);
    } else if (state.pendingBackward) {
        state.pendingBackward = false;
        if (std::string problem = startBackward(task, state, at); !problem.empty())
            refusedBackward(task, std::move(problem));
        if (state.backwardFrame != nullptr) return continueAt(state, at, here);
    } else if (!isTakenBack) {
        const bool inUndo = task.isUnwinding();
        const bool stops = shouldStop(task, state, at, reason);
        if (!inUndo && task.isUnwinding())
            return kUnwindSilent; // the run ended while a condition was evaluated
        if (!stops) return here;
    }
    return stopHere(task, state, at, here, reason);
}

bool Debugger::shouldStop(Task& task, State& state, Frame* at, StopReason& reason) {
    const bool hidden = at->routine->noStepIn != 0;
    if (!hidden && breakpoints_.dataStops(task, at)) {
        reason = StopReason::Data;
        return true;
    }
    if (state.mode != Mode::Backward && breakpoints_.stops(task, at)) {
        reason = breakpoints_.hitRoutine() ? StopReason::Routine : StopReason::Breakpoint;
        return true;
    }
    if (state.mode == Mode::Run || hidden) return false;
    if (state.passFirst) {
        state.passFirst = false;
        return false;
    }
    if (!stepEnds(state, at)) return false;
    reason = state.entry                  ? StopReason::Entry
             : state.mode == Mode::Cursor ? StopReason::Cursor
             : state.mode == Mode::Pause  ? StopReason::Order
                                          : StopReason::Step;
    return true;
}

bool Debugger::stepEnds(const State& state, const Frame* at) {
    const StmtDesc& statement = at->routine->statements[at->statement];
    switch (state.mode) {
    case Mode::Run: return false;
    case Mode::Backward: return (statement.flags & kStmtInBackward) != 0;
    case Mode::In:
    case Mode::Pause: return true;
    case Mode::Over: return steppingDepthOf(at) <= state.depth;
    case Mode::Out: return steppingDepthOf(at) < state.depth;
    case Mode::Line: {
        const std::size_t depth = steppingDepthOf(at);
        return depth < state.depth || (depth == state.depth && statement.line != state.fromLine);
    }
    case Mode::LineInto: return steppingDepthOf(at) != state.depth || statement.line != state.fromLine;
    case Mode::Move: return (statement.flags & kStmtMovement) != 0;
    case Mode::Cursor: return statement.line == state.cursorLine && isPlace(*at->routine, state.cursorPlace);
    }
    return false;
}

/// `here` is the statement that the compiled code has reached.
int32_t Debugger::continueAt(State& state, const Frame* at, int32_t here) {
    state.jumped = at->statement != here;
    return at->statement;
}

/// Halts before at->statement; the program pointer may be moved meanwhile.
int32_t Debugger::stopHere(Task& task, State& state, Frame* at, int32_t here, StopReason reason) {
    if (state.entry) // the stop at the entry is one for all tasks
        for (auto& [other, its] : states_)
            its.entry = false;
    state.mode = Mode::Run;
    state.standing = at;
    const Status status = standStill(task, reason);
    state.standing = nullptr;
    if (status < 0) {
        state.backwardFrame = nullptr;
        state.backwardLast = false;
        return status;
    }
    return continueAt(state, at, here);
}

Status Debugger::standStill(Task& task, StopReason reason) {
    Task* reported = &task;
    const bool isLast = reason != StopReason::Step || endsStepTogether(reported);
    if (isLast) noteStop(*reported, reason);
    task.setStepwise(true);
    task.stop(StopCause::Step);
    if (!isLast) return task.suspendStopped();
    // Without a client, each task completes the step that it makes together with others; a client expects all tasks to stop.
    const auto steps = [&](const auto& other) {
        const Mode mode = stateOf(*other).mode;
        return other.get() != &task && other->kind() == TaskKind::Normal && other->isExecuting() &&
               (mode == Mode::In || mode == Mode::Over || mode == Mode::Out || mode == Mode::Move);
    };
    if (reason == StopReason::Step && client_ == nullptr &&
        std::any_of(host_.tasks().begin(), host_.tasks().end(), steps))
        return task.suspendStopped();
    host_.stopNormalTasks(StopCause::Order);
    host_.forEachArm([](SteppedArm& arm) { arm.programStop(); });
    return task.suspendStopped();
}

Status Debugger::handledErrorRaised(Task& task, int number) {
    if (client_ == nullptr || quit_ || (task.frame != nullptr && task.frame->routine->noStepIn != 0) ||
        !client_->stopsAtHandledError(task, number))
        return kOk;
    stateOf(task).mode = Mode::Run;
    return standStill(task, StopReason::Raised);
}

void Debugger::noteError(Task& task) {
    if (client_ == nullptr || client_->stopsAtError(task))
        noteStop(task, StopReason::Error);
    else
        errorEndsRun_ = errorEndsRun_ || task.kind() == TaskKind::Normal;
}

Status Debugger::stopInside(Task& task) {
    State& state = stateOf(task);
    if (state.mode == Mode::Run || state.mode == Mode::Cursor) return kOk;
    state.insideCircle = true;
    noteStop(task, StopReason::CirclePoint);
    task.stop(StopCause::Step);
    host_.stopNormalTasks(StopCause::Order);
    const Status status = task.suspendStopped();
    state.insideCircle = false;
    return status;
}

bool Debugger::isBackward(const Task& task) const {
    const auto found = states_.find(&task);
    return found != states_.end() && found->second.backwardFrame != nullptr;
}

// ---- Orders --------------------------------------------------------------------------------------------------------

/// A background task that is halted because everything is; it was not stopped itself.
bool Debugger::isHeldHere(const Task& task) const {
    return held_ && task.kind() != TaskKind::Normal && !task.isStopped();
}

std::string Debugger::refusal(const Task& task) const {
    if (task.state() == TaskState::Finished) return fmt::format("task {} has ended", task.name());
    if (!task.isStopped() && !isHeldHere(task))
        return fmt::format("task {} is executing: stop it first", task.name());
    if (!available()) return "the program was not compiled for stepping";
    if (!task.canResume())
        return fmt::format(
            "task {} was stopped by an error and cannot continue from there: move its program pointer",
            task.name());
    return "";
}

bool Debugger::isAtFaultyStatement(const Task& task) {
    if (task.standing() != Standing::AtError || task.frame == nullptr) return false;
    const StmtDesc* statement = statementOf(*task.frame);
    return statement != nullptr && statement->canStart != 0;
}

/// The other NORMAL tasks execute until the one is halted again, and those in the background that a breakpoint stopped.
void Debugger::resumeOthers(const Task& task) {
    for (const auto& other : host_.tasks()) {
        const bool stopped = other->kind() == TaskKind::Normal || other->stopCause() == StopCause::Step;
        if (other.get() == &task || !stopped || !other->isStopped()) continue;
        continuous(*other);
        if (other->canResume()) other->resume();
    }
}

/// A task that has not come to its entry yet, because a stop of another one came first, still stops there.
Debugger::Mode Debugger::runningMode(const State& state, Mode mode) {
    return state.entry && mode == Mode::Run ? Mode::In : mode;
}

/// One task is stepped, the others execute until it halts again.
std::string Debugger::begin(Task& task, Mode mode, bool alone) {
    if (std::string problem = refusal(task); !problem.empty()) return problem;
    watch();
    State& state = stateOf(task);
    const bool forward = mode != Mode::Backward;
    if (forward && state.backwardLast && state.standing != nullptr && mode != Mode::Run) {
        if (turnForward(task, state)) {
            noteStop(task, StopReason::Step);
            return "";
        }
    }
    state.mode = runningMode(state, mode);
    state.passFirst = !state.entry && (task.stopCause() == StopCause::AtMain || isAtFaultyStatement(task)) &&
                      forward && mode != Mode::Cursor;
    state.depth = steppingDepthOf(state.standing != nullptr ? state.standing : task.frame);
    task.setStepwise(mode != Mode::Run && mode != Mode::Cursor);
    if (!alone) resumeOthers(task);
    held_ = false;
    host_.forEachArm([](SteppedArm& arm) { arm.programStart(); });
    if (!task.isStopped()) return "";
    // The place to which the program pointer was moved by hand decides between START and RESTART; a step is neither.
    if (task.kind() != TaskKind::Normal) {
    } else if (mode == Mode::Run || mode == Mode::Cursor) {
        host_.orderStartEvent(task);
    } else {
        task.events().owe(SystemEvent::Step);
    }
    task.resume();
    return "";
}

std::string Debugger::runAlone(Task& task) {
    if (std::string problem = refusal(task); !problem.empty()) return problem;
    continuous(task);
    return begin(task, Mode::Run, true);
}

std::string Debugger::stepLine(Task& task, bool intoRoutines, bool alone) {
    State& state = stateOf(task);
    const Frame* at = state.standing != nullptr ? state.standing : task.frame;
    const StmtDesc* statement = at != nullptr ? statementOf(*at) : nullptr;
    state.fromLine = statement != nullptr ? statement->line : 0;
    return begin(task, intoRoutines ? Mode::LineInto : Mode::Line, alone);
}

void Debugger::stopAll(Task& task) {
    for (const auto& other : host_.tasks())
        if (stateOf(*other).mode == Mode::Pause) stateOf(*other).mode = Mode::Run;
    pausing_ = nullptr;
    noteStop(task, StopReason::Order);
    host_.stopNormalTasks(StopCause::Order);
    host_.forEachArm([](SteppedArm& arm) { arm.programStop(); });
}

std::string Debugger::pause(Task& task) {
    if (held_) return "the program is not executing";
    if (task.state() == TaskState::Finished) return fmt::format("task {} has ended", task.name());
    watch();
    // Before a statement, data and the program pointer can be seen and changed best.
    const bool soon = task.state() == TaskState::Ready && task.isExecuting() && available();
    if (!soon || pausing_ != nullptr) {
        stopAll(task);
        return "";
    }
    stateOf(task).mode = Mode::Pause;
    pausing_ = &task;
    pausePolls_ = 0;
    return "";
}

void Debugger::continuous(Task& task) {
    State& state = stateOf(task);
    if (state.backwardLast && state.standing != nullptr) turnForward(task, state);
    state.mode = runningMode(state, Mode::Run);
    task.setStepwise(false);
}

std::string Debugger::run() {
    for (const auto& task : host_.tasks()) {
        const bool concerned = task->kind() == TaskKind::Normal || task->stopCause() == StopCause::Step ||
                               task->stopCause() == StopCause::Error;
        if (!concerned || !task->isStopped() || task->state() == TaskState::Finished) continue;
        continuous(*task);
        if (std::string problem = begin(*task, Mode::Run, true); !problem.empty()) return problem;
    }
    held_ = false;
    return "";
}

std::string Debugger::runToLine(Task& task, std::string_view where, uint32_t line) {
    bool exists = false;
    for (const RoutineEntry* entry : host_.tables().routines()) {
        const RoutineDesc& routine = *entry->desc;
        if (!isPlace(routine, where)) continue;
        for (uint32_t s = 0; s < routine.statementCount; ++s)
            exists = exists || (routine.statements[s].canStart != 0 && routine.statements[s].line == line);
    }
    if (!exists) return fmt::format("no instruction begins in line {} of {}", line, where);
    State& state = stateOf(task);
    state.cursorPlace = std::string(where);
    state.cursorLine = line;
    return begin(task, Mode::Cursor);
}

// ---- Program pointer -----------------------------------------------------------------------------------------------

std::string Debugger::pointerToLine(Task& task, uint32_t line) {
    if (std::string problem = refusal(task); !problem.empty()) return problem;
    State& state = stateOf(task);
    Frame* at = state.standing == nullptr && isAtFaultyStatement(task) ? task.frame : state.standing;
    // Activations that are about to be left, after a move to another routine, have no program pointer any more.
    if (at == nullptr || task.isUnwinding())
        return "the task is not stopped before an instruction: step it first";
    const RoutineDesc& routine = *at->routine;
    for (uint32_t s = 0; s < routine.statementCount; ++s) {
        const StmtDesc& statement = routine.statements[s];
        if (statement.canStart == 0 || statement.line != line) continue;
        if ((statement.flags & (kStmtInBackward | kStmtInHandler)) != 0)
            return "the program pointer cannot be moved into a handler";
        at->statement = static_cast<int32_t>(s);
        state.backwardLast = false;
        state.backwardFrame = nullptr;
        task.notePointerMoved(false);
        host_.arm(task).clearPath();
        return "";
    }
    return fmt::format("no instruction of routine {} begins in line {}", routine.name, line);
}

std::string Debugger::pointerToRoutine(Task& task, std::string_view name) {
    if (task.state() == TaskState::Finished) return fmt::format("task {} has ended", task.name());
    if (!task.isStopped()) return fmt::format("task {} is executing: stop it first", task.name());
    const std::size_t colon = name.find(':');
    const std::string_view module = colon == std::string_view::npos ? "" : name.substr(0, colon);
    const RoutineEntry* routine =
        host_.findRoutine(colon == std::string_view::npos ? name : name.substr(colon + 1), module, task);
    if (routine == nullptr) return fmt::format("there is no routine '{}' in task {}", name, task.name());
    if (routine->desc->callable == 0)
        return fmt::format("'{}' is not a procedure without parameters", routine->name);
    host_.arm(task).clearPath();
    task.moveToRoutine(reinterpret_cast<EntryFunction>(routine->address));
    forget(task);
    noteStop(task, StopReason::Pointer);
    return "";
}

std::string Debugger::pointerToMain() {
    for (const auto& task : host_.tasks())
        if (task->kind() == TaskKind::Normal && task->isExecuting())
            return fmt::format("task {} is executing: stop it first", task->name());
    host_.actionPpToMain();
    for (const auto& task : host_.tasks())
        forget(*task);
    return "";
}

std::string Debugger::enterRoutine(Task& task) {
    if (std::string problem = refusal(task); !problem.empty()) return problem;
    watch();
    State& state = stateOf(task);
    state.mode = Mode::In;
    state.passFirst = false;
    held_ = false;
    task.setStepwise(true);
    task.resume();
    return "";
}

void Debugger::forget(const Task& task) {
    State& state = stateOf(task);
    state.backwardFrame = nullptr;
    state.backwardLast = state.backwardTop = state.pendingBackward = false;
    state.mode = Mode::Run;
    state.backwardOn = false;
}

} // namespace rt

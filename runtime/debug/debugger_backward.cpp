// Backward execution (manual 1.21). Forwards the program pointer shows the next instruction; backwards the one above
// the motion pointer, and a movement goes to the target of the program pointer's instruction with type and speed of
// the motion pointer's.

#include "runtime/debug/debugger.h"
#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"

#include <fmt/format.h>

#include <utility>

namespace rt {
namespace {

const StmtDesc& row(const Frame& at, int32_t statement) {
    return at.routine->statements[statement];
}

/// The movement made last, if it lies before the program pointer in the same list and nothing between the two was
/// executed that has to be executed backwards first.
int32_t lastMovement(const MotionPointer& pointer, const Frame& at) {
    if (!pointer.valid || pointer.frame != &at || pointer.routine != at.routine) return -1;
    for (int32_t s = row(at, at.statement).previous; s >= 0; s = row(at, s).previous) {
        if (s == pointer.statement) return s;
        if ((row(at, s).flags & kStmtCallsRoutine) != 0) return -1;
    }
    return -1;
}

int32_t statementAfter(const RoutineDesc& routine, int32_t statement) {
    for (uint32_t s = 0; s < routine.statementCount; ++s)
        if (routine.statements[s].canStart != 0 && routine.statements[s].previous == statement)
            return static_cast<int32_t>(s);
    return -1;
}

constexpr const char* kTop =
    "the beginning of the routine, and of IF, FOR, WHILE and TEST, cannot be passed backwards";

} // namespace

std::string Debugger::stepBackward(Task& task) {
    if (std::string problem = refusal(task); !problem.empty()) return problem;
    State& state = stateOf(task);
    Frame* at = state.standing;
    if (state.insideCircle) {
        const std::string problem = "the direction cannot be changed while the robot executes MoveC";
        host_.log().write(EventId::StepRefused, &task, {"Stepping backward", problem});
        return problem;
    }
    if (at == nullptr) { // inside an instruction: it is finished first
        state.pendingBackward = true;
        return begin(task, Mode::Backward, true);
    }
    if (std::string problem = startBackward(task, state, at); !problem.empty()) {
        host_.log().write(EventId::StepRefused, &task, {"Stepping backward", problem});
        return problem;
    }
    const bool insidePart = (row(*at, at->statement).flags & kStmtInBackward) != 0;
    if (state.backwardFrame != nullptr || insidePart) return begin(task, Mode::Backward, true);
    noteStop(task, StopReason::Step);
    return "";
}

std::string Debugger::runBackward(Task& task) {
    std::string problem = stepBackward(task);
    if (problem.empty()) stateOf(task).backwardOn = true;
    return problem;
}

/// True: the task makes one more step, or is before the instruction above already.
bool Debugger::continuesBackward(Task& task) {
    State& state = stateOf(task);
    if (!std::exchange(state.backwardOn, false)) return false;
    if (stopReason_ != StopReason::Step || state.backwardTop || state.standing == nullptr ||
        breakpoints_.isAt(*state.standing))
        return false;
    return runBackward(task).empty();
}

std::string Debugger::startBackward(Task& task, State& state, Frame* at) {
    const StmtDesc& statement = row(*at, at->statement);
    if ((statement.flags & kStmtInBackward) != 0 && state.backwardFrame != nullptr)
        return ""; // goes on inside
    if ((statement.flags & (kStmtInBackward | kStmtInHandler)) != 0)
        return "instructions of a handler cannot be executed backwards";
    if (!state.backwardLast) {
        const int32_t movement = lastMovement(host_.arm(task).pointer(), *at);
        const int32_t above = row(*at, movement >= 0 ? movement : at->statement).previous;
        if (above < 0) return kTop;
        state.backwardLast = true;
        state.backwardTop = false;
        at->statement = above;
        return "";
    }
    if (state.backwardTop) return kTop;
    if ((statement.flags & kStmtForwardOnly) != 0)
        return fmt::format(
            "the instruction in line {} changes motion settings and cannot be executed backwards",
            statement.line);
    const bool call = (statement.flags & kStmtCallsRoutine) != 0;
    if (call && (statement.flags & kStmtCallsBackward) == 0)
        return fmt::format("the procedure called in line {} has no BACKWARD handler", statement.line);
    if (call || (statement.flags & kStmtMovement) != 0) {
        task.orderBackward(call ? at : nullptr);
        host_.arm(task).setBackward(true);
        state.backwardFrame = at;
        state.backwardStatement = at->statement;
        return "";
    }
    // Most instructions do nothing when they are executed backwards.
    state.backwardTop = statement.previous < 0;
    if (!state.backwardTop) at->statement = statement.previous;
    return "";
}

/// The statement is done; its frame is asked about the one behind it.
void Debugger::finishBackward(Task& task, State& state, Frame* at) {
    host_.arm(task).setBackward(false);
    task.orderBackward(nullptr);
    state.backwardFrame = nullptr;
    if (std::exchange(state.backwardRefused, false)) { // the program pointer stays
        at->statement = state.backwardStatement;
        return;
    }
    const int32_t above = row(*at, state.backwardStatement).previous;
    state.backwardTop = above < 0;
    at->statement = above < 0 ? state.backwardStatement : above;
}

bool Debugger::allowsCall(Task& task, const Frame* caller, const RoutineDesc& callee) {
    const auto found = states_.find(&task);
    if (found == states_.end() || found->second.backwardFrame != caller || callee.hasBackward != 0)
        return true;
    found->second.backwardRefused = true;
    host_.log().write(
        EventId::StepRefused, &task,
        {"Stepping backward", fmt::format("procedure '{}', called in line {}, has no BACKWARD handler",
                                          callee.name, row(*caller, caller->statement).line)});
    return false;
}

bool Debugger::turnForward(Task& task, State& state) {
    state.backwardLast = state.backwardTop = false;
    Frame* at = state.standing;
    const MotionPointer& pointer = host_.arm(task).pointer();
    const bool here = pointer.valid && pointer.frame == at && pointer.routine == at->routine;
    const int32_t next = statementAfter(*at->routine, here ? pointer.statement : at->statement);
    if (next < 0) return false;
    at->statement = next;
    return true;
}

} // namespace rt

// Backward execution (manual 1.21). Forwards the program pointer shows the next instruction; backwards the one above
// the motion pointer, and a movement goes to the target of the program pointer's instruction with type and speed of
// the motion pointer's.

#include "runtime/debug/debugger.h"
#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
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

/// After all rows of the statement and of those nested in it.
int32_t endOfStatement(const RoutineDesc& routine, int32_t statement) {
    const int32_t after = statementAfter(routine, statement);
    return after >= 0 ? after : static_cast<int32_t>(routine.statementCount);
}

bool hasBackwardInstructions(const RoutineDesc& routine) {
    return std::any_of(routine.statements, routine.statements + routine.statementCount,
                       [](const StmtDesc& statement) { return (statement.flags & kStmtInBackward) != 0; });
}

constexpr const char* kTop =
    "the beginning of the routine, and of IF, FOR, WHILE and TEST, cannot be passed backwards";

} // namespace

std::string Debugger::stepBackward(Task& task) {
    if (const std::vector<Task*> together = tasksTogether(task); !together.empty())
        return stepTogether(task, together);
    if (std::string problem = refusal(task); !problem.empty()) return problem;
    State& state = stateOf(task);
    Frame* at = state.standing;
    if (state.insideCircle) return refusedBackward(task, kInCircle);
    if (at == nullptr) { // inside an instruction: it is finished first
        state.pendingBackward = true;
        return begin(task, Mode::Backward, true);
    }
    const BackwardPlan plan = planBackward(task, state, at);
    if (!plan.problem.empty()) return refusedBackward(task, plan.problem);
    carryOut(task, state, at, plan);
    if (plan.executes()) return begin(task, Mode::Backward, true);
    noteStop(task, StopReason::Step);
    return "";
}

std::string Debugger::stepBackward(const std::vector<Task*>& tasks) {
    std::string first;
    std::set<const Task*> done;
    for (Task* task : tasks) {
        if (!done.insert(task).second) continue;
        const std::vector<Task*> together = tasksTogether(*task);
        done.insert(together.begin(), together.end());
        std::string problem = stepBackward(*task);
        if (first.empty()) first = std::move(problem);
    }
    return first;
}

std::string Debugger::refusedBackward(const Task& task, std::string problem) {
    host_.log().write(EventId::StepRefused, &task, {"Stepping backward", problem});
    return problem;
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
    if (stopReason_ != StopReason::Step || state.standing == nullptr) return false;
    if (breakpoints_.stopsBackward(*state.standing)) {
        stopReason_ = StopReason::Breakpoint;
        return false;
    }
    return !state.backwardTop && runBackward(task).empty();
}

std::string Debugger::refusalOfSync(const Task& task, const Frame& at, int32_t first, int32_t end) {
    if (!task.isMotionTask()) return "";
    SteppedArm& arm = host_.arm(task);
    const bool isOn = !arm.tasksTogether().empty();
    for (const TogetherChange& change : arm.togetherChange()) {
        if (change.frame != &at || change.routine != at.routine) continue;
        if (change.statement < first || change.statement >= end) return "";
        if (change.callee == nullptr)
            return isOn ? "SyncMoveOn cannot be passed backwards: move the program pointer"
                        : "SyncMoveOff and SyncMoveUndo cannot be passed backwards: move the program pointer";
        if (change.statement == first && hasBackwardInstructions(*change.callee)) return "";
        return fmt::format("the procedure called in line {} executed {}, which cannot be passed backwards: "
                           "move the program pointer",
                           row(at, change.statement).line, isOn ? "SyncMoveOn" : "SyncMoveOff");
    }
    return "";
}

Debugger::BackwardPlan Debugger::planBackward(Task& task, const State& state, Frame* at) {
    BackwardPlan plan{{}, BackwardPlan::Kind::Moves, at->statement, false};
    const StmtDesc& statement = row(*at, at->statement);
    const auto refused = [](std::string problem) {
        return BackwardPlan{std::move(problem), BackwardPlan::Kind::Moves, -1, false};
    };
    if ((statement.flags & kStmtInBackward) != 0 && state.backwardFrame != nullptr) {
        plan.kind = BackwardPlan::Kind::Continues;
        return plan;
    }
    if ((statement.flags & (kStmtInBackward | kStmtInHandler)) != 0)
        return refused("instructions of a handler cannot be executed backwards");
    // The statements that the step passes: up to the motion pointer's, later the program pointer's.
    int32_t first = at->statement;
    int32_t end = first;
    if (state.backwardLast)
        end = endOfStatement(*at->routine, first);
    else if (const int32_t movement = lastMovement(host_.arm(task).pointer(), *at); movement >= 0)
        first = movement;
    if (std::string problem = refusalOfSync(task, *at, first, end); !problem.empty())
        return refused(std::move(problem));
    if (!state.backwardLast) {
        plan.statement = row(*at, first).previous;
        return plan.statement < 0 ? refused(kTop) : plan;
    }
    if (state.backwardTop) return refused(kTop);
    if ((statement.flags & kStmtForwardOnly) != 0)
        return refused(
            fmt::format("the instruction in line {} changes motion settings and cannot be executed backwards",
                        statement.line));
    const bool call = (statement.flags & kStmtCallsRoutine) != 0;
    if (call && (statement.flags & kStmtCallsBackward) == 0)
        return refused(
            fmt::format("the procedure called in line {} has no BACKWARD handler", statement.line));
    if (call || (statement.flags & kStmtMovement) != 0) {
        plan.kind = call ? BackwardPlan::Kind::Calls : BackwardPlan::Kind::Executes;
        return plan;
    }
    // Most instructions do nothing when they are executed backwards.
    plan.isTop = statement.previous < 0;
    if (!plan.isTop) plan.statement = statement.previous;
    return plan;
}

void Debugger::carryOut(Task& task, State& state, Frame* at, const BackwardPlan& plan) {
    using Kind = BackwardPlan::Kind;
    if (plan.kind == Kind::Continues) return;
    at->statement = plan.statement;
    state.backwardLast = true;
    state.backwardTop = plan.isTop;
    if (plan.kind == Kind::Moves) return;
    task.orderBackward(plan.kind == Kind::Calls ? at : nullptr);
    host_.arm(task).setBackward(true);
    state.backwardFrame = at;
    state.backwardStatement = at->statement;
}

std::string Debugger::startBackward(Task& task, State& state, Frame* at) {
    BackwardPlan plan = planBackward(task, state, at);
    if (plan.problem.empty()) carryOut(task, state, at, plan);
    return std::move(plan.problem);
}

/// The statement is done; its frame is asked about the next one.
void Debugger::finishBackward(Task& task, State& state, Frame* at, bool isTakenBack) {
    host_.arm(task).setBackward(false);
    task.orderBackward(nullptr);
    state.backwardFrame = nullptr;
    if (std::exchange(state.backwardRefused, false) || isTakenBack) { // the program pointer stays
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
    refusedBackward(task, fmt::format("procedure '{}', called in line {}, has no BACKWARD handler",
                                      callee.name, row(*caller, caller->statement).line));
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

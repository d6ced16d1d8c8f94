// Backward execution (manual 1.21). Forwards the program pointer shows the next instruction; backwards the one above
// the motion pointer, and a movement goes to the target of the program pointer's instruction with type and speed of
// the motion pointer's.

#include "runtime/debug/debugger.h"
#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"

#include <fmt/format.h>

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
    if (stopReason_ != StopReason::Step || state.backwardTop || state.standing == nullptr ||
        breakpoints_.isAt(*state.standing))
        return false;
    return runBackward(task).empty();
}

std::string Debugger::refusalOfSync(const Task& task) {
    if (!task.isMotionTask()) return "";
    const MotionPointer& pointer = host_.arm(task).pointer();
    const MovingTogether together = host_.arm(task).together();
    if (!together.tasks.empty() && (!together.first || pointer.command.ident == *together.first))
        return "SyncMoveOn cannot be passed backwards: move the program pointer";
    if (!together.tasks.empty() || pointer.command.ident == motion::kNoIdent) return "";
    int arms = 0;
    host_.forEachArm([&arms](SteppedArm&) { ++arms; });
    if (arms == 1) return ""; // \ID has no meaning
    return "SyncMoveOff and SyncMoveUndo cannot be passed backwards: move the program pointer";
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
    if (std::string problem = refusalOfSync(task); !problem.empty()) return refused(std::move(problem));
    if (!state.backwardLast) {
        const int32_t movement = lastMovement(host_.arm(task).pointer(), *at);
        plan.statement = row(*at, movement >= 0 ? movement : at->statement).previous;
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

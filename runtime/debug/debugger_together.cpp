// Stepping backward over movements that robots make together (SyncMoveOn; manual 1.20, 1.21): each task of the group executes its
// movement, so that the robots return on their common path. Instructions between movements are passed by the task that is
// stepped, and by the others when they come to the movement.

#include "runtime/debug/debugger.h"
#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"

#include <fmt/format.h>

#include <algorithm>

namespace rt {

std::vector<Task*> Debugger::tasksTogether(const Task& task) {
    if (!task.isMotionTask()) return {};
    std::vector<Task*> all = host_.arm(task).tasksTogether();
    const bool takesPart = std::find(all.begin(), all.end(), &task) != all.end();
    return takesPart && all.size() > 1 ? all : std::vector<Task*>();
}

std::string Debugger::stepTogether(Task& task, const std::vector<Task*>& all) {
    for (Task* one : all)
        if (std::string problem = refusalTogether(*one); !problem.empty())
            return refusedBackward(task, std::move(problem));
    const auto isInside = [this](const Task* one) { return stateOf(*one).standing == nullptr; };
    std::vector<Task*> inside;
    std::copy_if(all.begin(), all.end(), std::back_inserter(inside), isInside);
    State& state = stateOf(task);
    if (!inside.empty() || !state.backwardLast) {
        if (std::string problem = turnTogether(all); !problem.empty())
            return refusedBackward(task, std::move(problem));
        if (inside.empty())
            noteStop(task, StopReason::Step);
        else
            finishTogether(task, std::move(inside));
        return "";
    }
    const BackwardPlan plan = planBackward(task, state, state.standing);
    if (!plan.problem.empty()) return refusedBackward(task, plan.problem);
    if (plan.executes()) return moveTogether(task, all);
    carryOut(task, state, state.standing, plan);
    noteStop(task, StopReason::Step);
    return "";
}

/// Why one of the tasks cannot make a step together with the others; "" when it can.
std::string Debugger::refusalTogether(const Task& task) {
    if (std::string problem = refusal(task); !problem.empty()) return problem;
    if (!host_.isTaskActive(task))
        return fmt::format("task {} takes part in the movement and is not selected: select it first",
                           task.name());
    const State& state = stateOf(task);
    if (state.insideCircle) return kInCircle;
    if (state.standing != nullptr || state.backwardFrame != nullptr || task.isMeeting()) return "";
    if (task.standing() == Standing::AfterStop) return "";
    // A movement ends by itself; another instruction may wait for what a task does that does not execute.
    const StmtDesc* statement = task.frame != nullptr ? statementOf(*task.frame) : nullptr;
    if (statement != nullptr && (statement->flags & kStmtMovement) != 0) return "";
    return fmt::format("task {} is inside the instruction in line {}: step it forward first", task.name(),
                       task.place().line);
}

/// The first step of those that have executed forwards moves their program pointers only.
std::string Debugger::turnTogether(const std::vector<Task*>& all) {
    std::vector<std::pair<Task*, BackwardPlan>> turning;
    for (Task* one : all) {
        State& state = stateOf(*one);
        if (state.standing == nullptr || state.backwardLast) continue;
        turning.emplace_back(one, planBackward(*one, state, state.standing));
        if (const std::string& problem = turning.back().second.problem; !problem.empty())
            return fmt::format("task {}: {}", one->name(), problem);
    }
    for (const auto& [one, plan] : turning)
        carryOut(*one, stateOf(*one), stateOf(*one).standing, plan);
    return "";
}

/// Tasks inside of a movement finish it; one that waits for the others is before it again.
void Debugger::finishTogether(Task& task, std::vector<Task*> inside) {
    for (Task* one : inside) {
        stateOf(*one).pendingBackward = stateOf(*one).backwardFrame == nullptr;
        if (one->isMeeting()) one->takeBack();
        (void)begin(*one, Mode::Backward, true); // refusalTogether has asked
    }
    together_ = {&task, std::move(inside)};
}

/// All execute their movement, after they have passed the instructions that follow it. When one cannot, nothing has changed.
std::string Debugger::moveTogether(Task& task, const std::vector<Task*>& all) {
    struct Place {
        State& state;
        int32_t statement;
        bool isTop;
        bool isBackward;
        BackwardPlan plan;
    };
    std::vector<Place> places;
    for (Task* one : all) {
        State& state = stateOf(*one);
        Frame* at = state.standing;
        places.push_back({state, at->statement, state.backwardTop, state.backwardLast, {}});
        BackwardPlan& plan = places.back().plan;
        plan = planBackward(*one, state, at);
        while (plan.problem.empty() && !plan.executes()) {
            carryOut(*one, state, at, plan);
            plan = planBackward(*one, state, at);
        }
        if (plan.problem.empty()) continue;
        for (const Place& place : places) {
            place.state.standing->statement = place.statement;
            place.state.backwardTop = place.isTop;
            place.state.backwardLast = place.isBackward;
        }
        return refusedBackward(task, fmt::format("task {}: {}", one->name(), plan.problem));
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        carryOut(*all[i], places[i].state, places[i].state.standing, places[i].plan);
        (void)begin(*all[i], Mode::Backward, true); // refusalTogether has asked
    }
    together_ = {&task, all};
    return "";
}

/// A task has completed its step. False: others that make it together with this one have not. Else `task` is the one that was stepped.
bool Debugger::endsStepTogether(Task*& task) {
    std::vector<Task*>& left = together_.tasks;
    const auto found = std::find(left.begin(), left.end(), task);
    if (found == left.end()) return true;
    left.erase(found);
    together_.isFirstDone = true;
    if (left.empty()) task = together_.ordered;
    return left.empty();
}

/// Some tasks have completed their step without the movement that the others wait for: these are before it again.
void Debugger::endMeeting() {
    const std::vector<Task*>& left = together_.tasks;
    const auto waits = [](const Task* one) { return one->isMeeting(); };
    if (!together_.isFirstDone || left.empty() || !std::all_of(left.begin(), left.end(), waits)) return;
    together_.isFirstDone = false;
    for (Task* one : left)
        one->takeBack();
}

bool Debugger::refuseBackward(Task& task) {
    const Frame* at = task.frame;
    const StmtDesc* statement = at != nullptr ? statementOf(*at) : nullptr;
    if (statement == nullptr) return false;
    State& state = stateOf(task);
    if (state.backwardFrame != at && (statement->flags & kStmtInBackward) == 0) return false;
    state.backwardRefused = state.backwardFrame == at;
    refusedBackward(task, fmt::format("task {} cannot execute the movement in line {} together with other "
                                      "tasks, which execute none with "
                                      "the same \\ID: move the program pointer",
                                      task.name(), statement->line));
    return true;
}

} // namespace rt

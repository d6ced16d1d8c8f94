#include "tools/rapidc/dap/execution_requests.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/error_search.h"
#include "tools/rapidc/dap/stop_event.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc::dap {

namespace {

enum class Granularity : uint8_t { Statement, Line, Move };

/// "move" is our own: until the next movement.
Granularity granularityOf(const Arguments& arguments) {
    const std::string text = arguments.text("granularity", "statement");
    if (text == "statement" || text == "instruction") return Granularity::Statement;
    if (text == "line") return Granularity::Line;
    if (text == "move") return Granularity::Move;
    throw Refusal(fmt::format("there is no granularity '{}'", text));
}

/// Null: the program pointer can be at none of its statements.
const rt::StmtDesc* firstStatement(const rt::RoutineDesc& routine) {
    for (uint32_t s = 0; s < routine.statementCount; ++s)
        if (routine.statements[s].canStart != 0) return &routine.statements[s];
    return nullptr;
}

} // namespace

void ExecutionRequests::addTo(Handlers& handlers) {
    const auto add = registrar(handlers, *this);
    add("threads", &ExecutionRequests::threads);
    add("continue", &ExecutionRequests::continueProgram);
    add("next", &ExecutionRequests::stepOver);
    add("stepIn", &ExecutionRequests::stepInto);
    add("stepOut", &ExecutionRequests::stepOut);
    add("stepBack", &ExecutionRequests::stepBack);
    add("reverseContinue", &ExecutionRequests::reverseContinue);
    handlers["pause"] = [this](const Request& request, const Arguments& arguments) {
        return pause(request, arguments);
    };
    add("gotoTargets", &ExecutionRequests::gotoTargets);
    add("goto", &ExecutionRequests::goTo);
    add("restartFrame", &ExecutionRequests::restartFrame);
}

rt::Task& ExecutionRequests::standing(const Arguments& arguments) {
    rt::Task& task = context_.task(arguments.number("threadId"));
    if (context_.evaluator && context_.evaluator->isBusy())
        throw Refusal("an expression is being evaluated: pause ends that");
    context_.requireStop();
    return task;
}

void ExecutionRequests::order(const std::function<std::string()>& action) {
    if (const std::string problem = action(); !problem.empty()) throw Refusal(problem);
    onContinue_();
}

Json ExecutionRequests::threads(const Arguments&) {
    Json list = Json::array();
    if (context_.program)
        for (const auto& task : context_.controller().tasks())
            list.push_back({{"id", Context::threadOf(*task)}, {"name", task->name()}});
    return {{"threads", std::move(list)}};
}

Json ExecutionRequests::continueProgram(const Arguments& arguments) {
    rt::Task& task = standing(arguments);
    const bool alone = arguments.flag("singleThread", false);
    rt::Debugger& debugger = context_.debugger();
    order([&] { return alone ? debugger.runAlone(task) : debugger.run(); });
    return {{"allThreadsContinued", !alone}};
}

Json ExecutionRequests::step(const Arguments& arguments, bool into) {
    rt::Task& task = standing(arguments);
    const bool alone = arguments.flag("singleThread", false);
    const Granularity granularity = granularityOf(arguments);
    rt::Debugger& debugger = context_.debugger();
    order([&] {
        if (granularity == Granularity::Move) return debugger.stepMove(task, alone);
        if (granularity == Granularity::Line) return debugger.stepLine(task, into, alone);
        return into ? debugger.stepIn(task, alone) : debugger.stepOver(task, alone);
    });
    return nullptr;
}

Json ExecutionRequests::stepOut(const Arguments& arguments) {
    rt::Task& task = standing(arguments);
    const bool alone = arguments.flag("singleThread", false);
    order([&] { return context_.debugger().stepOut(task, alone); });
    return nullptr;
}

Json ExecutionRequests::stepBack(const Arguments& arguments) {
    rt::Task& task = standing(arguments);
    order([&] { return context_.debugger().stepBackward(task); });
    return nullptr;
}

Json ExecutionRequests::reverseContinue(const Arguments& arguments) {
    rt::Task& task = standing(arguments);
    order([&] { return context_.debugger().runBackward(task); });
    return nullptr;
}

/// At a stop, the event of the stop comes again: clients exist that take the program for executing when a step was refused.
std::optional<Json> ExecutionRequests::pause(const Request& request, const Arguments& arguments) {
    rt::Task& task = context_.task(arguments.number("threadId"));
    rt::Debugger& debugger = context_.debugger();
    if (context_.evaluator && context_.evaluator->isBusy()) {
        context_.evaluator->breakOff();
        return nullptr;
    }
    if (context_.stopped != nullptr) {
        context_.client.answer(request, nullptr);
        context_.client.event("stopped", stopEvent(rt::StopReason::Order, task));
        return std::nullopt;
    }
    if (!context_.running) throw Refusal("the program is not executing");
    for (const auto& each : context_.controller().tasks())
        if (each->events().isVisited()) each->events().endVisit(); // the condition of a breakpoint
    if (const std::string problem = debugger.pause(task); !problem.empty()) throw Refusal(problem);
    return nullptr;
}

// ---- Program pointer -----------------------------------------------------------------------------------------------

/// The first statement at or below the line, in each routine that has one there.
Json ExecutionRequests::gotoTargets(const Arguments& arguments) {
    const std::string path = context_.pathIn(arguments.object("source"));
    const uint32_t line = context_.facts.lineIn(arguments.number("line"));
    (void)context_.debugger();
    const rt::RoutineDesc* found = nullptr;
    const rt::StmtDesc* best = nullptr;
    for (const rt::RoutineEntry* entry : context_.controller().tables().routines()) {
        const rt::RoutineDesc& routine = *entry->desc;
        if (routine.file == nullptr || *routine.file == '\0') continue;
        const std::string file = context_.program->hostPath(routine.file);
        std::error_code problem;
        if (file != path && !(std::filesystem::equivalent(file, path, problem) && !problem)) continue;
        for (uint32_t s = 0; s < routine.statementCount; ++s) {
            const rt::StmtDesc& statement = routine.statements[s];
            if (statement.canStart == 0 || statement.line < line) continue;
            if ((statement.flags & (rt::kStmtInBackward | rt::kStmtInHandler)) != 0) continue;
            if (best != nullptr && statement.line >= best->line) continue;
            best = &statement;
            found = &routine;
        }
    }
    Json targets = Json::array();
    if (best != nullptr) {
        targets_[++lastTarget_] = {found->name, found->module, best->line};
        targets.push_back({{"id", lastTarget_},
                           {"label", fmt::format("{} line {}", found->name, best->line)},
                           {"line", context_.facts.lineOut(best->line)},
                           {"column", context_.facts.columnOut(best->column)},
                           {"endLine", context_.facts.lineOut(best->endLine)},
                           {"endColumn", context_.facts.columnOut(best->endColumn)}});
    }
    return {{"targets", std::move(targets)}};
}

Json ExecutionRequests::goTo(const Arguments& arguments) {
    rt::Task& task = standing(arguments);
    const auto found = targets_.find(arguments.number("targetId"));
    if (found == targets_.end()) throw Refusal("there is no such target");
    const Target target = found->second;
    rt::Debugger& debugger = context_.debugger();
    const rt::Frame* at = task.frame;
    const bool here = at != nullptr && at->routine != nullptr &&
                      rt::sameName(at->routine->name, target.routine) &&
                      rt::sameName(at->routine->module, target.module);
    order([&]() -> std::string {
        if (here) {
            const std::string problem = debugger.pointerToLine(task, target.line);
            if (problem.empty()) debugger.noteStop(task, rt::StopReason::Pointer);
            return problem;
        }
        const rt::RoutineEntry* routine =
            context_.controller().findRoutine(target.routine, target.module, task);
        uint32_t first = 0;
        if (routine != nullptr)
            if (const rt::StmtDesc* statement = firstStatement(*routine->desc)) first = statement->line;
        if (first != target.line)
            return fmt::format(
                "line {} is in routine {}: the program pointer can be moved within the routine in "
                "progress, or to the first instruction of a procedure without parameters",
                target.line, target.routine);
        return debugger.pointerToRoutine(task, target.module + ":" + target.routine);
    });
    return nullptr;
}

/// As the program pointer may be moved (manual 1.2.2): to the beginning of the routine in progress, whose data keep their values; or to
/// the routine that the others were called from, which ends them.
Json ExecutionRequests::restartFrame(const Arguments& arguments) {
    const int64_t id = arguments.number("frameId");
    context_.requireStop();
    const FramePlace place = context_.frameOf(id);
    rt::Debugger& debugger = context_.debugger();
    const rt::Frame* at = place.frame.frame;
    if (at == nullptr || at->routine == nullptr) throw Refusal("this frame is not in progress");
    const rt::RoutineDesc& routine = *at->routine;
    if (place.index > 0 && place.index + 1 < place.count)
        throw Refusal(fmt::format(
            "routine {} waits for a routine that it has called, and others wait for it: only the innermost "
            "and the outermost routine can be restarted",
            routine.name));
    if (place.index == 0 && rt::inErrorHandler(*at))
        throw Refusal("the program pointer cannot be moved out of an error handler");
    const rt::StmtDesc* first = firstStatement(routine);
    if (first == nullptr) throw Refusal(fmt::format("routine {} has no instruction", routine.name));
    order([&]() -> std::string {
        if (place.index > 0)
            return debugger.pointerToRoutine(*place.task, fmt::format("{}:{}", routine.module, routine.name));
        const std::string problem = debugger.pointerToLine(*place.task, first->line);
        if (problem.empty()) debugger.noteStop(*place.task, rt::StopReason::Pointer);
        return problem;
    });
    restarting_ = true;
    return nullptr;
}

} // namespace rapidc::dap

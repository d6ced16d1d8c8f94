#include "tools/rapidc/line_debugger.h"

#include "runtime/base/text_util.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <unistd.h>
#include <utility>

namespace rapidc {

namespace {

const char* reasonText(rt::StopReason reason) {
    switch (reason) {
    case rt::StopReason::Entry: return "ready";
    case rt::StopReason::Breakpoint: return "breakpoint";
    case rt::StopReason::Step: return "step";
    case rt::StopReason::CirclePoint: return "circle point";
    case rt::StopReason::Cursor: return "cursor";
    case rt::StopReason::Order: return "stop order";
    case rt::StopReason::Stop: return "Stop";
    case rt::StopReason::Error: return "error";
    case rt::StopReason::Pointer: return "program pointer moved";
    case rt::StopReason::Routine: return "breakpoint";
    case rt::StopReason::Data: return "data changed";
    case rt::StopReason::Raised: return "error raised";
    }
    return "";
}

bool readNumber(std::string_view text, uint32_t& number) {
    text = rt::trimmed(text);
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    return problem == std::errc() && end == text.data() + text.size() && !text.empty();
}

/// The first word; `text` keeps the rest.
std::string_view takeWord(std::string_view& text) {
    text = rt::trimmed(text);
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    const std::string_view word = text.substr(0, end);
    text = rt::trimmed(text.substr(end));
    return word;
}

} // namespace

void LineDebugger::attach() {
    controller_.debugger().setClient(this);
    controller_.debugger().stopAtEntry();
}

const std::vector<LineDebugger::Command>& LineDebugger::commands() {
    using D = LineDebugger;
    static const std::vector<Command> all = {
        {"step s", "", "execute one instruction, into routines", &D::stepIn},
        {"next n over", "", "execute one instruction, routines as a whole", &D::stepOver},
        {"out finish", "", "execute until the routine has returned", &D::stepOut},
        {"move m", "", "execute until the next movement instruction", &D::stepMove},
        {"back b", "", "execute one instruction backwards", &D::stepBackward},
        {"continue c run", "", "execute until something stops the program", &D::run},
        {"cursor", "[MODULE:]LINE", "execute until this line", &D::cursor},
        {"pp", "LINE | ROUTINE | main", "move the program pointer", &D::pointer},
        {"break", "[MODULE:]LINE [IF CONDITION]", "stop before this line", &D::breakAt},
        {"breaks", "", "list the breakpoints", &D::breakpoints},
        {"delete", "NUMBER", "remove a breakpoint", &D::deleteBreakpoint},
        {"where w bt", "", "show the call chain", &D::where},
        {"frame f", "NUMBER", "look at another routine of the call chain", &D::selectFrame},
        {"locals", "", "show parameters and data of the routine", &D::locals},
        {"globals", "[TEXT]", "show data of the modules (whose name contains TEXT)", &D::globals},
        {"print p", "EXPRESSION", "show a value", &D::print},
        {"set", "NAME := VALUE", "change a value", &D::set},
        {"do", "INSTRUCTIONS", "execute instructions here", &D::perform},
        {"tasks", "", "list the tasks", &D::tasks},
        {"task", "NAME", "look at another task", &D::selectTask},
        {"list l", "", "show the program around the place", &D::list},
        {"robot r", "", "show the time and where the TCP is (tool and work object of the last movement)",
         &D::robot},
        {"help h", "", "show this list", &D::help},
        {"quit q", "", "end the run", &D::quit},
    };
    return all;
}

void LineDebugger::stopped(rt::Debugger& debugger, rt::Task& task, rt::StopReason reason) {
    controller_.panel().flush();
    controller_.log().flush();
    if (!std::exchange(sameStop_, false)) {
        debugger_ = &debugger;
        task_ = &task;
        reason_ = reason;
        frames_ = debugger.frames(task);
        selected_ = 0;
        showStop();
    }
    for (;;) {
        if (isatty(STDIN_FILENO) != 0) fmt::print("(rapidc) ");
        std::fflush(stdout);
        std::string line;
        if (!std::getline(std::cin, line)) {
            debugger.quit();
            return;
        }
        std::string_view text = rt::trimmed(line);
        if (!text.empty() && text.front() == '#') continue;
        // An empty line repeats the last order, as debuggers do.
        if (text.empty() && isatty(STDIN_FILENO) == 0) continue;
        if (!text.empty()) lastCommand_ = std::string(text);
        if (execute(lastCommand_)) return;
    }
}

void LineDebugger::showStop() {
    const bool atMain = task_->stopCause() == rt::StopCause::AtMain;
    fmt::print("[{}] {}", reasonText(reason_), task_->name());
    if (atMain || frames_.empty()) {
        fmt::print(": the program pointer is at the beginning\n");
        return;
    }
    fmt::print(": ");
    showPlace(frames_[0].place);
}

bool LineDebugger::execute(std::string_view line) {
    const std::string_view word = takeWord(line);
    for (const Command& command : commands()) {
        std::string_view names = command.names;
        while (!names.empty())
            if (rt::sameName(takeWord(names), word)) return (this->*command.action)(line);
    }
    fmt::print("unknown command '{}': 'help' lists them\n", word);
    return false;
}

// ---- Going on ------------------------------------------------------------------------------------------------------

bool LineDebugger::went(const std::string& problem) {
    if (!problem.empty()) fmt::print("not possible: {}\n", problem);
    return problem.empty();
}

bool LineDebugger::run(std::string_view) {
    return went(debugger_->run());
}
bool LineDebugger::stepIn(std::string_view) {
    return went(debugger_->stepIn(*task_));
}
bool LineDebugger::stepOver(std::string_view) {
    return went(debugger_->stepOver(*task_));
}
bool LineDebugger::stepOut(std::string_view) {
    return went(debugger_->stepOut(*task_));
}
bool LineDebugger::stepMove(std::string_view) {
    return went(debugger_->stepMove(*task_));
}
bool LineDebugger::stepBackward(std::string_view) {
    return went(debugger_->stepBackward(*task_));
}
bool LineDebugger::quit(std::string_view) {
    debugger_->quit();
    return true;
}

bool LineDebugger::readPlace(std::string_view text, std::string& module, uint32_t& line) {
    const std::size_t colon = text.rfind(':');
    if (colon != std::string_view::npos)
        module = std::string(rt::trimmed(text.substr(0, colon)));
    else if (const rt::DebugFrame* at = frame())
        module = at->place.module;
    if (readNumber(colon == std::string_view::npos ? text : text.substr(colon + 1), line) && !module.empty())
        return true;
    fmt::print("expected a line, or MODULE:LINE\n");
    return false;
}

bool LineDebugger::cursor(std::string_view arguments) {
    std::string module;
    uint32_t line = 0;
    return readPlace(arguments, module, line) && went(debugger_->runToLine(*task_, module, line));
}

bool LineDebugger::movedPointer(const std::string& problem) {
    if (!went(problem)) return false;
    frames_ = debugger_->frames(*task_);
    selected_ = 0;
    if (const rt::DebugFrame* at = frame()) showPlace(at->place);
    return false;
}

bool LineDebugger::pointer(std::string_view arguments) {
    uint32_t line = 0;
    if (readNumber(arguments, line)) return movedPointer(debugger_->pointerToLine(*task_, line));
    if (arguments.empty()) {
        fmt::print("expected a line of this routine, the name of a routine, or main\n");
        return false;
    }
    // The call chain is left, and UNDO handlers run: the scheduler has to work.
    if (rt::sameName(arguments, "main")) {
        if (!went(debugger_->pointerToMain())) return false;
        debugger_->noteStop(*task_, rt::StopReason::Pointer);
        return true;
    }
    return went(debugger_->pointerToRoutine(*task_, arguments));
}

// ---- Breakpoints ---------------------------------------------------------------------------------------------------

bool LineDebugger::holds(rt::Task& task, rt::Frame* at, const std::string& condition) {
    std::string problem;
    const dap::Site site{&task, at};
    const dap::CompiledExpression* code =
        evaluator_.compile(site, condition, dap::ExpressionKind::Value, problem);
    if (code != nullptr) {
        const dap::Evaluation result = evaluator_.now(site, *code);
        if (result.hasValue && result.value.type->kind == rt::DescKind::Bool)
            return *static_cast<const unsigned char*>(result.value.data) != 0;
        problem = result.problem.empty() ? "it is not a bool" : result.problem;
    }
    fmt::print("condition '{}': {}\n", condition, problem);
    return true;
}

bool LineDebugger::breakAt(std::string_view arguments) {
    std::string module, condition;
    uint32_t line = 0;
    if (const std::size_t word = rt::upperCase(arguments).find(" IF "); word != std::string::npos) {
        condition = std::string(rt::trimmed(arguments.substr(word + 4)));
        arguments = arguments.substr(0, word);
    }
    if (!readPlace(arguments, module, line)) return false;
    rt::BreakCondition accepts;
    if (!condition.empty())
        accepts = [this, condition](rt::Task& task, rt::Frame* at) { return holds(task, at, condition); };
    const rt::Breakpoint breakpoint = debugger_->breakpoints().addLine(
        module, line, [module](const rt::RoutineDesc& routine) { return rt::isPlace(routine, module); },
        std::move(accepts));
    if (breakpoint.waits)
        fmt::print("breakpoint {}: {}:{}, waits for a module of that name to be loaded\n", breakpoint.id,
                   module, line);
    else if (breakpoint.actualLine == 0)
        fmt::print("breakpoint {}: no instruction at or below line {} of {}\n", breakpoint.id, line, module);
    else
        fmt::print("breakpoint {}: {}:{}\n", breakpoint.id, module, breakpoint.actualLine);
    return false;
}

bool LineDebugger::breakpoints(std::string_view) {
    for (const rt::Breakpoint& breakpoint : debugger_->breakpoints().all())
        fmt::print("{}  {}:{}{}\n", breakpoint.id, breakpoint.file,
                   breakpoint.waits ? breakpoint.line : breakpoint.actualLine,
                   breakpoint.waits ? " (waits for its module)" : "");
    if (debugger_->breakpoints().all().empty()) fmt::print("no breakpoints\n");
    return false;
}

bool LineDebugger::deleteBreakpoint(std::string_view arguments) {
    uint32_t id = 0;
    if (!readNumber(arguments, id) || !debugger_->breakpoints().remove(static_cast<int>(id)))
        fmt::print("there is no breakpoint '{}'\n", arguments);
    return false;
}

// ---- Looking -------------------------------------------------------------------------------------------------------

const rt::DebugFrame* LineDebugger::frame() {
    return selected_ < frames_.size() ? &frames_[selected_] : nullptr;
}

const std::vector<std::string>& LineDebugger::source(const std::string& file) {
    auto [found, isNew] = sources_.try_emplace(file);
    if (isNew) {
        std::string loaded; // modules that came while the program runs are known by their names in HOME:
        const bool inHome = file.rfind("HOME:", 0) == 0 && controller_.volumes().resolve(file, loaded);
        std::ifstream in(inHome ? loaded : file, std::ios::binary);
        for (std::string line; std::getline(in, line);)
            found->second.push_back(rt::toUtf8(rt::trimmed(line)));
    }
    return found->second;
}

void LineDebugger::showPlace(const rt::SourcePlace& place) {
    fmt::print("{} {}:{}", place.routine, place.module, place.line);
    const std::vector<std::string>& lines = source(place.file);
    if (place.line > 0 && place.line <= lines.size()) fmt::print("  {}", lines[place.line - 1]);
    fmt::print("\n");
}

bool LineDebugger::where(std::string_view) {
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        fmt::print("{}{}  ", i == selected_ ? '*' : ' ', i);
        if (frames_[i].isTrap) fmt::print("(interrupt) ");
        showPlace(frames_[i].place);
    }
    if (frames_.empty()) fmt::print("no routine is in progress\n");
    return false;
}

bool LineDebugger::selectFrame(std::string_view arguments) {
    uint32_t number = 0;
    if (!readNumber(arguments, number) || number >= frames_.size()) {
        fmt::print("there is no routine number '{}' in the call chain\n", arguments);
        return false;
    }
    selected_ = number;
    showPlace(frames_[selected_].place);
    return false;
}

bool LineDebugger::locals(std::string_view) {
    const rt::DebugFrame* at = frame();
    if (at == nullptr) return false;
    const auto variables = debugger_->locals(*at);
    for (const rt::DebugVariable& variable : variables)
        fmt::print("{} {} = {}\n", rt::typeName(variable), variable.name, rt::valueText(variable));
    if (variables.empty()) fmt::print("the routine has no data\n");
    return false;
}

bool LineDebugger::globals(std::string_view arguments) {
    const std::string wanted = rt::upperCase(arguments);
    for (const rt::DebugVariable& variable : debugger_->globals(*task_)) {
        if (rt::upperCase(variable.name).find(wanted) == std::string::npos) continue;
        const char* kind = variable.isConstant ? "CONST" : variable.isPersistent ? "PERS" : "VAR";
        fmt::print("{} {} {}:{} = {}\n", kind, rt::typeName(variable), variable.module, variable.name,
                   rt::valueText(variable));
    }
    return false;
}

bool LineDebugger::print(std::string_view arguments) {
    std::string error;
    const rt::DebugVariable variable = debugger_->find(*task_, frame(), arguments, error);
    if (!error.empty()) return evaluate(arguments, dap::ExpressionKind::Value);
    fmt::print("{} {} = {}\n", rt::typeName(variable), variable.name, rt::valueText(variable));
    return false;
}

bool LineDebugger::evaluate(std::string_view text, dap::ExpressionKind kind) {
    std::string problem;
    const rt::DebugFrame* at = frame();
    const dap::Site site{task_, at != nullptr ? at->frame : nullptr};
    const dap::CompiledExpression* code = evaluator_.compile(site, std::string(text), kind, problem);
    if (code == nullptr) {
        fmt::print("{}\n", problem);
        return false;
    }
    evaluator_.later(site, *code, [this, name = std::string(text)](const dap::Evaluation& result) {
        controller_.panel().flush();
        if (!result.problem.empty()) fmt::print("{}\n", result.problem);
        if (result.hasValue)
            fmt::print("{} {} = {}\n", rt::typeName(result.value), name, rt::valueText(result.value));
        sameStop_ = true;
        debugger_->noteStop(*task_, reason_);
    });
    return true;
}

bool LineDebugger::perform(std::string_view arguments) {
    std::string text(arguments);
    if (!text.empty() && text.back() != ';') text += ';';
    return evaluate(text, dap::ExpressionKind::Orders);
}

bool LineDebugger::set(std::string_view arguments) {
    const std::size_t assign = arguments.find(":=");
    if (assign == std::string_view::npos) {
        fmt::print("expected NAME := VALUE\n");
        return false;
    }
    const std::string problem =
        debugger_->assign(*task_, frame(), arguments.substr(0, assign), arguments.substr(assign + 2));
    if (!problem.empty()) fmt::print("{}\n", problem);
    return problem.empty() ? print(arguments.substr(0, assign)) : false;
}

bool LineDebugger::tasks(std::string_view) {
    for (const auto& task : controller_.tasks()) {
        const rt::SourcePlace place = task->place();
        const char* state = task->state() == rt::TaskState::Finished ? "ended"
                            : task->isStopped()                      ? "stopped"
                                                                     : "executing";
        fmt::print("{}{} {} {}\n", task.get() == task_ ? '*' : ' ', task->name(), state,
                   place.module.empty() ? "at the beginning"
                                        : fmt::format("{}:{}", place.module, place.line));
    }
    return false;
}

bool LineDebugger::selectTask(std::string_view arguments) {
    rt::Task* task = controller_.findTask(arguments);
    if (task == nullptr) {
        fmt::print("there is no task '{}'\n", arguments);
        return false;
    }
    task_ = task;
    frames_ = debugger_->frames(*task);
    selected_ = 0;
    return where("");
}

bool LineDebugger::list(std::string_view) {
    const rt::DebugFrame* at = frame();
    if (at == nullptr) return false;
    const std::vector<std::string>& lines = source(at->place.file);
    const std::size_t here = at->place.line;
    for (std::size_t n = here > 5 ? here - 5 : 1; n <= std::min(here + 5, lines.size()); ++n)
        fmt::print("{} {:4}  {}\n", n == here ? "->" : "  ", n, lines[n - 1]);
    return false;
}

bool LineDebugger::robot(std::string_view) {
    rt::MotionDriver& motion = controller_.motion(*task_);
    const auto target = motion.system().currentTarget(motion.pointer().command.frames);
    const auto joints = motion.system().currentJoints();
    // Adding 0 turns -0 into 0.
    const auto rounded = [](double value) { return std::round(value * 100) / 100 + 0.0; };
    fmt::print("{:.3f} s  [{:.2f},{:.2f},{:.2f}]  axes", rt::toSeconds(controller_.scheduler().now()),
               rounded(target.pose.pos.x), rounded(target.pose.pos.y), rounded(target.pose.pos.z));
    for (const double axis : joints.robax)
        fmt::print(" {:.2f}", rounded(axis));
    fmt::print("\n");
    return false;
}

bool LineDebugger::help(std::string_view) {
    for (const Command& command : commands())
        fmt::print("{:16} {:26} {}\n", command.names, command.usage, command.meaning);
    return false;
}

} // namespace rapidc

#include "tools/rapidc/dap/breakpoint_requests.h"

#include "runtime/base/text_util.h"
#include "stdlib/native_table.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace rapidc::dap {

namespace fs = std::filesystem;

namespace {

std::string normalPath(const std::string& path) {
    return fs::path(path).lexically_normal().string();
}

bool isSameFile(const std::string& a, const std::string& b) {
    if (a == b || normalPath(a) == normalPath(b)) return true;
    std::error_code problem;
    return fs::equivalent(a, b, problem) && !problem;
}

/// Signals are watched by their value, data by their bytes.
std::function<std::string()> readerOf(Context& context, const std::string& name, std::string& problem) {
    rt::Controller& controller = context.controller();
    for (const auto& task : controller.tasks()) {
        const Evaluation found = context.evaluator->find({task.get(), nullptr}, name);
        if (!found.hasValue || !found.value.isPersistent) continue;
        return [value = found.value] { return rt::valueText(value, UINT32_MAX); };
    }
    rt::IoSystem& io = controller.io();
    const rt::SignalId signal = io.find(name);
    if (signal >= 0) return [&io, signal] { return fmt::format("{}", io.value(signal)); };
    problem =
        fmt::format("'{}' is neither a persistent nor a configured signal: only these can be watched", name);
    return {};
}

} // namespace

void BreakpointRequests::addTo(Handlers& handlers) {
    const auto add = registrar(handlers, *this);
    add("setBreakpoints", &BreakpointRequests::setBreakpoints);
    add("setFunctionBreakpoints", &BreakpointRequests::setFunctionBreakpoints);
    add("setDataBreakpoints", &BreakpointRequests::setDataBreakpoints);
    add("dataBreakpointInfo", &BreakpointRequests::dataBreakpointInfo);
    add("setExceptionBreakpoints", &BreakpointRequests::setExceptionBreakpoints);
    add("breakpointLocations", &BreakpointRequests::breakpointLocations);
}

Json BreakpointRequests::exceptionFilters() {
    const char* const condition =
        "Only these: names of errors or their numbers, such as ERR_DIVZERO, ERR_ARGVALERR";
    return Json::array({{{"filter", "unhandled"},
                         {"label", "Unhandled errors"},
                         {"description", "Errors that no ERROR handler takes"},
                         {"default", true},
                         {"supportsCondition", true},
                         {"conditionDescription", condition}},
                        {{"filter", "all"},
                         {"label", "All errors"},
                         {"description", "Errors when they are raised, also those that a handler takes"},
                         {"default", false},
                         {"supportsCondition", true},
                         {"conditionDescription", condition}}});
}

// ---- Setting -------------------------------------------------------------------------------------------------------

BreakpointRequests::Wanted BreakpointRequests::read(const Arguments& arguments) const {
    Wanted wanted;
    wanted.number = ++lastNumber_;
    wanted.condition = arguments.text("condition", "");
    wanted.hitCondition = arguments.text("hitCondition", "");
    wanted.logMessage = arguments.text("logMessage", "");
    return wanted;
}

rt::BreakCondition BreakpointRequests::conditionOf(Wanted& wanted) {
    wanted.rule =
        std::make_shared<BreakRule>(context_, wanted.condition, wanted.hitCondition, wanted.logMessage);
    if (wanted.rule->isPlain()) return {};
    return [rule = wanted.rule](rt::Task& task, rt::Frame* at) { return rule->accepts(task, at); };
}

void BreakpointRequests::set(Wanted& wanted, bool atRoutine) {
    wanted.id = 0;
    wanted.problem.clear();
    if (!context_.program || !context_.evaluator) return;
    rt::Breakpoints& breakpoints = context_.debugger().breakpoints();
    const auto covers = [this, path = wanted.name,
                         known = std::map<std::string, bool>()](const rt::RoutineDesc& routine) mutable {
        if (routine.file == nullptr || *routine.file == '\0') return false;
        const auto [found, isNew] = known.try_emplace(routine.file, false);
        if (isNew && context_.program)
            found->second = isSameFile(context_.program->hostPath(routine.file), path);
        return found->second;
    };
    rt::BreakCondition condition = conditionOf(wanted);
    const rt::Breakpoint made =
        atRoutine ? breakpoints.addRoutine(wanted.name, std::move(condition))
                  : breakpoints.addLine(wanted.name, wanted.line, covers, std::move(condition));
    wanted.id = made.id;
    int32_t task = 0;
    for (const rt::RoutineEntry* entry : context_.controller().tables().routines())
        if (entry->desc == made.routine) task = std::max(entry->task, 0);
    if (made.routine != nullptr || !made.waits) wanted.problem = wanted.rule->problem(task, made.routine);
    if (wanted.problem.empty()) return;
    breakpoints.remove(made.id);
    wanted.id = 0;
}

void BreakpointRequests::setData(Wanted& wanted) {
    wanted.id = 0;
    wanted.problem.clear();
    if (!context_.program || !context_.evaluator) return;
    auto reader = readerOf(context_, wanted.name, wanted.problem);
    if (!reader) return;
    rt::BreakCondition condition = conditionOf(wanted);
    wanted.problem = wanted.rule->problem(0, nullptr);
    if (wanted.problem.empty())
        wanted.id =
            context_.debugger().breakpoints().addData(wanted.name, std::move(reader), std::move(condition));
}

void BreakpointRequests::remove(const Wanted& wanted) {
    if (wanted.id != 0 && context_.program)
        context_.program->controller().debugger().breakpoints().remove(wanted.id);
}

Json BreakpointRequests::setBreakpoints(const Arguments& arguments) {
    const std::string path = context_.pathIn(arguments.object("source"));
    std::vector<Wanted> wanted;
    for (const Arguments& one : arguments.objects("breakpoints")) {
        Wanted& made = wanted.emplace_back(read(one));
        made.line = context_.facts.lineIn(one.number("line"));
    }
    if (!arguments.has("breakpoints"))
        for (const int64_t line : arguments.numbers("lines")) {
            wanted.emplace_back().number = ++lastNumber_;
            wanted.back().line = context_.facts.lineIn(line);
        }
    std::vector<Wanted>& present = lines_[normalPath(path)];
    for (const Wanted& old : present)
        remove(old);
    Json result = Json::array();
    for (Wanted& one : wanted) {
        one.name = path;
        set(one, false);
        result.push_back(describe(one));
    }
    present = std::move(wanted);
    return {{"breakpoints", std::move(result)}};
}

Json BreakpointRequests::setFunctionBreakpoints(const Arguments& arguments) {
    arguments.require("breakpoints");
    std::vector<Wanted> wanted;
    for (const Arguments& one : arguments.objects("breakpoints")) {
        Wanted& made = wanted.emplace_back(read(one));
        made.name = one.text("name");
    }
    for (const Wanted& old : routines_)
        remove(old);
    Json result = Json::array();
    for (Wanted& one : wanted) {
        set(one, true);
        result.push_back(describe(one));
    }
    routines_ = std::move(wanted);
    return {{"breakpoints", std::move(result)}};
}

Json BreakpointRequests::dataBreakpointInfo(const Arguments& arguments) {
    (void)context_.debugger();
    std::string name = arguments.text("name");
    if (arguments.has("variablesReference"))
        name = context_.expressionOf(arguments.number("variablesReference"), name);
    std::string problem;
    const bool known = static_cast<bool>(readerOf(context_, name, problem));
    if (!known) return {{"dataId", nullptr}, {"description", problem}};
    return {{"dataId", name},
            {"description", name},
            {"accessTypes", Json::array({"write"})},
            {"canPersist", true}};
}

Json BreakpointRequests::setDataBreakpoints(const Arguments& arguments) {
    arguments.require("breakpoints");
    std::vector<Wanted> wanted;
    std::vector<std::string> refused;
    for (const Arguments& one : arguments.objects("breakpoints")) {
        Wanted& made = wanted.emplace_back(read(one));
        made.name = one.text("dataId");
        const std::string access = one.text("accessType", "write");
        refused.push_back(access == "write" ? "" : "only access type 'write' is possible");
    }
    for (const Wanted& old : data_)
        remove(old);
    Json result = Json::array();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (refused[i].empty())
            setData(wanted[i]);
        else
            wanted[i].problem = refused[i];
        result.push_back(describe(wanted[i]));
    }
    data_ = std::move(wanted);
    return {{"breakpoints", std::move(result)}};
}

// ---- What the client learns ----------------------------------------------------------------------------------------

const rt::Breakpoint* BreakpointRequests::find(int id) const {
    if (id == 0 || !context_.program) return nullptr;
    for (const rt::Breakpoint& breakpoint : context_.program->controller().debugger().breakpoints().all())
        if (breakpoint.id == id) return &breakpoint;
    return nullptr;
}

Json BreakpointRequests::describe(const Wanted& wanted) const {
    const rt::Breakpoint* made = find(wanted.id);
    const bool data = made == nullptr && wanted.id != 0;
    const bool verified = data || (made != nullptr && made->actualLine != 0);
    Json json{{"id", wanted.number}, {"verified", verified}};
    if (wanted.line > 0) json["line"] = context_.facts.lineOut(wanted.line);
    if (verified && made != nullptr) {
        json["line"] = context_.facts.lineOut(made->actualLine);
        if (Json source = context_.source(made->routine->file); !source.is_null())
            json["source"] = std::move(source);
    }
    if (verified) return json;
    const bool waits = made == nullptr || made->waits;
    json["message"] = !wanted.problem.empty() ? wanted.problem
                      : !context_.program     ? "the program has not been launched yet"
                      : !context_.evaluator   ? "the program runs without debugging"
                      : waits                 ? "no module in program memory has it; it may be loaded later"
                                              : "no instruction at or below this line";
    json["reason"] = wanted.problem.empty() && waits ? "pending" : "failed";
    return json;
}

int BreakpointRequests::numberOf(int id) const {
    const auto in = [id](const std::vector<Wanted>& list) {
        for (const Wanted& wanted : list)
            if (wanted.id == id) return wanted.number;
        return 0;
    };
    for (const auto& [path, list] : lines_)
        if (const int number = in(list); number != 0) return number;
    const int number = in(routines_);
    return number != 0 ? number : in(data_);
}

void BreakpointRequests::changed(const rt::Breakpoint& breakpoint) {
    const auto look = [&](std::vector<Wanted>& list) {
        for (Wanted& wanted : list) {
            if (wanted.id != breakpoint.id) continue;
            int32_t task = 0;
            for (const rt::RoutineEntry* entry : context_.controller().tables().routines())
                if (entry->desc == breakpoint.routine) task = std::max(entry->task, 0);
            if (breakpoint.routine != nullptr)
                wanted.problem = wanted.rule->problem(task, breakpoint.routine);
            context_.client.event("breakpoint", {{"reason", "changed"}, {"breakpoint", describe(wanted)}});
        }
    };
    for (auto& [path, list] : lines_)
        look(list);
    look(routines_);
}

void BreakpointRequests::programMade() {
    if (!context_.evaluator) return;
    const auto tell = [this](const Wanted& wanted) {
        context_.client.event("breakpoint", {{"reason", "changed"}, {"breakpoint", describe(wanted)}});
    };
    for (auto& [path, list] : lines_)
        for (Wanted& wanted : list) {
            set(wanted, false);
            tell(wanted);
        }
    for (Wanted& wanted : routines_) {
        set(wanted, true);
        tell(wanted);
    }
    for (Wanted& wanted : data_) {
        setData(wanted);
        tell(wanted);
    }
    context_.debugger().breakpoints().onChange(
        [this](const rt::Breakpoint& breakpoint) { changed(breakpoint); });
}

Json BreakpointRequests::breakpointLocations(const Arguments& arguments) {
    const std::string path = context_.pathIn(arguments.object("source"));
    const uint32_t first = context_.facts.lineIn(arguments.number("line"));
    const uint32_t last =
        arguments.has("endLine") ? context_.facts.lineIn(arguments.number("endLine")) : first;
    std::map<std::pair<uint32_t, uint32_t>, const rt::StmtDesc*> places;
    for (const rt::RoutineEntry* entry : context_.controller().tables().routines()) {
        const rt::RoutineDesc& routine = *entry->desc;
        if (routine.file == nullptr || *routine.file == '\0') continue;
        if (!isSameFile(context_.program->hostPath(routine.file), path)) continue;
        for (uint32_t s = 0; s < routine.statementCount; ++s) {
            const rt::StmtDesc& statement = routine.statements[s];
            if (statement.canStart != 0 && statement.line >= first && statement.line <= last)
                places[{statement.line, statement.column}] = &statement;
        }
    }
    Json result = Json::array();
    for (const auto& [at, statement] : places)
        result.push_back({{"line", context_.facts.lineOut(at.first)},
                          {"column", context_.facts.columnOut(at.second)},
                          {"endLine", context_.facts.lineOut(statement->endLine)},
                          {"endColumn", context_.facts.columnOut(statement->endColumn)}});
    return {{"breakpoints", std::move(result)}};
}

// ---- Errors --------------------------------------------------------------------------------------------------------

std::vector<std::string> BreakpointRequests::errorsIn(const std::string& condition) {
    std::vector<std::string> errors;
    std::string word;
    for (const char c : condition + " ") {
        if (c != ' ' && c != ',' && c != ';' && c != '\t') {
            word += c;
        } else if (!word.empty()) {
            errors.push_back(rt::upperCase(word));
            word.clear();
        }
    }
    return errors;
}

bool BreakpointRequests::isError(const std::string& word) const {
    if (word.find_first_not_of("0123456789") == std::string::npos) return true;
    const auto table = rt::errorTable();
    if (std::any_of(table.begin(), table.end(),
                    [&](const rt::ErrorEntry& entry) { return entry.name == word; }))
        return true;
    if (!context_.evaluator) return false;
    for (const auto& task :
         context_.controller().tasks()) { // the program's own, which BookErrNo gives a number
        const Evaluation found = context_.evaluator->find({task.get(), nullptr}, word);
        if (found.hasValue && rt::typeName(found.value) == "errnum") return true;
    }
    return false;
}

bool BreakpointRequests::Filter::includes(int number, const Context& context) const {
    if (!on || everyError) return on;
    const std::string name = context.program ? context.program->controller().log().errorName(number) : "";
    return errors.contains(rt::upperCase(name)) || errors.contains(std::to_string(number));
}

std::string BreakpointRequests::addFilter(const std::string& name, const std::string& condition,
                                          Filter& unhandled, Filter& all) const {
    if (name != "unhandled" && name != "all")
        return fmt::format("the filter '{}' is unknown: use 'unhandled' or 'all'", name);
    const std::vector<std::string> errors = errorsIn(condition);
    for (const std::string& error : errors)
        if (!isError(error)) return fmt::format("'{}' is neither the name of an error nor its number", error);
    Filter& filter = name == "all" ? all : unhandled;
    filter.on = true;
    filter.everyError = filter.everyError || errors.empty();
    filter.errors.insert(errors.begin(), errors.end());
    return {};
}

/// The reply has an element for each filter and each option, in this order; they add up.
Json BreakpointRequests::setExceptionBreakpoints(const Arguments& arguments) {
    if (!arguments.has("filterOptions")) arguments.require("filters");
    Filter unhandled, all;
    Json result = Json::array();
    const auto answer = [&](const std::string& problem) {
        Json one{{"verified", problem.empty()}};
        if (!problem.empty()) one["message"] = problem;
        result.push_back(std::move(one));
    };
    for (const std::string& name : arguments.texts("filters"))
        answer(addFilter(name, "", unhandled, all));
    for (const Arguments& option : arguments.objects("filterOptions"))
        answer(addFilter(option.text("filterId"), option.text("condition", ""), unhandled, all));
    for (std::size_t i = arguments.objects("exceptionOptions").size(); i > 0; --i)
        answer("exception options are not supported: use filters");
    unhandled_ = std::move(unhandled);
    all_ = std::move(all);
    return {{"breakpoints", std::move(result)}};
}

} // namespace rapidc::dap

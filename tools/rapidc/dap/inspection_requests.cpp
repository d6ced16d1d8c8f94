#include "tools/rapidc/dap/inspection_requests.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/error_search.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace rapidc::dap {

namespace {

/// "n := 3", "TPWrite \"x\";": instructions, not an expression. In parentheses `:=` gives an optional argument of a function.
bool looksLikeInstructions(std::string_view text) {
    text = rt::trimmed(text);
    if (!text.empty() && text.back() == ';') return true;
    bool inText = false;
    int depth = 0;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] == '"') inText = !inText;
        if (inText) continue;
        if (text[i] == '(') ++depth;
        if (text[i] == ')') --depth;
        if (depth <= 0 && text[i] == ':' && text[i + 1] == '=') return true;
    }
    return false;
}

/// The last instruction may lack its semicolon; words that end a block stand without one.
std::string completed(const std::string& text) {
    const std::string_view trimmed = rt::trimmed(text);
    if (trimmed.empty() || trimmed.back() == ';') return text;
    const std::string_view last = trimmed.substr(trimmed.find_last_of(" \t\r\n") + 1);
    for (const char* word : {"ENDIF", "ENDFOR", "ENDWHILE", "ENDTEST"})
        if (rt::sameName(last, word)) return text;
    return text + "\n;";
}

} // namespace

InspectionRequests::InspectionRequests(Context& context) : context_(context), variables_(context) {
    context.expressionOf = [this](int64_t reference, const std::string& name) {
        return variables_.expressionOf(reference, name);
    };
    context.frameOf = [this](int64_t frame) { return framePlace(frame); };
}

void InspectionRequests::addTo(Handlers& handlers) {
    const auto add = registrar(handlers, *this);
    add("stackTrace", &InspectionRequests::stackTrace);
    add("scopes", &InspectionRequests::scopes);
    add("exceptionInfo", &InspectionRequests::exceptionInfo);
    add("completions", &InspectionRequests::completions);
    add("setExpression", &InspectionRequests::setExpression);
    handlers["variables"] = [this](const Request&, const Arguments& arguments) {
        return std::optional<Json>(variables_.children(arguments));
    };
    handlers["setVariable"] = [this](const Request&, const Arguments& arguments) {
        return std::optional<Json>(variables_.set(arguments));
    };
    handlers["evaluate"] = [this](const Request& request, const Arguments& arguments) {
        return evaluate(request, arguments);
    };
}

void InspectionRequests::forget() {
    frames_.clear();
    variables_.forget();
    error_ = {};
}

// ---- Call stack ----------------------------------------------------------------------------------------------------

InspectionRequests::FrameList& InspectionRequests::framesOf(rt::Task& task) {
    const auto [found, isNew] = frames_.try_emplace(&task);
    if (isNew) {
        if (context_.evaluator->isBusy()) {
            frames_.erase(found);
            throw Refusal("an expression is being evaluated");
        }
        found->second.frames = context_.debugger().frames(task);
        found->second.first = nextFrame_;
        nextFrame_ += static_cast<int64_t>(found->second.frames.size());
    }
    return found->second;
}

Json InspectionRequests::describe(const rt::DebugFrame& frame, int64_t id) const {
    std::string name = frame.place.routine.empty() ? "?" : frame.place.routine;
    if (frame.frame != nullptr) {
        const rt::StmtDesc* statement = rt::statementOf(*frame.frame);
        const int flags = statement != nullptr ? statement->flags : 0;
        if ((flags & rt::kStmtInBackward) != 0)
            name += " (BACKWARD)";
        else if (rt::inErrorHandler(*frame.frame))
            name += " (ERROR)";
        else if ((flags & rt::kStmtInHandler) != 0)
            name += " (UNDO)";
    }
    if (frame.isTrap) name += " (interrupt)";
    Json json = context_.place(frame.place);
    json["id"] = id;
    json["name"] = name;
    if (!json.contains("line")) json["line"] = context_.facts.lineOut(frame.place.line);
    if (!json.contains("column")) json["column"] = context_.facts.columnOut(frame.place.column);
    const rt::StmtDesc* statement = frame.frame != nullptr ? rt::statementOf(*frame.frame) : nullptr;
    if (statement != nullptr && statement->endLine > 0) {
        json["endLine"] = context_.facts.lineOut(statement->endLine);
        json["endColumn"] = context_.facts.columnOut(statement->endColumn);
    }
    json["moduleId"] = frame.place.module;
    return json;
}

Json InspectionRequests::stackTrace(const Arguments& arguments) {
    rt::Task& task = context_.task(arguments.number("threadId"));
    const int64_t start = arguments.number("startFrame", 0);
    const int64_t levels = arguments.number("levels", 0);
    if (start < 0 || levels < 0) throw Refusal("'startFrame' and 'levels' must not be negative");
    context_.requireStop();
    const FrameList& list = framesOf(task);
    const auto size = static_cast<int64_t>(list.frames.size());
    const int64_t end = levels > 0 && levels < size - start ? start + levels : size;
    Json frames = Json::array();
    for (int64_t i = start; i < end; ++i)
        frames.push_back(describe(list.frames[static_cast<std::size_t>(i)], list.first + i));
    return {{"stackFrames", std::move(frames)}, {"totalFrames", size}};
}

Site InspectionRequests::site(const Arguments& arguments) {
    if (!arguments.has("frameId")) {
        rt::Task* task = context_.stopped;
        if (task == nullptr) task = context_.controller().tasks().front().get();
        return {task, nullptr};
    }
    const FramePlace place = framePlace(arguments.number("frameId"));
    return {place.task, place.frame.frame};
}

FramePlace InspectionRequests::framePlace(int64_t id) const {
    for (const auto& [task, list] : frames_) {
        const int64_t place = id - list.first;
        if (place < 0 || place >= static_cast<int64_t>(list.frames.size())) continue;
        const auto index = static_cast<std::size_t>(place);
        return {const_cast<rt::Task*>(task), list.frames[index], index, list.frames.size()};
    }
    throw Refusal(fmt::format("there is no frame {}; frames are valid until the program continues", id));
}

Json InspectionRequests::scopes(const Arguments& arguments) {
    (void)arguments.number("frameId");
    context_.requireStop();
    const Site at = site(arguments);
    return variables_.scopes(*at.task, at.frame);
}

Json InspectionRequests::exceptionInfo(const Arguments& arguments) {
    const rt::Task& task = context_.task(arguments.number("threadId"));
    context_.requireStop();
    if (error_.task != &task) throw Refusal("the task was not stopped by an error");
    const std::string name =
        error_.name.empty() ? (error_.number != 0 ? std::to_string(error_.number) : "error") : error_.name;
    std::string chain;
    for (const rt::SourcePlace& place : task.callChain())
        chain += fmt::format("{} {}:{}\n", place.routine, place.module, place.line);
    return {
        {"exceptionId", name},
        {"description", error_.text},
        {"breakMode", error_.handled ? "always" : "unhandled"},
        {"details",
         {{"message", error_.text}, {"typeName", name}, {"evaluateName", "ERRNO"}, {"stackTrace", chain}}}};
}

// ---- Expressions ---------------------------------------------------------------------------------------------------

Json InspectionRequests::resultOf(const Evaluation& value, const std::string& expression) {
    Json json = variables_.describe(value.value, expression, value.storage);
    json["result"] = json["value"];
    json.erase("value");
    return json;
}

std::optional<Json> InspectionRequests::evaluate(const Request& request, const Arguments& arguments) {
    const std::string text = arguments.text("expression");
    const std::string context = arguments.text("context", "watch");
    if (rt::trimmed(text).empty()) throw Refusal("the expression is empty");
    context_.requireProgram();
    (void)context_.debugger();
    const Site at = site(arguments);
    if (!context_.debugger().standsStill()) {
        const Evaluation found = context_.evaluator->find(at, text);
        if (!found.hasValue) throw Refusal("the program is executing: pause it to evaluate more than a name");
        return resultOf(found, text);
    }
    return evaluateIn(request, at, text, context);
}

std::optional<Json> InspectionRequests::evaluateIn(const Request& request, const Site& at,
                                                   const std::string& text, const std::string& context) {
    Evaluator& evaluator = *context_.evaluator;
    const bool console = context == "repl";
    const bool orders = console && looksLikeInstructions(text);
    if (!orders) {
        const Evaluation found = evaluator.find(at, text);
        if (found.hasValue) return resultOf(found, std::string(rt::trimmed(text)));
    }
    std::string problem;
    const ExpressionKind kind = context == "hover" ? ExpressionKind::Harmless : ExpressionKind::Value;
    const CompiledExpression* code = orders ? nullptr : evaluator.compile(at, text, kind, problem);
    bool isOrder = false;
    if (code == nullptr && console) {
        std::string other;
        code = evaluator.compile(at, completed(text), ExpressionKind::Orders, other);
        isOrder = code != nullptr;
        if (orders || isOrder) problem = other;
    }
    if (code == nullptr) throw Refusal(problem.empty() ? "the text means nothing here" : problem);
    if (at.task->state() == rt::TaskState::Finished)
        throw Refusal(fmt::format("task {} has ended: only names can be evaluated", at.task->name()));
    execute({request, at, code, std::string(rt::trimmed(text)), isOrder});
    return std::nullopt;
}

/// One after the other: each needs the fibre of a task.
void InspectionRequests::execute(Waiting waiting) {
    waiting.number = ++lastWaiting_;
    waiting_.push_back(std::move(waiting));
    if (waiting_.size() == 1) begin();
}

void InspectionRequests::begin() {
    const Waiting& first = waiting_.front();
    context_.evaluator->later(first.site, *first.code, [this, number = first.number](Evaluation result) {
        // Not here, on the stack of the task.
        context_.inbox.post([this, number, result = std::move(result)] {
            if (waiting_.empty() || waiting_.front().number != number) return;
            const Waiting done = std::move(waiting_.front());
            waiting_.pop_front();
            finish(done, result);
            if (!waiting_.empty()) begin();
        });
    });
}

void InspectionRequests::finish(const Waiting& waiting, Evaluation result) {
    if (!result.problem.empty()) {
        context_.client.refuse(waiting.request, result.problem);
    } else if (waiting.isOrder) {
        context_.client.answer(waiting.request, {{"result", ""}, {"variablesReference", 0}});
    } else {
        context_.client.answer(waiting.request, resultOf(result, ""));
    }
}

void InspectionRequests::refuseWaiting() {
    for (const Waiting& waiting : std::exchange(waiting_, {}))
        context_.client.refuse(waiting.request, "the program has ended");
}

Json InspectionRequests::setExpression(const Arguments& arguments) {
    context_.requireStop();
    const std::string text = arguments.text("expression");
    const std::string value = arguments.text("value");
    const Evaluation found = context_.evaluator->find(site(arguments), text);
    if (!found.hasValue)
        throw Refusal(found.problem.empty() ? fmt::format("'{}' cannot be changed", text) : found.problem);
    Variables::assign(found.value, value);
    return variables_.describe(found.value, text);
}

Json InspectionRequests::completions(const Arguments& arguments) {
    const std::string text = arguments.text("text");
    const int64_t column = arguments.number("column") - (context_.facts.columnsStartAt1 ? 1 : 0);
    if (column < 0) throw Refusal("argument 'column' is in front of the text");
    context_.requireStop();
    const Site at = site(arguments);
    std::vector<rt::DebugVariable> data;
    std::string module = at.task->place().module;
    if (at.frame != nullptr) {
        module = at.frame->routine->module;
        data = context_.debugger().locals({rt::placeOf(at.frame), at.frame, false});
    }
    for (rt::DebugVariable& variable : variables_.moduleData(*at.task, module))
        data.push_back(std::move(variable));
    return completionsFor(context_, at, text, static_cast<std::size_t>(column), data);
}

} // namespace rapidc::dap

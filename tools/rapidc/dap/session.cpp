#include "tools/rapidc/dap/session.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/error_search.h"
#include "tools/rapidc/dap/stop_event.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace rapidc::dap {

Session::Session(protocol::Channel& channel, rt::Inbox& inbox, StrayOutput& stray)
    : client_(channel), stray_(stray), context_{client_, inbox, {}, nullptr, nullptr, false, nullptr},
      breakpoints_(context_), inspection_(context_), execution_(context_,
                                                                [this] {
                                                                    inspection_.forget();
                                                                    execution_.forgetTargets();
                                                                    context_.stopped = nullptr;
                                                                }),
      sources_(context_), dialogs_(context_) {
    breakpoints_.addTo(handlers_);
    inspection_.addTo(handlers_);
    execution_.addTo(handlers_);
    sources_.addTo(handlers_);
    dialogs_.addTo(handlers_);
    const auto add = registrar(handlers_, *this);
    add("initialize", &Session::initialize);
    add("configurationDone", &Session::configurationDone);
    handlers_["disconnect"] = [this](const Request& request, const Arguments&) {
        disconnect(request);
        return std::optional<Json>();
    };
    add("terminate", &Session::terminate);
    handlers_["attach"] = [](const Request&, const Arguments&) -> std::optional<Json> {
        throw Refusal("attaching is not possible: use a launch request");
    };
    handlers_["cancel"] = [](const Request&, const Arguments&) { return std::optional<Json>(nullptr); };
    handlers_["launch"] = [this](const Request& request, const Arguments& arguments) {
        return launch(request, arguments);
    };
    handlers_["restart"] = [this](const Request& request, const Arguments& arguments) {
        return restart(request, arguments);
    };
}

Session::~Session() {
    dropProgram();
}

int Session::run() {
    while (!finished_) {
        context_.inbox.wait(-1);
        context_.inbox.run();
        while (startWanted_ && !finished_) {
            startWanted_ = false;
            runProgram();
            carryOutRestart();
        }
        if (client_.hasGone()) finished_ = true;
    }
    if (disconnect_) client_.answer(*disconnect_, nullptr);
    return status_;
}

// ---- Messages ------------------------------------------------------------------------------------------------------

void Session::take(const std::string& message) {
    if (finished_) return;
    if (startWanted_ && !context_.running) { // comes when the program runs
        early_.push_back(message);
        return;
    }
    const Json json = rapid::config::tryParseJson(message);
    Request request;
    if (!json.is_object()) {
        client_.refuse(request, "the message is not a JSON object");
        return;
    }
    const auto text = [&json](const char* name) {
        const auto found = json.find(name);
        return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const std::string type = text("type");
    if (type == "response" || type == "event") return;
    request.command = text("command");
    if (const auto seq = json.find("seq"); seq != json.end() && seq->is_number_integer())
        request.seq = seq->get<int64_t>();
    if (const auto arguments = json.find("arguments"); arguments != json.end())
        request.arguments = *arguments;
    if (type != "request" || request.command.empty()) {
        client_.refuse(request, "the message is not a request");
        return;
    }
    handle(request);
}

void Session::handle(const Request& request) {
    try {
        const auto handler = handlers_.find(request.command);
        if (handler == handlers_.end()) throw Refusal(fmt::format("unknown request '{}'", request.command));
        if (!initialized_ && request.command != "initialize" && request.command != "disconnect")
            throw Refusal("the first request must be initialize");
        if (!request.arguments.is_null() && !request.arguments.is_object())
            throw Refusal("the arguments of the request are not an object");
        std::optional<Json> answer = handler->second(request, Arguments(request.arguments));
        if (answer) client_.answer(request, std::move(*answer));
    } catch (const Refusal& refusal) {
        client_.refuse(request, refusal.what());
    } catch (const std::exception& problem) {
        client_.refuse(request, problem.what());
    }
    showStray();
}

void Session::inputEnded(const std::string& problem) {
    if (!problem.empty()) {
        client_.output("important", "The session ends: " + problem);
        status_ = 1;
    }
    finished_ = true;
    endRun();
}

void Session::showStray() {
    stray_.take([this](std::string_view line) { client_.output("console", line); });
}

// ---- The session ---------------------------------------------------------------------------------------------------

Json Session::capabilities() {
    Json json = Json::object();
    for (const char* name : {"supportsConfigurationDoneRequest",
                             "supportsFunctionBreakpoints",
                             "supportsConditionalBreakpoints",
                             "supportsHitConditionalBreakpoints",
                             "supportsEvaluateForHovers",
                             "supportsStepBack",
                             "supportsSetVariable",
                             "supportsGotoTargetsRequest",
                             "supportsCompletionsRequest",
                             "supportsModulesRequest",
                             "supportsRestartRequest",
                             "supportsRestartFrame",
                             "supportsExceptionOptions",
                             "supportsExceptionInfoRequest",
                             "supportTerminateDebuggee",
                             "supportsDelayedStackTraceLoading",
                             "supportsLoadedSourcesRequest",
                             "supportsLogPoints",
                             "supportsSetExpression",
                             "supportsTerminateRequest",
                             "supportsDataBreakpoints",
                             "supportsBreakpointLocationsRequest",
                             "supportsClipboardContext",
                             "supportsSteppingGranularity",
                             "supportsExceptionFilterOptions",
                             "supportsSingleThreadExecutionRequests",
                             "supportsCancelRequest"})
        json[name] = true;
    json.erase("supportsExceptionOptions");
    json["completionTriggerCharacters"] = Json::array({"."});
    json["exceptionBreakpointFilters"] = BreakpointRequests::exceptionFilters();
    return json;
}

Json Session::initialize(const Arguments& arguments) {
    if (initialized_) throw Refusal("the session has been initialized already");
    (void)arguments.text("clientID", "");
    (void)arguments.text("adapterID", "");
    const std::string format = arguments.text("pathFormat", "path");
    if (format != "path" && format != "uri")
        throw Refusal(fmt::format("there is no path format '{}'", format));
    context_.facts.linesStartAt1 = arguments.flag("linesStartAt1", true);
    context_.facts.columnsStartAt1 = arguments.flag("columnsStartAt1", true);
    context_.facts.usesUris = format == "uri";
    context_.facts.showsProgress = arguments.flag("supportsProgressReporting", false);
    initialized_ = true;
    return capabilities();
}

void Session::progress(bool begins) {
    if (!context_.facts.showsProgress) return;
    if (begins)
        client_.event("progressStart", {{"progressId", "launch"}, {"title", "Compiling the program"}});
    else
        client_.event("progressEnd", {{"progressId", "launch"}});
}

/// Throws a Refusal; then there is no program.
void Session::makeProgram(const LaunchArguments& arguments) {
    progress(true);
    try {
        context_.program = std::make_unique<Program>(arguments, client_, context_.facts, context_.inbox);
    } catch (const Refusal& refusal) {
        progress(false);
        // The controller writes to standard error why it cannot start.
        std::string printed;
        stray_.take([&](std::string_view line) {
            client_.output("stderr", line);
            if (!rt::trimmed(line).empty())
                printed += (printed.empty() ? "" : "; ") + std::string(rt::trimmed(line));
        });
        throw Refusal(printed.empty() ? refusal.what() : fmt::format("{}: {}", refusal.what(), printed));
    }
    progress(false);
    rt::Controller& controller = context_.controller();
    output_ = std::make_unique<ProgramOutput>(context_, [this] { dialogs_.look(); });
    dialogs_.begin(arguments.operatorDialogs);
    sources_.programMade();
    controller.onSleep([this] {
        showStray();
        if (sources_.hasOtherCount()) sources_.look();
    });
    if (!arguments.noDebug) {
        context_.evaluator = std::make_unique<Evaluator>(context_.program->compilation(), controller);
        controller.debugger().setClient(this);
        if (arguments.stopOnEntry) controller.debugger().stopAtEntry();
    }
    breakpoints_.programMade();
}

std::optional<Json> Session::launch(const Request& request, const Arguments& arguments) {
    if (launched_) throw Refusal("a program has been launched already");
    const LaunchArguments wanted = LaunchArguments::from(arguments);
    makeProgram(wanted);
    launched_ = wanted;
    client_.answer(request, nullptr);
    client_.event("initialized", nullptr);
    startWanted_ = configured_;
    return std::nullopt;
}

Json Session::configurationDone(const Arguments&) {
    if (configured_) throw Refusal("the configuration is done already");
    configured_ = true;
    startWanted_ = context_.program != nullptr;
    return nullptr;
}

/// The run comes to its end soon.
void Session::endRun() {
    if (!context_.running) return;
    if (context_.evaluator) context_.evaluator->breakOff();
    context_.controller().debugger().quit();
}

/// Answered when the run has ended.
void Session::disconnect(const Request& request) {
    disconnect_ = request;
    finished_ = true;
    endRun();
}

Json Session::terminate(const Arguments&) {
    context_.requireProgram();
    if (!context_.running) { // launched, not started yet
        startWanted_ = false;
        dropProgram();
        client_.event("terminated", nullptr);
        return nullptr;
    }
    endRun();
    return nullptr;
}

std::optional<Json> Session::restart(const Request& request, const Arguments& arguments) {
    if (!launched_) throw Refusal("no program has been launched");
    if (restart_) throw Refusal("the program is being restarted already");
    LaunchArguments wanted = *launched_;
    if (const Arguments given = arguments.object("arguments"); given.has("program"))
        wanted = LaunchArguments::from(given);
    restart_ = Restart{request, std::move(wanted)};
    if (context_.running)
        endRun();
    else
        carryOutRestart();
    return std::nullopt;
}

void Session::carryOutRestart() {
    if (!restart_) return;
    const Restart wanted = *std::exchange(restart_, std::nullopt);
    if (finished_) {
        client_.refuse(wanted.request, "the session ends");
        return;
    }
    dropProgram();
    try {
        makeProgram(wanted.arguments);
        launched_ = wanted.arguments;
        client_.answer(wanted.request, nullptr);
        startWanted_ = true;
    } catch (const Refusal& refusal) {
        client_.refuse(wanted.request, refusal.what());
        client_.event("terminated", nullptr);
    }
}

void Session::runProgram() {
    context_.running = true;
    for (const std::string& message : std::exchange(early_, {}))
        take(message);
    const int status = static_cast<int>(context_.controller().run());
    context_.running = false;
    sources_.look();
    dialogs_.look();
    inspection_.refuseWaiting();
    inspection_.forget();
    showStray();
    dropProgram();
    if (restart_ || finished_) return;
    client_.event("exited", {{"exitCode", status}});
    client_.event("terminated", nullptr);
}

void Session::dropProgram() {
    context_.stopped = nullptr;
    context_.evaluator.reset();
    dialogs_.end();
    output_.reset();
    context_.hasEnded = context_.hasEnded || context_.program != nullptr;
    context_.program.reset();
}

// ---- Stops ---------------------------------------------------------------------------------------------------------

bool Session::stopsAtError(const rt::Task& task) {
    return breakpoints_.stopsAtError(task.errorNumber);
}

bool Session::stopsAtHandledError(const rt::Task&, int number) {
    return breakpoints_.stopsAtHandledError(number);
}

void Session::stopped(rt::Debugger& debugger, rt::Task& task, rt::StopReason reason) {
    // The program pointer at another routine: that is entered, so that there is a place to show.
    if (reason == rt::StopReason::Pointer && debugger.frames(task).empty() &&
        debugger.enterRoutine(task).empty()) {
        entering_ = true;
        return;
    }
    if (std::exchange(entering_, false) && reason == rt::StopReason::Step) reason = rt::StopReason::Pointer;
    inspection_.forget();
    execution_.forgetTargets();
    context_.stopped = &task;
    showStray();
    sources_.look();
    const bool restarted = execution_.takeRestart() && reason == rt::StopReason::Pointer;
    Json body = stopEvent(reason, task);
    if (restarted) body["reason"] = "restart";
    if (reason == rt::StopReason::Breakpoint || reason == rt::StopReason::Routine ||
        reason == rt::StopReason::Data) {
        Json ids = Json::array();
        for (const int id : debugger.breakpoints().hits())
            if (const int number = breakpoints_.numberOf(id); number != 0) ids.push_back(number);
        body["hitBreakpointIds"] = std::move(ids);
        if (reason == rt::StopReason::Data) body["text"] = debugger.breakpoints().change();
    }
    if (reason == rt::StopReason::Error || reason == rt::StopReason::Raised) {
        StopError error{&task, task.errorNumber, reason == rt::StopReason::Raised,
                        context_.controller().log().errorName(task.errorNumber), task.errorText()};
        body["text"] = error.text;
        if (!error.name.empty())
            body["description"] =
                fmt::format("{}: {}", body["description"].get_ref<const std::string&>(), error.name);
        inspection_.setError(std::move(error));
    }
    client_.event("stopped", std::move(body));
    if (context_.program->arguments().robotEvents) showRobot(task);
}

/// For clients that show the robot; others may ignore it.
void Session::showRobot(rt::Task& task) {
    rt::Controller& controller = context_.controller();
    rt::MotionDriver& motion = controller.motion(task);
    const auto target = motion.system().currentTarget(motion.pointer().command.frames);
    const auto joints = motion.system().currentJoints();
    const auto rounded = [](double value) { return std::round(value * 1000) / 1000 + 0.0; };
    Json axes = Json::array();
    for (const double axis : joints.robax)
        axes.push_back(rounded(axis));
    Json body{{"threadId", Context::threadOf(task)},
              {"time", rt::toSeconds(controller.scheduler().now())},
              {"tcp", {rounded(target.pose.pos.x), rounded(target.pose.pos.y), rounded(target.pose.pos.z)}},
              {"joints", std::move(axes)}};
    const rt::MotionPointer& pointer = motion.pointer();
    if (pointer.valid && pointer.routine != nullptr) {
        const rt::StmtDesc* statement = rt::statementOf(*pointer.routine, pointer.statement);
        if (statement != nullptr) {
            Json place = context_.place({pointer.routine->module, pointer.routine->name,
                                         pointer.routine->file, statement->line, statement->column});
            body["motionPointer"] = std::move(place);
        }
    }
    client_.event("rapidcRobot", std::move(body));
}

} // namespace rapidc::dap

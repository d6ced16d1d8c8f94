#include "tools/rws/execution.h"
#include "tools/rws/request_values.h"

#include "tools/rws/rapid_support.h"
#include "tools/rws/state_watch.h"

#include <algorithm>
#include <array>

namespace rapidc::rws {

namespace {

using service::Change;
using service::ExecutionMode;
using service::StopMode;

constexpr const char* kExecutionPath = "/rw/rapid/execution";

template <class Value> struct Word {
    const char* text;
    Value value;
};
constexpr Word<ExecutionMode> kModes[] = {
    {"continue", ExecutionMode::Continue},    {"stepin", ExecutionMode::StepIn},
    {"stepover", ExecutionMode::StepOver},    {"stepout", ExecutionMode::StepOut},
    {"stepback", ExecutionMode::StepBack},    {"steplast", ExecutionMode::StepLast},
    {"stepmotion", ExecutionMode::StepMotion}};
constexpr Word<StopMode> kStops[] = {{"stop", StopMode::Stop},
                                     {"cycle", StopMode::Cycle},
                                     {"instr", StopMode::Instruction},
                                     {"qstop", StopMode::Quick}};

/// The value of a word; the first one for "". None: there is no such word.
template <class Value, std::size_t N>
std::optional<Value> valueOf(const Word<Value> (&words)[N], const std::string& text) {
    if (text.empty()) return words[0].value;
    for (const Word<Value>& word : words)
        if (text == word.text) return word.value;
    return std::nullopt;
}

/// A field that must have one of these values, or be absent.
bool isOneOf(const Request& request, const char* field, std::initializer_list<const char*> values) {
    const std::string text = request.form.text(field);
    return text.empty() || std::find(values.begin(), values.end(), text) != values.end();
}

const char* stateOf(const service::VirtualController& controller) {
    return controller.isRunning() ? "running" : "stopped";
}

const char* cycleOf(const service::VirtualController& controller) {
    return controller.panel().runOnce ? "once" : "forever";
}

} // namespace

void Execution::addTo(Router& router, Subscribables& subscribables) {
    router.getBoth(kExecutionPath, [this](const Request&) {
        Document document;
        document.add("rap-execution", "execution")
            .value("ctrlexecstate", stateOf(controller_))
            .value("cycle", cycleOf(controller_));
        return Reply::of(std::move(document));
    });
    addOrder(router, kExecutionPath, "start", "start",
             [this](const Request& request) { return start(request); });
    addOrder(router, kExecutionPath, "stop", "stop",
             [this](const Request& request) { return stop(request); });
    addOrder(router, kExecutionPath, "resetpp", "resetpp",
             access_.guarded(Domain::Rapid,
                             [this](const Request&) { return replyTo(controller_.resetPointers()); }));
    addOrder(router, kExecutionPath, "setcycle", "cycle",
             access_.guarded(Domain::Rapid, [this](const Request& request) { return setCycle(request); }));
    addOrder(router, kExecutionPath, "startprodentry", "startprodentry",
             access_.guarded(Domain::Rapid, [this](const Request&) { return startFromMain(); }));
    const Handler hold = [](const Request& request) {
        const std::string state = request.form.text("state");
        if (state != "press" && state != "held" && state != "release")
            return badParameter("state", "press, held or release");
        return Reply::done(); // a program that was started runs without being held
    };
    addOrder(router, kExecutionPath, "holdtorun-state", "holdtorun", hold);
    router.action(kExecutionPath, "holdtorun", hold);
    const auto watch = [this](const char* type, const char* title, Change change, auto read) {
        return [this, type, title, change, read](const Request&, const Changed& changed, Subscription& out) {
            return watchState(
                controller_.observers(), {change},
                [this, type, title, read] {
                    Entry entry;
                    entry.type = type;
                    entry.title = title;
                    entry.value(title, read(controller_));
                    return entry;
                },
                changed, out);
        };
    };
    subscribables.add({kExecutionPath,
                       "ctrlexecstate",
                       false,
                       {},
                       watch("rap-ctrlexecstate-ev", "ctrlexecstate", Change::Execution, stateOf)});
    subscribables.add({kExecutionPath,
                       "rapidexeccycle",
                       false,
                       {},
                       watch("rap-execcycle-ev", "rapidexeccycle", Change::Cycle, cycleOf)});
}

Reply Execution::start(const Request& request) {
    const std::optional<ExecutionMode> mode = valueOf(kModes, request.form.text("execmode"));
    if (!mode)
        return badParameter("execmode",
                            "continue, stepin, stepover, stepout, stepback, steplast or stepmotion");
    if (!isOneOf(request, "regain", {"continue", "regain", "clear", "enterconsume"}))
        return badParameter("regain", "continue, regain, clear or enterconsume");
    if (!isOneOf(request, "cycle", {"forever", "once", "asis"}))
        return badParameter("cycle", "forever, once or asis");
    if (!isOneOf(request, "condition", {"none", "callchain"}))
        return badParameter("condition", "none or callchain");
    if (!isOneOf(request, "stopatbp", {"enabled", "disabled"}))
        return badParameter("stopatbp", "enabled or disabled");
    if (request.form.has("alltaskbytsp") && !flagIn(request.form.text("alltaskbytsp")))
        return badParameter("alltaskbytsp", "true or false");
    const bool before = controller_.panel().runOnce;
    const std::string cycle = request.form.text("cycle");
    const bool once = cycle == "once" || (cycle != "forever" && before);
    if (once != before) (void)controller_.setRunOnce(once);
    const bool stoppedBefore = breakpoints_.setStopping(request.form.text("stopatbp") != "disabled");
    const service::Refusal refusal = controller_.start(*mode);
    if (!refusal.empty()) breakpoints_.setStopping(stoppedBefore);
    if (!refusal.empty() && once != before) (void)controller_.setRunOnce(before);
    return replyTo(refusal, ReturnCode::StartRefused);
}

Reply Execution::stop(const Request& request) {
    const std::optional<StopMode> mode = valueOf(kStops, request.form.text("stopmode"));
    if (!mode) return badParameter("stopmode", "stop, cycle, instr or qstop");
    if (!isOneOf(request, "usetsp", {"normal", "alltsk", "alltask"}))
        return badParameter("usetsp", "normal or alltsk");
    return replyTo(controller_.stop(*mode));
}

Reply Execution::setCycle(const Request& request) {
    const std::string cycle = request.form.text("cycle");
    if (cycle != "forever" && cycle != "once" && cycle != "asis")
        return badParameter("cycle", "forever, once or asis");
    return cycle == "asis" ? Reply::done() : replyTo(controller_.setRunOnce(cycle == "once"));
}

Reply Execution::startFromMain() {
    if (const service::Refusal refusal = controller_.resetPointers(); !refusal.empty())
        return replyTo(refusal);
    return replyTo(controller_.start(ExecutionMode::Continue), ReturnCode::StartRefused);
}

} // namespace rapidc::rws

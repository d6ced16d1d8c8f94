#include "tools/rws/system.h"

#include "config/letter_case.h"
#include "tools/http/url.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"
#include "tools/service/event_journal.h"
#include "tools/service/system_facts.h"

#include <fmt/format.h>

#include <cmath>
#include <ctime>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

constexpr const char* kTime = "/ctrl/virtualtime";
constexpr double kMostSpeed = 100'000; // per cent of the wall clock's pace

} // namespace

System::System(service::VirtualController& controller, const service::FileVolumes& volumes)
    : controller_(controller), volumes_(volumes) {
    service::Observer observer;
    observer.changed = [this](service::Change change, const rt::Task*) {
        if (change == service::Change::Restart) ++restarts_;
        if (change != service::Change::Generation) return;
        facts_.reset();
        rt::Controller& core = controller_.core();
        core.setCalendarSeconds(core.calendarSeconds() + clockOffset_);
    };
    token_ = controller_.observers().add(std::move(observer));
}

System::~System() {
    controller_.observers().remove(token_);
}

const service::SystemFacts& System::facts() const {
    if (!facts_) facts_ = service::systemFacts(controller_);
    return *facts_;
}

// ---- /rw/system ----------------------------------------------------------------------------------------------------

Reply System::system(const Request& request) const {
    const bool isFirst = request.dialect == Dialect::V1;
    const service::RobotWareVersion version =
        service::robotWareVersion(isFirst ? 6 : controller_.settings().robotWare);
    const service::SystemFacts& facts = this->facts();
    Document document;
    Entry& entry = document.add(isFirst ? "sys-system-li" : "sys-system", "system");
    entry.value("major", fmt::format("{}", version.major)).value("minor", fmt::format("{}", version.minor));
    entry.value("build", fmt::format("{}", version.build))
        .value("revision", fmt::format("{}", version.revision));
    entry.value("title", "RobotWare")
        .value("type", "RobotWare")
        .value("description", "Virtual controller of rapidc");
    entry.value("name", facts.name).value("rwversion", version.version).value("rwversionname", version.name);
    entry.value("sysid", facts.id).value("starttm", service::calendarText(facts.startSeconds));
    if (isFirst) {
        for (const std::string& option : facts.options)
            document.add("sys-option-li", option).value("option", option);
        return Reply::of(std::move(document));
    }
    Entry& list = document.add("sys-options-li", "options");
    list.self = "/rw/system/options";
    list.nestedName = "options";
    for (const std::string& option : facts.options) {
        Entry nested;
        nested.type = "sys-options";
        nested.title = option;
        nested.value("option", option);
        list.nested.push_back(std::move(nested));
    }
    return Reply::of(std::move(document));
}

Reply System::options(const Request&) const {
    Document document;
    for (const std::string& option : facts().options)
        document.add("sys-option-li", option).value("option", option);
    return Reply::of(std::move(document));
}

Reply System::products(const Request& request) const {
    const bool isFirst = request.dialect == Dialect::V1;
    const service::RobotWareVersion version =
        service::robotWareVersion(isFirst ? 6 : controller_.settings().robotWare);
    Document document;
    Entry& entry = document.add("sys-product-li", "RobotWare");
    entry.value("product", "RobotWare").value("version-name", version.name).value("version", version.version);
    return Reply::of(std::move(document));
}

namespace {

void describeCode(const ReturnCodeText& text, Entry& entry) {
    entry.value("name", text.symbol).value("code", fmt::format("{}", static_cast<int>(text.code)));
    entry.value("severity", text.severity).value("description", text.text);
}

Reply allReturnCodes() {
    Document document;
    for (const ReturnCodeText& text : returnCodes())
        describeCode(text, document.add("err-desc-li", fmt::format("{}", static_cast<int>(text.code))));
    return Reply::of(std::move(document));
}

} // namespace

Reply System::returnCode(const Request& request) const {
    if (!request.query.has("code")) return allReturnCodes();
    const auto number = numberIn(request.query.text("code"));
    if (!number || std::fabs(*number) > 4e9 || *number != std::floor(*number))
        return badParameter("code", "the number of a return code");
    auto value = static_cast<int64_t>(*number);
    if (value > INT32_MAX) value -= int64_t{1} << 32; // some clients have it without its sign
    const auto found = describe(static_cast<int>(value));
    if (!found)
        return Reply::refuse(ReturnCode::NotFound,
                             fmt::format("there is no return code {}", request.query.text("code")));
    Document document;
    describeCode(*found, document.add("err-desc", fmt::format("{}", value)));
    return Reply::of(std::move(document));
}

void System::addSystem(Router& router) {
    router.getBoth("/rw/system", [this](const Request& r) { return system(r); });
    router.getBoth("/rw/system/options", [this](const Request& r) { return options(r); });
    router.getBoth("/rw/system/products", [this](const Request& r) { return products(r); });
    router.getBoth("/rw/system/license", [](const Request&) {
        return oneValue("sys-license-info", "license", "license", "virtual controller");
    });
    router.getBoth("/rw/system/robottype", [this](const Request&) {
        return oneValue("sys-robottype", "robottype", "robot-type", facts().robotType);
    });
    router.getBoth("/rw/retcode", [this](const Request& r) { return returnCode(r); });
}

// ---- /ctrl ---------------------------------------------------------------------------------------------------------

Reply System::identity(const Request& request, Document::Place place) const {
    const service::SystemFacts& facts = this->facts();
    Document document;
    document.place = place;
    const bool isList = place == Document::Place::Resources; // RWS 2.0: entries of /ctrl
    const std::string ending = isList && request.dialect == Dialect::V2 ? "-li" : "";
    Entry& entry = document.add("ctrl-identity-info" + ending, "identity");
    entry.self = "/ctrl/identity";
    entry.value("ctrl-name", facts.name)
        .value("ctrl-id", facts.name)
        .value("ctrl-type", "Virtual Controller");
    entry.value("ctrl-mac", "00-00-00-00-00-00").value("ctrl-level", "Virtual");
    if (isList) {
        Entry& clock = document.add("ctrl-clock-info" + ending, "clock");
        clock.self = "/ctrl/clock";
        clock.value("datetime", service::calendarText(controller_.core().calendarSeconds()));
    }
    return Reply::of(std::move(document));
}

Reply System::clock(const Request&) const {
    return oneValue("ctrl-clock-info", "clock", "datetime",
                    service::calendarText(controller_.core().calendarSeconds()));
}

Reply System::setClock(const Request& request) {
    int64_t parts[6] = {};
    const auto form = http::parseFields(request.body); // bodies of PUT are not read as forms
    const auto textOf = [&](const char* name) {
        if (form)
            for (const auto& [field, value] : *form)
                if (sameName(field, name)) return value;
        return fieldOf(request, name);
    };
    struct Part {
        const char* field;
        int64_t least, most;
    };
    constexpr Part kParts[6] = {{"sys-clock-year", 1970, 2100}, {"sys-clock-month", 1, 12},
                                {"sys-clock-day", 1, 31},       {"sys-clock-hour", 0, 23},
                                {"sys-clock-min", 0, 59},       {"sys-clock-sec", 0, 59}};
    for (std::size_t i = 0; i < 6; ++i) {
        const auto value = wholeIn(textOf(kParts[i].field), kParts[i].least, kParts[i].most);
        if (!value)
            return badParameter(kParts[i].field, fmt::format("{} to {}", kParts[i].least, kParts[i].most));
        parts[i] = *value;
    }
    std::tm time{};
    time.tm_year = static_cast<int>(parts[0] - 1900);
    time.tm_mon = static_cast<int>(parts[1] - 1);
    time.tm_mday = static_cast<int>(parts[2]);
    time.tm_hour = static_cast<int>(parts[3]);
    time.tm_min = static_cast<int>(parts[4]);
    time.tm_sec = static_cast<int>(parts[5]);
    const auto seconds = static_cast<int64_t>(::timegm(&time));
    if (time.tm_mday != parts[2]) return badParameter("sys-clock-day", "a day that the month has");
    rt::Controller& core = controller_.core();
    clockOffset_ += seconds - core.calendarSeconds();
    core.setCalendarSeconds(seconds);
    facts_.reset();
    return Reply::done();
}

Reply System::restart(const Request& request) {
    const std::string mode = fieldOf(request, "restart-mode");
    for (const char* warm : {"", "restart", "wstart"})
        if (sameName(mode, warm)) return replyTo(controller_.orderRestart(service::RestartMode::Warm));
    for (const char* cold : {"istart", "pstart", "bstart", "xstart"})
        if (sameName(mode, cold)) return replyTo(controller_.orderRestart(service::RestartMode::Cold));
    return badParameter("restart-mode", "restart, istart, pstart, bstart or xstart");
}

/// `_value` (RWS 2.0: `value`): a path after /fileservice/, of $LANGUAGE the language of the event log.
Reply System::environment(const Request& request) const {
    const std::string name = request.parameter("name");
    const char* const value = request.dialect == Dialect::V1 ? "_value" : "value";
    if (sameName(name, "$LANGUAGE")) return oneValue("ctrl-env", "$LANGUAGE", value, "en");
    if (!name.starts_with('$') || !volumes_.has(name))
        return Reply::refuse(ReturnCode::NotFound,
                             fmt::format("there is no resource or environment variable {}", name));
    const std::string title = "$" + rapid::config::upperCase(name.substr(1));
    return oneValue("ctrl-env", title.c_str(), value, title);
}

void System::addControl(Router& router) {
    router.getBoth("/ctrl", [this](const Request& r) { return identity(r, Document::Place::Resources); });
    router.getBoth("/ctrl/identity",
                   [this](const Request& r) { return identity(r, Document::Place::State); });
    router.getBoth("/ctrl/clock", [this](const Request& r) { return clock(r); });
    router.addBoth({Method::Put, "/ctrl/clock", {}, [this](const Request& r) { return setClock(r); }});
    router.getBoth("/ctrl/clock/timezone",
                   [](const Request&) { return oneValue("ctrl-timezone", "timezone", "timezone", "UTC"); });
    router.getBoth("/ctrl/{name}", [this](const Request& r) { return environment(r); });
    router.getBoth("/ctrl/options", [](const Request&) { return Reply::done(); });
    router.getBoth("/ctrl/options/{option}", [this](const Request& request) {
        const std::string wanted = request.parameter("option");
        for (const std::string& option : facts().options)
            if (sameName(option, wanted)) return oneValue("ctrl-option", option.c_str(), "option", option);
        return Reply::refuse(ReturnCode::NotFound, "the system does not have the option " + wanted);
    });
    router.post(Dialect::V2, "/ctrl/restart", [this](const Request& r) { return restart(r); });
    router.action("/ctrl", "restart", [this](const Request& r) { return restart(r); });
    router.get(Dialect::V2, "/ctrl/restart/restartcount", [this](const Request&) {
        return oneValue("ctrl-restart-count", "restartcount", "restart-count", fmt::format("{}", restarts_));
    });
}

// ---- Virtual time --------------------------------------------------------------------------------------------------

Reply System::setTimeState(const Request& request) {
    const bool isOld = request.form.has("vtstate"); // as RWS 1.0 documents it
    const std::string state = request.form.text(isOld ? "vtstate" : "vtcurrstate");
    const bool runs = sameName(state, isOld ? "VTFREERUN" : "running");
    if (!runs && !sameName(state, isOld ? "VTSTOP" : "stopped"))
        return badParameter(isOld ? "vtstate" : "vtcurrstate",
                            isOld ? "VTFREERUN or VTSTOP" : "running or stopped");
    controller_.setTimeRunning(runs);
    return Reply::done();
}

Reply System::setTimeSpeed(const Request& request) {
    const auto speed = numberIn(fieldOf(request, request.form.has("vtspeed") ? "vtspeed" : "vtcurrspeed"));
    if (!speed || *speed < 0 || *speed > kMostSpeed)
        return badParameter("vtcurrspeed", "per cent of the wall clock's pace; 0: as fast as possible");
    controller_.setPace(static_cast<int>(std::lround(*speed)));
    return Reply::done();
}

void System::addVirtualTime(Router& router) {
    const std::string base = kTime;
    router.getBoth(base, [](const Request&) {
        return folder({{"ctrl-vttime-li", "/ctrl/virtualtime/vttime"},
                       {"ctrl-vtstate-li", "/ctrl/virtualtime/vtstate"},
                       {"ctrl-vtspeed-li", "/ctrl/virtualtime/vtspeed"},
                       {"ctrl-vttimeslice-li", "/ctrl/virtualtime/vttimeslice"}});
    });
    router.getBoth(base + "/vttime", [this](const Request&) {
        const int64_t milliseconds = controller_.core().scheduler().now() / rt::kMillisecond;
        return oneValue("ctrl-vttime", "vttime", "vtcounter", fmt::format("{}", milliseconds));
    });
    router.getBoth(base + "/vtstate", [this](const Request&) {
        return oneValue("ctrl-vtstate", "vtstate", "vtcurrstate",
                        controller_.isTimeRunning() ? "running" : "stopped");
    });
    router.getBoth(base + "/vtspeed", [this](const Request&) {
        return oneValue("ctrl-vtspeed", "vtspeed", "vtcurrspeed", fmt::format("{}", controller_.pace()));
    });
    router.getBoth(base + "/vttimeslice", [this](const Request&) {
        const service::CycleCount& cycles = controller_.cycles(); // besides what controllers say
        Document document;
        document.add("ctrl-vttimeslice", "vttimeslice")
            .value("vttimeslice", "4")
            .value("cycles", fmt::format("{}", cycles.cycles))
            .value("missed-cycles", fmt::format("{}", cycles.missed))
            .value("latest-cycle",
                   fmt::format("{:.3f}", static_cast<double>(cycles.latest) / rt::kMillisecond));
        return Reply::of(std::move(document));
    });
    const auto state = [this](bool running) {
        return [this, running](const Request&) {
            controller_.setTimeRunning(running);
            return Reply::done();
        };
    };
    router.action(base + "/vtstate", "run", state(true));
    router.action(base + "/vtstate", "pause", state(false));
    router.action(base + "/vtrun", "", state(true));
    router.postBoth(base + "/vtstate", [this](const Request& r) { return setTimeState(r); });
    router.action(base + "/vtspeed", "set", [this](const Request& r) { return setTimeSpeed(r); });
    router.postBoth(base + "/vtspeed", [this](const Request& r) { return setTimeSpeed(r); });
    const Handler slice = [](const Request& request) { // the cycle of motion is what it is
        const auto value = numberIn(fieldOf(request, "vttimeslice"));
        if (!value || *value <= 0) return badParameter("vttimeslice", "milliseconds");
        return *value == 4 ? Reply::done() : Reply::refuse(ReturnCode::Rejected, "the time slice is 4 ms");
    };
    router.action(base + "/vttimeslice", "set", slice);
    router.postBoth(base + "/vttimeslice", slice);
}

void System::addTo(Router& router, Subscribables&) {
    addSystem(router);
    addControl(router);
    addVirtualTime(router);
}

} // namespace rapidc::rws

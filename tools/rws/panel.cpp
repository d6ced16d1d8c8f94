#include "tools/rws/panel.h"
#include "tools/rws/request_values.h"

#include "tools/rws/rapid_support.h"
#include "tools/rws/state_watch.h"

#include <algorithm>
#include <cctype>

namespace rapidc::rws {

namespace {

using service::Change;
using service::MotorState;
using service::OperatingMode;

const char* textOf(MotorState state) {
    switch (state) {
    case MotorState::Init: return "init";
    case MotorState::On: return "motoron";
    case MotorState::Off: return "motoroff";
    case MotorState::GuardStop: return "guardstop";
    case MotorState::EmergencyStop: return "emergencystop";
    case MotorState::EmergencyStopReset: return "emergencystopreset";
    case MotorState::SystemFailure: break;
    }
    return "sysfail";
}

const char* textOf(OperatingMode mode) {
    switch (mode) {
    case OperatingMode::Auto: return "AUTO";
    case OperatingMode::ManualReduced: return "MANR";
    case OperatingMode::ManualFull: break;
    }
    return "MANF";
}

/// A value of the panel: its resource, the word in its classes and the name of its span.
struct Value {
    const char *word, *span;
    std::string (*read)(service::VirtualController&);
};
constexpr Value kMotors{"ctrlstate", "ctrlstate", [](service::VirtualController& controller) {
                            return std::string(textOf(controller.panel().motors));
                        }};
constexpr Value kMode{"opmode", "opmode", [](service::VirtualController& controller) {
                          return std::string(textOf(controller.panel().mode));
                      }};
constexpr Value kSpeed{"speedratio", "speedratio", [](service::VirtualController& controller) {
                           return std::to_string(controller.panel().speedRatio);
                       }};
/// A collision stops the program with an event; no state remains.
constexpr Value kCollision{"coldetstate", "coldetstate",
                           [](service::VirtualController&) { return std::string("INIT"); }};

Entry entryOf(service::VirtualController& controller, const Value& value, const char* suffix) {
    Entry entry;
    entry.type = std::string("pnl-") + value.word + suffix;
    entry.title = value.word;
    entry.value(value.span, value.read(controller));
    return entry;
}

} // namespace

void Panel::addTo(Router& router, Subscribables& subscribables) {
    const auto show = [&](Dialect dialect, const char* name, const Value& value) {
        router.get(dialect, std::string("/rw/panel/") + name, [this, value](const Request&) {
            Document document;
            document.entries.push_back(entryOf(controller_, value, ""));
            return Reply::of(std::move(document));
        });
    };
    show(Dialect::V1, "ctrlstate", kMotors);
    show(Dialect::V2, "ctrl-state", kMotors);
    show(Dialect::V1, "opmode", kMode);
    for (const Dialect dialect : {Dialect::V1, Dialect::V2}) {
        show(dialect, "speedratio", kSpeed);
        show(dialect, "coldetstate", kCollision);
    }
    router.get(Dialect::V1, "/rw/panel", [](const Request&) {
        return folder({{"pnl-ctrlstate-li", "panel/ctrlstate"},
                       {"pnl-opmode-li", "panel/opmode"},
                       {"pnl-speedratio-li", "panel/speedratio"},
                       {"pnl-coldetstate-li", "panel/coldetstate"}});
    });
    router.get(Dialect::V2, "/rw/panel", [](const Request&) {
        return folder({{"pnl-ctrlstate-li", "panel/ctrl-state"},
                       {"pnl-opmode-li", "panel/opmode"},
                       {"pnl-speedratio-li", "panel/speedratio"},
                       {"pnl-coldetstate-li", "panel/coldetstate"}});
    });
    const Handler motors = [this](const Request& request) { return setMotors(request); };
    router.action("/rw/panel/ctrlstate", "setctrlstate", motors);
    router.post(Dialect::V2, "/rw/panel/ctrl-state", motors);
    router.post(Dialect::V2, "/rw/panel/ctrl-state/keyless-motoron",
                [this](const Request&) { return replyTo(controller_.setMotors(true)); });
    const Handler speed =
        access_.guarded(Domain::Rapid, [this](const Request& request) { return setSpeedRatio(request); });
    router.action("/rw/panel/speedratio", "setspeedratio", speed);
    router.post(Dialect::V2, "/rw/panel/speedratio", speed);
    router.action("/rw/panel", "restart", [this](const Request& request) { return restart(request); });
    router.get(Dialect::V2, "/rw/panel/enreq", [this](const Request&) {
        Document document;
        document.add("pnl-enreq", "enreq")
            .value("state", controller_.panel().motors == MotorState::On ? "on" : "off");
        return Reply::of(std::move(document));
    });
    addMode(router);
    addStops(router);
    subscribe(subscribables);
}

void Panel::addMode(Router& router) {
    const Handler mode = [this](const Request& request) { return setMode(request); };
    router.postBoth("/rw/panel/opmode", mode);
    router.action("/rw/panel/opmode", "setopmode", mode);
    addOrder(router, "/rw/panel/opmode", "acknowledge", "acknowledge", mode);
    addOrder(router, "/rw/panel/opmode", "lock", "lock",
             [this](const Request& request) { return lock(request); });
    addOrder(router, "/rw/panel/opmode", "unlock", "unlock", [this](const Request&) {
        locked_ = false;
        return Reply::done();
    });
    // Clients of RWS 2.0 take the first of several entries: the second one leads to the lock.
    router.get(Dialect::V2, "/rw/panel/opmode", [this](const Request&) {
        Document document;
        document.entries.push_back(entryOf(controller_, kMode, ""));
        document.add("pnl-opmode-lockstate-li", "lock-state").self = "/rw/panel/opmode/lock-state";
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, "/rw/panel/opmode/lock-state", [this](const Request&) {
        Document document;
        document.add("pnl-opmode-lockstate-li", "lock-state")
            .value("lockstate", locked_ ? "locked" : "unlocked");
        return Reply::of(std::move(document));
    });
}

void Panel::addStops(Router& router) {
    using Controller = service::VirtualController;
    const auto chain = [&](const char* name, void (Controller::*order)(bool)) {
        router.post(Dialect::V2, std::string("/rw/panel/") + name,
                    [this, order](const Request& request) { return setChain(request, order); });
    };
    chain("emergency-stop", &Controller::pressEmergencyStop);
    chain("external-emergency-stop", &Controller::pressEmergencyStop);
    chain("general-stop", &Controller::openSafeguard);
    chain("auto-stop", &Controller::openSafeguard);
    router.post(Dialect::V2, "/rw/panel/enable-switch", [](const Request& request) {
        if (!flagIn(request.form.text("state"))) return badParameter("state", "on or off");
        return Reply::done(); // motors are switched on by ctrl-state, in every mode
    });
    const Handler language = [](const Request& request) {
        const std::string code = request.form.text("lang-code");
        if (code.empty() || code.size() > 8) return badParameter("lang-code", "a language such as en");
        return Reply::done();
    };
    router.action("/rw/panel", "setlang", language);
    router.post(Dialect::V2, "/rw/panel/lang", language);
}

void Panel::subscribe(Subscribables& subscribables) {
    const auto add = [&](const char* name, const char* resource, std::optional<Dialect> only,
                         const Value& value, Change change) {
        subscribables.add({std::string("/rw/panel/") + name, resource, false, only,
                           [this, value, change](const Request&, const Changed& changed, Subscription& out) {
                               return watchState(
                                   controller_.observers(), {change},
                                   [this, value] { return entryOf(controller_, value, "-ev"); }, changed,
                                   out);
                           }});
    };
    add("ctrlstate", "", Dialect::V1, kMotors, Change::MotorState);
    add("ctrl-state", "", Dialect::V2, kMotors, Change::MotorState);
    add("ctrl-state", "ctrlstate", Dialect::V2, kMotors,
        Change::MotorState); // some clients keep the old word
    add("opmode", "", std::nullopt, kMode, Change::OperatingMode);
    add("speedratio", "", std::nullopt, kSpeed, Change::SpeedRatio);
    add("coldetstate", "", std::nullopt, kCollision, Change::MotorState);
}

Reply Panel::setMotors(const Request& request) {
    const std::string state = request.form.text("ctrl-state");
    if (state != "motoron" && state != "motoroff") return badParameter("ctrl-state", "motoron or motoroff");
    return replyTo(controller_.setMotors(state == "motoron"));
}

Reply Panel::setMode(const Request& request) {
    const std::string mode = request.form.text("opmode");
    if (mode != "auto" && mode != "man" && mode != "manfs" && mode != "manf")
        return badParameter("opmode", "auto, man, manfs or manf");
    if (locked_) return Reply::refuse(ReturnCode::Rejected, "The operating mode is locked");
    const OperatingMode wanted = mode == "auto"  ? OperatingMode::Auto
                                 : mode == "man" ? OperatingMode::ManualReduced
                                                 : OperatingMode::ManualFull;
    return replyTo(controller_.setMode(wanted));
}

Reply Panel::setSpeedRatio(const Request& request) {
    const std::string text = request.form.text("speed-ratio");
    // some clients write 50.0
    const std::size_t point = text.find('.');
    const bool isWhole =
        point == std::string::npos || text.find_first_not_of('0', point + 1) == std::string::npos;
    const auto ratio = wholeIn(std::string_view(text).substr(0, point), 0, 100);
    if (!ratio || !isWhole) return badParameter("speed-ratio", "a whole number from 0 to 100");
    return replyTo(controller_.setSpeedRatio(static_cast<int>(*ratio)));
}

Reply Panel::lock(const Request& request) {
    const std::string pin = request.form.text("pin");
    const bool isPin = !pin.empty() && pin.size() <= 8 && std::all_of(pin.begin(), pin.end(), [](char c) {
        return std::isdigit(static_cast<unsigned char>(c)) != 0;
    });
    if (!isPin) return badParameter("pin", "up to 8 digits");
    locked_ = true;
    return Reply::done();
}

Reply Panel::restart(const Request& request) {
    const std::string mode = request.form.text("restart-mode");
    if (mode == "restart" || mode.empty())
        return replyTo(controller_.orderRestart(service::RestartMode::Warm));
    if (mode != "istart" && mode != "pstart" && mode != "bstart")
        return badParameter("restart-mode", "restart, istart, pstart or bstart");
    return replyTo(controller_.orderRestart(service::RestartMode::Cold));
}

Reply Panel::setChain(const Request& request, void (service::VirtualController::*order)(bool)) {
    const std::string state = request.form.text("state");
    const bool opens = state == "off" || state == "active", closes = state == "on" || state == "reset";
    if (!opens && !closes) return badParameter("state", "off (engages the stop) or on (releases it)");
    (controller_.*order)(opens);
    // after a release the motors can be switched on again
    if (closes && controller_.panel().motors == MotorState::EmergencyStopReset)
        (void)controller_.setMotors(false);
    return Reply::done();
}

} // namespace rapidc::rws

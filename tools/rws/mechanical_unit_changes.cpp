// Changes of the motion system: active tool and the like, supervision, lead-through, teleport, jogging.

#include "config/letter_case.h"
#include "tools/rws/mechanical_units.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using service::UnitChoice;

constexpr std::array<const char*, 9> kJogModes = {"AxisGroup1",       "AxisGroup2", "Joint",
                                                  "Cartesian",        "Linear",     "Reorient",
                                                  "ConfigurationJog", "GoToPos",    "Align"};
constexpr std::array<const char*, 4> kCoordinates = {"World", "Base", "Tool", "Wobj"};

/// Takes the spelling of the table; false when the text is none of it.
template <std::size_t Count>
bool takeWord(const std::array<const char*, Count>& words, const std::string& text, std::string& out) {
    for (const char* word : words) {
        if (!sameName(word, text)) continue;
        out = word;
        return true;
    }
    return false;
}

/// Steps of inc-mode: mm of the TCP, and degrees.
struct Increment {
    const char* name;
    double line, turn;
};
constexpr std::array<Increment, 3> kIncrements = {
    {{"Small", 0.05, 0.005}, {"Medium", 1, 0.02}, {"Large", 5, 0.2}}};

} // namespace

Handler MechanicalUnits::forUnit(Reply (MechanicalUnits::*handler)(const Request&, const Unit&)) {
    return [this, handler](const Request& request) {
        const Unit* unit = unitOf(request);
        return unit == nullptr ? noUnit(request) : (this->*handler)(request, *unit);
    };
}

Handler MechanicalUnits::changing(Reply (MechanicalUnits::*handler)(const Request&, const Unit&)) {
    return access_.guarded(Domain::Motion, forUnit(handler));
}

Reply MechanicalUnits::choose(const Request& request, const Unit& unit) {
    UnitChoice choice = manual_.choice(unit);
    bool isGiven = false;
    const auto take = [&](const char* field, std::string& to) {
        if (!request.form.has(field)) return;
        to = request.form.text(field);
        isGiven = true;
    };
    take("tool", choice.tool);
    take("wobj", choice.workObject);
    take("payload", choice.payload);
    take("total-payload", choice.totalPayload);
    if (const std::string mode = request.form.text("jog-mode"); !mode.empty()) {
        if (!takeWord(kJogModes, mode, choice.jogMode))
            return badParameter("jog-mode", "AxisGroup1, AxisGroup2, Cartesian ..");
        isGiven = true;
    }
    if (const std::string system = request.form.text("coord-system"); !system.empty()) {
        if (!takeWord(kCoordinates, sameName(system, "Word") ? "World" : system, choice.coordinateSystem))
            return badParameter("coord-system", "World, Base, Tool or Wobj");
        isGiven = true;
    }
    if (const std::string mode = request.form.text("mode"); !mode.empty()) {
        const bool active = sameName(mode, "Activated");
        if (!active && !sameName(mode, "Deactivated"))
            return badParameter("mode", "Activated or Deactivated");
        if (const service::Refusal refusal = manual_.setActive(unit, active); !refusal.empty())
            return Reply::refuse(ReturnCode::Rejected, refusal);
        isGiven = true;
    }
    if (!isGiven) return badParameter("tool", "tool, wobj, payload, total-payload, jog-mode or coord-system");
    return replyTo(manual_.choose(unit, std::move(choice)), ReturnCode::BadParameter);
}

Reply MechanicalUnits::setMotionSupervision(const Request& request, const Unit& unit) {
    UnitChoice choice = manual_.choice(unit);
    const std::string mode = fieldOf(request, "mode"), sensitivity = fieldOf(request, "sensitivity");
    if (!mode.empty()) {
        const auto on = flagIn(mode);
        if (!on) return badParameter("mode", "ON or OFF");
        choice.motionSupervision = *on;
    }
    if (!sensitivity.empty()) {
        const auto level = wholeIn(sensitivity, 0, 300);
        if (!level) return badParameter("sensitivity", "0 to 300 per cent");
        choice.motionSensitivity = static_cast<int>(*level);
    }
    if (mode.empty() && sensitivity.empty()) return badParameter("mode", "ON or OFF");
    return replyTo(manual_.choose(unit, std::move(choice)));
}

Reply MechanicalUnits::setPathSupervision(const Request& request, const Unit& unit) {
    UnitChoice choice = manual_.choice(unit);
    const std::string mode = fieldOf(request, "mode"), text = fieldOf(request, "level");
    const auto on = flagIn(mode);
    const auto level = wholeIn(text, 0, 300);
    if (mode.empty() && text.empty()) return badParameter("mode", "ON or OFF");
    if ((!mode.empty() && !on) || (!text.empty() && !level))
        return badParameter("mode", "ON or OFF; level from 0 to 300");
    if (on) choice.pathSupervision = *on;
    if (level) choice.pathSensitivity = static_cast<int>(*level);
    return replyTo(manual_.choose(unit, std::move(choice)));
}

Reply MechanicalUnits::setLeadThrough(const Request& request, const Unit& unit) {
    const std::string status = fieldOf(request, "status");
    if (!sameName(status, "active") && !sameName(status, "inactive"))
        return badParameter("status", "active or inactive");
    if (!unit.isRobot)
        return Reply::refuse(ReturnCode::Rejected, fmt::format("{} is not a robot", unit.name));
    if (sameName(status, "active") && controller_.isRunning())
        return Reply::refuse(ReturnCode::Rejected, "the program is executing: stop it first");
    UnitChoice choice = manual_.choice(unit);
    choice.leadThrough = sameName(status, "active");
    return replyTo(manual_.choose(unit, std::move(choice)));
}

Reply MechanicalUnits::teleport(const Request& request, const Unit& unit) {
    const robot::Kinematics& kinematics = manual_.motionOf(unit).system().kinematics();
    auto arm = numbersIn(fieldOf(request, "rob_joint"), 6);
    const auto external = numbersIn(fieldOf(request, "ext_joint"), 6);
    if (!arm) arm = numbersIn(fieldOf(request, "rob_joint"), 7);
    if (!arm || !external)
        return badParameter("rob_joint and ext_joint",
                            "[a1,..,a6] and [a,..,f], degrees or mm, 9E9 for no axis");
    return replyTo(manual_.teleport(unit, service::jointsFrom(kinematics, *arm, *external)));
}

// ---- Jogging -------------------------------------------------------------------------------------------------------

Reply MechanicalUnits::setJogUnit(const Request& request) {
    jogUnit_.clear();
    const Unit* unit = unitOf(request);
    if (unit == nullptr) return noUnit(request);
    jogUnit_ = unit->name;
    return Reply::done();
}

/// The directions of a jog mode; axes are shares from -1 to 1.
void MechanicalUnits::direct(const Unit& unit, const std::string& mode, const std::array<double, 7>& axes,
                             rt::JogOrder& order) const {
    if (mode == "Reorient") {
        const bool isShort = axes[3] == 0 && axes[4] == 0 && axes[5] == 0;
        order.turn =
            isShort ? motion::Vec3{axes[0], axes[1], axes[2]} : motion::Vec3{axes[3], axes[4], axes[5]};
    } else if (mode == "Cartesian" || mode == "Linear") {
        order.line = {axes[0], axes[1], axes[2]};
        if (mode == "Cartesian") order.turn = {axes[3], axes[4], axes[5]};
    } else if (unit.isRobot) {
        const robot::Kinematics& kinematics = manual_.motionOf(unit).system().kinematics();
        for (std::size_t i = 0; i < kinematics.jointCount(); ++i)
            order.joints[i] = axes[static_cast<std::size_t>(kinematics.axisNumber(i) - 1)];
    } else {
        for (std::size_t i = 0; i < unit.own.size() && i < axes.size(); ++i)
            if (unit.own[i].index < order.external.size()) order.external[unit.own[i].index] = axes[i];
    }
    const std::string& system = manual_.choice(unit).coordinateSystem;
    order.frame = sameName(system, "Base")   ? rt::JogFrame::Base
                  : sameName(system, "Tool") ? rt::JogFrame::Tool
                  : sameName(system, "Wobj") ? rt::JogFrame::WorkObject
                                             : rt::JogFrame::World;
}

/// A reply when the request makes no sense.
std::optional<Reply> MechanicalUnits::readJog(const Request& request, const Unit& unit,
                                              rt::JogOrder& order) const {
    std::array<double, 7> axes{};
    bool isGiven = false;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::string field = fmt::format("axis{}", i + 1), text = fieldOf(request, field);
        const auto value = numberIn(text);
        if (!text.empty() && (!value || std::fabs(*value) > 1e6)) return badParameter(field, "a number");
        axes[i] = value.value_or(0);
        isGiven = isGiven || value;
    }
    if (!isGiven) return badParameter("axis1", "speeds axis1 to axis6");
    if (const std::string count = fieldOf(request, "ccount"); !count.empty() && !numberIn(count))
        return badParameter("ccount", "a number");
    std::string mode = fieldOf(request, "jogmode"), known;
    if (mode.empty()) mode = manual_.choice(unit).jogMode;
    if (!takeWord(kJogModes, mode, known) || known == "ConfigurationJog")
        return badParameter("jogmode",
                            "AxisGroup1, AxisGroup2, Joint, Cartesian, Linear, Reorient, Align or GoToPos");
    const std::string speedText = fieldOf(request, "cjogspeed"), increment = fieldOf(request, "inc-mode");
    const auto speed = numberIn(speedText);
    if (!speedText.empty() && (!speed || *speed < 0 || *speed > 100))
        return badParameter("cjogspeed", "0 to 100 per cent");
    const bool steps = !increment.empty() && !sameName(increment, "None") && !sameName(increment, "User");
    const auto* step = std::find_if(kIncrements.begin(), kIncrements.end(),
                                    [&](const Increment& each) { return sameName(each.name, increment); });
    if (steps && step == kIncrements.end()) return badParameter("inc-mode", "Small, Medium, Large or User");
    for (double& axis : axes) {
        if (steps)
            axis = axis > 0 ? 1 : axis < 0 ? -1 : 0;
        else
            axis = speed ? std::clamp(axis, -1.0, 1.0) * *speed / 100 : std::clamp(axis / 1000, -1.0, 1.0);
    }
    direct(unit, known, axes, order);
    if (order.isLinear() && !unit.isRobot) return badParameter("jogmode", "Joint: the unit has no TCP");
    const bool isLine = order.line.x != 0 || order.line.y != 0 || order.line.z != 0;
    if (steps) order.increment = isLine ? step->line : step->turn;
    return std::nullopt;
}

/// axis1 .. axis6: per mille of the speed of jogging; with cjogspeed (per cent) signs and shares of it. They last for 0.3 s unless they
/// are repeated; zeros stop. With inc-mode one step in each direction given.
Reply MechanicalUnits::jog(const Request& request, const Unit& unit) {
    rt::JogOrder order;
    if (auto reply = readJog(request, unit, order)) return std::move(*reply);
    std::string mode = fieldOf(request, "jogmode");
    if (mode.empty()) mode = manual_.choice(unit).jogMode;
    const bool aligns = sameName(mode, "Align"), goes = sameName(mode, "GoToPos");
    if (!aligns && !goes) return replyTo(manual_.jog(unit, order));
    if (!unit.isRobot) return badParameter("jogmode", "Joint: the unit has no TCP");
    if (!order.moves()) { // zeros stop
        manual_.stopJogging();
        return Reply::done();
    }
    if (aligns) return replyTo(manual_.align(unit));
    if (!jogTarget_) return Reply::refuse(ReturnCode::Rejected, "set the target first (positiontarget)");
    return replyTo(manual_.goTo(unit, *jogTarget_));
}

/// Sets the target of jogging with GoToPos, in the work object of the unit; mm.
Reply MechanicalUnits::setJogTarget(const Request& request) {
    motion::RobTarget target;
    std::array<double, 11> figures{};
    constexpr std::array<const char*, 11> kNames = {"pos-x",     "pos-y",     "pos-z",     "orient-q1",
                                                    "orient-q2", "orient-q3", "orient-q4", "config-j1",
                                                    "config-j4", "config-j6", "config-jx"};
    constexpr std::size_t kRequired = 10;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        const auto figure = numberIn(fieldOf(request, kNames[i]));
        if (!figure && (i < kRequired || request.form.has(kNames[i])))
            return badParameter(kNames[i], "a number");
        figures[i] = figure.value_or(0);
    }
    const motion::Quat turn{figures[3], figures[4], figures[5], figures[6]};
    if (std::fabs(std::hypot(std::hypot(turn.w, turn.x), std::hypot(turn.y, turn.z)) - 1) > 0.01)
        return badParameter("orient-q1", "a quaternion of length 1");
    target.pose = {{figures[0], figures[1], figures[2]}, robot::normalized(turn)};
    target.conf = {static_cast<int>(figures[7]), static_cast<int>(figures[8]), static_cast<int>(figures[9]),
                   static_cast<int>(figures[10])};
    for (std::size_t i = 0; i < target.extax.size(); ++i)
        if (const auto axis = numberIn(fieldOf(request, fmt::format("extjoint-{}", i + 1))))
            target.extax[i] = *axis;
    jogTarget_ = target;
    return Reply::done();
}

/// A mode that can only be off here: ON is refused.
Handler MechanicalUnits::onlyOff(const char* why) {
    return access_.guarded(Domain::Motion, [why](const Request& request) {
        const auto on = flagIn(fieldOf(request, "mode"));
        if (!on) return badParameter("mode", "ON or OFF");
        return *on ? Reply::refuse(ReturnCode::NotSupported, why, 403) : Reply::done();
    });
}

void MechanicalUnits::addChanges(Router& router) {
    const std::string all = "/rw/motionsystem", unit = all + "/mechunits/{unit}";
    const auto change = [&](const std::string& pattern, const char* old, const char* now, auto handler) {
        router.action(pattern, old, changing(handler));
        router.post(Dialect::V2, now[0] == '\0' ? pattern : pattern + "/" + now, changing(handler));
    };
    change(unit, "set", "", &MechanicalUnits::choose);
    change(unit, "mechunit-position", "position", &MechanicalUnits::teleport);
    // Of the changes here only this one needs no mastership of motion: it orders no movement.
    const Handler leadThrough = access_.shared(Domain::Motion, forUnit(&MechanicalUnits::setLeadThrough));
    router.action(unit, "set-lead-through", leadThrough);
    router.post(Dialect::V2, unit + "/lead-through", leadThrough);
    change(unit + "/motionsupervision", "set", "mode", &MechanicalUnits::setMotionSupervision);
    router.post(Dialect::V2, unit + "/motionsupervision/level",
                changing(&MechanicalUnits::setMotionSupervision));
    change(unit + "/pathsupervision", "set", "mode", &MechanicalUnits::setPathSupervision);
    router.post(Dialect::V2, unit + "/pathsupervision/level", changing(&MechanicalUnits::setPathSupervision));
    addOrder(router, all, "jog", "jog", changing(&MechanicalUnits::jog));
    for (const char* action : {"set", "set-mode", "set-level"}) {
        router.action(all + "/motionsupervision", action, changing(&MechanicalUnits::setMotionSupervision));
        router.action(all + "/pathsupervision", action, changing(&MechanicalUnits::setPathSupervision));
    }
    const Handler simulation = onlyOff("non-motion execution is not supported on a virtual controller");
    const Handler prediction = onlyOff("Option is missing: Collision Avoidance");
    for (const char* action : {"set", "set-mode"})
        router.action(all + "/nonmotionexecution", action, simulation);
    router.post(Dialect::V2, all + "/nonmotionexecution", simulation);
    router.action(all + "/motionsupervision", "set-colpred-mode", prediction);
    router.post(Dialect::V2, all + "/collisionprediction", prediction);
    addOrder(router, all, "positiontarget", "position-target",
             access_.guarded(Domain::Motion, [this](const Request& r) { return setJogTarget(r); }));
    const Handler base = access_.guarded(Domain::Motion, [](const Request&) {
        return Reply::refuse(
            ReturnCode::Rejected,
            "the base frame is a system parameter: change base_frame_pos_x .. of /rw/cfg/MOC/ROBOT "
            "and restart");
    });
    router.action(unit + "/baseframe", "set", base);
    router.post(Dialect::V2, unit + "/baseframe", base);
    router.action(all, "set-mechunit", [this](const Request& r) { return setJogUnit(r); });
    router.add(Dialect::V2,
               {Method::Post, all + "/set-mechunit", {}, [this](const Request& r) { return setJogUnit(r); }});
}

} // namespace rapidc::rws

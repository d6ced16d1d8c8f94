// jog.*, teach.*: moving by hand, and positions that are taken over into the program.

#include "config/json_text.h"
#include "config/letter_case.h"
#include "runtime/host/mechanical_units.h"
#include "runtime/host/motion_driver.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/pendant/unit_frames.h"
#include "tools/rws/mod_pos.h"
#include "tools/service/manual_motion.h"

#include <cmath>
#include <fmt/format.h>
#include <set>

namespace rapidc::pendant {

namespace {

using rapid::config::sameName;

enum class JogKind : uint8_t { Joint, Linear, Reorient, External };
constexpr Word<JogKind> kJogKinds[] = {{"joint", JogKind::Joint},
                                       {"linear", JogKind::Linear},
                                       {"reorient", JogKind::Reorient},
                                       {"external", JogKind::External}};
constexpr Word<rt::JogFrame> kJogFrames[] = {{"world", rt::JogFrame::World},
                                             {"base", rt::JogFrame::Base},
                                             {"tool", rt::JogFrame::Tool},
                                             {"workObject", rt::JogFrame::WorkObject}};
enum class TargetKind : uint8_t { Robtarget, Jointtarget };
constexpr Word<TargetKind> kTargets[] = {{"robtarget", TargetKind::Robtarget},
                                         {"jointtarget", TargetKind::Jointtarget}};
constexpr double kMostIncrement = 1000; // mm or degrees

std::string figure(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string axesText(const motion::ExternalAxes& axes) {
    std::string text;
    for (const double axis : axes)
        text += (text.empty() ? "[" : ",") + (motion::isConnected(axis) ? figure(axis, 4) : "9E+09");
    return text + "]";
}

/// The last part of "T_ROB1/Module/tGripper".
std::string nameOf(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

class JogArea final : public Area {
  public:
    explicit JogArea(const Context& context)
        : controller_(context.controller), manual_(context.manual), hub_(context.hub) {}

    void addTo(MethodTable& methods) override {
        methods.add("jog.start", [this](Client&, const Json& params) { return start(params); });
        methods.add("jog.stop", [this](Client&, const Json&) {
            manual_.stopJogging();
            return Json();
        });
        methods.add("jog.tool", [this](Client&, const Json& params) { return choose(params); });
        methods.add("teach.read", [this](Client&, const Json& params) { return read(params); });
        methods.add("teach.modify", [this](Client&, const Json& params) { return modify(params); });
    }
    void flush() override;

  private:
    rt::MechanicalUnit& unitOf(const Json& params) const {
        const std::string name = textOf(params, "unit");
        rt::MechanicalUnit* unit = manual_.unit(name);
        if (unit == nullptr) notFound(fmt::format("There is no mechanical unit {}", name));
        return *unit;
    }
    Json start(const Json& params);
    Json choose(const Json& params);
    Json read(const Json& params);
    Json modify(const Json& params);

    service::VirtualController& controller_;
    service::ManualMotion& manual_;
    Hub& hub_;
    std::set<std::string> moving_; ///< names of units
};

Json JogArea::start(const Json& params) {
    const rt::MechanicalUnit& unit = unitOf(params);
    const JogKind kind = wordOf(params, "kind", kJogKinds);
    const std::vector<double> values = numbersOf(params, "values", robot::kMostJoints);
    for (const double value : values)
        if (std::fabs(value) > 1) badRequest("values are shares of the jog speed, from -1 to 1");
    rt::JogOrder order;
    if (has(params, "frame")) order.frame = wordOf(params, "frame", kJogFrames);
    const auto vector = [&]() -> motion::Vec3 {
        if (values.size() != 3) badRequest("values must be [x, y, z]");
        return {values[0], values[1], values[2]};
    };
    switch (kind) {
    case JogKind::Joint: std::copy(values.begin(), values.end(), order.joints.begin()); break;
    case JogKind::External:
        if (values.size() > order.external.size()) badRequest("there are six external axes");
        std::copy(values.begin(), values.end(), order.external.begin());
        break;
    case JogKind::Linear: order.line = vector(); break;
    case JogKind::Reorient: order.turn = vector(); break;
    }
    if (!unit.isRobot && kind != JogKind::External)
        badRequest(fmt::format("{} has no arm", unit.name), "Jog its external axes");
    if (has(params, "increment")) {
        order.increment = numberOf(params, "increment");
        if (!(*order.increment > 0 && *order.increment <= kMostIncrement))
            badRequest(fmt::format("increment must be above 0 and at most {}", kMostIncrement));
    }
    refuseUnless(manual_.jog(unit, order));
    moving_.insert(unit.name);
    hub_.wake();
    return {};
}

void JogArea::flush() {
    if (moving_.empty()) return;
    if (manual_.isJogging()) return hub_.wake();
    for (const std::string& name : std::exchange(moving_, {})) {
        const rt::MechanicalUnit* unit = manual_.unit(name);
        hub_.broadcast(
            "jog",
            {{"unit", name}, {"moving", false}, {"limit", unit != nullptr ? manual_.jogLimit(*unit) : ""}});
    }
}

Json JogArea::choose(const Json& params) {
    const rt::MechanicalUnit& unit = unitOf(params);
    service::UnitChoice choice = manual_.choice(unit);
    if (has(params, "tool")) choice.tool = nameOf(textOf(params, "tool"));
    if (has(params, "workObject")) choice.workObject = nameOf(textOf(params, "workObject"));
    refuseUnless(manual_.choose(unit, choice));
    NamedFrame tool = tool0(), object = workObject0();
    if (const rt::Task* task = manual_.taskOf(unit)) {
        for (const NamedFrame& each : toolsOf(controller_, *task))
            if (sameName(each.name, choice.tool)) tool = each;
        for (const NamedFrame& each : workObjectsOf(controller_, *task))
            if (sameName(each.name, choice.workObject)) object = each;
    }
    return {{"tool", frameJson(tool)}, {"workObject", frameJson(object)}};
}

Json JogArea::read(const Json& params) {
    const rt::MechanicalUnit& unit = unitOf(params);
    const TargetKind kind = wordOf(params, "kind", kTargets);
    motion::MotionSystem& system = manual_.motionOf(unit).system();
    const robot::Kinematics& kinematics = system.kinematics();
    if (kind == TargetKind::Jointtarget) {
        const auto axes = system.current().numberedAxes();
        std::string arm;
        for (std::size_t i = 0; i < 6; ++i)
            arm += (arm.empty() ? "" : ",") + figure(axes[i], 4);
        motion::ExternalAxes external = motion::kNoExternalAxes;
        std::copy(axes.begin() + 6, axes.end(), external.begin());
        return {{"value", fmt::format("[[{}],{}]", arm, axesText(external))}};
    }
    if (!unit.isRobot) badRequest(fmt::format("{} has no TCP", unit.name), "Read a jointtarget");
    motion::FrameSetup frames;
    const service::UnitChoice& choice = manual_.choice(unit);
    refuseUnless(manual_.framesOf(unit, choice.tool, choice.workObject, frames));
    const motion::RobTarget target = system.currentTarget(frames);
    motion::ExternalAxes external = target.extax;
    if (kinematics.hasArmAngle()) external[0] = target.armAngle;
    const robot::Pose& pose = target.pose;
    return {{"value",
             fmt::format("[[{},{},{}],[{},{},{},{}],[{},{},{},{}],{}]", figure(pose.pos.x, 3),
                         figure(pose.pos.y, 3), figure(pose.pos.z, 3), figure(pose.rot.w, 7),
                         figure(pose.rot.x, 7), figure(pose.rot.y, 7), figure(pose.rot.z, 7), target.conf.cf1,
                         target.conf.cf4, target.conf.cf6, target.conf.cfx, axesText(external))}};
}

/// The names in that line count; the rest of an instruction that continues on other lines does not.
Json JogArea::modify(const Json& params) {
    const NamedModule named = moduleOf(controller_, params);
    const uint32_t line = lineOf(params);
    if (controller_.panel().mode == service::OperatingMode::Auto)
        refuseUnless("positions cannot be modified in automatic mode: choose manual mode");
    if (controller_.isRunning()) refuseUnless("the program is executing: stop it first");
    const uint64_t changes = controller_.structuralChanges(named.task);
    const rws::TextRange range{line, 1, line, -1};
    const std::string module = named.module.name;
    refuseUnless(rws::modifyPositions(controller_, named.task, module, named.text, range));
    return {{"inText", controller_.structuralChanges(named.task) != changes}};
}

} // namespace

std::unique_ptr<Area> makeJogArea(const Context& context) {
    return std::make_unique<JogArea>(context);
}

} // namespace rapidc::pendant

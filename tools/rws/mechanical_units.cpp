// Questions about the motion system. Changes: mechanical_unit_changes.cpp; kinematics: kinematics.cpp.

#include "tools/rws/mechanical_units.h"

#include "config/letter_case.h"
#include "runtime/robot/angles.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

constexpr const char* kUnits = "/rw/motionsystem/mechunits";
constexpr std::size_t kLeastAxes = 6; // entries that clients expect of an arm
constexpr std::array<const char*, 6> kExternalNames = {"eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f"};

/// RAPID's 9E9 for an axis that is not connected.
std::string axisText(double value) {
    return motion::isConnected(value) ? shown(value) : "9E+09";
}

/// Without what rounding leaves of a zero.
std::string millimetres(double value) {
    return shown(std::fabs(value) < 1e-9 ? 0 : value);
}

void addPose(const motion::Pose& pose, Entry& entry) {
    entry.value("x", millimetres(pose.pos.x))
        .value("y", millimetres(pose.pos.y))
        .value("z", millimetres(pose.pos.z));
    entry.value("q1", shown(pose.rot.w))
        .value("q2", shown(pose.rot.x))
        .value("q3", shown(pose.rot.y))
        .value("q4", shown(pose.rot.z));
}

/// In the base frame of the robot; from how the flange moves when the axis does.
motion::Pose axisFrame(const robot::Kinematics& kinematics, const robot::Joints& joints, std::size_t axis) {
    const robot::JacobianMatrix moves = kinematics.jacobian(joints);
    const robot::Vec3 line{moves(0, axis), moves(1, axis), moves(2, axis)};
    const robot::Vec3 turn{moves(3, axis), moves(4, axis), moves(5, axis)};
    const bool isLinear = kinematics.isLinear(axis);
    const robot::Vec3 along = isLinear ? line : turn;
    const robot::Vec3 direction = along * (1 / std::sqrt(std::max(dot(along, along), 1e-30)));
    robot::Pose frame = kinematics.forward(joints);
    if (!isLinear) frame.pos = frame.pos + cross(direction, line);
    constexpr robot::Vec3 kUp{0, 0, 1};
    const robot::Vec3 across = cross(kUp, direction);
    const double sine = std::sqrt(dot(across, across));
    const robot::Vec3 about = sine > 1e-9 ? across * (1 / sine) : robot::Vec3{1, 0, 0};
    frame.rot = robot::fromAxisAngle(about, std::atan2(sine, direction.z) * robot::kDegreesPerRadian);
    return frame;
}

const char* typeOf(const rt::MechanicalUnit& unit) {
    if (unit.isRobot) return "TCPRobot";
    return unit.axes > 1 || unit.own.size() > 1   ? "Robot"
           : unit.own.empty() && !unit.isConveyor ? "None"
                                                  : "Single";
}

Reply noAxis(const Request& request, const std::string& unit) {
    return Reply::refuse(ReturnCode::NotFound,
                         fmt::format("{} has no axis {}", unit, request.parameter("axis")));
}

std::size_t axesOf(const rt::MechanicalUnit& unit) {
    return unit.isRobot ? static_cast<std::size_t>(unit.axes) : std::max<std::size_t>(unit.own.size(), 1);
}

} // namespace

/// The path names the unit, else the field mechunit (RWS 1.0), else it is the first one.
const rt::MechanicalUnit* MechanicalUnits::unitOf(const Request& request) const {
    std::string name = request.parameter("unit");
    for (const char* field : {"mechunit", "mechunit-name"})
        if (name.empty()) name = fieldOf(request, field);
    if (name.empty()) name = jogUnit_;
    const auto& all = controller_.core().units().all();
    return name.empty() && !all.empty() ? all.front().get() : manual_.unit(name);
}

Reply MechanicalUnits::noUnit(const Request& request) {
    const std::string name = request.parameter("unit");
    if (!name.empty())
        return Reply::refuse(ReturnCode::NotFound, fmt::format("there is no mechanical unit {}", name));
    return badParameter("mechunit", "the name of a mechanical unit");
}

Handler MechanicalUnits::forUnit(Reply (MechanicalUnits::*handler)(const Request&, const Unit&) const) const {
    return [this, handler](const Request& request) {
        const Unit* unit = unitOf(request);
        return unit == nullptr ? noUnit(request) : (this->*handler)(request, *unit);
    };
}

// ---- The whole -----------------------------------------------------------------------------------------------------

Reply MechanicalUnits::motionSystem(const Request& request) const {
    Document document;
    const std::string count = fmt::format("{}", manual_.changeCount());
    if (sameName(request.query.text("resource"), "change-count")) {
        document.add("ms-changecount", "change-count").value("ccount", count).value("change-count", count);
        return Reply::of(std::move(document));
    }
    const auto& units = controller_.core().units().all();
    Entry& entry = document.add("ms-motionsystem", "motionsystem");
    entry.value("change-count", count);
    entry.value("mechunit-name", !jogUnit_.empty() ? jogUnit_
                                 : units.empty()   ? std::string()
                                                   : units.front()->name);
    entry.links.emplace_back("mechunits", kUnits);
    entry.links.emplace_back("errorstate", "/rw/motionsystem/errorstate");
    return Reply::of(std::move(document));
}

namespace {

/// The names that positions of a task have in RWS 1.0, besides those of mechanical units.
void nameForTask(Document& document) {
    for (Entry& entry : document.entries) {
        entry.type = entry.type == "ms-jointtarget" ? "rapid-jointtarget" : "rapid-robtarget";
        auto values = entry.values;
        for (const auto& [name, value] : values) {
            if (name.starts_with("rax_")) entry.value("j" + name.substr(4), value);
            if (name.starts_with("eax_")) entry.value(fmt::format("ej{}", name[4] - 'a' + 1), value);
        }
    }
}

} // namespace

Reply MechanicalUnits::changeCount(const Request& request) const {
    std::string text = request.parameter("count");
    if (text.empty()) text = request.query.text("changecount");
    const auto count = countIn(text);
    if (!count) return badParameter("changecount", "a number");
    const std::string changed = *count != manual_.changeCount() ? "TRUE" : "FALSE";
    Document document;
    document.add("check-changecount", "changecount")
        .value("change-state", changed)
        .value("changestate", changed);
    return Reply::of(std::move(document));
}

Reply MechanicalUnits::list(const Request&) const {
    Document document;
    for (const auto& unit : controller_.core().units().all()) {
        Entry& entry = document.add("ms-mechunit-li", unit->name);
        entry.self = fmt::format("{}/{}", kUnits, escapedSegment(unit->name));
        entry.value("mode", unit->isActive ? "Activated" : "Deactivated");
        entry.value("activation-allowed", unit->isRobot || unit->staysActive ? "FALSE" : "TRUE");
        entry.value("drive-module", fmt::format("{}", unit->group + 1));
    }
    return Reply::of(std::move(document));
}

// ---- One unit ------------------------------------------------------------------------------------------------------

void MechanicalUnits::describeStatic(const Unit& unit, Entry& entry) const {
    const rt::Task* task = manual_.taskOf(unit);
    entry.value("task-name", task == nullptr ? "none" : task->name());
    entry.value("is-integrated-unit", "NoIntegratedUnit").value("has-integrated-unit", "NoIntegratedUnit");
    entry.value("type", typeOf(unit));
    entry.value("axes", fmt::format("{}", axesOf(unit))).value("axes-total", fmt::format("{}", axesOf(unit)));
}

void MechanicalUnits::describeDynamic(const Unit& unit, Entry& entry) const {
    const service::UnitChoice& choice = manual_.choice(unit);
    entry.value("tool-name", choice.tool).value("wobj-name", choice.workObject);
    entry.value("payload-name", choice.payload).value("total-payload-name", choice.totalPayload);
    entry.value("status", "Synchronized").value("jog-mode", choice.jogMode);
    entry.value("mode", unit.isActive ? "Activated" : "Deactivated")
        .value("coord-system", choice.coordinateSystem);
}

Reply MechanicalUnits::unit(const Request& request, const Unit& unit) const {
    const std::string resource = request.query.text("resource");
    if (sameName(resource, "lead-through")) return leadThrough(request, unit);
    Document document;
    Entry& entry = document.add("ms-mechunit", unit.name);
    if (!sameName(resource, "dynamic")) describeStatic(unit, entry);
    if (!sameName(resource, "static")) describeDynamic(unit, entry);
    return Reply::of(std::move(document));
}

Reply MechanicalUnits::jointTarget(const Request&, const Unit& unit) const {
    const auto axes = manual_.motionOf(unit).system().current().numberedAxes();
    Document document;
    Entry& entry = document.add("ms-jointtarget", unit.name);
    for (std::size_t i = 0; i < 6; ++i)
        entry.value(fmt::format("rax_{}", i + 1), axisText(axes[i]));
    for (std::size_t i = 0; i < kExternalNames.size(); ++i)
        entry.value(kExternalNames[i], axisText(axes[6 + i]));
    return Reply::of(std::move(document));
}

std::optional<Failure> MechanicalUnits::poseFor(const Request& request, const Unit& unit,
                                                motion::RobTarget& target) const {
    if (!unit.isRobot) return Failure{ReturnCode::BadParameter, fmt::format("{} has no TCP", unit.name), 400};
    const service::UnitChoice& choice = manual_.choice(unit);
    const std::string askedTool = request.query.text("tool"), askedObject = request.query.text("wobj");
    const std::string coordinate = request.query.text("coordinate");
    motion::FrameSetup frames;
    const service::Refusal refusal =
        manual_.framesOf(unit, askedTool.empty() ? choice.tool : askedTool,
                         askedObject.empty() ? choice.workObject : askedObject, frames);
    if (!refusal.empty()) return Failure{ReturnCode::BadParameter, refusal, 400};
    motion::MotionSystem& system = manual_.motionOf(unit).system();
    target = system.currentTarget(frames);
    if (coordinate.empty() || sameName(coordinate, "Wobj")) return std::nullopt;
    const motion::JointTarget joints = system.currentJoints();
    const motion::Pose flange = system.flangeInWorld(joints);
    const motion::Pose base = flange * inverse(system.kinematics().forward(joints.robax));
    const motion::Pose tcp = frames.tool.robotHeld ? flange * frames.tool.tframe : frames.tool.tframe;
    if (sameName(coordinate, "World") || sameName(coordinate, "Word")) // RobotWare 6 spells it so
        target.pose = tcp;
    else if (sameName(coordinate, "Base"))
        target.pose = inverse(base) * tcp;
    else if (sameName(coordinate, "Tool"))
        target.pose = {};
    else
        return Failure{ReturnCode::BadParameter, "coordinate is Base, World, Tool or Wobj", 400};
    return std::nullopt;
}

Reply MechanicalUnits::robTarget(const Request& request, const Unit& unit) const {
    motion::RobTarget target;
    if (const auto failure = poseFor(request, unit, target))
        return Reply::refuse(failure->code, failure->message, failure->status);
    Document document;
    Entry& entry = document.add("ms-robtargets", unit.name);
    addPose(target.pose, entry);
    entry.value("cf1", fmt::format("{}", target.conf.cf1)).value("cf4", fmt::format("{}", target.conf.cf4));
    entry.value("cf6", fmt::format("{}", target.conf.cf6)).value("cfx", fmt::format("{}", target.conf.cfx));
    auto external = target.extax;
    if (manual_.motionOf(unit).system().kinematics().hasArmAngle()) external[0] = target.armAngle;
    for (const bool withBar : {true, false}) // eax_a and eaxa: clients read either
        for (std::size_t i = 0; i < external.size(); ++i)
            entry.value(fmt::format("eax{}{}", withBar ? "_" : "", static_cast<char>('a' + i)),
                        axisText(external[i]));
    return Reply::of(std::move(document));
}

Reply MechanicalUnits::cartesian(const Request& request, const Unit& unit) const {
    motion::RobTarget target;
    if (const auto failure = poseFor(request, unit, target))
        return Reply::refuse(failure->code, failure->message, failure->status);
    Document document;
    Entry& entry = document.add("ms-mechunit-cartesian", unit.name);
    addPose(target.pose, entry);
    entry.value("j1", fmt::format("{}", target.conf.cf1)).value("j4", fmt::format("{}", target.conf.cf4));
    entry.value("j6", fmt::format("{}", target.conf.cf6)).value("jx", fmt::format("{}", target.conf.cfx));
    return Reply::of(std::move(document));
}

Reply MechanicalUnits::baseFrame(const Request&, const Unit& unit) const {
    motion::Pose base;
    motion::MotionSystem& system = manual_.motionOf(unit).system();
    const motion::JointTarget joints = system.currentJoints();
    if (unit.isRobot)
        base = system.flangeInWorld(joints) * inverse(system.kinematics().forward(joints.robax));
    else if (!unit.geometry.joints.empty())
        base = unit.geometry.joints.front().base;
    Document document;
    addPose(base, document.add("ms-mechunit-baseframe", unit.name));
    return Reply::of(std::move(document));
}

Reply MechanicalUnits::axes(const Request&, const Unit& unit) const {
    Document document;
    const std::size_t count = axesOf(unit);
    document.add("ms-mechunit-axes", unit.name).value("axes", fmt::format("{}", count));
    const auto all = manual_.motionOf(unit).system().current().numberedAxes();
    for (std::size_t i = 0; i < std::max(count, unit.isRobot ? kLeastAxes : count); ++i) {
        Entry& entry = document.add("ms-mechunit-axis-li", fmt::format("{}", i + 1));
        entry.self = fmt::format("{}/{}/axes/{}", kUnits, escapedSegment(unit.name), i + 1);
        entry.value("axis-status", "Synchronized");
        const std::size_t place = unit.isRobot ? i : i < unit.own.size() ? 6 + unit.own[i].index : 0;
        entry.value("position", place < all.size() ? axisText(all[place]) : "0");
    }
    return Reply::of(std::move(document));
}

std::optional<std::size_t> MechanicalUnits::axisOf(const Request& request, const Unit& unit) {
    const auto number = countIn(request.parameter("axis"));
    if (!number || *number < 1 || *number > axesOf(unit)) return std::nullopt;
    return *number;
}

Reply MechanicalUnits::axis(const Request& request, const Unit& unit) const {
    if (sameName(request.query.text("resource"), "pose")) return axisPose(request, unit);
    const auto number = axisOf(request, unit);
    if (!number) return noAxis(request, unit.name);
    const std::size_t logical = unit.isRobot                 ? *number
                                : *number <= unit.own.size() ? 7 + unit.own[*number - 1].index
                                                             : *number;
    Document document;
    document.add("ms-mechunit-axisstatus", fmt::format("{}", *number)).value("axis-status", "Synchronized");
    document.add("ms-mechunit-logicalaxis", fmt::format("{}", *number))
        .value("logical-axis", fmt::format("{}", logical));
    return Reply::of(std::move(document));
}

/// In the world: z is the axis, in its positive direction; the origin is the point of the axis that is nearest to the flange.
Reply MechanicalUnits::axisPose(const Request& request, const Unit& unit) const {
    const auto number = axisOf(request, unit);
    if (!number) return noAxis(request, unit.name);
    motion::Pose pose;
    const auto external = std::find_if(
        unit.geometry.joints.begin(), unit.geometry.joints.end(), [&](const robot::ExternalJoint& joint) {
            return *number <= unit.own.size() && joint.axis == unit.own[*number - 1].index;
        });
    if (unit.isRobot) {
        motion::MotionSystem& system = manual_.motionOf(unit).system();
        const robot::Kinematics& kinematics = system.kinematics();
        const motion::JointTarget joints = system.currentJoints();
        const motion::Pose base = system.flangeInWorld(joints) * inverse(kinematics.forward(joints.robax));
        pose = base * axisFrame(kinematics, joints.robax, *number - 1);
    } else if (external != unit.geometry.joints.end()) {
        pose = external->base;
    }
    Document document;
    addPose(pose, document.add("ms-mechunit-axispose", fmt::format("{}", *number)));
    return Reply::of(std::move(document));
}

// ---- Supervision ---------------------------------------------------------------------------------------------------

Reply MechanicalUnits::motionSupervision(const Request&, const Unit& unit) const {
    const service::UnitChoice& choice = manual_.choice(unit);
    Document document;
    Entry& entry = document.add("ms-motionsupervision", unit.name);
    entry.value("mode", choice.motionSupervision ? "ON" : "OFF")
        .value("mode-enabled", choice.motionSupervision ? "TRUE" : "FALSE");
    entry.value("level", fmt::format("{}", choice.motionSensitivity));
    return Reply::of(std::move(document));
}

Reply MechanicalUnits::pathSupervision(const Request&, const Unit& unit) const {
    const service::UnitChoice& choice = manual_.choice(unit);
    Document document;
    Entry& entry = document.add("ms-pathsupervision", unit.name);
    entry.value("mode", choice.pathSupervision ? "ON" : "OFF")
        .value("level", fmt::format("{}", choice.pathSensitivity));
    return Reply::of(std::move(document));
}

Reply MechanicalUnits::leadThrough(const Request&, const Unit& unit) const {
    Document document;
    document.add("ms-lead-through", unit.name)
        .value("status", manual_.choice(unit).leadThrough ? "Active" : "Inactive");
    return Reply::of(std::move(document));
}

// ---- By task ---------------------------------------------------------------------------------------------------------

/// Whether the axes of the external unit turn or move along a line.
Reply MechanicalUnits::externalJoints(const Unit& unit) const {
    const motion::MotionSystem& system = manual_.motionOf(unit).system();
    const motion::ExternalAxes here = system.currentJoints().extax;
    Document document;
    Entry& entry = document.add("rapid-extjointstate", "extjointstate");
    for (std::size_t i = 0; i < here.size(); ++i)
        entry.value(fmt::format("j{}", i + 1), !motion::isConnected(here[i])        ? "not_active"
                                               : !system.externalAxes()[i].rotating ? "linear"
                                                                                    : "rotating");
    return Reply::of(std::move(document));
}

/// /rw/rapid/tasks/T/motion: the units that a task moves.
Reply MechanicalUnits::taskMotion(const Request& request) const {
    const rt::Task* task = taskOf(controller_, request);
    if (task == nullptr) return noTask(request);
    const std::string resource = request.query.text("resource");
    if (resource.empty())
        return folder({{"rapid-robtarget-li", "motion?resource=robtarget"},
                       {"rapid-jointtarget-li", "motion?resource=jointtarget"},
                       {"rapid-extjointstate-li", "motion?resource=extjointstate"},
                       {"rapid-mechunit-li", "motion?resource=mechunit"}});
    Document document;
    const Unit* robot = nullptr;
    for (const auto& unit : controller_.core().units().all()) {
        if (manual_.taskOf(*unit) != task) continue;
        if (robot == nullptr || (unit->isRobot && !robot->isRobot)) robot = unit.get();
        document.add("rapid-mechunit", unit->name)
            .value("name", unit->name)
            .value("mode", unit->isActive ? "Activated" : "Deactivated")
            .value("type", typeOf(*unit));
    }
    if (robot == nullptr)
        return Reply::refuse(ReturnCode::BadParameter, fmt::format("task {} moves nothing", task->name()));
    if (sameName(resource, "mechunit")) return Reply::of(std::move(document));
    if (sameName(resource, "extjointstate")) return externalJoints(*robot);
    Reply reply = sameName(resource, "robtarget") ? robTarget(request, *robot)
                  : sameName(resource, "jointtarget")
                      ? jointTarget(request, *robot)
                      : badParameter("resource", "robtarget, jointtarget, extjointstate or mechunit");
    if (reply.document) nameForTask(*reply.document);
    return reply;
}

// ---- Routes --------------------------------------------------------------------------------------------------------

void MechanicalUnits::addMotionSystem(Router& router) {
    const std::string all = "/rw/motionsystem";
    router.getBoth(all, [this](const Request& r) { return motionSystem(r); });
    router.get(Dialect::V2, all + "/checkchangecount/{count}",
               [this](const Request& r) { return changeCount(r); });
    router.get(Dialect::V1, all + "/checkchangecount", [this](const Request& r) { return changeCount(r); });
    router.getBoth(all + "/errorstate", [](const Request&) {
        Document document;
        document.add("ms-errorstate", "errorstate").value("err-state", "HPJ_OK").value("err-count", "0");
        return Reply::of(std::move(document));
    });
    router.getBoth(all + "/nonmotionexecution", [](const Request&) {
        Document document;
        document.add("ms-nonmotionexecution", "nonmotionexecution").value("mode", "OFF");
        return Reply::of(std::move(document));
    });
    router.getBoth("/rw/rapid/tasks/{task}/motion", [this](const Request& r) { return taskMotion(r); });
    router.get(Dialect::V1, all + "/motionsupervision", forUnit(&MechanicalUnits::motionSupervision));
    router.get(Dialect::V1, all + "/pathsupervision", forUnit(&MechanicalUnits::pathSupervision));
    router.get(Dialect::V2, all + "/collisionprediction", [](const Request&) {
        Document document;
        document.add("ms-collision-prediction-mode", "collisionprediction")
            .value("collision-prediction-mode-enabled", "false");
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, all + "/collisionprediction/modelname", [this](const Request& request) {
        const auto number = countIn(request.query.text("robotnumber"));
        const auto& units = controller_.core().units().all();
        const auto robots = static_cast<std::size_t>(
            std::count_if(units.begin(), units.end(), [](const auto& unit) { return unit->isRobot; }));
        if (!number || *number >= robots) return badParameter("robotnumber", "the number of a robot, from 0");
        Document document; // there is no model
        document.add("ms-collision-prediction-model-name", "modelname").value("modelname", "");
        return Reply::of(std::move(document));
    });
    router.get(Dialect::V2, std::string(kUnits) + "/{unit}/coll-pred-model", [this](const Request& request) {
        const Unit* unit = unitOf(request);
        if (unit == nullptr) return noUnit(request);
        Document document;
        document.add("ms-mechunit-collision-prediction-model", unit->name)
            .value("model-file", "")
            .value("init-state", "not initialized");
        return Reply::of(std::move(document));
    });
}

void MechanicalUnits::addUnits(Router& router) {
    const std::string unit = std::string(kUnits) + "/{unit}";
    router.getBoth(kUnits, [this](const Request& r) { return list(r); });
    router.getBoth(unit, forUnit(&MechanicalUnits::unit));
    router.getBoth(unit + "/jointtarget", forUnit(&MechanicalUnits::jointTarget));
    router.getBoth(unit + "/robtarget", forUnit(&MechanicalUnits::robTarget));
    router.getBoth(unit + "/cartesian", forUnit(&MechanicalUnits::cartesian));
    router.getBoth(unit + "/baseframe", forUnit(&MechanicalUnits::baseFrame));
    router.getBoth(unit + "/axes", forUnit(&MechanicalUnits::axes));
    router.getBoth(unit + "/axes/{axis}", forUnit(&MechanicalUnits::axis));
    router.getBoth(unit + "/axes/{axis}/pose", forUnit(&MechanicalUnits::axisPose));
    router.getBoth(unit + "/motionsupervision", forUnit(&MechanicalUnits::motionSupervision));
    router.getBoth(unit + "/pathsupervision", forUnit(&MechanicalUnits::pathSupervision));
    router.getBoth(unit + "/lead-through", forUnit(&MechanicalUnits::leadThrough));
    router.getBoth(unit + "/pjoints", forUnit(&MechanicalUnits::jointTarget));
}

void MechanicalUnits::addTo(Router& router, Subscribables&) {
    addMotionSystem(router);
    addUnits(router);
    addChanges(router);
}

} // namespace rapidc::rws

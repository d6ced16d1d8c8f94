// Units in the state, units.frames: what there is to draw.

#include "config/json_text.h"
#include "runtime/host/mechanical_units.h"
#include "runtime/host/motion_driver.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/arm_bodies.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/support.h"
#include "tools/pendant/unit_frames.h"
#include "tools/service/manual_motion.h"

#include <cmath>
#include <fmt/format.h>

namespace rapidc::pendant {

namespace {

const char* motionName(Body::Motion motion) {
    switch (motion) {
    case Body::Motion::Fixed: return "fixed";
    case Body::Motion::Rotary: return "rotary";
    case Body::Motion::Linear: return "linear";
    case Body::Motion::Flange: break;
    }
    return "flange";
}

Json solidJson(const Solid& solid) {
    static constexpr const char* kKinds[] = {"capsule", "cylinder", "rod"};
    static constexpr const char* kRoles[] = {"arm", "joint", "flange"};
    Json json{{"kind", kKinds[static_cast<std::size_t>(solid.kind)]},
              {"role", kRoles[static_cast<std::size_t>(solid.role)]},
              {"from", vectorJson(solid.from)},
              {"to", vectorJson(solid.to)},
              {"radius", rounded(solid.radius, kLengthDecimals)}};
    if (solid.kind == Solid::Kind::Rod) json["toBody"] = solid.toBody;
    return json;
}

Json bodyJson(const Body& body) {
    Json terms = Json::array(), solids = Json::array();
    for (const auto& [joint, factor] : body.terms)
        terms.push_back(Json::array({joint, factor}));
    for (const Solid& solid : body.solids)
        solids.push_back(solidJson(solid));
    return {
        {"name", body.name},
        {"parent", body.parent},
        {"origin", poseJson(body.origin)},
        {"axis", Json::array({rounded(body.axis.x, 7), rounded(body.axis.y, 7), rounded(body.axis.z, 7)})},
        {"motion", motionName(body.motion)},
        {"constant", rounded(body.constant, kAngleDecimals)},
        {"terms", std::move(terms)},
        {"solids", std::move(solids)}};
}

Json jointsJson(const rt::MotionDriver& motion, const robot::Kinematics& kinematics) {
    const robot::RobotModel& model = motion.model();
    Json joints = Json::array();
    for (std::size_t i = 0; i < kinematics.jointCount(); ++i)
        joints.push_back({{"axis", kinematics.axisNumber(i)},
                          {"name", std::to_string(kinematics.axisNumber(i))},
                          {"kind", kinematics.isLinear(i) ? "linear" : "rotary"},
                          {"lower", rounded(kinematics.lowerDeg()[i], kAngleDecimals)},
                          {"upper", rounded(kinematics.upperDeg()[i], kAngleDecimals)},
                          {"maxSpeed", rounded(model.maxSpeed[i], kAngleDecimals)}});
    return joints;
}

class UnitArea final : public Area {
  public:
    explicit UnitArea(const Context& context) : controller_(context.controller), manual_(context.manual) {}

    void addTo(MethodTable& methods) override {
        methods.add("units.frames", [this](Client&, const Json& params) { return frames(params); });
    }
    void describe(Json& state) override {
        Json& units = state["units"] = Json::array();
        for (const auto& motion : controller_.core().motions())
            units.push_back(unitJson(*motion));
    }

  private:
    Json unitJson(rt::MotionDriver& motion) const;
    Json externalJson(const rt::MotionDriver& motion) const;
    Json frames(const Json& params) const;

    service::VirtualController& controller_;
    service::ManualMotion& manual_;
};

/// The external axes of the group, with the frames in which they move.
Json UnitArea::externalJson(const rt::MotionDriver& motion) const {
    Json external = Json::array();
    for (const auto& unit : controller_.core().units().all()) {
        if (unit->isRobot || unit->group != motion.group()) continue;
        for (std::size_t i = 0; i < unit->own.size(); ++i) {
            const rt::MechanicalUnit::Axis& axis = unit->own[i];
            Json json{{"number", axis.index + 1},
                      {"name", std::string(1, static_cast<char>('a' + axis.index))},
                      {"unit", unit->name},
                      {"active", unit->isActive},
                      {"kind", axis.limits.rotating ? "rotary" : "linear"},
                      {"lower", rounded(axis.limits.lower, kAngleDecimals)},
                      {"upper", rounded(axis.limits.upper, kAngleDecimals)},
                      {"maxSpeed", rounded(axis.limits.maxSpeed, kAngleDecimals)},
                      {"base", nullptr}};
            for (const robot::ExternalJoint& joint : unit->geometry.joints)
                if (joint.axis == axis.index) json["base"] = poseJson(joint.base);
            external.push_back(std::move(json));
        }
    }
    return external;
}

Json UnitArea::unitJson(rt::MotionDriver& motion) const {
    motion::MotionSystem& system = motion.system();
    const robot::Kinematics& kinematics = system.kinematics();
    const bool hasArm = motion.model().kinematics != robot::KinematicsKind::NoArm;
    const motion::JointTarget joints = system.currentJoints();
    rt::Task* task = taskMoving(controller_, motion);
    Json bodies = Json::array();
    for (const Body& body : bodiesOf(motion.model()))
        bodies.push_back(bodyJson(body));
    Json json{{"name", motion.unitName()},
              {"model", hasArm ? motion.model().name : std::string()},
              {"task", task == nullptr ? std::string() : task->name()},
              {"base", poseJson(motion.model().baseFrame)},
              {"joints", hasArm ? jointsJson(motion, kinematics) : Json::array()},
              {"external", externalJson(motion)},
              {"bodies", std::move(bodies)},
              {"reach", rounded(motion.model().reachM * 1000, 0)}};
    if (hasArm)
        json["base"] = poseJson(system.flangeInWorld(joints) * inverse(kinematics.forward(joints.robax)));
    NamedFrame tool = tool0(), object = workObject0();
    if (task != nullptr)
        tool = toolInForce(controller_, *task), object = workObjectInForce(controller_, *task);
    json["tool"] = frameJson(tool);
    json["toolMass"] = rounded(tool.massKg, 3);
    json["workObject"] = frameJson(object);
    if (const rt::MechanicalUnit* unit = manual_.unit(motion.unitName())) {
        json["jogTool"] = manual_.choice(*unit).tool;
        json["jogWorkObject"] = manual_.choice(*unit).workObject;
    }
    return json;
}

Json UnitArea::frames(const Json& params) const {
    const rt::MotionDriver& motion = motionOf(controller_, textOf(params, "unit"));
    Json tools = Json::array(), objects = Json::array();
    tools.push_back(frameJson(tool0()));
    objects.push_back(frameJson(workObject0()));
    if (const rt::Task* task = taskMoving(controller_, motion)) {
        for (const NamedFrame& each : toolsOf(controller_, *task)) {
            tools.push_back(frameJson(each));
            tools.back()["mass"] = rounded(each.massKg, 3);
        }
        for (const NamedFrame& each : workObjectsOf(controller_, *task))
            objects.push_back(frameJson(each));
    }
    return {{"tools", std::move(tools)}, {"workObjects", std::move(objects)}};
}

} // namespace

std::unique_ptr<Area> makeUnitArea(const Context& context) {
    return std::make_unique<UnitArea>(context);
}

} // namespace rapidc::pendant

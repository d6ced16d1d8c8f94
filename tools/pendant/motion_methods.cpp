// The samples of motion, units.positions, path.planned, and changes of the tool in force.

#include "config/json_text.h"
#include "runtime/host/motion_driver.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"
#include "tools/pendant/planned_path.h"
#include "tools/pendant/support.h"
#include "tools/pendant/unit_frames.h"
#include "tools/service/manual_motion.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace rapidc::pendant {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds kSamplePeriod{16'000}; // of the wall clock: about 60 a second

const char* kindOf(motion::MoveKind kind) {
    switch (kind) {
    case motion::MoveKind::Linear: return "linear";
    case motion::MoveKind::Circular: return "circular";
    default: return "joint";
    }
}

Json jointsJson(const robot::Joints& joints) {
    Json json = Json::array();
    for (const double joint : joints)
        json.push_back(rounded(joint, kAngleDecimals));
    return json;
}

/// Null for axes that are not connected; those at the end are left out.
Json externalJson(const motion::ExternalAxes& axes) {
    Json json = Json::array();
    for (const double axis : axes)
        json.push_back(motion::isConnected(axis) ? rounded(axis, kAngleDecimals) : Json());
    while (!json.empty() && json.back().is_null())
        json.erase(json.size() - 1);
    return json;
}

class MotionArea final : public Area {
  public:
    explicit MotionArea(const Context& context)
        : controller_(context.controller), manual_(context.manual), hub_(context.hub) {
        service::Observer observer;
        observer.motion = [this] { Hub::guarded([this] { sample(); }); };
        observer.changed = [this](service::Change change, const rt::Task*) {
            if (change == service::Change::Generation) begin();
        };
        observer_ = controller_.observers().add(std::move(observer));
        begin();
    }
    ~MotionArea() override { controller_.observers().remove(observer_); }
    MotionArea(const MotionArea&) = delete;
    MotionArea& operator=(const MotionArea&) = delete;

    void addTo(MethodTable& methods) override {
        methods.add("units.positions", [this](Client&, const Json&) { return positions(); });
        methods.add("path.planned", [this](Client&, const Json& params) { return planned(params); });
    }
    void describe(Json& state) override { state["motion"] = sampleOf(true); }

  private:
    /// The last sample of a unit that was sent.
    struct Sent {
        robot::Joints joints;
        motion::ExternalAxes external = motion::kNoExternalAxes;
        robot::Pose tcp;
        FramesInForce frames;
        bool moving = false;
    };

    void begin();
    void sample();
    Json sampleOf(bool all);
    void lookAtFrames(std::size_t unit);
    Json positions() const;
    Json planned(const Json& params);

    service::VirtualController& controller_;
    service::ManualMotion& manual_;
    Hub& hub_;
    service::Observers::Token observer_ = 0;
    Clock::time_point next_;
    std::vector<Sent> sent_;                            ///< by motion group
    std::vector<std::unique_ptr<PlannedPath>> planned_; ///< by motion group
};

/// Another controller has other arms.
void MotionArea::begin() {
    const auto& motions = controller_.core().motions();
    sent_.assign(motions.size(), {});
    planned_.clear();
    for (const auto& motion : motions)
        planned_.push_back(std::make_unique<PlannedPath>(*motion));
}

/// Each 4 ms of virtual time, which may pass much faster than the wall clock, and once at rest: that sample is never left out.
void MotionArea::sample() {
    if (!hub_.hasClients()) return;
    const Clock::time_point now = Clock::now();
    const auto& motions = controller_.core().motions();
    const bool moves =
        std::any_of(motions.begin(), motions.end(), [](const auto& motion) { return motion->isMoving(); });
    if (moves && now < next_) return;
    next_ = now + kSamplePeriod;
    Json sample = sampleOf(false);
    if (!sample.at("units").empty()) hub_.broadcastUnlessCongested("motion", sample);
    for (std::size_t unit = 0; unit < sent_.size(); ++unit)
        if (sent_[unit].moving) lookAtFrames(unit);
}

Json MotionArea::sampleOf(bool all) {
    Json units = Json::array();
    const auto& motions = controller_.core().motions();
    for (std::size_t i = 0; i < motions.size() && i < sent_.size(); ++i) {
        motion::MotionSystem& system = motions[i]->system();
        const motion::MotionState state = system.current();
        Sent& sent = sent_[i];
        const bool isSame = state.joints == sent.joints && state.extax == sent.external &&
                            state.tcp == sent.tcp && state.moving == sent.moving;
        if (isSame && !all) continue;
        if (!all)
            sent.joints = state.joints, sent.external = state.extax, sent.tcp = state.tcp,
            sent.moving = state.moving;
        const bool hasArm = motions[i]->model().kinematics != robot::KinematicsKind::NoArm;
        const robot::Pose flange = hasArm ? system.kinematics().forward(state.joints) : robot::Pose{};
        Json unit = Json::array({i, hasArm ? jointsJson(state.joints) : Json::array(),
                                 externalJson(state.extax), poseJson(state.tcp), poseJson(flange),
                                 rounded(state.tcpSpeed, 2), state.moving ? 1 : 0});
        const std::size_t group = motions[i]->group();
        const auto& groups = controller_.core().units().groups();
        if (hasArm && group < groups.size() && groups[group].options.baseMover != nullptr)
            unit.push_back(poseJson(system.flangeInWorld({state.joints, state.extax}) * inverse(flange)));
        units.push_back(std::move(unit));
    }
    return {{"t", rounded(rt::toSeconds(controller_.core().scheduler().now()), 4)},
            {"units", std::move(units)}};
}

void MotionArea::lookAtFrames(std::size_t unit) {
    const rt::MotionDriver& motion = *controller_.core().motions()[unit];
    rt::Task* task = taskMoving(controller_, motion);
    if (task == nullptr) return;
    const FramesInForce frames = framesInForce(*task);
    if (std::exchange(sent_[unit].frames, frames) == frames) return;
    const NamedFrame tool = toolInForce(controller_, *task), object = workObjectInForce(controller_, *task);
    hub_.broadcast(
        "frames",
        {{"unit", motion.unitName()}, {"tool", frameJson(tool)}, {"workObject", frameJson(object)}});
}

Json MotionArea::positions() const {
    Json units = Json::array();
    for (const auto& motion : controller_.core().motions()) {
        motion::MotionSystem& system = motion->system();
        const motion::JointTarget joints = system.currentJoints();
        Json json{{"unit", motion->unitName()},
                  {"joints", jointsJson(joints.robax)},
                  {"external", externalJson(joints.extax)}};
        const rt::MechanicalUnit* unit = manual_.unit(motion->unitName());
        motion::FrameSetup frames;
        const bool hasArm = motion->model().kinematics != robot::KinematicsKind::NoArm;
        const auto choice = unit != nullptr ? manual_.choice(*unit) : service::UnitChoice{};
        if (hasArm && unit != nullptr &&
            manual_.framesOf(*unit, choice.tool, choice.workObject, frames).empty()) {
            const motion::RobTarget target = system.currentTarget(frames);
            const robot::Pose flange = system.kinematics().forward(joints.robax);
            const robot::Pose base = system.flangeInWorld(joints) * inverse(flange);
            const robot::Pose world =
                frames.tool.robotHeld ? base * flange * frames.tool.tframe : frames.tool.tframe;
            json["tcp"] = poseJson(target.pose);
            json["world"] = poseJson(world);
            json["base"] = poseJson(inverse(base) * world);
            json["flange"] = poseJson(flange);
            json["config"] =
                Json::array({target.conf.cf1, target.conf.cf4, target.conf.cf6, target.conf.cfx});
            json["tool"] = choice.tool;
            json["workObject"] = choice.workObject;
        }
        units.push_back(std::move(json));
    }
    return {{"units", std::move(units)}};
}

Json MotionArea::planned(const Json& params) {
    const rt::MotionDriver& motion = motionOf(controller_, textOf(params, "unit"));
    const auto most = static_cast<std::size_t>(wholeOr(params, "count", 200, 1, 10'000));
    Json points = Json::array(), moves = Json::array();
    for (const PlannedPath::Move& move : planned_[motion.group()]->moves()) {
        for (const robot::Vec3& point : move.points)
            if (points.size() < most) points.push_back(vectorJson(point));
        moves.push_back({{"kind", kindOf(move.kind)},
                         {"to", poseJson(move.to)},
                         {"module", move.module},
                         {"line", move.line}});
    }
    return {{"points", std::move(points)}, {"moves", std::move(moves)}};
}

} // namespace

std::unique_ptr<Area> makeMotionArea(const Context& context) {
    return std::make_unique<MotionArea>(context);
}

} // namespace rapidc::pendant

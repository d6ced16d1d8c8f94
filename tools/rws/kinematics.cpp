#include "tools/rws/kinematics.h"

#include "config/letter_case.h"
#include "runtime/robot/angles.h"
#include "runtime/robot/lengths.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"

#include <fmt/format.h>

#include <cmath>

namespace rapidc::rws {

namespace {

constexpr double kNotGiven = 8.9e9; // 9E9 and more: no axis

/// A joint of the arm in radians or metres, as clients have it, in degrees or mm.
double fromClient(const robot::Kinematics& kinematics, std::size_t i, double value) {
    return value * (kinematics.isLinear(i) ? robot::kMmPerMetre : robot::kDegreesPerRadian);
}
double toClient(const robot::Kinematics& kinematics, std::size_t i, double value) {
    return value / (kinematics.isLinear(i) ? robot::kMmPerMetre : robot::kDegreesPerRadian);
}

/// Joints from two fields: 6 figures (axis 7 is the first of the external ones), or 7. None: they make no sense.
std::optional<robot::Joints> jointsIn(const robot::Kinematics& kinematics, const std::string& arm,
                                      const std::string& external) {
    auto figures = numbersIn(arm, 6);
    if (!figures) figures = numbersIn(arm, 7);
    if (!figures) figures = numbersIn(arm, kinematics.jointCount());
    const auto more = numbersIn(external, 6);
    if (!figures || (!external.empty() && !more)) return std::nullopt;
    robot::Joints joints = robot::Joints::zeros(kinematics.jointCount());
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto number = static_cast<std::size_t>(kinematics.axisNumber(i));
        const bool isShort = figures->size() == kinematics.jointCount() && figures->size() < 6;
        double figure = 0;
        if (isShort)
            figure = (*figures)[i];
        else if (number <= figures->size())
            figure = (*figures)[number - 1];
        else if (more && (*more)[0] < kNotGiven)
            figure = (*more)[0];
        joints[i] = fromClient(kinematics, i, figure);
    }
    return joints;
}

std::optional<motion::Pose> poseIn(const std::string& position, const std::string& orientation) {
    const auto place = numbersIn(position, 3), turn = numbersIn(orientation, 4);
    if (!place || !turn) return std::nullopt;
    const robot::Quat rot{(*turn)[0], (*turn)[1], (*turn)[2], (*turn)[3]};
    if (std::fabs(norm(rot) - 1) > 0.01) return std::nullopt;
    return motion::Pose{{(*place)[0] * robot::kMmPerMetre, (*place)[1] * robot::kMmPerMetre,
                         (*place)[2] * robot::kMmPerMetre},
                        robot::normalized(rot)};
}

/// The tool of a request; none given: tool0.
std::optional<motion::Pose> toolIn(const Request& request) {
    const std::string position = fieldOf(request, "tool_frame_position"),
                      orientation = fieldOf(request, "tool_frame_orientation");
    if (position.empty() && orientation.empty()) return motion::Pose();
    return poseIn(position, orientation);
}

void addJoints(const robot::Kinematics& kinematics, const robot::Joints& joints, Entry& entry) {
    std::array<double, 7> byNumber{};
    for (std::size_t i = 0; i < joints.size(); ++i)
        byNumber[static_cast<std::size_t>(kinematics.axisNumber(i) - 1)] = toClient(kinematics, i, joints[i]);
    for (std::size_t i = 0; i < 6; ++i)
        entry.value(fmt::format("robotjoint{}", i + 1), shownExactly(byNumber[i]));
    if (kinematics.hasArmAngle()) entry.value("robotjoint7", shownExactly(byNumber[6]));
    for (std::size_t i = 0; i < 6; ++i)
        entry.value(fmt::format("externaljoint{}", i + 1),
                    i == 0 && kinematics.hasArmAngle() ? shownExactly(byNumber[6]) : "9E+09");
}

/// The posture turned by whole turns so that each axis is within its range, if that is possible.
bool bringWithin(const robot::Kinematics& kinematics, robot::Joints& joints) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (kinematics.isLinear(i)) continue;
        const double lower = kinematics.lowerDeg()[i] - 1e-6, upper = kinematics.upperDeg()[i] + 1e-6;
        if (joints[i] > upper) joints[i] -= 360 * std::ceil((joints[i] - upper) / 360);
        if (joints[i] < lower) joints[i] += 360 * std::ceil((lower - joints[i]) / 360);
    }
    return kinematics.jointOutsideLimits(joints) == 0;
}

Reply outOfReach(const std::string& why) {
    return Reply::refuse(ReturnCode::BadParameter, "there are no joints for this pose: " + why);
}

/// Input of the calculations from a pose.
struct PoseRequest {
    motion::Pose flange; ///< in base
    robot::Joints seed;
    double armAngle = robot::kSeedArmAngle;
    std::optional<robot::ConfData> configuration;
};

std::optional<Failure> readPose(const Request& request, motion::MotionSystem& system, PoseRequest& out) {
    const robot::Kinematics& kinematics = system.kinematics();
    const auto fail = [](const char* what) { return Failure{ReturnCode::BadParameter, what, 0}; };
    const auto tcp = poseIn(fieldOf(request, "curr_position"), fieldOf(request, "curr_orientation"));
    if (!tcp)
        return fail("curr_position is [x,y,z] in metres, curr_orientation a unit quaternion [q1,q2,q3,q4]");
    const auto tool = toolIn(request);
    if (!tool)
        return fail("tool_frame_position is [x,y,z] in metres, tool_frame_orientation a unit quaternion");
    const std::string fixed = fieldOf(request, "robot_fixed_object");
    const auto holdsObject = fixed.empty() ? std::optional(false) : flagIn(fixed);
    if (!holdsObject) return fail("robot_fixed_object is TRUE or FALSE");
    // A stationary tool: the pose is that of the object at the flange relative to the tool.
    out.flange = *holdsObject ? *tool * inverse(*tcp) : *tcp * inverse(*tool);
    out.seed = system.currentJoints().robax;
    if (const std::string old = fieldOf(request, "old_rob_joints"); !old.empty()) {
        const auto seed = jointsIn(kinematics, old, fieldOf(request, "old_ext_joints"));
        if (!seed) return fail("old_rob_joints is [a1,..,a6] in radians");
        out.seed = *seed;
    }
    const auto external = numbersIn(fieldOf(request, "curr_ext_joints"), 6);
    if (kinematics.hasArmAngle() && external && (*external)[0] < kNotGiven)
        out.armAngle = (*external)[0] * robot::kDegreesPerRadian;
    if (const std::string text = fieldOf(request, "robot_configuration"); !text.empty()) {
        const auto figures = numbersIn(text, 4);
        if (!figures) return fail("robot_configuration is [cf1,cf4,cf6,cfx]");
        for (const double figure : *figures)
            if (std::fabs(figure) > 100) return fail("robot_configuration is [cf1,cf4,cf6,cfx]");
        const auto whole = [&](std::size_t i) { return static_cast<int>(std::lround((*figures)[i])); };
        out.configuration = robot::ConfData{whole(0), whole(1), whole(2), whole(3)};
    }
    return std::nullopt;
}

} // namespace

Handler Kinematics::forRobot(Calculation calculation) const {
    return [this, calculation](const Request& request) {
        const rt::MechanicalUnit* unit = manual_.unit(request.parameter("unit"));
        if (unit == nullptr)
            return Reply::refuse(ReturnCode::NotFound,
                                 fmt::format("there is no mechanical unit {}", request.parameter("unit")));
        if (!unit->isRobot)
            return Reply::refuse(ReturnCode::BadParameter, fmt::format("{} has no TCP", unit->name));
        return (this->*calculation)(request, *unit);
    };
}

namespace {

/// RobotWare 6 spells the first one with two digits; clients read either.
void addQuarters(const robot::ConfData& conf, Entry& entry) {
    entry.value("quarter_rev_j1", fmt::format("{}", conf.cf1))
        .value("quarter_rev_j11", fmt::format("{}", conf.cf1))
        .value("quarter_rev_j4", fmt::format("{}", conf.cf4));
    entry.value("quarter_rev_j6", fmt::format("{}", conf.cf6))
        .value("quarter_rev_jx", fmt::format("{}", conf.cfx));
}

} // namespace

Reply Kinematics::poseFromJoints(const Request& request, const rt::MechanicalUnit& unit) const {
    const robot::Kinematics& kinematics = manual_.motionOf(unit).system().kinematics();
    const auto joints = jointsIn(kinematics, fieldOf(request, "rob_joints"), fieldOf(request, "ext_joints"));
    if (!joints) return badParameter("rob_joints", "[a1,..,a6] in radians");
    const auto tool = toolIn(request);
    if (!tool)
        return badParameter("tool_frame_position",
                            "[x,y,z] in metres, and a unit quaternion as tool_frame_orientation");
    const auto holdsObject = flagIn(fieldOf(request, "robot_fixed_object")).value_or(false);
    const motion::Pose flange = kinematics.forward(*joints);
    const motion::Pose tcp = holdsObject ? inverse(flange) * *tool : flange * *tool;
    const robot::ConfData conf = kinematics.configuration(*joints);
    Document document;
    Entry& entry = document.add("position-from-joint", unit.name);
    entry.value("position-x", shownExactly(tcp.pos.x / robot::kMmPerMetre))
        .value("position-y", shownExactly(tcp.pos.y / robot::kMmPerMetre));
    entry.value("position-z", shownExactly(tcp.pos.z / robot::kMmPerMetre));
    entry.value("robtargetorientation-u0", shownExactly(tcp.rot.w))
        .value("robtargetorientation-u1", shownExactly(tcp.rot.x));
    entry.value("robtargetorientation-u2", shownExactly(tcp.rot.y))
        .value("robtargetorientation-u3", shownExactly(tcp.rot.z));
    entry.value("quarter-rev-j1", fmt::format("{}", conf.cf1))
        .value("quarter-rev-j4", fmt::format("{}", conf.cf4));
    entry.value("quarter-rev-j6", fmt::format("{}", conf.cf6))
        .value("quarter-rev-jx", fmt::format("{}", conf.cfx));
    if (kinematics.hasArmAngle())
        entry.value("arm-angle", shownExactly(kinematics.armAngle(*joints) / robot::kDegreesPerRadian));
    return Reply::of(std::move(document));
}

Reply Kinematics::jointsFromPose(const Request& request, const rt::MechanicalUnit& unit) const {
    motion::MotionSystem& system = manual_.motionOf(unit).system();
    PoseRequest pose;
    if (const auto failure = readPose(request, system, pose)) return Reply::refuse(*failure);
    const robot::Kinematics& kinematics = system.kinematics();
    auto joints = kinematics.inverseNear(pose.flange, pose.seed, pose.armAngle);
    if (pose.configuration) {
        auto configured = kinematics.inverse(pose.flange, *pose.configuration, pose.seed, pose.armAngle);
        if (configured || !joints) joints = configured;
    }
    if (!joints) return outOfReach(joints.error().message());
    Document document;
    addJoints(kinematics, *joints, document.add("joints-from-cartesian", unit.name));
    return Reply::of(std::move(document));
}

Reply Kinematics::allSolutions(const Request& request, const rt::MechanicalUnit& unit) const {
    motion::MotionSystem& system = manual_.motionOf(unit).system();
    PoseRequest pose;
    if (const auto failure = readPose(request, system, pose)) return Reply::refuse(*failure);
    const robot::Kinematics& kinematics = system.kinematics();
    robot::IkBranches branches;
    kinematics.inverseAll(pose.flange, pose.seed, branches, pose.armAngle);
    Document document;
    for (int i = 0; i < static_cast<int>(robot::kMostBranches); ++i) {
        if (!branches.has(i)) continue;
        robot::Joints joints = branches.joints[static_cast<std::size_t>(i)];
        if (!bringWithin(kinematics, joints)) continue;
        Entry& entry = document.add("all-joint-solutions", fmt::format("{}", document.entries.size() + 1));
        addJoints(kinematics, joints, entry);
        addQuarters(kinematics.configuration(joints), entry);
    }
    if (document.entries.empty())
        return outOfReach(branches.valid == 0 ? "it is out of reach" : "an axis would leave its range");
    return Reply::of(std::move(document));
}

Reply Kinematics::targetFromJoints(const Request& request, const rt::MechanicalUnit& unit) const {
    const auto arm = numbersIn(fieldOf(request, "curr_joints"), 6),
               external = numbersIn(fieldOf(request, "curr_ext_joints"), 6);
    if (!arm || !external)
        return badParameter("curr_joints and curr_ext_joints", "six figures each, degrees or mm");
    const std::string tool = fieldOf(request, "tool"), object = fieldOf(request, "wobj");
    motion::FrameSetup frames;
    const service::Refusal refusal =
        manual_.framesOf(unit, tool.empty() ? "tool0" : tool, object.empty() ? "wobj0" : object, frames);
    if (!refusal.empty()) return Reply::refuse(ReturnCode::BadParameter, refusal);
    motion::MotionSystem& system = manual_.motionOf(unit).system();
    const motion::RobTarget target =
        system.toRobTarget(service::jointsFrom(system.kinematics(), *arm, *external), frames);
    Document document;
    Entry& entry = document.add("ms-robtarget", unit.name);
    entry.value("x", shown(target.pose.pos.x))
        .value("y", shown(target.pose.pos.y))
        .value("z", shown(target.pose.pos.z));
    entry.value("q1", shown(target.pose.rot.w))
        .value("q2", shown(target.pose.rot.x))
        .value("q3", shown(target.pose.rot.y));
    entry.value("q4", shown(target.pose.rot.z)).value("cf1", fmt::format("{}", target.conf.cf1));
    entry.value("cf4", fmt::format("{}", target.conf.cf4)).value("cf6", fmt::format("{}", target.conf.cf6));
    entry.value("cfx", fmt::format("{}", target.conf.cfx));
    return Reply::of(std::move(document));
}

void Kinematics::addTo(Router& router, Subscribables&) {
    const std::string unit = "/rw/motionsystem/mechunits/{unit}";
    addOrder(router, unit, "CalcPoseFromJoints", "pose-from-joints", forRobot(&Kinematics::poseFromJoints));
    addOrder(router, unit, "JointsFromCartesian", "joints-from-cartesian",
             forRobot(&Kinematics::jointsFromPose));
    addOrder(router, unit, "CalcJointsFromPose", "joints-from-pose", forRobot(&Kinematics::jointsFromPose));
    addOrder(router, unit, "AllJointSolutions", "all-joints-solution", forRobot(&Kinematics::allSolutions));
    for (const Dialect dialect : {Dialect::V1, Dialect::V2})
        router.add(dialect,
                   {Method::Post, unit, "CalcRobTFromJoints", forRobot(&Kinematics::targetFromJoints)});
}

} // namespace rapidc::rws

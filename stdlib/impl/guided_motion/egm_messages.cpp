#include "stdlib/impl/guided_motion/egm_messages.h"

#include "egm.pb.h"

#include <algorithm>
#include <cmath>

namespace rt::lib {
namespace {

constexpr double kUnitTolerance = 0.01; // of quaternions that were rounded on their way
constexpr int kRobotAxes = 6;           // of a message

// ---- EgmRobot ----------------------------------------------------------------------------------------------------

void put(const motion::Vec3& from, egm::EgmVector& to) {
    to.set_x(from.x);
    to.set_y(from.y);
    to.set_z(from.z);
}

void put(const RobotPlace& from, const RobotData& data, egm::EgmPlace& to) {
    for (const double joint : from.joints)
        to.mutable_joints()->add_value(joint);
    egm::EgmPose& pose = *to.mutable_cartesian();
    put(from.pose.pos, *pose.mutable_pos());
    pose.mutable_orient()->set_u0(from.pose.rot.w);
    pose.mutable_orient()->set_u1(from.pose.rot.x);
    pose.mutable_orient()->set_u2(from.pose.rot.y);
    pose.mutable_orient()->set_u3(from.pose.rot.z);
    put(robot::eulerZyx(from.pose.rot), *pose.mutable_euler());
    (void)to.mutable_externaljoints(); // there, even without axes
    for (const double axis : from.external)
        to.mutable_externaljoints()->add_value(axis);
    to.mutable_time()->set_sec(static_cast<uint64_t>(data.calendar));
    to.mutable_time()->set_usec(static_cast<uint64_t>(data.nanoseconds % 1'000'000'000 / 1000));
}

// ---- EgmSensor ---------------------------------------------------------------------------------------------------

constexpr const char* kNoMessage = "a datagram is not a message of EGM";

/// Reports nothing by itself, unlike ParseFromArray.
template <class Message> bool parse(std::string_view bytes, Message& message) {
    return message.ParsePartialFromArray(bytes.data(), static_cast<int>(bytes.size())) &&
           message.IsInitialized();
}

template <class Numbers> bool areFinite(const Numbers& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

bool isFinite(const egm::EgmVector& v) {
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

bool isFinite(const egm::EgmSensor& message) {
    const egm::EgmPlace& planned = message.planned();
    const egm::EgmPose& pose = planned.cartesian();
    const egm::EgmSpeedRef& speed = message.speedref();
    const egm::EgmQuaternion& q = pose.orient();
    return areFinite(planned.joints().value()) && areFinite(planned.externaljoints().value()) &&
           isFinite(pose.pos()) && isFinite(pose.euler()) &&
           std::isfinite(q.u0() + q.u1() + q.u2() + q.u3()) && areFinite(speed.joints().value()) &&
           areFinite(speed.cartesians().value()) && areFinite(speed.externaljoints().value()) &&
           areFinite(message.rapidtorobot().dnum());
}

/// The first numbers, as many as there is room for.
template <class Array> void take(const egm::EgmNumbers& numbers, Array& to) {
    for (std::size_t i = 0; i < std::min<std::size_t>(to.size(), numbers.value().size()); ++i)
        to[i] = numbers.value(static_cast<int>(i));
}

void takePose(const egm::EgmPose& pose, SensorData& data) {
    if (pose.has_pos()) {
        data.pose[0] = pose.pos().x();
        data.pose[1] = pose.pos().y();
        data.pose[2] = pose.pos().z();
    }
    if (pose.has_euler()) { // of the two, the angles count
        data.pose[3] = pose.euler().x();
        data.pose[4] = pose.euler().y();
        data.pose[5] = pose.euler().z();
    } else if (pose.has_orient()) {
        const egm::EgmQuaternion& q = pose.orient();
        data.orientation = robot::normalized(motion::Quat{q.u0(), q.u1(), q.u2(), q.u3()});
    }
}

bool isUnit(const egm::EgmQuaternion& q) {
    const double length = std::sqrt(q.u0() * q.u0() + q.u1() * q.u1() + q.u2() * q.u2() + q.u3() * q.u3());
    return std::fabs(length - 1) <= kUnitTolerance;
}

/// Why the target cannot be used; "" when it can.
std::string targetProblem(const egm::EgmPlace& planned, GuidanceMode mode) {
    const egm::EgmPose& pose = planned.cartesian();
    if (mode == GuidanceMode::Joint && planned.joints().value_size() != kRobotAxes)
        return "a message of joint guidance needs six joints";
    if (mode == GuidanceMode::Pose && (!pose.has_pos() || (!pose.has_orient() && !pose.has_euler())))
        return "a message of pose guidance needs a position and an orientation";
    if (pose.has_orient() && !isUnit(pose.orient()))
        return "the quaternion of a message does not have the length 1";
    return {};
}

void takeRapidData(const egm::EgmRapidData& from, SensorData& data) {
    if (from.has_digval()) data.digital = from.digval();
    const int count = std::min(from.dnum_size(), static_cast<int>(kMostRapidNumbers));
    data.numbers.assign(from.dnum().begin(), from.dnum().begin() + count);
}

std::string decodeGuidance(std::string_view bytes, GuidanceMode mode, SensorData& data) {
    egm::EgmSensor message;
    if (!parse(bytes, message)) return kNoMessage;
    if (message.header().mtype() != egm::EgmHeader::CORRECTION)
        return "a message is not of the type CORRECTION";
    if (!isFinite(message)) return "a message holds a number that is not finite";
    const egm::EgmPlace& planned = message.planned();
    if (message.has_rapidtorobot()) takeRapidData(message.rapidtorobot(), data);
    data.hasTarget = !message.has_rapidtorobot() || planned.has_joints() || planned.has_cartesian();
    if (!data.hasTarget) return {};
    if (std::string problem = targetProblem(planned, mode); !problem.empty()) return problem;
    take(planned.joints(), data.joints);
    take(planned.externaljoints(), data.additional);
    if (planned.externaljoints().value_size() > 0)
        data.joints[kRobotAxes] = planned.externaljoints().value(0);
    takePose(planned.cartesian(), data);
    take(message.speedref().joints(), data.jointSpeed);
    take(message.speedref().cartesians(), data.poseSpeed);
    take(message.speedref().externaljoints(), data.additionalSpeed);
    return {};
}

std::string decodeCorrection(std::string_view bytes, SensorData& data) {
    egm::EgmSensorPathCorr message;
    if (!parse(bytes, message)) return kNoMessage;
    if (message.header().mtype() != egm::EgmHeader::PATH_CORRECTION)
        return "a message is not of the type PATH_CORRECTION";
    if (!message.has_pathcorr()) return "a message of path correction needs a position";
    const egm::EgmVector& pos = message.pathcorr().pos();
    if (!isFinite(pos)) return "a message holds a number that is not finite";
    data.pose[0] = pos.x();
    data.pose[1] = pos.y();
    data.pose[2] = pos.z();
    return {};
}

} // namespace

std::string encodeRobotMessage(const RobotData& data, uint32_t sequence) {
    egm::EgmRobot message;
    egm::EgmHeader& header = *message.mutable_header();
    header.set_seqno(sequence);
    header.set_tm(static_cast<uint32_t>(data.nanoseconds / 1'000'000));
    header.set_mtype(egm::EgmHeader::DATA);
    put(data.feedback, data, *message.mutable_feedback());
    put(data.planned, data, *message.mutable_planned());
    message.mutable_motorstate()->set_state(data.motorsOn ? egm::EgmMotorState::ON : egm::EgmMotorState::OFF);
    message.mutable_mcistate()->set_state(data.isGuided ? egm::EgmGuidanceState::RUNNING
                                                        : egm::EgmGuidanceState::STOPPED);
    message.set_mciconvergencemet(data.isConverged);
    message.mutable_testsignals()->add_value(0);
    message.mutable_rapidexecstate()->set_state(data.programRuns ? egm::EgmExecutionState::RUNNING
                                                                 : egm::EgmExecutionState::STOPPED);
    message.mutable_measuredforce()->set_fcactive(false); // no force sensor
    message.mutable_measuredforce()->mutable_force()->Resize(kRobotAxes, 0);
    message.set_utilizationrate(data.utilization);
    message.set_moveindex(data.moveIndex);
    message.mutable_collisioninfo()->set_triggered(data.hasCollided);
    message.mutable_rapidfromrobot()->set_digval(data.digital);
    for (const double number : data.numbers)
        message.mutable_rapidfromrobot()->add_dnum(number);
    return message.SerializeAsString();
}

std::string decodeSensorMessage(std::string_view bytes, GuidanceMode expected, SensorData& data) {
    data = {};
    return expected == GuidanceMode::PathCorrection ? decodeCorrection(bytes, data)
                                                    : decodeGuidance(bytes, expected, data);
}

} // namespace rt::lib

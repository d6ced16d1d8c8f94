#include "runtime/host/axis_reader.h"

#include "runtime/base/text_util.h"
#include "runtime/robot/angles.h"
#include "runtime/robot/lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rt {

namespace {

constexpr int kFirstLogicalAxis = 7; // of the external axes

} // namespace

const CfgInstance* instanceNamed(const std::vector<const CfgInstance*>& instances, std::string_view name) {
    const auto found = std::find_if(instances.begin(), instances.end(), [&](const CfgInstance* instance) {
        return sameName(instance->text("name"), name);
    });
    return found == instances.end() ? nullptr : *found;
}

robot::Pose baseFrameOf(const CfgInstance& instance, const robot::Pose& otherwise) {
    robot::Pose base;
    bool isGiven = false;
    double* const position[] = {&base.pos.x, &base.pos.y, &base.pos.z};
    for (int i = 0; i < 3; ++i) {
        double metres = 0;
        if (!instance.number(fmt::format("base_frame_pos_{}", "xyz"[i]), metres)) continue;
        *position[i] = metres * robot::kMmPerMetre;
        isGiven = true;
    }
    double* const q[] = {&base.rot.w, &base.rot.x, &base.rot.y, &base.rot.z};
    for (int i = 0; i < 4; ++i)
        isGiven = instance.number(fmt::format("base_frame_orient_u{}", i), *q[i]) || isGiven;
    if (!isGiven) return otherwise;
    base.rot = robot::normalized(base.rot);
    return base;
}

AxisReader AxisReader::ofSingle(const CfgLookup& configuration, std::string_view single) {
    const CfgInstance* instance = instanceNamed(configuration("MOC", "SINGLE"), single);
    const std::string joint = text(instance, "use_joint");
    return {configuration, instance, joint.empty() ? single : std::string_view(joint)};
}

AxisReader AxisReader::ofJoint(const CfgLookup& configuration, std::string_view joint) {
    return {configuration, nullptr, joint};
}

AxisReader::AxisReader(const CfgLookup& configuration, const CfgInstance* single, std::string_view joint)
    : lookup_(configuration), single_(single), joint_(find("JOINT", joint, {})), name_(joint),
      arm_(find("ARM", text(joint_, "use_arm"), name_)),
      transmission_(find("TRANSMISSION", text(joint_, "use_transmission"), name_)) {}

const CfgInstance* AxisReader::find(std::string_view type, std::string_view name,
                                    std::string_view fallback) const {
    const std::string_view wanted = name.empty() ? fallback : name;
    return wanted.empty() ? nullptr : instanceNamed(lookup_("MOC", type), wanted);
}

bool AxisReader::isRotating() const {
    const CfgInstance* type = find("SINGLE_TYPE", text(single_, "use_single_type"), {});
    const std::string mechanics = upperCase(text(type, "mechanics"));
    if (mechanics.find("ROT") != std::string::npos) return true;
    if (mechanics == "TRACK" || mechanics.find("LIN") != std::string::npos) return false;
    return transmission_ == nullptr || transmission_->flag("rotating_move");
}

motion::ExternalAxisModel AxisReader::limits() const {
    motion::ExternalAxisModel axis;
    axis.rotating = isRotating();
    const double unit = axis.rotating ? robot::kDegreesPerRadian : robot::kMmPerMetre;
    axis.maxSpeed = axis.rotating ? 180 : 1500;
    axis.maxAcceleration = axis.rotating ? 360 : 2500;
    double value = 0;
    if (arm_ != nullptr && arm_->number("lower_joint_bound", value)) axis.lower = value * unit;
    if (arm_ != nullptr && arm_->number("upper_joint_bound", value)) axis.upper = value * unit;
    const CfgInstance* acceleration = find("ACC_DATA", name_, {});
    if (acceleration != nullptr && acceleration->number("wc_acc", value) && value > 0)
        axis.maxAcceleration = value * unit;
    if (const double speed = fastest(); speed > 0) axis.maxSpeed = speed * unit;
    return axis;
}

bool AxisReader::mayBeIndependent() const {
    return arm_ != nullptr && arm_->flag("independent_joint_on");
}

std::optional<std::size_t> AxisReader::axisIndex() const {
    double logical = 0;
    if (joint_ == nullptr || !joint_->number("logical_axis", logical)) return {};
    const int index = static_cast<int>(logical) - kFirstLogicalAxis;
    if (index < 0 || index >= robot::kExternalCount) return {};
    return static_cast<std::size_t>(index);
}

/// Turned about x by attitude, along x by length, turned about z by theta_home_position, along z by offset_z.
std::optional<robot::Pose> AxisReader::step() const {
    const CfgInstance* type = find("ARM_TYPE", text(arm_, "use_arm_type"), {});
    if (type == nullptr) return {};
    const auto value = [type](std::string_view name) {
        double result = 0;
        type->number(name, result);
        return result;
    };
    const robot::Pose twist{{value("length") * robot::kMmPerMetre, 0, 0},
                            robot::fromAxisAngle({1, 0, 0}, value("attitude") * robot::kDegreesPerRadian)};
    const robot::Pose turn{
        {}, robot::fromAxisAngle({0, 0, 1}, value("theta_home_position") * robot::kDegreesPerRadian)};
    return twist * turn * robot::Pose{{0, 0, value("offset_z") * robot::kMmPerMetre}, {}};
}

/// Speed of the arm, rad/s or m/s, from that of the motor; 0 = not given.
double AxisReader::fastest() const {
    const CfgInstance* drive = find("DRIVE_SYSTEM", text(joint_, "use_drive_system"), {});
    const CfgInstance* duty = find("STRESS_DUTY_CYCLE", text(drive, "use_stress_duty_cycle"), {});
    double motor = 0;
    double gear = 0;
    if (duty == nullptr || !duty->number("speed_absolute_max", motor)) return 0;
    if (transmission_ == nullptr || !transmission_->number("trans_joint", gear) || gear == 0) return 0;
    return std::fabs(motor / gear);
}

} // namespace rt

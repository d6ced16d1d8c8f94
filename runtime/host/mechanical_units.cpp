#include "runtime/host/mechanical_units.h"

#include "runtime/base/text_util.h"
#include "runtime/robot/robot_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace rt {

namespace {

constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;
constexpr double kMmPerMetre = 1000;
constexpr const char* kFirstRobot = "ROB_1";
constexpr int kFirstLogicalAxis = 7;    // of the external axes
constexpr std::size_t kUnnumbered = 99; // an axis whose place among the external axes is not known yet

const CfgInstance* named(const std::vector<const CfgInstance*>& instances, std::string_view name) {
    const auto found = std::find_if(instances.begin(), instances.end(), [&](const CfgInstance* instance) {
        return sameName(instance->text("name"), name);
    });
    return found == instances.end() ? nullptr : *found;
}

/// base_frame_pos_* (m) and base_frame_orient_u* of a ROBOT or SINGLE; what is not given is 0 and the identity.
robot::Pose baseFrameOf(const CfgInstance& instance) {
    robot::Pose base;
    double* const position[] = {&base.pos.x, &base.pos.y, &base.pos.z};
    for (int i = 0; i < 3; ++i) {
        double metres = 0;
        if (instance.number(fmt::format("base_frame_pos_{}", "xyz"[i]), metres))
            *position[i] = metres * kMmPerMetre;
    }
    double* const q[] = {&base.rot.w, &base.rot.x, &base.rot.y, &base.rot.z};
    for (int i = 0; i < 4; ++i)
        instance.number(fmt::format("base_frame_orient_u{}", i), *q[i]);
    base.rot = robot::normalized(base.rot);
    return base;
}

/// Bounds of the robot's axes: ARM "rob1_1" to "rob1_6", the second robot's "rob2_1" and so on.
void applyBounds(const std::vector<const CfgInstance*>& arms, std::size_t robot, robot::RobotModel& model) {
    for (const CfgInstance* arm : arms) {
        for (std::size_t axis = 0; axis < model.lowerDeg.size(); ++axis) {
            if (!sameName(arm->text("name"), fmt::format("rob{}_{}", robot + 1, axis + 1))) continue;
            double bound = 0;
            if (arm->number("upper_joint_bound", bound)) model.upperDeg[axis] = bound * kDegreesPerRadian;
            if (arm->number("lower_joint_bound", bound)) model.lowerDeg[axis] = bound * kDegreesPerRadian;
        }
    }
}

/// What the configuration says about the axis of a SINGLE. Types refer to each other by name; what is missing keeps the
/// value of a usual positioner or track.
class SingleReader {
  public:
    SingleReader(const CfgLookup& configuration, std::string_view single)
        : lookup_(configuration), single_(named(lookup_("MOC", "SINGLE"), single)),
          joint_(find("JOINT", text(single_, "use_joint"), single)),
          arm_(find("ARM", text(joint_, "use_arm"), jointName())),
          transmission_(find("TRANSMISSION", text(joint_, "use_transmission"), jointName())) {}

    bool isRotating() const {
        const CfgInstance* type = find("SINGLE_TYPE", text(single_, "use_single_type"), {});
        const std::string mechanics = upperCase(text(type, "mechanics"));
        if (mechanics.find("ROT") != std::string::npos) return true;
        if (mechanics == "TRACK" || mechanics.find("LIN") != std::string::npos) return false;
        return transmission_ == nullptr || transmission_->flag("rotating_move");
    }

    motion::ExternalAxisModel limits() const {
        motion::ExternalAxisModel axis;
        axis.rotating = isRotating();
        const double unit = axis.rotating ? kDegreesPerRadian : kMmPerMetre;
        axis.maxSpeed = axis.rotating ? 180 : 1500;
        axis.maxAcceleration = axis.rotating ? 360 : 2500;
        double value = 0;
        if (arm_ != nullptr && arm_->number("lower_joint_bound", value)) axis.lower = value * unit;
        if (arm_ != nullptr && arm_->number("upper_joint_bound", value)) axis.upper = value * unit;
        const CfgInstance* acceleration = find("ACC_DATA", text(joint_, "name"), {});
        if (acceleration != nullptr && acceleration->number("wc_acc", value) && value > 0)
            axis.maxAcceleration = value * unit;
        if (const double speed = fastest(); speed > 0) axis.maxSpeed = speed * unit;
        return axis;
    }

    /// 0 for eax_a; nothing when the configuration does not tell.
    std::optional<std::size_t> axisIndex() const {
        double logical = 0;
        if (joint_ == nullptr || !joint_->number("logical_axis", logical)) return {};
        const int index = static_cast<int>(logical) - kFirstLogicalAxis;
        if (index < 0 || index >= robot::kExternalCount) return {};
        return static_cast<std::size_t>(index);
    }

    robot::Pose base() const { return single_ != nullptr ? baseFrameOf(*single_) : robot::Pose{}; }
    std::string carrier() const { return text(single_, "base_frame_coordinated"); }

  private:
    static std::string text(const CfgInstance* instance, std::string_view attribute) {
        return instance != nullptr ? instance->text(attribute) : std::string();
    }
    std::string jointName() const {
        return joint_ != nullptr ? joint_->text("name") : text(single_, "use_joint");
    }
    const CfgInstance* find(std::string_view type, std::string_view name, std::string_view fallback) const {
        const std::string_view wanted = name.empty() ? fallback : name;
        return wanted.empty() ? nullptr : named(lookup_("MOC", type), wanted);
    }
    /// Speed of the arm, rad/s or m/s, from that of the motor; 0 = not given.
    double fastest() const {
        const CfgInstance* drive = find("DRIVE_SYSTEM", text(joint_, "use_drive_system"), {});
        const CfgInstance* duty = find("STRESS_DUTY_CYCLE", text(drive, "use_stress_duty_cycle"), {});
        double motor = 0;
        double gear = 0;
        if (duty == nullptr || !duty->number("speed_absolute_max", motor)) return 0;
        if (transmission_ == nullptr || !transmission_->number("trans_joint", gear) || gear == 0) return 0;
        return std::fabs(motor / gear);
    }

    const CfgLookup& lookup_;
    const CfgInstance* single_;
    const CfgInstance* joint_;
    const CfgInstance* arm_;
    const CfgInstance* transmission_;
};

/// Names of the singles of a MECHANICAL_UNIT, in order.
std::vector<std::string> singlesOf(const CfgInstance& unit) {
    std::vector<std::string> names;
    for (int i = 0; i < robot::kExternalCount; ++i)
        if (std::string name = unit.text(fmt::format("use_single_{}", i)); !name.empty())
            names.push_back(std::move(name));
    return names;
}

} // namespace

bool isIndexingName(std::string_view name) {
    return upperCase(std::string(name)).starts_with("INDCNV");
}

bool isConveyorName(std::string_view name) {
    const std::string upper = upperCase(std::string(name));
    return upper.starts_with("CNV") || upper.starts_with("SSYNC") || isIndexingName(name);
}

std::string MechanicalUnits::read(const CfgLookup& configuration, const std::vector<std::string>& robots,
                                  std::string_view defaultModel, std::size_t needed, bool& isUsage) {
    const std::vector<RobotPlan> plans = planRobots(configuration, robots, defaultModel, needed);
    if (std::string problem = addRobots(configuration, plans, isUsage); !problem.empty()) return problem;
    addExternalUnits(configuration);
    addGroups(configuration);
    connectAxes();
    carryBases();
    return {};
}

std::vector<MechanicalUnits::RobotPlan> MechanicalUnits::planRobots(const CfgLookup& configuration,
                                                                    const std::vector<std::string>& robots,
                                                                    std::string_view defaultModel,
                                                                    std::size_t needed) const {
    std::vector<RobotPlan> plans;
    const auto planned = [&](const std::string& name) -> RobotPlan& {
        for (RobotPlan& plan : plans)
            if (sameName(plan.name, name)) return plan;
        plans.push_back({name, {}, nullptr, false});
        return plans.back();
    };
    for (const CfgInstance* instance : configuration("MOC", "ROBOT")) {
        const std::string name = instance->text("name");
        RobotPlan& plan = planned(name.empty() ? kFirstRobot : name);
        plan.model = instance->text("use_robot_type");
        plan.instance = instance;
    }
    if (plans.empty()) planned(kFirstRobot);
    for (const CfgInstance* group : configuration("SYS", "MECHANICAL_UNIT_GROUP"))
        if (const std::string name = group->text("Robot"); !name.empty()) planned(name);
    for (const std::string& asked : robots) {
        const std::size_t equals = asked.find('=');
        RobotPlan& plan = equals == std::string::npos ? plans.front() : planned(asked.substr(0, equals));
        plan.model = equals == std::string::npos ? asked : asked.substr(equals + 1);
        plan.isAsked = true;
    }
    if (configuration("MOC", "ROBOT").empty()) // nothing names the robots of several motion tasks
        while (plans.size() < needed)
            planned(fmt::format("ROB_{}", plans.size() + 1));
    if (plans.front().model.empty()) plans.front().model = defaultModel;
    for (RobotPlan& plan : plans)
        if (plan.model.empty()) plan.model = plans.front().model;
    return plans;
}

std::string MechanicalUnits::addRobots(const CfgLookup& configuration, const std::vector<RobotPlan>& plans,
                                       bool& isUsage) {
    for (const RobotPlan& plan : plans) {
        auto unit = std::make_unique<MechanicalUnit>();
        unit->name = plan.name;
        const auto model = robot::loadRobotModel(plan.model);
        if (!model && (groups_.empty() || plan.isAsked)) {
            isUsage = plan.isAsked;
            return model.error().message;
        }
        if (!model) { // a positioner, say
            warnings_.push_back(
                fmt::format("the robot {} ({}) of MOC.cfg is not in the catalogue: it does not move",
                            plan.name, plan.model));
            unit->geometry.name = plan.name;
            units_.push_back(std::move(unit));
            continue;
        }
        MotionGroup group;
        group.robot = plan.name;
        group.model = *model;
        if (plan.instance != nullptr) group.model.baseFrame = baseFrameOf(*plan.instance);
        applyBounds(configuration("MOC", "ARM"), groups_.size(), group.model);
        unit->isRobot = unit->isActive = unit->staysActive = true;
        unit->axes = static_cast<int>(group.model.lowerDeg.size());
        unit->group = groups_.size();
        if (plan.instance != nullptr) unit->carrier = plan.instance->text("base_frame_coordinated");
        groups_.push_back(std::move(group));
        units_.push_back(std::move(unit));
    }
    return {};
}

void MechanicalUnits::addExternalUnits(const CfgLookup& configuration) {
    for (const CfgInstance* instance : configuration("MOC", "MECHANICAL_UNIT")) {
        const std::string name = instance->text("name");
        if (name.empty() || find(name) != nullptr) continue;
        auto unit = std::make_unique<MechanicalUnit>();
        unit->name = unit->geometry.name = name;
        unit->isActive = instance->flag("activate_at_start_up");
        unit->staysActive = instance->flag("deactivation_forbidden");
        for (const std::string& single : singlesOf(*instance)) {
            const SingleReader reader(configuration, single);
            const std::size_t index = reader.axisIndex().value_or(kUnnumbered);
            unit->own.push_back({single, index, reader.limits()});
            unit->geometry.joints.push_back({index, reader.isRotating(), reader.base(), 0});
            if (unit->carrier.empty()) unit->carrier = reader.carrier(); // of the first one
        }
        const auto processes = configuration("PROC", "CONVEYOR");
        unit->isConveyor = isConveyorName(name) ||
                           std::any_of(processes.begin(), processes.end(), [&](const CfgInstance* process) {
                               return sameName(process->text("Name"), name);
                           });
        if (unit->isConveyor) { // not an axis that a planner moves
            unit->axes = 1;
            unit->own.clear();
            unit->carrier.clear();
            units_.push_back(std::move(unit));
            continue;
        }
        unit->axes = static_cast<int>(unit->own.size());
        units_.push_back(std::move(unit));
    }
}

void MechanicalUnits::addGroups(const CfgLookup& configuration) {
    for (const CfgInstance* instance : configuration("SYS", "MECHANICAL_UNIT_GROUP")) {
        const MechanicalUnit* robot = find(instance->text("Robot"));
        std::size_t group = groups_.size();
        if (robot != nullptr && robot->isRobot) {
            group = robot->group;
        } else {
            MotionGroup alone;
            alone.model = robot::armlessModel();
            groups_.push_back(std::move(alone));
        }
        groups_[group].name = instance->text("Name");
        for (const CfgAttribute& attribute : instance->attributes) {
            if (!attribute.name.starts_with("MechanicalUnit")) continue;
            for (const std::string& name : attribute.values)
                if (MechanicalUnit* unit = find(name); unit != nullptr && !unit->isRobot) unit->group = group;
        }
    }
}

/// Logical axes 7 to 12 are eax_a to eax_f of the group; an axis without a number takes the first that is free.
void MechanicalUnits::connectAxes() {
    std::vector<std::array<bool, robot::kExternalCount>> taken(groups_.size());
    for (std::size_t i = 0; i < groups_.size(); ++i)
        taken[i][0] = groups_[i].model.lowerDeg.size() > 6; // the seventh axis of the arm is eax_a
    for (const auto& unit : units_)
        for (const MechanicalUnit::Axis& axis : unit->own)
            if (axis.index != kUnnumbered) taken[unit->group][axis.index] = true;
    for (const auto& unit : units_) {
        auto& used = taken[unit->group];
        for (std::size_t i = 0; i < unit->own.size(); ++i) {
            MechanicalUnit::Axis& axis = unit->own[i];
            if (axis.index == kUnnumbered)
                axis.index =
                    static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
            if (axis.index >= used.size()) { // more axes than a position has
                warnings_.push_back(
                    fmt::format("axis {} of {} does not move: a motion group has six external axes",
                                axis.single, unit->name));
                unit->own.resize(i);
                unit->geometry.joints.resize(i);
                unit->axes = static_cast<int>(i);
                break;
            }
            used[axis.index] = true;
            unit->geometry.joints[i].axis = axis.index;
            motion::ExternalAxisModel& model = groups_[unit->group].options.external[axis.index];
            model = axis.limits;
            model.present = unit->isActive;
        }
    }
}

/// Robots and units whose base another unit of the group moves.
void MechanicalUnits::carryBases() {
    for (const auto& unit : units_) {
        const MechanicalUnit* carrier = carrierNamed(unit->carrier);
        if (carrier == nullptr || carrier == unit.get() || carrier->group != unit->group) continue;
        if (unit->isRobot)
            groups_[unit->group].options.baseMover = &carrier->geometry;
        else
            unit->geometry.joints.insert(unit->geometry.joints.begin(), carrier->geometry.joints.begin(),
                                         carrier->geometry.joints.end());
    }
}

/// The external unit with that name, or that has a single with that name (they are usually the same).
MechanicalUnit* MechanicalUnits::carrierNamed(std::string_view name) const {
    for (const auto& unit : units_) {
        const bool hasSingle =
            std::any_of(unit->own.begin(), unit->own.end(),
                        [&](const MechanicalUnit::Axis& axis) { return sameName(axis.single, name); });
        if (!name.empty() && !unit->isRobot && (hasSingle || sameName(unit->name, name))) return unit.get();
    }
    return nullptr;
}

void MechanicalUnits::setActive(MechanicalUnit& unit, bool active, robot::ExternalAxes& axes) {
    unit.isActive = active;
    for (const MechanicalUnit::Axis& axis : unit.own) {
        for (const auto& carried : units_) { // also those that it carries
            if (carried->group != unit.group) continue;
            for (robot::ExternalJoint& joint : carried->geometry.joints)
                if (joint.axis == axis.index && !active) joint.parked = axes[axis.index];
        }
    }
    for (std::size_t i = 0; i < unit.own.size(); ++i) {
        // The unit's own axes are the last ones of its chain.
        const std::size_t joint = unit.geometry.joints.size() - unit.own.size() + i;
        axes[unit.own[i].index] = active ? unit.geometry.joints[joint].parked : robot::kNotConnected;
    }
}

bool MechanicalUnits::addConveyor(const std::string& name) {
    if (const MechanicalUnit* unit = find(name)) return unit->isConveyor;
    auto unit = std::make_unique<MechanicalUnit>();
    unit->name = unit->geometry.name = name;
    unit->isConveyor = true;
    unit->axes = 1;
    units_.push_back(std::move(unit));
    return true;
}

MechanicalUnit* MechanicalUnits::find(std::string_view name) const {
    for (const auto& unit : units_)
        if (sameName(unit->name, name)) return unit.get();
    return nullptr;
}

int MechanicalUnits::groupNamed(std::string_view name) const {
    for (std::size_t i = 0; i < groups_.size(); ++i)
        if (!name.empty() && sameName(groups_[i].name, name)) return static_cast<int>(i);
    return -1;
}

} // namespace rt

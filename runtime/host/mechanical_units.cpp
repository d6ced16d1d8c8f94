#include "runtime/host/mechanical_units.h"

#include "runtime/base/text_util.h"
#include "runtime/host/axis_reader.h"
#include "runtime/host/cfg_types.h"
#include "runtime/robot/angles.h"
#include "runtime/robot/robot_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace rt {

namespace {

constexpr const char* kFirstRobot = "ROB_1";
constexpr std::size_t kUnnumbered = 99; // an axis whose place among the external axes is not known yet

/// Bounds of the robot's axes.
void applyBounds(const std::vector<const CfgInstance*>& arms, std::string_view name, std::size_t robot,
                 robot::RobotModel& model) {
    for (const CfgInstance* arm : arms) {
        for (std::size_t axis = 0; axis < model.lowerDeg.size(); ++axis) {
            if (!sameName(arm->text("name"), robotAxisName(name, robot, axis + 1))) continue;
            double bound = 0;
            if (arm->number("upper_joint_bound", bound))
                model.upperDeg[axis] = bound * robot::kDegreesPerRadian;
            if (arm->number("lower_joint_bound", bound))
                model.lowerDeg[axis] = bound * robot::kDegreesPerRadian;
        }
    }
}

/// Turns z to y: the axis about which a positioner of two axes tilts its plate, as far as nothing else is given.
robot::Quat tiltAxis() {
    return robot::fromAxisAngle({1, 0, 0}, -90);
}

/// The MECHANICAL_UNIT of a ROBOT; null when there is none.
const CfgInstance* unitWithRobot(const CfgLookup& configuration, std::string_view robot) {
    for (const CfgInstance* unit : configuration("MOC", "MECHANICAL_UNIT"))
        if (sameName(unit->text("use_robot"), robot)) return unit;
    return instanceNamed(configuration("MOC", "MECHANICAL_UNIT"), robot);
}

/// Joints of a ROBOT: use_joint_0 and so on; else "STN1_1", "STN1_2"; else the usual names of a station, "ARM1" (tilting) and
/// "PLATE1" with the number of the unit.
std::vector<std::string> jointsOf(const CfgLookup& configuration, const CfgInstance& robot) {
    std::vector<std::string> names;
    for (int i = 0; i < robot::kExternalCount; ++i)
        if (std::string name = robot.text(fmt::format("use_joint_{}", i)); !name.empty())
            names.push_back(std::move(name));
    if (!names.empty()) return names;
    const auto add = [&](const std::string& name) {
        if (instanceNamed(configuration("MOC", "JOINT"), name) != nullptr ||
            instanceNamed(configuration("MOC", "ARM"), name) != nullptr)
            names.push_back(name);
    };
    const std::string unit = robot.text("name");
    for (int i = 1; i <= robot::kExternalCount; ++i)
        add(fmt::format("{}_{}", unit, i));
    if (!names.empty()) return names;
    const std::string number = unit.substr(std::min(unit.size(), unit.find_last_not_of("0123456789") + 1));
    add("ARM" + number);
    add("PLATE" + number);
    return names;
}

/// A ROBOT that is a positioner (IRBP), or of an unknown model while its joints are described.
bool isPositioner(const CfgLookup& configuration, const CfgInstance& robot, bool isUnknown) {
    if (jointsOf(configuration, robot).empty()) return false;
    return upperCase(robot.text("use_robot_type")).find("IRBP") != std::string::npos ||
           (isUnknown && !upperCase(robot.text("use_robot_type")).starts_with("ROB"));
}

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
        plans.push_back({name, {}, nullptr});
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
        RobotPlan& plan =
            equals == std::string::npos ? firstRobot(configuration, plans) : planned(asked.substr(0, equals));
        plan.model = equals == std::string::npos ? asked : asked.substr(equals + 1);
        plan.isAsked = true;
    }
    if (configuration("MOC", "ROBOT").empty()) // nothing names the robots of several motion tasks
        while (plans.size() < needed)
            planned(fmt::format("ROB_{}", plans.size() + 1));
    RobotPlan& first = firstRobot(configuration, plans);
    first.isAssumed = first.model.empty();
    if (first.isAssumed) first.model = defaultModel;
    for (RobotPlan& plan : plans) {
        if (!plan.model.empty()) continue;
        plan.model = first.model;
        plan.isAssumed = first.isAssumed;
    }
    return plans;
}

/// The first one that has a TCP.
MechanicalUnits::RobotPlan& MechanicalUnits::firstRobot(const CfgLookup& configuration,
                                                        std::vector<RobotPlan>& plans) {
    for (RobotPlan& plan : plans)
        if (plan.instance == nullptr || !isPositioner(configuration, *plan.instance, false)) return plan;
    return plans.front();
}

std::string MechanicalUnits::addRobots(const CfgLookup& configuration, const std::vector<RobotPlan>& plans,
                                       bool& isUsage) {
    std::vector<const RobotPlan*> positioners;
    for (const RobotPlan& plan : plans) {
        auto unit = std::make_unique<MechanicalUnit>();
        unit->name = plan.name;
        auto model = robot::loadRobotModel(plan.model);
        if (!plan.isAsked && plan.instance != nullptr &&
            isPositioner(configuration, *plan.instance, !model)) {
            positioners.push_back(&plan);
            continue;
        }
        if (!model && !plan.isAsked) takeSimilar(plan, model);
        if (!model && (groups_.empty() || plan.isAsked)) {
            isUsage = plan.isAsked;
            return model.error().message;
        }
        if (!model) {
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
        group.isModelAssumed = plan.isAssumed;
        if (plan.instance != nullptr)
            group.model.baseFrame = baseFrameOf(*plan.instance, group.model.baseFrame);
        applyBounds(configuration("MOC", "ARM"), plan.name, groups_.size(), group.model);
        unit->isRobot = unit->isActive = unit->staysActive = true;
        unit->axes = static_cast<int>(group.model.lowerDeg.size());
        unit->group = groups_.size();
        if (plan.instance != nullptr) unit->carrier = plan.instance->text("base_frame_coordinated");
        groups_.push_back(std::move(group));
        units_.push_back(std::move(unit));
    }
    for (const RobotPlan* plan : positioners)
        addPositioner(configuration, *plan->instance);
    return {};
}

/// A robot of the configuration that is not in the catalogue: one like it moves instead.
void MechanicalUnits::takeSimilar(const RobotPlan& plan,
                                  robot::Expected<robot::RobotModel, robot::ModelError>& model) {
    const std::string similar = robot::similarRobotModel(plan.model);
    if (similar.empty()) return;
    model = robot::loadRobotModel(similar);
    warnings_.push_back(
        fmt::format("the robot {} ({}) of MOC.cfg is not in the catalogue: {} takes its place; "
                    "--robot names another one",
                    plan.name, plan.model, similar));
}

/// An instance of ROBOT without TCP: the axes of a positioner.
void MechanicalUnits::addPositioner(const CfgLookup& configuration, const CfgInstance& instance) {
    auto unit = std::make_unique<MechanicalUnit>();
    unit->name = unit->geometry.name = instance.text("name");
    unit->carrier = instance.text("base_frame_coordinated");
    const CfgInstance* of = unitWithRobot(configuration, unit->name);
    unit->isActive = of == nullptr || of->flag("activate_at_start_up");
    unit->staysActive = of != nullptr && of->flag("deactivation_forbidden");
    const robot::Pose base = baseFrameOf(instance);
    robot::Pose frame = base;
    bool isDescribed = false; // by ARM_TYPE
    const std::vector<std::string> joints = jointsOf(configuration, instance);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const AxisReader reader = AxisReader::ofJoint(configuration, joints[i]);
        const std::size_t index = reader.axisIndex().value_or(kUnnumbered);
        if (const auto step = reader.step()) {
            frame = frame * *step;
            isDescribed = true;
        }
        robot::Pose axis = isDescribed ? frame : base;
        if (!isDescribed && i + 1 < joints.size()) axis.rot = base.rot * tiltAxis();
        unit->own.push_back({joints[i], index, reader.limits(), reader.mayBeIndependent()});
        unit->geometry.joints.push_back({index, true, axis, 0});
    }
    unit->axes = static_cast<int>(unit->own.size());
    units_.push_back(std::move(unit));
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
            const AxisReader reader = AxisReader::ofSingle(configuration, single);
            const std::size_t index = reader.axisIndex().value_or(kUnnumbered);
            unit->own.push_back({single, index, reader.limits(), reader.mayBeIndependent()});
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
            unit->geometry.joints[i].isParked = !unit->isActive;
        }
    }
    for (const auto& unit : units_)
        startUnit(*unit);
}

/// Stations that are never active together may share logical axes; the first active one has them.
void MechanicalUnits::startUnit(MechanicalUnit& unit) {
    if (unit.own.empty()) return;
    if (const MechanicalUnit* other = unit.isActive ? sharesAxes(unit) : nullptr) {
        warnings_.push_back(
            fmt::format("{} is not active at the start: it shares a logical axis with {}, which is. "
                        "Remove activate_at_start_up of one of them",
                        unit.name, other->name));
        unit.isActive = false;
        for (robot::ExternalJoint& joint : unit.geometry.joints)
            joint.isParked = true;
    }
    for (const MechanicalUnit::Axis& axis : unit.own) {
        motion::ExternalAxisModel& model = groups_[unit.group].options.external[axis.index];
        if (model.present) continue;
        model = axis.limits;
        model.present = unit.isActive;
    }
}

const MechanicalUnit* MechanicalUnits::sharesAxes(const MechanicalUnit& unit) const {
    for (const auto& other : units_) {
        if (other.get() == &unit || other->group != unit.group || !other->isActive) continue;
        for (const MechanicalUnit::Axis& a : unit.own)
            for (const MechanicalUnit::Axis& b : other->own)
                if (a.index == b.index) return other.get();
    }
    return nullptr;
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
    const auto park = [&](robot::ExternalJoint& joint) {
        if (!active) joint.parked = axes[joint.axis];
        joint.isParked = !active;
    };
    // The unit's own axes are the last ones of its chain, and the first ones of the chains of units that it carries.
    const std::size_t first = unit.geometry.joints.size() - unit.own.size();
    for (const auto& carried : units_)
        if (carried.get() != &unit && carried->group == unit.group && !carried->isRobot &&
            carrierNamed(carried->carrier) == &unit)
            for (std::size_t i = 0; i < unit.own.size(); ++i)
                park(carried->geometry.joints[first + i]);
    for (std::size_t i = 0; i < unit.own.size(); ++i)
        park(unit.geometry.joints[first + i]);
    for (std::size_t i = 0; i < unit.own.size(); ++i)
        axes[unit.own[i].index] = active ? unit.geometry.joints[first + i].parked : robot::kNotConnected;
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

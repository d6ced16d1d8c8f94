#include "runtime/host/cfg_types.h"

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "runtime/robot/angles.h"
#include "runtime/robot/lengths.h"

#include <fmt/format.h>

#include <array>

namespace rt {

std::string robotTypeName(const std::string& model, std::size_t group) {
    std::string type = fmt::format("ROB{}_", group + 1);
    for (const char c : model.substr(std::min(model.find(' ') + 1, model.size())))
        type += c == '-' || c == '/' || c == ' ' ? '_' : c;
    return type;
}

std::string robotAxisName(std::string_view robot, std::size_t group, std::size_t axis) {
    constexpr std::string_view kRobot = "ROB_";
    const bool hasLetter = robot.size() > kRobot.size() && sameName(robot.substr(0, kRobot.size()), kRobot) &&
                           robot.find_first_of("0123456789") == std::string_view::npos;
    return hasLetter ? fmt::format("rob_{}_{}", robot.substr(kRobot.size()), axis)
                     : fmt::format("rob{}_{}", group + 1, axis);
}

namespace {

struct Row {
    const char *domain, *type, *attributes;
};
constexpr Row kRows[] = {
#define CFG_TYPE(domain, type, attributes) {domain, type, attributes},
#include "runtime/host/cfg_types.def"
#undef CFG_TYPE
};

CfgType read(const Row& row) {
    CfgType type{row.domain, row.type, {}};
    std::string_view rest = row.attributes;
    while (!rest.empty()) {
        const std::string_view one = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(rest.size(), one.size() + 1));
        const std::size_t colon = one.find(':');
        type.attributes.push_back({std::string(one.substr(0, colon)),
                                   static_cast<CfgValueKind>(one[colon + 1]),
                                   std::string(one.substr(colon + 3))});
    }
    return type;
}

const std::vector<CfgType>& allTypes() {
    static const std::vector<CfgType> types = [] {
        std::vector<CfgType> all;
        for (const Row& row : kRows)
            all.push_back(read(row));
        return all;
    }();
    return types;
}

CfgInstance& add(std::vector<CfgInstance>& instances) {
    return instances.emplace_back();
}
void put(CfgInstance& instance, std::string name, const std::string& value) {
    instance.attributes.push_back({std::move(name), {value}, true, 0});
}
void putNumber(CfgInstance& instance, std::string name, double value) {
    instance.attributes.push_back(
        {std::move(name), {fmt::format("{}", static_cast<float>(value))}, false, 0});
}
void putFlag(CfgInstance& instance, std::string name, bool value) {
    if (value) instance.attributes.push_back({std::move(name), {}, false, 0});
}

/// One axis of a robot or an external unit.
struct Axis {
    std::string name; ///< of its JOINT, ARM and TRANSMISSION
    int logical = 0, kinematic = 0;
    bool rotating = true;
    double lower = 0, upper = 0; ///< rad or m
};

std::vector<Axis> axesOf(const MechanicalUnits& units, const MechanicalUnit& unit) {
    std::vector<Axis> axes;
    if (!unit.isRobot) {
        int number = 0;
        for (const MechanicalUnit::Axis& own : unit.own) {
            const double factor = own.limits.rotating ? robot::kDegreesPerRadian : robot::kMmPerMetre;
            axes.push_back({own.single.empty() ? fmt::format("{}_{}", unit.name, number + 1) : own.single,
                            7 + static_cast<int>(own.index), ++number, own.limits.rotating,
                            own.limits.lower / factor, own.limits.upper / factor});
        }
        return axes;
    }
    const robot::RobotModel& model = units.groups()[unit.group].model;
    const robot::Kinematics kinematics(model);
    for (std::size_t i = 0; i < kinematics.jointCount(); ++i) {
        const int number = kinematics.axisNumber(i);
        const double factor = kinematics.isLinear(i) ? robot::kMmPerMetre : robot::kDegreesPerRadian;
        axes.push_back({robotAxisName(unit.name, unit.group, static_cast<std::size_t>(number)), number,
                        number, !kinematics.isLinear(i), model.lowerDeg[i] / factor,
                        model.upperDeg[i] / factor});
    }
    return axes;
}

void putFrame(CfgInstance& instance, const robot::Pose& frame) {
    putNumber(instance, "base_frame_pos_x", frame.pos.x / robot::kMmPerMetre);
    putNumber(instance, "base_frame_pos_y", frame.pos.y / robot::kMmPerMetre);
    putNumber(instance, "base_frame_pos_z", frame.pos.z / robot::kMmPerMetre);
    putNumber(instance, "base_frame_orient_u0", frame.rot.w);
    putNumber(instance, "base_frame_orient_u1", frame.rot.x);
    putNumber(instance, "base_frame_orient_u2", frame.rot.y);
    putNumber(instance, "base_frame_orient_u3", frame.rot.z);
}

void addAxis(std::vector<CfgInstance>& instances, std::string_view type, const Axis& axis) {
    CfgInstance& instance = add(instances);
    put(instance, "name", axis.name);
    if (type == "ARM") {
        put(instance, "use_arm_type", axis.name);
        putNumber(instance, "upper_joint_bound", axis.upper);
        putNumber(instance, "lower_joint_bound", axis.lower);
    } else if (type == "JOINT") {
        putNumber(instance, "logical_axis", axis.logical);
        putNumber(instance, "kinematic_axis_number", axis.kinematic);
        put(instance, "use_arm", axis.name);
        put(instance, "use_transmission", axis.name);
    } else {
        putFlag(instance, "rotating_move", axis.rotating);
    }
}

void addRobot(std::vector<CfgInstance>& instances, const MechanicalUnits& units, const MechanicalUnit& unit) {
    CfgInstance& instance = add(instances);
    const MotionGroup& group = units.groups()[unit.group];
    put(instance, "name", unit.name);
    put(instance, "use_robot_type", robotTypeName(group.model.name, unit.group));
    std::size_t joint = 0;
    for (const Axis& axis : axesOf(units, unit))
        if (joint < 6) put(instance, fmt::format("use_joint_{}", joint++), axis.name);
    putFrame(instance, group.model.baseFrame);
    put(instance, "base_frame_coordinated", unit.carrier);
}

void addUnit(std::vector<CfgInstance>& instances, const MechanicalUnits& units, const MechanicalUnit& unit) {
    CfgInstance& instance = add(instances);
    put(instance, "name", unit.name);
    if (unit.isRobot) put(instance, "use_robot", unit.name);
    std::size_t single = 0;
    if (!unit.isRobot)
        for (const Axis& axis : axesOf(units, unit))
            if (single < 6) put(instance, fmt::format("use_single_{}", single++), axis.name);
    putFlag(instance, "activate_at_start_up", unit.isActive);
    putFlag(instance, "deactivation_forbidden", unit.staysActive);
}

/// Of MECHANICAL_UNIT_GROUP; controllers call those that no file names rob1, rob2 ...
std::string groupName(const MechanicalUnits& units, std::size_t number) {
    const std::string& name = units.groups()[number].name;
    return name.empty() ? fmt::format("rob{}", number + 1) : name;
}

void addGroup(std::vector<CfgInstance>& instances, const MechanicalUnits& units, std::size_t number) {
    CfgInstance& instance = add(instances);
    const MotionGroup& group = units.groups()[number];
    put(instance, "Name", groupName(units, number));
    put(instance, "Robot", group.robot);
    std::size_t other = 1;
    for (const auto& unit : units.all())
        if (!unit->isRobot && unit->group == number && other <= 6)
            put(instance, fmt::format("MechanicalUnit_{}", other++), unit->name);
}

void addTask(std::vector<CfgInstance>& instances, const Controller& controller, const Task& task) {
    CfgInstance& instance = add(instances);
    put(instance, "Name", task.name());
    put(instance, "Type", controller.program().tasks[task.index()].type);
    putFlag(instance, "MotionTask", task.isMotionTask());
    if (!task.isMotionTask()) return;
    const auto group = static_cast<std::size_t>(task.motionGroup());
    if (group < controller.units().groups().size())
        put(instance, "UseMechanicalUnitGroup", groupName(controller.units(), group));
}

/// Levels of access that every controller has; the client on the controller is the FlexPendant.
void addAccessLevels(std::vector<CfgInstance>& instances) {
    constexpr std::array kAll = {"Rapid", "LocalManual", "LocalAuto", "RemoteManual", "RemoteAuto"};
    constexpr std::array kLevels = {std::pair("All", 5), std::pair("Default", 2), std::pair("ReadOnly", 0)};
    for (const auto& [name, rights] : kLevels) {
        CfgInstance& instance = add(instances);
        put(instance, "Name", name);
        for (std::size_t i = 0; i < static_cast<std::size_t>(rights); ++i)
            putFlag(instance, kAll[i], true);
    }
}

/// Calibration of each axis, and the serial number and arm loads of each robot.
void addRobotData(std::vector<CfgInstance>& instances, const MechanicalUnits& units,
                  const MechanicalUnit& unit, std::string_view type) {
    constexpr int kArmLoads = 4; // of each robot
    if (type == "MOTOR_CALIB")
        for (const Axis& axis : axesOf(units, unit)) {
            CfgInstance& instance = add(instances);
            put(instance, "name", axis.name);
            putFlag(instance, "valid_cal_offset", true);
        }
    if (!unit.isRobot) return;
    if (type == "ROBOT_SERIAL_NUMBER") {
        CfgInstance& instance = add(instances);
        const std::size_t hyphen = kSerialNumber.find('-');
        put(instance, "name", fmt::format("rob_{}", unit.group + 1));
        put(instance, "robot_serial_number_high_part", std::string(kSerialNumber.substr(0, hyphen)));
        put(instance, "robot_serial_number_low_part", std::string(kSerialNumber.substr(hyphen + 1)));
    }
    if (type == "ARM_LOAD")
        for (int i = 1; i <= kArmLoads; ++i)
            put(add(instances), "name", fmt::format("r{}_load_{}", unit.group + 1, i));
}

void addSingles(std::vector<CfgInstance>& instances, const MechanicalUnits& units,
                const MechanicalUnit& unit) {
    for (const Axis& axis : axesOf(units, unit)) {
        CfgInstance& single = add(instances);
        put(single, "name", axis.name);
        put(single, "use_single_type", axis.name);
        put(single, "use_joint", axis.name);
        const auto index = static_cast<std::size_t>(axis.kinematic - 1);
        putFrame(single,
                 index < unit.geometry.joints.size() ? unit.geometry.joints[index].base : robot::Pose());
    }
}

/// The instances that a motion group needs besides its units; controllers number the planners and supervisions from 1.
void addPlanning(std::vector<CfgInstance>& instances, std::size_t number, std::string_view type) {
    const std::string planner = fmt::format("motion_planner_{}", number + 1);
    const std::string supervision = fmt::format("rob{}", number + 1);
    CfgInstance& instance = add(instances);
    put(instance, "name", type == "MOTION_SUP" ? supervision : planner);
    if (type == "MOTION_SUP") {
        putFlag(instance, "path_col_detect_on", true);
        putFlag(instance, "jog_col_detect_on", true);
    } else if (type == "MOTION_PLANNER") {
        put(instance, "use_motion_sup", supervision);
        put(instance, "use_jog_parameters", planner);
        putFlag(instance, "use_for_jogging", true);
        putFlag(instance, "repos_installed", true);
    }
}

void addMotionSystem(std::vector<CfgInstance>& instances) {
    CfgInstance& instance = add(instances);
    put(instance, "name", "system_1");
    for (const char* place : {"cabinet", "robot"}) { // degrees Celsius
        putNumber(instance, fmt::format("min_temp_ambient_{}", place), 5);
        putNumber(instance, fmt::format("max_temp_ambient_{}", place), 45);
    }
}

/// The settings that files of controllers have without a change by the user.
void addSettings(std::vector<CfgInstance>& instances, const Controller& controller) {
    const std::array settings = {
        std::pair("SimulateMenu", 1),          std::pair("NoOfRetry", controller.settings().noOfRetry),
        std::pair("ModalPayLoadMode", 1),      std::pair("StationaryPayLoadMode", 0),
        std::pair("PayloadsInWristCoords", 0), std::pair("CollisionErrorHandling", 0)};
    for (const auto& [name, value] : settings) {
        CfgInstance& instance = add(instances);
        put(instance, "Name", name);
        putNumber(instance, "Value", value);
    }
}

void addSystemParameters(std::vector<CfgInstance>& instances, const Controller& controller,
                         std::string_view type) {
    const MechanicalUnits& units = controller.units();
    if (type == "MECHANICAL_UNIT_GROUP")
        for (std::size_t i = 0; i < units.groups().size(); ++i)
            addGroup(instances, units, i);
    if (type == "CAB_TASKS")
        for (const auto& task : controller.tasks())
            addTask(instances, controller, *task);
    if (type == "SYS_MISC") addSettings(instances, controller);
    if (type == "RUN_MODE_SETTINGS")
        for (const char* name : {"AutoToManual", "ManualToAuto"})
            put(add(instances), "name", name);
}

} // namespace

const CfgAttributeType* CfgType::find(std::string_view attribute) const {
    for (const CfgAttributeType& each : attributes)
        if (sameName(each.name, attribute)) return &each;
    return nullptr;
}

const CfgType* cfgType(std::string_view domain, std::string_view type) {
    for (const CfgType& each : allTypes())
        if (sameName(each.domain, domain) && sameName(each.type, type)) return &each;
    return nullptr;
}

std::vector<std::string> cfgTypesOf(std::string_view domain) {
    std::vector<std::string> types;
    for (const CfgType& each : allTypes())
        if (sameName(each.domain, domain)) types.push_back(each.type);
    return types;
}

std::vector<CfgInstance> impliedInstances(const Controller& controller, std::string_view domain,
                                          std::string_view wanted) {
    std::vector<CfgInstance> instances;
    const MechanicalUnits& units = controller.units();
    const std::string type = upperCase(wanted);
    if (sameName(domain, "SYS")) addSystemParameters(instances, controller, type);
    if (sameName(domain, "EIO") && type == "EIO_ACCESS") addAccessLevels(instances);
    if (!sameName(domain, "MOC")) return instances;
    if (type == "MOTION_SYSTEM") addMotionSystem(instances);
    if (type == "MOTION_SUP" || type == "MOTION_PLANNER" || type == "JOG_PARAMETERS")
        for (std::size_t i = 0; i < units.groups().size(); ++i)
            addPlanning(instances, i, type);
    for (const auto& unit : units.all()) {
        if (type == "ARM" || type == "JOINT" || type == "TRANSMISSION")
            for (const Axis& axis : axesOf(units, *unit))
                addAxis(instances, type, axis);
        if (type == "ROBOT" && unit->isRobot) addRobot(instances, units, *unit);
        if (type == "MECHANICAL_UNIT") addUnit(instances, units, *unit);
        if (type == "SINGLE" && !unit->isRobot) addSingles(instances, units, *unit);
        addRobotData(instances, units, *unit, type);
    }
    return instances;
}

} // namespace rt

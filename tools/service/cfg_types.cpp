#include "tools/service/cfg_types.h"

#include "config/letter_case.h"

#include <fmt/format.h>

#include <array>

namespace rapidc::service {

namespace {

using rapid::config::CfgAttribute;
using rapid::config::CfgInstance;
using rapid::config::sameName;

constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;
constexpr double kMillimetres = 1000;

struct Row {
    const char *domain, *type, *attributes;
};
constexpr Row kRows[] = {
#define CFG_TYPE(domain, type, attributes) {domain, type, attributes},
#include "tools/service/cfg_types.def"
#undef CFG_TYPE
};

CfgType read(const Row& row) {
    CfgType type{row.domain, row.type, {}};
    std::string_view rest = row.attributes;
    while (!rest.empty()) {
        const std::string_view one = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(rest.size(), one.size() + 1));
        const std::size_t colon = one.find(':');
        type.attributes.push_back({std::string(one.substr(0, colon)), static_cast<CfgKind>(one[colon + 1]),
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

std::vector<Axis> axesOf(const rt::MechanicalUnits& units, const rt::MechanicalUnit& unit) {
    std::vector<Axis> axes;
    if (!unit.isRobot) {
        int number = 0;
        for (const rt::MechanicalUnit::Axis& own : unit.own) {
            const double factor = own.limits.rotating ? kDegreesPerRadian : kMillimetres;
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
        const double factor = kinematics.isLinear(i) ? kMillimetres : kDegreesPerRadian;
        axes.push_back({fmt::format("rob{}_{}", unit.group + 1, number), number, number,
                        !kinematics.isLinear(i), model.lowerDeg[i] / factor, model.upperDeg[i] / factor});
    }
    return axes;
}

void putFrame(CfgInstance& instance, const robot::Pose& frame) {
    putNumber(instance, "base_frame_pos_x", frame.pos.x / kMillimetres);
    putNumber(instance, "base_frame_pos_y", frame.pos.y / kMillimetres);
    putNumber(instance, "base_frame_pos_z", frame.pos.z / kMillimetres);
    putNumber(instance, "base_frame_orient_u0", frame.rot.w);
    putNumber(instance, "base_frame_orient_u1", frame.rot.x);
    putNumber(instance, "base_frame_orient_u2", frame.rot.y);
    putNumber(instance, "base_frame_orient_u3", frame.rot.z);
}

/// "IRB 120-3/0.58" as use_robot_type has it: "ROB1_120_3_0.58".
std::string robotType(const std::string& model, std::size_t group) {
    std::string type = fmt::format("ROB{}_", group + 1);
    for (const char c : model.substr(std::min(model.find(' ') + 1, model.size())))
        type += c == '-' || c == '/' || c == ' ' ? '_' : c;
    return type;
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

void addRobot(std::vector<CfgInstance>& instances, const rt::MechanicalUnits& units,
              const rt::MechanicalUnit& unit) {
    CfgInstance& instance = add(instances);
    const rt::MotionGroup& group = units.groups()[unit.group];
    put(instance, "name", unit.name);
    put(instance, "use_robot_type", robotType(group.model.name, unit.group));
    std::size_t joint = 0;
    for (const Axis& axis : axesOf(units, unit))
        if (joint < 6) put(instance, fmt::format("use_joint_{}", joint++), axis.name);
    putFrame(instance, group.model.baseFrame);
    put(instance, "base_frame_coordinated", unit.carrier);
}

void addUnit(std::vector<CfgInstance>& instances, const rt::MechanicalUnits& units,
             const rt::MechanicalUnit& unit) {
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

void addGroup(std::vector<CfgInstance>& instances, const rt::MechanicalUnits& units, std::size_t number) {
    CfgInstance& instance = add(instances);
    const rt::MotionGroup& group = units.groups()[number];
    const std::string fallback = number == 0 ? "rob1" : fmt::format("rob{}", number + 1);
    put(instance, "Name", group.name.empty() ? fallback : group.name);
    put(instance, "Robot", group.robot);
    std::size_t other = 1;
    for (const auto& unit : units.all())
        if (!unit->isRobot && unit->group == number && other <= 6)
            put(instance, fmt::format("MechanicalUnit_{}", other++), unit->name);
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

std::vector<CfgInstance> impliedInstances(const rt::MechanicalUnits& units, std::string_view domain,
                                          std::string_view wanted) {
    std::vector<CfgInstance> instances;
    const std::string type = rapid::config::upperCase(wanted);
    if (sameName(domain, "SYS") && type == "MECHANICAL_UNIT_GROUP") {
        for (std::size_t i = 0; i < units.groups().size(); ++i)
            addGroup(instances, units, i);
        return instances;
    }
    if (!sameName(domain, "MOC")) return instances;
    for (const auto& unit : units.all()) {
        if (type == "ARM" || type == "JOINT" || type == "TRANSMISSION")
            for (const Axis& axis : axesOf(units, *unit))
                addAxis(instances, type, axis);
        if (type == "ROBOT" && unit->isRobot) addRobot(instances, units, *unit);
        if (type == "MECHANICAL_UNIT") addUnit(instances, units, *unit);
        if (type != "SINGLE" || unit->isRobot) continue;
        for (const Axis& axis : axesOf(units, *unit)) {
            CfgInstance& single = add(instances);
            put(single, "name", axis.name);
            put(single, "use_single_type", axis.name);
            put(single, "use_joint", axis.name);
            const auto index = static_cast<std::size_t>(axis.kinematic - 1);
            putFrame(single, index < unit->geometry.joints.size() ? unit->geometry.joints[index].base
                                                                  : robot::Pose());
        }
    }
    return instances;
}

} // namespace rapidc::service

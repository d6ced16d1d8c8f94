#pragma once
// CfgTypes: the attributes of configuration types (cfg_types.def), and the instances that a controller has without a file saying so:
// the joints of a robot belong to its model, its tasks to the program.

#include "runtime/host/mechanical_units.h"

#include <string>
#include <string_view>
#include <vector>

namespace rt {

class Controller;

enum class CfgValueKind : char { Text = 's', Number = 'n', Flag = 'b' };

struct CfgAttributeType {
    std::string name;
    CfgValueKind kind = CfgValueKind::Text;
    std::string standard; ///< as shown: "0", "false"
};

struct CfgType {
    std::string domain, type;
    std::vector<CfgAttributeType>
        attributes; ///< the first one is the name of an instance, unless the type has none
    const CfgAttributeType* find(std::string_view attribute) const;
};

/// Null for a type that the table does not have.
const CfgType* cfgType(std::string_view domain, std::string_view type);
/// The types of a domain in the table.
std::vector<std::string> cfgTypesOf(std::string_view domain);

/// use_robot_type of a model in a motion group, counted from 0: "ROB1_120_3_0.58" of "IRB 120-3/0.58".
std::string robotTypeName(const std::string& model, std::size_t group);

/// Name of a robot's axis, from 1: "rob1_1" of ROB_1, the robot of the first motion group (counted from 0), and "rob_L_1" of ROB_L: a
/// robot with a letter, as those of a YuMi.
std::string robotAxisName(std::string_view robot, std::size_t group, std::size_t axis);

/// Serial number of the simulated robot: its parts before and after the hyphen are parameters (ROBOT_SERIAL_NUMBER).
inline constexpr std::string_view kSerialNumber = "00-00000";

/// Instances of a type that a controller has without a file: from the mechanical units (MOC, MECHANICAL_UNIT_GROUP), the tasks
/// (CAB_TASKS), and the levels of access that are always there. Lengths in metres, angles in radians.
std::vector<CfgInstance> impliedInstances(const Controller& controller, std::string_view domain,
                                          std::string_view type);

} // namespace rt

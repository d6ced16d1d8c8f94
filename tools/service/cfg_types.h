#pragma once
// CfgTypes: the attributes of configuration types (cfg_types.def), and the instances that a controller has without a file saying so:
// the joints of a robot belong to its model.

#include "config/cfg_parser.h"
#include "runtime/host/mechanical_units.h"

#include <string>
#include <string_view>
#include <vector>

namespace rapidc::service {

enum class CfgKind : char { Text = 's', Number = 'n', Flag = 'b' };

struct CfgAttributeType {
    std::string name;
    CfgKind kind = CfgKind::Text;
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

/// Instances of MOC types and SYS MECHANICAL_UNIT_GROUP from the mechanical units. Lengths in metres, angles in radians.
std::vector<rapid::config::CfgInstance> impliedInstances(const rt::MechanicalUnits& units,
                                                         std::string_view domain, std::string_view type);

} // namespace rapidc::service

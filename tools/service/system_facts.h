#pragma once
// SystemFacts: what a controller says about itself: name, identity, versions, options, robot.

#include "tools/service/virtual_controller.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rapidc::service {

struct RobotWareVersion {
    int major = 7, minor = 21, build = 0, revision = 0;
    std::string name;    ///< "6.16.02.00", "7.21.0", "8.2.1"
    std::string version; ///< with the number of the build: "8.2.1+1023"
};
/// `robotWare`: 6, 7 or 8.
RobotWareVersion robotWareVersion(int robotWare);

struct SystemFacts {
    std::string name; ///< of a backup's system, or "rapidc"
    std::string id;   ///< a GUID in braces, the same for the same name
    std::vector<std::string>
        options; ///< RobotWare options: of the backup, of PRESENT_OPTIONS, or those that are simulated
    std::vector<std::string> addIns; ///< of the backup: "PartTracker Add-In 2.1.0"
    std::string robotType;           ///< of the first robot: "IRB 120-3/0.58"
    int64_t startSeconds = 0;        ///< when the controller started, its clock
};
/// Of the controller as it is now. On its thread.
SystemFacts systemFacts(VirtualController& controller);

} // namespace rapidc::service

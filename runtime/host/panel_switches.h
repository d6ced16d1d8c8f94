#pragma once
// PanelSwitches: what the operator chooses at the panel of the controller (manual 1.20, 2.10); a service of the Controller.

#include <cstdint>

namespace rt {

enum class OperatingMode : uint8_t {
    Auto,
    ManualReduced, ///< at reduced speed, 250 mm/s
    ManualFull,
};

struct PanelSwitches {
    OperatingMode mode = OperatingMode::Auto;
    bool emergencyStop = false;  ///< from the button until the motors are on again, or its reset is confirmed
    bool simulationMode = false; ///< system input SimMode
    bool errorReset = false;     ///< system input ResetError since the last error
    bool backupInProgress = false,
         backupFailed = false; ///< the latest backup is being written; could not be written
};

} // namespace rt

#pragma once
// PanelState: the operator's panel of the controller: motors, mode, speed, cycle (manual 1.20, 2.10).

#include "runtime/host/panel_switches.h"

#include <cstdint>

namespace rapidc::service {

enum class MotorState : uint8_t {
    Init,
    On,
    Off,
    GuardStop,
    EmergencyStop,
    EmergencyStopReset,
    SystemFailure
};
using rt::OperatingMode;

struct PanelState {
    MotorState motors = MotorState::Off;
    OperatingMode mode = OperatingMode::Auto;
    int speedRatio = 100; ///< per cent
    bool runOnce = false; ///< cycle: once, else forever
    bool backupInProgress = false, backupFailed = false;
};

} // namespace rapidc::service

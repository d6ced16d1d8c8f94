#pragma once
// The configuration of a servo gun (MOC.cfg, SG_PROCESS).

#include "runtime/host/controller.h"

#include <optional>
#include <utility>
#include <vector>

namespace rt::lib {

struct GunSetup {
    /// Tip force in N and the motor torque in Nm that gives it, ascending; at least one.
    std::vector<std::pair<double, double>> forces;
    double readyDelay = 0; ///< s that the force needs beyond its ramp

    /// Between the entries and beyond them: a straight line.
    double forceOf(double torque) const;
    double torqueOf(double force) const;
};

/// Nothing for a unit that is not a servo gun: one whose single axis leads to an SG_PROCESS by name, directly or by the names
/// in MECHANICAL_UNIT, SINGLE, JOINT and PROCESS.
std::optional<GunSetup> gunSetup(const Controller& controller, const MechanicalUnit& unit);

} // namespace rt::lib

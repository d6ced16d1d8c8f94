#pragma once
// External mechanical units: tracks, positioners, conveyors. A unit is a chain of axes that moves a frame: the base of
// a robot, or the user frame of a work object (manual 2.1, coordinated additional axes).

#include "runtime/robot/frames.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace robot {

/// Value of an external axis that is not connected (RAPID's 9E9).
inline constexpr double kNotConnected = 9e9;
inline constexpr int kExternalCount = 6;
/// External axes a..f, degrees or mm; kNotConnected where there is none.
using ExternalAxes = std::array<double, kExternalCount>;
inline constexpr ExternalAxes kNoExternalAxes{kNotConnected, kNotConnected, kNotConnected,
                                              kNotConnected, kNotConnected, kNotConnected};
inline bool isConnected(double externalValue) {
    return externalValue < 8.9e9;
}

/// One axis of a unit. It turns about z of its base frame, or moves along x of it when it is linear.
struct ExternalJoint {
    std::size_t axis = 0;  ///< index in ExternalAxes
    bool rotating = true;  ///< degrees, else mm
    Pose base;             ///< base frame with every axis of the unit at 0, in world
    double parked = 0;     ///< position while the axis is not connected: the unit has been deactivated
    bool isParked = false; ///< the unit is not active; another one may use the axis meanwhile
};

/// A unit as geometry. The objects belong to the controller and outlive all moves that name them.
struct ExternalUnit {
    std::string name;
    std::vector<ExternalJoint> joints; ///< in order, the one that carries the others first

    /// The frame that the unit moves, in world: the base frame of its last axis, moved by all of them.
    Pose frame(const ExternalAxes& axes) const;
    /// The pose of a carried frame that is given in world with all axes at 0.
    Pose carry(const Pose& frameAtZero, const ExternalAxes& axes) const;
};

/// The unit with that name; null when there is none.
using UnitLookup = std::function<const ExternalUnit*(const std::string&)>;

} // namespace robot

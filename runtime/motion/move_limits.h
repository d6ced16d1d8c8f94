#pragma once
// MoveLimits: what program and robot allow on one move, in deg, mm and s.

#include "runtime/motion/move_command.h"
#include "runtime/robot/robot_model.h"

#include <array>

namespace motion {

/// An external axis as the planner sees it; not present unless configured.
struct ExternalAxisModel {
    bool present = false;
    bool rotating = true; ///< degrees, else mm
    double lower = -1e6, upper = 1e6;
    double maxSpeed = 100; ///< deg/s or mm/s
    double maxAcceleration = 500;
};
using ExternalAxisModels = std::array<ExternalAxisModel, kExternalCount>;

/// A programmed speed of 0 is executed at the lowest speed of the controller: mm/s, deg/s.
inline constexpr double kLowestSpeed = 0.01;

struct MoveLimits {
    double tcpSpeed = 0;
    double orientationSpeed = 0;
    double armAngleSpeed =
        0; ///< deg/s, of the arm angle along lines and circles: RAPID's v_reax, as eax_a is its place
    double pathSpeed = 1e300; ///< of the path parameter; used for moves with a given duration
    Joints jointSpeed{};
    /// Of the robot's accelerations: AccSet and the load.
    std::array<double, robot::kMostJoints> accelerationShare{1, 1, 1, 1, 1, 1, 1};
    double rampShare = 1; ///< AccSet, of the rate at which acceleration changes
    double finePointRampShare =
        1; ///< AccSet, of the rate at which deceleration decreases towards a stop point
    ExternalAxes externalSpeed{};
    ExternalAxes externalAcceleration{};
    double pathAcceleration = 1e300, pathDeceleration = 1e300; ///< mm/s^2
    double worldAcceleration = 1e300;                          ///< mm/s^2
};

/// Speed limits that hold for every move while a system input asks for it (SpeedLimAxis, SpeedLimCheckPoint).
struct SpeedLimits {
    static constexpr double kNone = 1e300;
    double tcp = kNone;                                                                             ///< mm/s
    std::array<double, robot::kMostJoints> joints{kNone, kNone, kNone, kNone, kNone, kNone, kNone}; ///< deg/s
    ExternalAxes external{kNone, kNone, kNone, kNone, kNone, kNone}; ///< deg/s or mm/s
    friend bool operator==(const SpeedLimits&, const SpeedLimits&) = default;
};
/// The limits of a move, no higher than these.
MoveLimits limitedTo(MoveLimits limits, const SpeedLimits& most);

/// Limits of a move with these arguments and settings.
MoveLimits limitsOf(const MoveCommand& command, const robot::RobotModel& model,
                    const ExternalAxisModels& external);

} // namespace motion

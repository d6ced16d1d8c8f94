#include "runtime/motion/move_limits.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>

namespace motion {

namespace {

/// Shares of the accelerations that a load leaves: the torque of a motor is the same, the inertia grows (docs/motion.md).
std::array<double, robot::kMostJoints> loadShares(const CarriedLoad& load, const robot::RobotModel& model) {
    std::array<double, robot::kMostJoints> shares{};
    shares.fill(1);
    // The load of the recordings is in the identified figures already.
    const double further = load.mass - model.dynamics.load;
    if (!(further > 0) || !(model.payloadKg > 0)) return shares;
    constexpr double kArmMass = 2;       // of the moving arm, thought in the wrist: in rated payloads
    constexpr double kRatedOffset = 0.2; // m from the flange to the centre of a rated payload, at least
    const double offset = std::max(kRatedOffset, 0.001 * model.geometry.c4);
    const double ofMass = 1 / (1 + further / (kArmMass * model.payloadKg));
    const double inertia = load.inertia * further / load.mass;
    const double ofInertia = 1 / (1 + inertia / (kArmMass * model.payloadKg * offset * offset));
    for (std::size_t i = 0; i < shares.size(); ++i)
        shares[i] = model.axisNumbers[i] >= 4 && model.axisNumbers[i] <= 6 ? ofInertia : ofMass;
    return shares;
}

} // namespace

StopPoint strictest(const StopPoint& a, const StopPoint& b) {
    return {std::min(a.positionPercent, b.positionPercent),
            std::min(a.speedPercent, b.speedPercent),
            std::max(a.minTime, b.minTime),
            std::max(a.maxTime, b.maxTime),
            std::max(a.standTime, b.standTime),
            a.isAwaited || b.isAwaited};
}

MoveLimits limitsOf(const MoveCommand& command, const robot::RobotModel& model,
                    const ExternalAxisModels& external) {
    MoveLimits limits;
    const MotionSettings& set = command.settings;
    const double accelerationShare = 0.01 * std::clamp(set.accelerationPercent, 20.0, 100.0);
    limits.accelerationShare = loadShares(command.load, model);
    for (double& axis : limits.accelerationShare)
        axis *= accelerationShare;
    limits.rampShare = 0.01 * std::clamp(set.rampPercent, 10.0, 100.0);
    limits.finePointRampShare = 0.01 * std::clamp(set.finePointRampPercent, 10.0, 100.0);
    limits.jointSpeed = model.maxSpeed;
    const bool isTimed = command.duration > 0; // the time replaces the programmed speeds
    const double share = 0.01 * std::clamp(set.velocityPercent, 0.01, 100.0);
    const auto programmed = [&](double speed) {
        return isTimed ? kUnlimited : share * std::max(speed, kLowestSpeed);
    };
    limits.tcpSpeed = std::min(programmed(command.speed.vTcp),
                               isTimed ? kUnlimited : std::max(set.maxTcpSpeed, kLowestSpeed));
    limits.orientationSpeed = programmed(command.speed.vOri);
    limits.armAngleSpeed = programmed(command.speed.vReax);
    for (std::size_t i = 0; i < limits.externalSpeed.size(); ++i) {
        const ExternalAxisModel& axis = external[i];
        const double wanted = programmed(axis.rotating ? command.speed.vReax : command.speed.vLeax);
        limits.externalSpeed[i] = std::min(wanted, axis.maxSpeed);
        limits.externalAcceleration[i] = accelerationShare * axis.maxAcceleration;
    }
    if (set.pathAcceleration > 0) limits.pathAcceleration = 1000 * set.pathAcceleration;
    if (set.pathDeceleration > 0) limits.pathDeceleration = 1000 * set.pathDeceleration;
    if (set.worldAcceleration > 0) limits.worldAcceleration = 1000 * set.worldAcceleration;
    return limits;
}

MoveLimits limitedTo(MoveLimits limits, const SpeedLimits& most) {
    limits.tcpSpeed = std::min(limits.tcpSpeed, most.tcp);
    for (std::size_t i = 0; i < limits.jointSpeed.size(); ++i)
        limits.jointSpeed[i] = std::min(limits.jointSpeed[i], most.joints[i]);
    for (std::size_t i = 0; i < limits.externalSpeed.size(); ++i)
        limits.externalSpeed[i] = std::min(limits.externalSpeed[i], most.external[i]);
    return limits;
}

} // namespace motion

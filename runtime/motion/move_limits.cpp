#include "runtime/motion/move_limits.h"

#include <algorithm>

namespace motion {

MoveLimits limitsOf(const MoveCommand& command, const robot::RobotModel& model,
                    const ExternalAxisModels& external) {
    constexpr double kUnlimited = 1e300;
    MoveLimits limits;
    const MotionSettings& set = command.settings;
    limits.accelerationShare = 0.01 * std::clamp(set.accelerationPercent, 20.0, 100.0);
    limits.rampShare = 0.01 * std::clamp(set.rampPercent, 10.0, 100.0);
    limits.jointSpeed = model.maxSpeed;
    const bool isTimed = command.duration > 0; // the time replaces the programmed speeds
    const double share = 0.01 * std::clamp(set.velocityPercent, 0.01, 100.0);
    // A speed of 0 would never arrive; controllers take it as the slowest they can do.
    const auto programmed = [&](double speed) {
        return isTimed ? kUnlimited : share * std::max(speed, 0.01);
    };
    limits.tcpSpeed =
        std::min(programmed(command.speed.vTcp), isTimed ? kUnlimited : std::max(set.maxTcpSpeed, 0.01));
    limits.orientationSpeed = programmed(command.speed.vOri);
    limits.armAngleSpeed = programmed(command.speed.vReax);
    for (std::size_t i = 0; i < limits.externalSpeed.size(); ++i) {
        const ExternalAxisModel& axis = external[i];
        const double wanted = programmed(axis.rotating ? command.speed.vReax : command.speed.vLeax);
        limits.externalSpeed[i] = std::min(wanted, axis.maxSpeed);
        limits.externalAcceleration[i] = limits.accelerationShare * axis.maxAcceleration;
    }
    if (set.pathAcceleration > 0) limits.pathAcceleration = 1000 * set.pathAcceleration;
    if (set.pathDeceleration > 0) limits.pathDeceleration = 1000 * set.pathDeceleration;
    if (set.worldAcceleration > 0) limits.worldAcceleration = 1000 * set.worldAcceleration;
    return limits;
}

} // namespace motion

// Instructions of the gripper: g_... and, with the same meaning, Hand_...

#include "stdlib/impl/grippers/smart_gripper.h"
#include "stdlib/impl/support/fail.h"

#include "natives/grippers.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>

using namespace rt;
using lib::SmartGripper;

namespace {

constexpr double kReached = 0.5; // mm

/// kOk, or ERR_ARGVALERR: a given value must lie in 0 (without 0 when `isAbove`) to `most`.
Status checkRange(TaskCore* task, const float* value, double most, bool isAbove, const char* what) {
    if (value == nullptr || (*value <= most && (isAbove ? *value > 0 : *value >= 0))) return kOk;
    return lib::fail(
        task, err::ERR_ARGVALERR,
        fmt::format("the {} of the gripper must lie {} 0 and {}", what, isAbove ? "between" : "from", most));
}

Status jog(TaskCore* task, bool inward) {
    SmartGripper& gripper = SmartGripper::of(task);
    if (inward)
        gripper.moveInward();
    else
        gripper.moveOutward();
    return gripper.waitStill(taskOf(task));
}

Status calibrate(TaskCore* task, bool jogs, bool grips) {
    SmartGripper& gripper = SmartGripper::of(task);
    if (jogs || grips)
        if (const Status status = jog(task, true)) return status;
    gripper.calibrate();
    return jogs ? jog(task, false) : kOk;
}

Status initialize(TaskCore* task, const float* speed, const float* force, const float* limit,
                  bool calibrates) {
    if (const Status status = checkRange(task, speed, SmartGripper::kMostSpeed, true, "speed (mm/s)"))
        return status;
    if (const Status status = checkRange(task, force, SmartGripper::kMostForce, false, "force (N)"))
        return status;
    if (const Status status = checkRange(task, limit, SmartGripper::kMostTravel, true, "range (mm)"))
        return status;
    SmartGripper& gripper = SmartGripper::of(task);
    gripper.setSpeed(speed != nullptr ? *speed : SmartGripper::kUsualSpeed);
    gripper.setForce(force != nullptr ? *force : SmartGripper::kUsualForce);
    gripper.setLimit(limit != nullptr ? *limit : SmartGripper::kMostTravel);
    return calibrates ? calibrate(task, true, false) : kOk;
}

Status moveTo(TaskCore* task, float position, bool noWait) {
    SmartGripper& gripper = SmartGripper::of(task);
    if (const Status status = checkRange(task, &position, gripper.limit(), false, "position (mm)"))
        return status;
    if (!gripper.isCalibrated())
        return lib::fail(
            task, err::ERR_HAND_NOTCALIBRATED,
            "the gripper has no positions before it is calibrated (g_Calibrate, g_Init \\Calibrate)");
    gripper.moveTo(position);
    if (noWait) return kOk;
    if (const Status status = gripper.waitStill(taskOf(task))) return status;
    if (std::abs(gripper.position() - static_cast<double>(position)) <= kReached) return kOk;
    return lib::fail(
        task, err::ERR_HAND_FAILEDMOVEPOS,
        fmt::format("the fingers stopped at {:g} mm on their way to {:g} mm", gripper.position(), position));
}

/// Without \targetPos every place where the fingers stop is right, also the end of their travel.
Status grip(TaskCore* task, bool inward, const float* force, const float* position, const float* allowance,
            bool noWait) {
    constexpr double kUsualAllowance = 2; // mm
    SmartGripper& gripper = SmartGripper::of(task);
    if (const Status status = checkRange(task, force, SmartGripper::kMostForce, false, "force (N)"))
        return status;
    if (const Status status = checkRange(task, position, SmartGripper::kMostTravel, false, "position (mm)"))
        return status;
    if (const Status status = checkRange(task, allowance, SmartGripper::kMostTravel, false, "allowance (mm)"))
        return status;
    if (force != nullptr) gripper.setForce(*force);
    if (inward)
        gripper.moveInward();
    else
        gripper.moveOutward();
    if (noWait) return kOk;
    if (const Status status = gripper.waitStill(taskOf(task))) return status;
    const double most = allowance != nullptr ? static_cast<double>(*allowance) : kUsualAllowance;
    if (position == nullptr || std::abs(gripper.position() - *position) <= most) return kOk;
    return lib::fail(
        task, err::ERR_HAND_FAILEDGRIPPOS,
        fmt::format("the fingers stopped at {:g} mm, and a part was expected at {:g} mm (allowance {:g} mm)",
                    gripper.position(), *position, most));
}

Status stop(TaskCore* task) {
    SmartGripper::of(task).stop();
    return kOk;
}

Status setSpeed(TaskCore* task, float speed) {
    if (const Status status = checkRange(task, &speed, SmartGripper::kMostSpeed, true, "speed (mm/s)"))
        return status;
    SmartGripper::of(task).setSpeed(speed);
    return kOk;
}

Status setForce(TaskCore* task, float force) {
    if (const Status status = checkRange(task, &force, SmartGripper::kMostForce, false, "force (N)"))
        return status;
    SmartGripper::of(task).setForce(force);
    return kOk;
}

Status vacuum(TaskCore* task, std::size_t cup, bool on) {
    SmartGripper& gripper = SmartGripper::of(task);
    gripper.setVacuum(cup, on);
    if (!on || !gripper.failsVacuum(cup)) return kOk;
    return lib::fail(task, err::ERR_HAND_FAILEDVACUUM, fmt::format("vacuum {} is not reached", cup + 1));
}

Status blow(TaskCore* task, std::size_t cup, bool on) {
    SmartGripper::of(task).setBlow(cup, on);
    return kOk;
}

Status isCalibrated(TaskCore* task, bool* result) {
    *result = SmartGripper::of(task).isCalibrated();
    return kOk;
}

Status position(TaskCore* task, float* result) {
    *result = static_cast<float>(SmartGripper::of(task).position());
    return kOk;
}

} // namespace

extern "C" {
Status rt_g_Init(TaskCore* task, const float* maxSpd, const float* holdForce, const float* phyLimit,
                 bool Calibrate) {
    return initialize(task, maxSpd, holdForce, phyLimit, Calibrate);
}
Status rt_Hand_Initialize(TaskCore* task, const float* maxSpd, const float* holdForce, const float* phyLimit,
                          bool Calibrate) {
    return initialize(task, maxSpd, holdForce, phyLimit, Calibrate);
}

Status rt_g_Calibrate(TaskCore* task, bool Jog, bool Grip) {
    return calibrate(task, Jog, Grip);
}
Status rt_Hand_DoCalibrate(TaskCore* task, bool Jog, bool Grip) {
    return calibrate(task, Jog, Grip);
}

Status rt_g_JogIn(TaskCore* task) {
    return jog(task, true);
}
Status rt_Hand_JogInward(TaskCore* task) {
    return jog(task, true);
}

Status rt_g_JogOut(TaskCore* task) {
    return jog(task, false);
}
Status rt_Hand_JogOutward(TaskCore* task) {
    return jog(task, false);
}

Status rt_g_MoveTo(TaskCore* task, float targetPos, bool NoWait) {
    return moveTo(task, targetPos, NoWait);
}
Status rt_Hand_MoveTo(TaskCore* task, float targetPos, bool NoWait) {
    return moveTo(task, targetPos, NoWait);
}

Status rt_g_GripIn(TaskCore* task, const float* holdForce, const float* targetPos, const float* posAllowance,
                   bool NoWait) {
    return grip(task, true, holdForce, targetPos, posAllowance, NoWait);
}
Status rt_Hand_GripInward(TaskCore* task, const float* holdForce, const float* targetPos,
                          const float* posAllowance, bool NoWait) {
    return grip(task, true, holdForce, targetPos, posAllowance, NoWait);
}

Status rt_g_GripOut(TaskCore* task, const float* holdForce, const float* targetPos, const float* posAllowance,
                    bool NoWait) {
    return grip(task, false, holdForce, targetPos, posAllowance, NoWait);
}
Status rt_Hand_GripOutward(TaskCore* task, const float* holdForce, const float* targetPos,
                           const float* posAllowance, bool NoWait) {
    return grip(task, false, holdForce, targetPos, posAllowance, NoWait);
}

Status rt_g_Stop(TaskCore* task) {
    return stop(task);
}
Status rt_Hand_Stop(TaskCore* task) {
    return stop(task);
}

Status rt_g_SetMaxSpd(TaskCore* task, float maxSpd) {
    return setSpeed(task, maxSpd);
}
Status rt_Hand_SetMaxSpeed(TaskCore* task, float maxSpd) {
    return setSpeed(task, maxSpd);
}

Status rt_g_SetForce(TaskCore* task, float holdForce) {
    return setForce(task, holdForce);
}
Status rt_Hand_SetHoldForce(TaskCore* task, float holdForce) {
    return setForce(task, holdForce);
}

Status rt_g_VacuumOn1(TaskCore* task) {
    return vacuum(task, 0, true);
}
Status rt_Hand_TurnOnVacuum1(TaskCore* task) {
    return vacuum(task, 0, true);
}

Status rt_g_VacuumOff1(TaskCore* task) {
    return vacuum(task, 0, false);
}
Status rt_Hand_TurnOffVacuum1(TaskCore* task) {
    return vacuum(task, 0, false);
}

Status rt_g_BlowOn1(TaskCore* task) {
    return blow(task, 0, true);
}
Status rt_Hand_TurnOnBlow1(TaskCore* task) {
    return blow(task, 0, true);
}

Status rt_g_BlowOff1(TaskCore* task) {
    return blow(task, 0, false);
}
Status rt_Hand_TurnOffBlow1(TaskCore* task) {
    return blow(task, 0, false);
}

Status rt_g_VacuumOn2(TaskCore* task) {
    return vacuum(task, 1, true);
}
Status rt_Hand_TurnOnVacuum2(TaskCore* task) {
    return vacuum(task, 1, true);
}

Status rt_g_VacuumOff2(TaskCore* task) {
    return vacuum(task, 1, false);
}
Status rt_Hand_TurnOffVacuum2(TaskCore* task) {
    return vacuum(task, 1, false);
}

Status rt_g_BlowOn2(TaskCore* task) {
    return blow(task, 1, true);
}
Status rt_Hand_TurnOnBlow2(TaskCore* task) {
    return blow(task, 1, true);
}

Status rt_g_BlowOff2(TaskCore* task) {
    return blow(task, 1, false);
}
Status rt_Hand_TurnOffBlow2(TaskCore* task) {
    return blow(task, 1, false);
}

Status rt_g_IsCalibrated(TaskCore* task, bool* result) {
    return isCalibrated(task, result);
}
Status rt_Hand_IsCalibrated(TaskCore* task, bool* result) {
    return isCalibrated(task, result);
}

Status rt_g_GetPos(TaskCore* task, float* result) {
    return position(task, result);
}
Status rt_Hand_GetActualPos(TaskCore* task, float* result) {
    return position(task, result);
}
}

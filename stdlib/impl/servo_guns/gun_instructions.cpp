// Instructions of servo tools: STClose, STOpen, STCalib and their like.

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/servo_guns/servo_gun.h"
#include "stdlib/impl/support/fail.h"

#include "natives/servo_tools.h"
#include "natives/spot.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>

using namespace rt;
using lib::ServoGun;

namespace {

ServoGun* gunNamed(TaskCore* task, std::string_view name, Status& status) {
    Controller& controller = taskOf(task).controller();
    ServoGun* gun = controller.service<lib::ServoGuns>().find(controller, name);
    if (gun == nullptr)
        status = lib::fail(
            task, err::ERR_NO_SGUN,
            fmt::format("\"{}\" is not a servo gun: MOC.cfg needs a mechanical unit of that name with one "
                        "axis, and an SG_PROCESS of the same name",
                        name));
    return gun;
}

enum Needs : unsigned { Sync = 1, Opened = 2 };

/// The gun for a movement; null with the error in `status`.
ServoGun* gunToMove(TaskCore* task, std::string_view name, unsigned needs, Status& status) {
    if ((status = lib::requireMotionTask(task)) != kOk) return nullptr;
    ServoGun* gun = gunNamed(task, name, status);
    if (gun == nullptr) return nullptr;
    const auto refuse = [&](Status error, const char* text) {
        status = lib::fail(task, error, text);
        return nullptr;
    };
    if (gun->unit().group != lib::motionOf(task).group())
        return refuse(err::ERR_NO_SGUN, "the servo gun belongs to the mechanical unit group of another task");
    if (!gun->unit().isActive)
        return refuse(err::ERR_SGUN_NOTACT, "the servo gun is not activated: use ActUnit first");
    if (!gun->isInitialized())
        return refuse(err::ERR_SGUN_NOTINIT, "the position of the servo gun is not initialized");
    if ((needs & Sync) != 0 && !gun->isSynchronized())
        return refuse(err::ERR_SGUN_NOTSYNC,
                      "the tips of the servo gun are not synchronized: use STCalib \\ToolChg first");
    if ((needs & Opened) != 0 && gun->phase() != ServoGun::Phase::Open)
        return refuse(err::ERR_SGUN_NOTOPEN, "the servo gun is not open: use STOpen first");
    return gun;
}

Status checkNegative(TaskCore* task, const float* value, const char* what) {
    if (value == nullptr || *value >= 0) return kOk;
    return lib::fail(task, err::ERR_SGUN_NEGVAL, fmt::format("{} of a servo gun must not be negative", what));
}

void give(float* result, double value) {
    if (result != nullptr) *result = static_cast<float>(value);
}

/// Name of the gun that spot welding knows by a number, counted in the order of the units, or by gundata.
std::string spotGunName(TaskCore* task, const float* number, const data::Gundata* gun) {
    if (gun != nullptr) return std::string(gun->gun_name.view());
    Controller& controller = taskOf(task).controller();
    double left = *number;
    for (const auto& unit : controller.units().all())
        if (controller.service<lib::ServoGuns>().find(controller, unit->name) != nullptr && --left == 0)
            return unit->name;
    return fmt::format("gun {}", *number);
}

ServoGun* gunOfUnit(TaskCore* task, const Handle* unit, Status& status) {
    const MechanicalUnit* found = lib::unitOf(task, *unit, status);
    return found == nullptr ? nullptr : gunNamed(task, found->name, status);
}

} // namespace

extern "C" {

Status rt_STClose(TaskCore* task, const String* ToolName, float TipForce, float Thickness,
                  float* RetThickness, bool Conc) {
    Status status = kOk;
    ServoGun* gun = gunToMove(task, ToolName->view(), Sync | Opened, status);
    if (gun == nullptr) return status;
    if ((status = checkNegative(task, &TipForce, "the force")) != kOk) return status;
    if ((status = checkNegative(task, &Thickness, "the thickness")) != kOk) return status;
    if ((status = gun->close(task, Thickness, Conc)) != kOk) return status;
    if (!Conc) give(RetThickness, gun->thickness());
    return kOk;
}

/// A gun that is open already stays as it is.
Status rt_STOpen(TaskCore* task, const String* ToolName, bool WaitZeroSpeed, bool Conc) {
    Status status = kOk;
    ServoGun* gun = gunToMove(task, ToolName->view(), Sync, status);
    if (gun == nullptr) return status;
    if (WaitZeroSpeed && (status = lib::motionOf(task).waitZeroSpeed(taskOf(task))) != kOk) return status;
    if (gun->phase() == ServoGun::Phase::Calibrating)
        return lib::fail(task, err::ERR_SGUN_NOTOPEN,
                         "the servo gun is being calibrated: it opens when that ends");
    return gun->phase() == ServoGun::Phase::Open ? kOk : gun->open(task, Conc);
}

Status rt_STCalib(TaskCore* task, const String* ToolName, bool ToolChg, bool TipChg, bool TipWear,
                  float* RetTipWear, float* RetPosAdj, const float* PrePos, bool Conc) {
    if (ToolChg + TipChg + TipWear != 1)
        return lib::fail(task, err::ERR_ARGVALERR, "STCalib needs one of \\ToolChg, \\TipChg and \\TipWear");
    Status status = kOk;
    ServoGun* gun = gunToMove(task, ToolName->view(), ToolChg ? Opened : Sync | Opened, status);
    if (gun == nullptr) return status;
    if ((status = checkNegative(task, PrePos, "\\PrePos")) != kOk) return status;
    using Kind = ServoGun::Calibration;
    const Kind kind = ToolChg ? Kind::ToolChange : TipChg ? Kind::TipChange : Kind::TipWear;
    status = gun->calibrate(task, kind, PrePos != nullptr ? *PrePos : -1.0, Conc);
    if (status != kOk || Conc) return status;
    give(RetTipWear, gun->tipWear());
    give(RetPosAdj, gun->adjustment());
    return kOk;
}

Status rt_STIndGun(TaskCore* task, const String* ToolName, float GunPos) {
    Status status = kOk;
    ServoGun* gun = gunToMove(task, ToolName->view(), 0, status);
    if (gun == nullptr) return status;
    if ((status = checkNegative(task, &GunPos, "the position")) != kOk) return status;
    return gun->moveAlone(task, GunPos);
}

Status rt_STIndGunReset(TaskCore* task, const String* ToolName) {
    Status status = kOk;
    ServoGun* gun = gunNamed(task, ToolName->view(), status);
    if (gun != nullptr) gun->endIndependence();
    return status;
}

Status rt_IndGunMove(TaskCore* task, const float* Gun, data::Gundata* GunData, float GunPos) {
    Status status = kOk;
    ServoGun* gun = gunToMove(task, spotGunName(task, Gun, GunData), 0, status);
    if (gun == nullptr) return status;
    if ((status = checkNegative(task, &GunPos, "the position")) != kOk) return status;
    return gun->moveAlone(task, GunPos);
}

Status rt_IndGunMoveReset(TaskCore* task, const float* Gun, data::Gundata* GunData) {
    Status status = kOk;
    ServoGun* gun = gunNamed(task, spotGunName(task, Gun, GunData), status);
    if (gun != nullptr) gun->endIndependence();
    return status;
}

/// Of the tuning values only the time of the force's ramp has something to act on.
Status rt_STTune(TaskCore* task, Handle* MecUnit, float TuneValue, float Type) {
    constexpr float kLeast = 20, kMost = 500; // percent
    Status status = kOk;
    ServoGun* gun = gunOfUnit(task, MecUnit, status);
    if (gun == nullptr) return status;
    if (!(Type >= k::RampTorqRef && Type <= k::CollLimSpeed && Type == std::floor(Type)))
        return lib::fail(task, err::ERR_ARGVALERR, "STTune: the type must be one of the tunegtype constants");
    if (!(TuneValue >= kLeast && TuneValue <= kMost))
        return lib::failWith(task, err::ERR_ARGVALERR, "STTune: the value must lie between {} and {} percent",
                             kLeast, kMost);
    if (Type == k::RampTime) gun->tuneRamp(TuneValue);
    return kOk;
}

Status rt_STTuneReset(TaskCore* task, Handle* MecUnit) {
    Status status = kOk;
    ServoGun* gun = gunOfUnit(task, MecUnit, status);
    if (gun != nullptr) gun->tuneRamp(100);
    return status;
}

/// Without a switch: both.
Status rt_STIsCalib(TaskCore* task, bool* result, const String* ToolName, bool sguninit, bool sgunsynch) {
    Status status = kOk;
    const ServoGun* gun = gunNamed(task, ToolName->view(), status);
    if (gun == nullptr) return status;
    *result = (sgunsynch || gun->isInitialized()) && (sguninit || gun->isSynchronized());
    return kOk;
}

Status rt_STIsClosed(TaskCore* task, bool* result, const String* ToolName, float* RetThickness) {
    Status status = kOk;
    const ServoGun* gun = gunNamed(task, ToolName->view(), status);
    if (gun == nullptr) return status;
    *result = gun->phase() == ServoGun::Phase::Closed;
    if (*result) give(RetThickness, gun->thickness());
    return kOk;
}

Status rt_STIsOpen(TaskCore* task, bool* result, const String* ToolName, float* RetTipWear,
                   float* RetPosAdj) {
    Status status = kOk;
    const ServoGun* gun = gunNamed(task, ToolName->view(), status);
    if (gun == nullptr) return status;
    *result = gun->phase() == ServoGun::Phase::Open;
    if (!*result) return kOk;
    give(RetTipWear, gun->tipWear());
    give(RetPosAdj, gun->adjustment());
    return kOk;
}

Status rt_STIsIndGun(TaskCore* task, bool* result, const String* ToolName) {
    Status status = kOk;
    const ServoGun* gun = gunNamed(task, ToolName->view(), status);
    if (gun != nullptr) *result = gun->isIndependent();
    return status;
}

Status rt_STCalcForce(TaskCore* task, float* result, const String* ToolName, float MotorTorque) {
    Status status = kOk;
    const ServoGun* gun = gunNamed(task, ToolName->view(), status);
    if (gun == nullptr) return status;
    if ((status = checkNegative(task, &MotorTorque, "the torque")) != kOk) return status;
    *result = static_cast<float>(gun->setup().forceOf(MotorTorque));
    return kOk;
}

Status rt_STCalcTorque(TaskCore* task, float* result, const String* ToolName, float TipForce) {
    Status status = kOk;
    const ServoGun* gun = gunNamed(task, ToolName->view(), status);
    if (gun == nullptr) return status;
    if ((status = checkNegative(task, &TipForce, "the force")) != kOk) return status;
    *result = static_cast<float>(gun->setup().torqueOf(TipForce));
    return kOk;
}
}

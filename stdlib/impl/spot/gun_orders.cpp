// SetForce, Calibrate and the high lift: a gun without a movement of the robot.

#include "stdlib/impl/spot/gun_orders.h"

#include "stdlib/impl/support/fail.h"

#include "natives/spot.h"
#include "stdlib_constants.h"

#include <cmath>
#include <utility>

namespace rt::lib {
namespace {

/// Closes, holds and opens.
Status pressGun(TaskCore* task, SpotGun& gun, double seconds) {
    Task& owner = taskOf(task);
    gun.weldError(false);
    gun.close(owner.now());
    Status status = gun.waitClosed(task);
    if (status == kOk) status = owner.sleepFor(fromSeconds(seconds));
    if (status == kOk) {
        gun.open(owner.now());
        status = gun.waitOpen(task);
    }
    if (status != kOk) gun.abandon(owner.now());
    return status;
}

} // namespace

Status calibrateGun(TaskCore* task, SpotGun& gun, data::Gundata* data, Calibration how, float* wear) {
    if (const Status status = pressGun(task, gun, 0)) return status;
    const auto worn = static_cast<float>(gun.wearPerWeld() * std::exchange(gun.weldsSinceCalibration, 0));
    const bool isNew = how == Calibration::TipsChanged || how == Calibration::First;
    if (wear != nullptr) *wear = isNew ? 0 : worn;
    if (data == nullptr) return kOk;
    if (isNew) {
        data->curr_tip_wear = 0;
        data->weld_counter = 0;
    } else if (how == Calibration::TipWear) {
        data->curr_tip_wear += worn;
    }
    return kOk;
}

} // namespace rt::lib

using namespace rt;

namespace {

Status setLift(TaskCore* task, const float* number, const data::Gundata* data, bool open) {
    Status status = kOk;
    if (const lib::SpotGun* gun = lib::spotGunOf(task, number, data, status)) gun->highLift(open);
    return status;
}

} // namespace

extern "C" {

Status rt_SetForce(TaskCore* task, const float* Gun, data::Gundata* GunData, data::Forcedata* Force) {
    Status status = kOk;
    lib::SpotGun* gun = lib::spotGunOf(task, Gun, GunData, status);
    if (gun == nullptr) return status;
    if (!(Force->tip_force >= 0) || !(Force->force_time >= 0) || !std::isfinite(Force->force_time))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "tip_force and force_time of forcedata must not be negative");
    gun->select(0, Force->tip_force);
    return lib::pressGun(task, *gun, Force->force_time);
}

Status rt_Calibrate(TaskCore* task, const float* Gun, data::Gundata* GunData, bool TipChg, bool TipWear,
                    bool FirstCal, float* RetTipWear) {
    Status status = kOk;
    lib::SpotGun* gun = lib::spotGunOf(task, Gun, GunData, status);
    if (gun == nullptr) return status;
    return lib::calibrateGun(task, *gun, GunData, lib::calibrationOf(TipChg, TipWear, FirstCal), RetTipWear);
}

Status rt_OpenHighLift(TaskCore* task, const float* Gun, data::Gundata* GunData) {
    return setLift(task, Gun, GunData, true);
}

Status rt_CloseHighLift(TaskCore* task, const float* Gun, data::Gundata* GunData) {
    return setLift(task, Gun, GunData, false);
}
}

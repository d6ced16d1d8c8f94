#pragma once
// The actions of a gun at a place: calibration, closing with a force.

#include "stdlib/impl/spot/spot_gun.h"

namespace rt::lib {

enum class Calibration : uint8_t { Plain, TipsChanged, TipWear, First };

/// Closes and opens the gun; wear and number of welds of `data` follow. `wear` gets the wear since the last calibration, mm.
Status calibrateGun(TaskCore* task, SpotGun& gun, data::Gundata* data, Calibration how, float* wear);
/// One of the alternatives, which exclude each other.
inline Calibration calibrationOf(bool changed, bool wear, bool first) {
    return changed ? Calibration::TipsChanged
           : wear  ? Calibration::TipWear
           : first ? Calibration::First
                   : Calibration::Plain;
}

} // namespace rt::lib

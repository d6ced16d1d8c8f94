// libFuzzer target: any bytes as a datagram of EGM. Data that are taken over are finite, bounded and of the mode.

#include "fuzz_support.h"
#include "stdlib/impl/guided_motion/egm_messages.h"

#include <cmath>
#include <string>

namespace {

using rapid::fuzz::require;
using rt::lib::GuidanceMode;

template <class Values> void requireFinite(const Values& values) {
    for (const auto& value : values)
        if constexpr (requires { value.has_value(); })
            require(!value || std::isfinite(*value), "a target is not finite");
        else
            require(std::isfinite(value), "a number is not finite");
}

void decode(std::string_view bytes, GuidanceMode mode) {
    rt::lib::SensorData data;
    const std::string why = rt::lib::decodeSensorMessage(bytes, mode, data);
    if (!why.empty()) return;
    requireFinite(data.joints);
    requireFinite(data.additional);
    requireFinite(data.pose);
    requireFinite(data.jointSpeed);
    requireFinite(data.poseSpeed);
    requireFinite(data.additionalSpeed);
    requireFinite(data.numbers);
    require(data.numbers.size() <= 40, "more numbers than RAPID takes");
    if (!data.hasTarget) return;
    if (mode == GuidanceMode::Joint) require(data.joints[5].has_value(), "a target without six joints");
    if (mode != GuidanceMode::Joint) require(data.pose[2].has_value(), "a target without a position");
    if (data.orientation) require(std::fabs(norm(*data.orientation) - 1) < 1e-6, "not a rotation");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string bytes(rapid::fuzz::bytesOf(data, size));
    for (const GuidanceMode mode : {GuidanceMode::Joint, GuidanceMode::Pose, GuidanceMode::PathCorrection})
        decode(bytes, mode);
    return 0;
}

#pragma once
// The messages of EGM, as protobuf (version 2) puts them into a datagram; egm.proto defines them.

#include "stdlib/impl/guided_motion/partner.h"

#include <string>
#include <string_view>

namespace rt::lib {

/// The EgmRobot message with this sequence number.
std::string encodeRobotMessage(const RobotData& data, uint32_t sequence);

/// An EgmSensor message, or EgmSensorPathCorr for path correction. Returns why it cannot be used ("" when it can): not a message,
/// another type than `expected`, numbers that are not finite, not six joints, an orientation that is not a unit quaternion. A
/// message that has RAPID data and no place is used as well (SensorData::hasTarget).
std::string decodeSensorMessage(std::string_view bytes, GuidanceMode expected, SensorData& data);

} // namespace rt::lib

#pragma once
// The messages of EGM, as protobuf (version 2) puts them into a datagram.

#include "stdlib/impl/guided_motion/partner.h"

#include <string>
#include <string_view>

namespace rt::lib {

/// Axes of the message: six of the robot, further ones (axis 7, additional axes) as external joints.
/// The EgmRobot message with this sequence number.
std::string encodeRobotMessage(const RobotData& data, uint32_t sequence);

/// An EgmSensor message. Returns why it cannot be used ("" when it can): not a message, another type than `expected`, numbers
/// that are not finite, too few joints, an orientation that is not a unit quaternion.
std::string decodeSensorMessage(std::string_view bytes, GuidanceMode expected, SensorData& data);

} // namespace rt::lib

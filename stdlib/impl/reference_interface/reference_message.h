#pragma once
// Messages of Robot Reference Interface: XML with the values of a record and what the controller adds.

#include "stdlib/impl/reference_interface/device_description.h"
#include "stdlib/impl/reference_interface/xml_text.h"

#include "runtime/motion/motion_system.h"

#include <cstdint>
#include <string>

namespace rt::lib {

/// State of the controller when a message leaves; the state of the arm is missing in a task without one.
struct InternState {
    std::string operationMode;
    double seconds = 0; ///< virtual time
    bool hasArm = false;
    motion::Pose actualPose, plannedPose;            ///< TCP in the work object, mm
    motion::JointTarget actualJoints, plannedJoints; ///< deg
};

/// The fields of `property`: internal ones from `state`, the others from the components of the record, in order. A record, or an
/// array, within the record becomes attributes X1, X2 ...
std::string composeMessage(const ReferenceProperty& property, uint32_t id, const InternState& state,
                           const void* data, const TypeDesc& type);

/// Takes the values of a message into the record. All or nothing: returns why they cannot be used, or "".
std::string takeMessage(const ReferenceProperty& property, const XmlElement& message, void* data,
                        const TypeDesc& type);

/// Cuts the first whole message off a stream of bytes. False when none is there; `problem` says what cannot become one.
bool nextMessage(std::string& stream, std::string& message, std::string& problem);

} // namespace rt::lib

#pragma once
// A device of Robot Reference Interface as the XML files in HOME:/GSI describe it: Settings.xml names the devices, Description.xml
// and Configuration.xml in the folder of the device say how to reach it and which records the messages have.

#include "runtime/base/time.h"
#include "runtime/host/controller.h"
#include "runtime/net/network.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rt::lib {

/// Periods and times of the interface are multiples of it.
inline constexpr Time kReferenceTick = 4 * kMillisecond;

/// An element of a message.
struct ReferenceField {
    std::string source;    ///< "FeedbackPose" ... of internal ones
    std::string tag;       ///< name of the element: the alias, else the name
    std::string type;      ///< "Pose", "Frame", "Joints", "Time", "Real" ...
    bool isIntern = false; ///< the controller gives it; others are components of the RAPID data, in order
};

/// RAPID data with the name of the property, and the messages that carry them.
struct ReferenceProperty {
    std::string name;
    std::string tag; ///< name of the root element
    bool isSent = true, isReceived = true;
    std::vector<ReferenceField> fields;
};

struct ReferenceDescription {
    std::string name;
    net::Address address;
    bool datagrams = true;                             ///< UDP, else TCP
    bool isSupervised = false;                         ///< messages must be answered (DryRun false)
    Time timeout = 4 * kSecond;                        ///< for an answer
    int maxLost = 10;                                  ///< messages without an answer
    std::map<std::string, std::string> operationModes; ///< "Automatic" -> text in messages
    std::vector<ReferenceProperty> properties;

    /// By the name of the RAPID data; null when there is none.
    const ReferenceProperty* find(std::string_view data) const;
};

/// Reads the description of a device. Returns what is missing or wrong and in which file, for people; "" when all is there.
std::string readDescription(Controller& controller, std::string_view device, ReferenceDescription& out);

} // namespace rt::lib

// Robot Reference Interface: SiConnect, SiGetCyclic, SiSetCyclic, SiClose.

#include "stdlib/impl/reference_interface/reference_device.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"

#include "natives/sensors.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

using namespace rt;
using lib::ReferenceDevice;
using lib::ReferenceDevices;

namespace {

/// Devices and records have the names of the persistents; "" for data without a name of their own.
std::string nameOf(TaskCore* task, const void* data) {
    const GlobalDesc* found = lib::dataAt(taskOf(task).controller(), data);
    return found != nullptr && found->address == data ? found->name : std::string();
}

/// Null, with the error raised in `status`, when the device is not connected.
ReferenceDevice* connected(TaskCore* task, const data::Sensor* sensor, Status& status) {
    const std::string name = nameOf(task, sensor);
    ReferenceDevice* device = ReferenceDevices::of(taskOf(task).controller()).find(name);
    if (device == nullptr || device->isConnecting())
        status = lib::fail(task, err::ERR_COMM_EXT,
                           fmt::format("device {} is not connected: execute SiConnect first", name));
    return status == kOk ? device : nullptr;
}

/// A period in ms as the instructions take it: 0, or a multiple of 4.
Status periodOf(TaskCore* task, float rate, Time& period) {
    constexpr float kLongest = 3600000;
    if (!(rate >= 0 && rate <= kLongest) || std::fmod(rate, 4.0F) != 0)
        return lib::fail(task, err::ERR_ARGVALERR, "Rate must be 0, or a multiple of 4 ms");
    period = static_cast<Time>(rate) * (kSecond / 1000);
    return kOk;
}

/// The property with the name of the data, which the device must know for this direction.
const lib::ReferenceProperty* propertyOf(TaskCore* task, const ReferenceDevice& device, const void* data,
                                         bool sends, Status& status) {
    const std::string name = nameOf(task, data);
    const lib::ReferenceProperty* property = device.description().find(name);
    const auto refuse = [&](const std::string& why) -> const lib::ReferenceProperty* {
        status = lib::fail(task, err::ERR_ARGVALERR,
                           fmt::format("Configuration.xml of device {}: {}", device.description().name, why));
        return nullptr;
    };
    if (property == nullptr) return refuse(fmt::format("no Property has the Name \"{}\"", name));
    if (sends ? property->isSent : property->isReceived) return property;
    return refuse(
        fmt::format("the Flag of property \"{}\" forbids to {} it", name, sends ? "send" : "receive"));
}

/// Orders cyclic transfer of `data`, in one direction, from a connected device or to it.
template <class Order>
Status transfer(TaskCore* task, const data::Sensor* sensor, const void* data, float rate, bool sends,
                Order&& order) {
    Status status = kOk;
    Time period = 0;
    ReferenceDevice* device = connected(task, sensor, status);
    if (device == nullptr || (status = periodOf(task, rate, period)) != kOk) return status;
    const lib::ReferenceProperty* property = propertyOf(task, *device, data, sends, status);
    if (property != nullptr) order(*device, *property, period);
    return status;
}

} // namespace

extern "C" {

Status rt_SiConnect(TaskCore* task, data::Sensor* Sensor, bool NoStop) {
    Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    lib::ReferenceDescription description;
    const std::string name = nameOf(task, Sensor);
    if (name.empty())
        return lib::fail(task, err::ERR_ARGVALERR, "the device must be a persistent with a name of its own");
    if (const std::string problem = readDescription(controller, name, description); !problem.empty())
        return lib::fail(task, err::ERR_COMM_INIT_FAILED, problem);
    ReferenceDevices& devices = ReferenceDevices::of(controller);
    if (const ReferenceDevice* other = devices.find(name); other != nullptr && other->isConnecting())
        return lib::fail(task, err::ERR_COMM_INIT_FAILED,
                         fmt::format("another task is connecting device {}", name));
    return devices
        .add(std::make_unique<ReferenceDevice>(controller, owner, std::move(description), Sensor, !NoStop))
        .connect(task);
}

Status rt_SiGetCyclic(TaskCore* task, data::Sensor* Sensor, void* Data, const TypeDesc* DataType,
                      float Rate) {
    return transfer(task, Sensor, Data, Rate, false,
                    [&](ReferenceDevice& device, const lib::ReferenceProperty& property, Time period) {
                        device.receive(property, Data, *DataType, period);
                    });
}

Status rt_SiSetCyclic(TaskCore* task, data::Sensor* Sensor, void* Data, const TypeDesc* DataType,
                      float Rate) {
    return transfer(task, Sensor, Data, Rate, true,
                    [&](ReferenceDevice& device, const lib::ReferenceProperty& property, Time period) {
                        device.send(property, Data, *DataType, period);
                    });
}

/// Without a connection it has no effect.
Status rt_SiClose(TaskCore* task, data::Sensor* Sensor) {
    ReferenceDevices& devices = ReferenceDevices::of(taskOf(task).controller());
    const std::string name = nameOf(task, Sensor);
    ReferenceDevice* device = devices.find(name);
    if (device != nullptr && device->isConnecting())
        return lib::fail(task, err::ERR_COMM_EXT, fmt::format("another task is connecting device {}", name));
    if (device != nullptr) device->close();
    devices.remove(name);
    return kOk;
}
}

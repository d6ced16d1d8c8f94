// Manual 1.9: I/O devices and networks, and where a signal comes from. All of them are simulated: a device works unless a
// program has deactivated it.

#include "runtime/base/text_util.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <cstring>
#include <set>

using namespace rt;

namespace {

/// Names in upper case.
struct Devices {
    std::set<std::string> off;
    bool followsRestarts = false;
};

Devices& devicesOf(Controller& controller) {
    auto& devices = controller.service<Devices>();
    if (devices.followsRestarts) return devices;
    devices.followsRestarts = true;
    controller.onShutDown([&controller, &devices] { // a restart activates every device
        for (const std::string& name : devices.off)
            controller.io().setDeviceOff(name, false);
        devices.off.clear();
    });
    return devices;
}

bool endsWith(const std::string& text, std::string_view end) {
    return upperCase(text).ends_with(end);
}
bool isDeviceType(const std::string& type) {
    return endsWith(type, "_DEVICE") || sameName(type, "EIO_UNIT");
}
bool isNetworkType(const std::string& type) {
    return sameName(type, "EIO_BUS") || sameName(type, "INDUSTRIAL_NETWORK") || endsWith(type, "_NETWORK");
}

/// The instance of that name of a type that `isWanted`; null when there is none.
const CfgInstance* instanceOf(const Controller& controller, std::string_view name,
                              bool (*isWanted)(const std::string& type)) {
    for (const CfgFile& file : controller.configuration()) {
        if (!sameName(file.domain, "EIO")) continue;
        for (const CfgSection& section : file.sections) {
            if (!isWanted(section.type)) continue;
            for (const CfgInstance& instance : section.instances)
                if (sameName(instance.text("Name"), name)) return &instance;
        }
    }
    return nullptr;
}

/// A device that the configuration defines, or that a signal is connected to.
bool isDevice(const Controller& controller, std::string_view name) {
    if (instanceOf(controller, name, isDeviceType) != nullptr) return true;
    for (const CfgInstance* signal : controller.instances("EIO", "EIO_SIGNAL"))
        if (!name.empty() && sameName(signal->text("Device", signal->text("Unit")), name)) return true;
    return false;
}

bool isNetwork(const Controller& controller, std::string_view name) {
    return instanceOf(controller, name, isNetworkType) != nullptr || sameName(name, "Local") ||
           sameName(name, "Virtual1") || sameName(name, "Virtual");
}

Status badName(TaskCore* task, const char* kind, const String& name) {
    return lib::fail(task, err::ERR_NAME_INVALID,
                     std::string("the configuration (EIO.cfg) has no I/O ") + kind + " named '" +
                         std::string(name.view()) + "'");
}

/// DenyDeactivate of the trust level, or level 0 in RobotWare 5.
bool mustStayOn(const Controller& controller, std::string_view name) {
    const CfgInstance* device = instanceOf(controller, name, isDeviceType);
    if (device == nullptr) return false;
    const std::string level = device->text("TrustLevel", device->text("UnitTrustLevel"));
    const auto isLevel = [](const std::string& type) {
        return upperCase(type).find("TRUST") != std::string::npos;
    };
    const CfgInstance* trust = instanceOf(controller, level, isLevel);
    return trust != nullptr ? trust->flag("DenyDeactivate") : level == "0";
}

Status activate(TaskCore* task, const String& name, bool on) {
    Controller& controller = taskOf(task).controller();
    if (!isDevice(controller, name.view())) return badName(task, "device", name);
    if (!on && mustStayOn(controller, name.view()))
        return lib::fail(task, err::ERR_TRUSTLEVEL,
                         "the trust level of I/O device " + std::string(name.view()) +
                             " does not allow that it is deactivated");
    const std::string key = upperCase(name.view());
    if (on)
        devicesOf(controller).off.erase(key);
    else
        devicesOf(controller).off.insert(key);
    controller.io().setDeviceOff(name.view(), !on);
    return kOk;
}

Status deviceState(TaskCore* task, float* result, const String& name, bool physical, bool logical) {
    Controller& controller = taskOf(task).controller();
    if (!isDevice(controller, name.view())) return badName(task, "device", name);
    const bool on = !devicesOf(controller).off.contains(upperCase(name.view()));
    if (physical)
        *result = on ? k::IOUNIT_PHYS_STATE_RUNNING : k::IOUNIT_PHYS_STATE_UNCONNECTED;
    else if (logical)
        *result = on ? k::IOUNIT_LOG_STATE_ENABLED : k::IOUNIT_LOG_STATE_DISABLED;
    else
        *result = on ? k::IOUNIT_RUNNING : k::IOUNIT_DISABLE;
    return kOk;
}

Status networkState(TaskCore* task, float* result, const String& name, bool physical, bool logical) {
    if (!isNetwork(taskOf(task).controller(), name.view())) return badName(task, "network", name);
    *result = physical ? k::IOBUS_PHYS_STATE_RUNNING : logical ? k::IOBUS_LOG_STATE_STARTED : k::BUSSTATE_RUN;
    return kOk;
}

/// There are no messages to suppress: a simulated device never loses its contact.
Status muteDevice(TaskCore* task, const String& name) {
    return isDevice(taskOf(task).controller(), name.view()) ? kOk : badName(task, "device", name);
}

} // namespace

extern "C" {

Status rt_IOActivate(TaskCore* task, const String* DeviceName, float) {
    return activate(task, *DeviceName, true);
}
Status rt_IOEnable(TaskCore* task, const String* UnitName, float) {
    return activate(task, *UnitName, true);
}
Status rt_IODeactivate(TaskCore* task, const String* DeviceName, float) {
    return activate(task, *DeviceName, false);
}
Status rt_IODisable(TaskCore* task, const String* UnitName, float) {
    return activate(task, *UnitName, false);
}

Status rt_IODeviceState(TaskCore* task, float* result, const String* DeviceName, bool Phys, bool Logic) {
    return deviceState(task, result, *DeviceName, Phys, Logic);
}
Status rt_IOUnitState(TaskCore* task, float* result, const String* UnitName, bool Phys, bool Logic) {
    return deviceState(task, result, *UnitName, Phys, Logic);
}

Status rt_IONetworkState(TaskCore* task, float* result, const String* NetworkName, bool Phys, bool Logic) {
    return networkState(task, result, *NetworkName, Phys, Logic);
}
Status rt_IOBusState(TaskCore* task, const String* BusName, float* State, bool Phys, bool Logic) {
    return networkState(task, State, *BusName, Phys, Logic);
}
Status rt_IOBusStart(TaskCore* task, const String* BusName) {
    float running = 0;
    return networkState(task, &running, *BusName, false, false);
}

Status rt_IODeviceMute(TaskCore* task, bool, bool, const String* DeviceName) {
    return muteDevice(task, *DeviceName);
}
Status rt_IOEventMessage(TaskCore* task, bool, bool, const String* DeviceName) {
    return muteDevice(task, *DeviceName);
}

/// A variable of the program is connected by AliasIO or not at all; other signals are those of the configuration.
Status rt_GetSignalOrigin(TaskCore* task, float* result, void* Signal, const TypeDesc*, String* SignalName) {
    Handle handle = 0;
    std::memcpy(&handle, Signal, sizeof handle);
    Controller& controller = taskOf(task).controller();
    SignalName->assign(lib::signalName(controller.io(), handle));
    const bool isVariable = taskOf(task).ownsAddress(Signal) || lib::dataAt(controller, Signal) != nullptr;
    if (controller.io().idOf(handle) < 0)
        *result = k::SIGORIG_NONE;
    else
        *result = isVariable ? k::SIGORIG_ALIAS : k::SIGORIG_CFG;
    return kOk;
}
}

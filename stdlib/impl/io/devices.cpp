// Manual 1.9: I/O devices and networks (simulated, `IoDevices`), and where a signal comes from.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"

#include "natives/io_signals.h"
#include "stdlib_constants.h"

#include <cstring>

using namespace rt;

namespace {

Status badName(TaskCore* task, const char* kind, const String& name) {
    return lib::fail(task, err::ERR_NAME_INVALID,
                     std::string("the configuration (EIO.cfg) has no I/O ") + kind + " named '" +
                         std::string(name.view()) + "'");
}

/// Waits until the device answers; false when `maxTime` (s) has passed before.
Status waitForContact(TaskCore* core, const String& name, float maxTime, bool& answers) {
    Task& task = taskOf(core);
    IoDevices& devices = task.controller().io().devices();
    WaitSpec spec;
    spec.queues = {&devices.changed()};
    spec.condition = [&] { return devices.hasContact(name.view()); };
    spec.deadline = addTime(task.now(), fromSeconds(maxTime));
    WaitResult result = WaitResult::Done;
    const Status status = task.waitFor(spec, result);
    answers = result == WaitResult::Done;
    return status;
}

Status activate(TaskCore* task, const String& name, float maxTime) {
    IoDevices& devices = taskOf(task).controller().io().devices();
    if (!devices.isDevice(name.view())) return badName(task, "device", name);
    if (devices.isNetworkOfInError(name.view()))
        return lib::fail(task, err::ERR_BUSSTATE,
                         "the network of I/O device " + std::string(name.view()) + " is in error");
    devices.setActive(name.view(), true);
    bool answers = false;
    const Status status = waitForContact(task, name, maxTime, answers);
    if (status != kOk || answers) return status;
    return lib::fail(task, err::ERR_IOENABLE,
                     "I/O device " + std::string(name.view()) + " has not answered within MaxTime");
}

Status deactivate(TaskCore* task, const String& name, float maxTime) {
    IoDevices& devices = taskOf(task).controller().io().devices();
    if (!devices.isDevice(name.view())) return badName(task, "device", name);
    if (devices.mustStayActive(name.view()))
        return lib::fail(task, err::ERR_TRUSTLEVEL,
                         "the trust level of I/O device " + std::string(name.view()) +
                             " does not allow that it is deactivated");
    bool answers = false;
    const Status status = waitForContact(task, name, maxTime, answers);
    if (status != kOk) return status;
    if (!answers)
        return lib::fail(task, err::ERR_IODISABLE,
                         "I/O device " + std::string(name.view()) + " has not answered within MaxTime");
    devices.setActive(name.view(), false);
    return kOk;
}

Status deviceState(TaskCore* task, float* result, const String& name, bool physical, bool logical) {
    const IoDevices& devices = taskOf(task).controller().io().devices();
    if (!devices.isDevice(name.view())) return badName(task, "device", name);
    const bool isActive = devices.isActive(name.view());
    const bool answers = devices.hasContact(name.view());
    if (logical)
        *result = isActive ? k::IOUNIT_LOG_STATE_ENABLED : k::IOUNIT_LOG_STATE_DISABLED;
    else if (physical)
        *result = !isActive ? k::IOUNIT_PHYS_STATE_UNCONNECTED
                  : answers ? k::IOUNIT_PHYS_STATE_RUNNING
                            : k::IOUNIT_PHYS_STATE_ERROR;
    else
        *result = !isActive ? k::IOUNIT_DISABLE : answers ? k::IOUNIT_RUNNING : k::IOUNIT_RUNERROR;
    return kOk;
}

Status networkState(TaskCore* task, float* result, const String& name, bool physical, bool logical) {
    const IoDevices& devices = taskOf(task).controller().io().devices();
    if (!devices.isNetwork(name.view())) return badName(task, "network", name);
    const bool isInError = devices.isNetworkInError(name.view());
    if (logical)
        *result = k::IOBUS_LOG_STATE_STARTED;
    else if (physical)
        *result = isInError ? k::IOBUS_PHYS_STATE_ERROR : k::IOBUS_PHYS_STATE_RUNNING;
    else
        *result = isInError ? k::BUSSTATE_ERROR : k::BUSSTATE_RUN;
    return kOk;
}

/// Whether losses of contact are reported in the event log.
Status muteDevice(TaskCore* task, const String& name, bool muted) {
    IoDevices& devices = taskOf(task).controller().io().devices();
    if (!devices.isDevice(name.view())) return badName(task, "device", name);
    devices.setMuted(name.view(), muted);
    return kOk;
}

} // namespace

extern "C" {

Status rt_IOActivate(TaskCore* task, const String* DeviceName, float MaxTime) {
    return activate(task, *DeviceName, MaxTime);
}
Status rt_IOEnable(TaskCore* task, const String* UnitName, float MaxTime) {
    return activate(task, *UnitName, MaxTime);
}
Status rt_IODeactivate(TaskCore* task, const String* DeviceName, float MaxTime) {
    return deactivate(task, *DeviceName, MaxTime);
}
Status rt_IODisable(TaskCore* task, const String* UnitName, float MaxTime) {
    return deactivate(task, *UnitName, MaxTime);
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

Status rt_IODeviceMute(TaskCore* task, bool, bool Off, const String* DeviceName) {
    return muteDevice(task, *DeviceName, !Off);
}
Status rt_IOEventMessage(TaskCore* task, bool, bool Off, const String* DeviceName) {
    return muteDevice(task, *DeviceName, Off);
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

#include "stdlib/impl/io/signals.h"

#include "runtime/abi/support_natives.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <cmath>

namespace rt::lib {

std::string signalName(const IoSystem& io, Handle handle) {
    const SignalId id = io.idOf(handle);
    return id < 0 ? std::string() : io.config(id).name;
}

Handle signalNamed(const IoSystem& io, const std::string& name) {
    const SignalId id = io.find(name);
    return id < 0 ? 0 : IoSystem::handleOf(id);
}

Status ioStatus(TaskCore* task, IoResult result, Handle handle) {
    if (result == IoResult::Ok) return kOk;
    const IoSystem& io = taskOf(task).controller().io();
    const SignalId id = io.idOf(handle);
    const std::string name = signalName(io, handle);
    switch (result) {
    case IoResult::Ok: return kOk;
    case IoResult::NoSignal:
        if (const std::string undefined = io.undefinedName(handle); !undefined.empty())
            return fail(
                task, err::ERR_NO_ALIASIO_DEF,
                "signal " + undefined +
                    " is not defined by a configuration; define it in EIO.cfg and pass that with --config, "
                    "or use --assume-signals");
        return fail(task, err::ERR_NO_ALIASIO_DEF,
                    "the signal variable is not connected; connect it with AliasIO first");
    case IoResult::OutOfRange: {
        const SignalConfig& config = io.config(id);
        const bool analog = isAnalog(config.type);
        return fail(task, analog ? err::ERR_AO_LIM : err::ERR_GO_LIM,
                    "the value is outside the limits of signal " + name + ", " + formatDnum(config.minValue) +
                        " to " + formatDnum(config.maxValue));
    }
    case IoResult::NotWritable:
        return fail(task, err::ERR_SIG_NOT_VALID,
                    "signal " + name + " cannot be set from a program (input, or Access level)");
    case IoResult::DeviceOff:
        return fail(task, err::ERR_NORUNUNIT,
                    "I/O device " + io.config(id).device + " of signal " + name +
                        (io.devices().isActive(io.config(id).device)
                             ? " has lost contact"
                             : " is deactivated; activate it with IOActivate (IOEnable)"));
    case IoResult::NotValid: return fail(task, err::ERR_SIG_NOT_VALID, "signal " + name + " is not valid");
    case IoResult::BadTime:
        return fail(task, err::ERR_ARGVALERR, "a pulse lasts 0.001 to 2000 s, a delay 0 to 2000 s");
    case IoResult::TooManyDelays:
        return fail(task, err::ERR_ARGVALERR, "20 delayed changes are pending already, the maximum");
    }
    return kOk;
}

SignalId signalOf(TaskCore* task, Handle handle, Status& status) {
    const SignalId id = taskOf(task).controller().io().idOf(handle);
    status = id < 0 ? ioStatus(task, IoResult::NoSignal, handle) : kOk;
    return id;
}

SignalId usableSignal(TaskCore* task, Handle handle, Status& status) {
    const IoSystem& io = taskOf(task).controller().io();
    status = ioStatus(task, io.access(handle), handle);
    return status == kOk ? io.idOf(handle) : -1;
}

Status readSignal(TaskCore* task, Handle handle, double& value) {
    IoResult result = IoResult::Ok;
    value = taskOf(task).controller().io().read(handle, result);
    return ioStatus(task, result, handle);
}

Status checkWhole(TaskCore* task, double value) {
    if (std::trunc(value) == value) return kOk;
    return fail(task, err::ERR_ARGVALERR, "a group takes whole numbers only");
}

void keepSignalVariables(Controller& controller, StateKeepers& kept) {
    const IoSystem& io = controller.io();
    const auto textOf = [&io](Handle handle) { return signalName(io, handle); };
    const auto make = [&io](const std::string& name) { return signalNamed(io, name); };
    for (const char* type : {"signaldi", "signaldo", "signalai", "signalao", "signalgi", "signalgo"})
        kept.handles[type] = {textOf, make};
}

} // namespace rt::lib

extern "C" {

rt::Status rt_readSignalNum(rt::TaskCore* task, float* result, const rt::Handle* signal) {
    double value = 0;
    if (const rt::Status status = rt::lib::readSignal(task, *signal, value)) return status;
    *result = static_cast<float>(value);
    return rt::kOk;
}

rt::Status rt_readSignalDnum(rt::TaskCore* task, double* result, const rt::Handle* signal) {
    return rt::lib::readSignal(task, *signal, *result);
}
}

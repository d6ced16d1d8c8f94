// Manual 1.9: signal variables and the signals that they refer to.

#include "config/letter_case.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"

#include "natives/io_signals.h"
#include "stdlib_constants.h"

#include <cctype>
#include <cstring>

using namespace rt;

namespace {

/// "signaldo" for SignalType::DO.
bool sameSignalType(const char* rapidType, SignalType type) {
    const std::string_view name(rapidType);
    const std::string_view kind = signalTypeName(type);
    return name.size() == 8 && rapid::config::sameName(name.substr(6), kind);
}

Handle handleAt(const void* slot) {
    Handle handle = 0;
    std::memcpy(&handle, slot, sizeof handle);
    return handle;
}

} // namespace

extern "C" {

/// FromSignal is a signal, or the name of one in a string.
Status rt_AliasIO(TaskCore* task, void* FromSignal, const TypeDesc* FromSignalType, void* ToSignal,
                  const TypeDesc* ToSignalType) {
    const IoSystem& io = taskOf(task).controller().io();
    SignalId id = -1;
    if (FromSignalType->kind == DescKind::String)
        id = io.find(static_cast<const String*>(FromSignal)->view());
    else if (FromSignalType->kind == DescKind::Handle)
        id = io.idOf(handleAt(FromSignal));
    if (FromSignalType->kind == DescKind::Handle && handleAt(FromSignal) == 0)
        return lib::fail(task, err::ERR_NO_ALIASIO_DEF, "AliasIO: the variable FromSignal is not connected");
    if (id < 0 || ToSignalType->kind != DescKind::Handle)
        return lib::fail(task, err::ERR_ALIASIO_DEF, "AliasIO: FromSignal names no configured signal");
    if (!sameSignalType(ToSignalType->baseName, io.config(id).type))
        return lib::fail(task, err::ERR_ALIASIO_TYPE,
                         "AliasIO: signal " + io.config(id).name +
                             " is of a different type than the variable");
    const Handle handle = IoSystem::handleOf(id);
    std::memcpy(ToSignal, &handle, sizeof handle);
    return kOk;
}

Status rt_AliasIOReset(TaskCore* task, void* Signal, const TypeDesc*) {
    if (handleAt(Signal) == 0)
        return lib::fail(task, err::ERR_NO_ALIASIO_DEF, "AliasIOReset: the signal variable is not connected");
    const Handle none = 0;
    std::memcpy(Signal, &none, sizeof none);
    return kOk;
}

Status rt_ValidIO(TaskCore* task, bool* result, void* Signal, const TypeDesc*) {
    Status status = kOk;
    lib::signalOf(task, handleAt(Signal), status);
    *result = status == kOk;
    return status;
}

Status rt_GetGroupSignalInfo(TaskCore* task, void* Signal, const TypeDesc*, double* MaxDvalue, String* Label,
                             String* DeviceName) {
    Status status = kOk;
    const SignalId id = lib::signalOf(task, handleAt(Signal), status);
    if (status != kOk) return status;
    const SignalConfig& config = taskOf(task).controller().io().config(id);
    if (MaxDvalue) *MaxDvalue = config.maxValue;
    if (Label) Label->assign(config.label);
    if (DeviceName) DeviceName->assign(config.device);
    return kOk;
}
}

// Manual 1.9: setting outputs and reading signals.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"

#include "natives/io_signals.h"
#include "stdlib_constants.h"

using namespace rt;
using lib::ioStatus;

namespace {

IoSystem& ioOf(TaskCore* task) {
    return taskOf(task).controller().io();
}

Status setNow(TaskCore* task, Handle signal, double value) {
    return ioStatus(task, ioOf(task).set(signal, value), signal);
}

/// Now, or `delay` seconds later when it is given.
Status setAfter(TaskCore* task, Handle signal, double value, const float* delay) {
    if (!delay) return setNow(task, signal, value);
    if (*delay < 0) return ioStatus(task, IoResult::BadTime, signal);
    return ioStatus(task, ioOf(task).setDelayed(signal, value, fromSeconds(*delay)), signal);
}

Status readNum(TaskCore* task, float* result, Handle signal) {
    double value = 0;
    if (const Status status = lib::readSignal(task, signal, value)) return status;
    *result = static_cast<float>(value);
    return kOk;
}

constexpr double kPulseSeconds = 0.2;

} // namespace

extern "C" {

Status rt_Set(TaskCore* task, Handle* Signal) {
    return setNow(task, *Signal, 1);
}
Status rt_Reset(TaskCore* task, Handle* Signal) {
    return setNow(task, *Signal, 0);
}
Status rt_InvertDO(TaskCore* task, Handle* Signal) {
    return ioStatus(task, ioOf(task).invert(*Signal), *Signal);
}
/// \Sync asks to wait until the output has reached the device; a virtual device has it at once.
Status rt_SetDO(TaskCore* task, const float* SDelay, bool, Handle* Signal, float Value) {
    return setAfter(task, *Signal, Value != 0 ? 1 : 0, SDelay);
}
Status rt_SetAO(TaskCore* task, Handle* Signal, float Value) {
    return setNow(task, *Signal, Value);
}
Status rt_SetGO(TaskCore* task, const float* SDelay, Handle* Signal, const float* Value,
                const double* Dvalue) {
    const double value = Value ? static_cast<double>(*Value) : *Dvalue;
    if (const Status status = lib::checkWhole(task, value)) return status;
    return setAfter(task, *Signal, value, SDelay);
}
Status rt_PulseDO(TaskCore* task, bool High, const float* PLength, Handle* Signal) {
    const Time length = fromSeconds(PLength ? static_cast<double>(*PLength) : kPulseSeconds);
    return ioStatus(task, ioOf(task).pulse(*Signal, length, High), *Signal);
}

Status rt_TestDI(TaskCore* task, bool* result, Handle* Signal) {
    double value = 0;
    if (const Status status = lib::readSignal(task, *Signal, value)) return status;
    *result = value == 1;
    return kOk;
}
Status rt_DInput(TaskCore* task, float* result, Handle* Signal) {
    return readNum(task, result, *Signal);
}
Status rt_DOutput(TaskCore* task, float* result, Handle* Signal) {
    return readNum(task, result, *Signal);
}
Status rt_AInput(TaskCore* task, float* result, Handle* Signal) {
    return readNum(task, result, *Signal);
}
Status rt_AOutput(TaskCore* task, float* result, Handle* Signal) {
    return readNum(task, result, *Signal);
}
Status rt_GInput(TaskCore* task, float* result, Handle* Signal) {
    return readNum(task, result, *Signal);
}
Status rt_GOutput(TaskCore* task, float* result, Handle* Signal) {
    return readNum(task, result, *Signal);
}
Status rt_GInputDnum(TaskCore* task, double* result, Handle* Signal) {
    return lib::readSignal(task, *Signal, *result);
}
Status rt_GOutputDnum(TaskCore* task, double* result, Handle* Signal) {
    return lib::readSignal(task, *Signal, *result);
}
}

// Manual 1.11: interrupts from analog signals. Every change of the signal is a sample. A sample counts when its value
// meets the condition and is further from the reference value than DeltaValue; it is the new reference then, whatever
// its direction, and raises the interrupt unless \DPos or \DNeg asks for the other direction. The first reference is
// the value at the time of the order. With a DeltaValue of 0 that value is a sample itself: "the first time the signal is
// between 0.5 and 1.5" is now when it is there already. It has no direction.

#include "stdlib/impl/interrupts/ordering.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"

#include "natives/interrupts.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

using namespace rt;

namespace {

struct AnalogOrder {
    Handle signal = 0;
    lib::OrderKind kind;
    float condition = 0, high = 0, low = 0, delta = 0;
    bool risingOnly = false, fallingOnly = false;
    float* interrupt = nullptr;
};

/// The value that is compared with each sample: a num, as RAPID sees the signal.
struct Watch {
    AnalogOrder order;
    float reference = 0;

    bool meets(float value) const {
        const float condition = order.condition;
        if (condition == k::AIO_ABOVE_HIGH) return value > order.high;
        if (condition == k::AIO_BELOW_HIGH) return value < order.high;
        if (condition == k::AIO_ABOVE_LOW) return value > order.low;
        if (condition == k::AIO_BELOW_LOW) return value < order.low;
        if (condition == k::AIO_BETWEEN) return value >= order.low && value <= order.high;
        if (condition == k::AIO_OUTSIDE) return value < order.low || value > order.high;
        return true; // AIO_ALWAYS
    }
    /// True when the value at the time of the order raises it.
    bool first() const {
        return order.delta == 0 && !order.risingOnly && !order.fallingOnly && meets(reference);
    }
    /// True when this sample raises the interrupt.
    bool sample(float value) {
        const float change = value - reference;
        if (!meets(value) || !(std::fabs(change) > order.delta)) return false;
        reference = value;
        return change > 0 ? !order.fallingOnly : !order.risingOnly;
    }
};

Status checkArguments(TaskCore* task, const AnalogOrder& order, const SignalConfig& signal) {
    if (!(order.condition >= k::AIO_ABOVE_HIGH && order.condition <= k::AIO_ALWAYS &&
          order.condition == std::floor(order.condition)))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the condition must be one of AIO_ABOVE_HIGH to AIO_ALWAYS (1 to 7)");
    if (!(order.delta >= 0)) return lib::fail(task, err::ERR_ARGVALERR, "DeltaValue must not be negative");
    for (const float limit : {order.high, order.low}) {
        if (limit >= signal.minValue && limit <= signal.maxValue) continue;
        return lib::fail(task, err::ERR_AO_LIM,
                         fmt::format("{} is outside the limits of signal {} ({} to {})", limit, signal.name,
                                     signal.minValue, signal.maxValue));
    }
    return kOk;
}

Status orderAnalog(TaskCore* core, const AnalogOrder& order) {
    Task& task = taskOf(core);
    IoSystem& io = task.controller().io();
    Status status = kOk;
    const SignalId id = lib::usableSignal(core, order.signal, status);
    if (status != kOk) return status;
    status = checkArguments(core, order, io.config(id));
    if (status != kOk) return status;
    const int number = lib::numberToOrder(core, order.interrupt, status);
    if (status != kOk) return status;
    const auto watch = std::make_shared<Watch>(Watch{order, static_cast<float>(io.value(id))});
    const uint64_t listener = io.addListener(id, [&task, number, watch](SignalId, double, double now) {
        if (watch->sample(static_cast<float>(now))) task.interrupts().post(number);
    });
    status = lib::orderInterrupt(core, number, order.kind, [&io, listener] { io.removeListener(listener); },
                                 {lib::kAnalogOrder,
                                  io.config(id).name,
                                  {order.condition, order.high, order.low, order.delta,
                                   order.risingOnly ? 1.0 : 0.0, order.fallingOnly ? 1.0 : 0.0}});
    if (status == kOk && watch->first()) task.interrupts().post(number);
    return status;
}

} // namespace

extern "C" {

Status rt_ISignalAI(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float Condition,
                    float HighValue, float LowValue, float DeltaValue, bool DPos, bool DNeg,
                    float* Interrupt) {
    return orderAnalog(
        task,
        {*Signal, {Single, SingleSafe}, Condition, HighValue, LowValue, DeltaValue, DPos, DNeg, Interrupt});
}

Status rt_ISignalAO(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float Condition,
                    float HighValue, float LowValue, float DeltaValue, bool DPos, bool DNeg,
                    float* Interrupt) {
    return rt_ISignalAI(task, Single, SingleSafe, Signal, Condition, HighValue, LowValue, DeltaValue, DPos,
                        DNeg, Interrupt);
}
}

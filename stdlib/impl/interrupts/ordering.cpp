// Manual 1.11: connecting, ordering and switching interrupts.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/support_natives.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <algorithm>
#include <memory>

using namespace rt;

namespace {

constexpr float kShortestCycle = 0.1F;   // s, ITimer
constexpr float kShortestSingle = 0.01F; // s, ITimer \Single

int numberOf(const float* interrupt) {
    return static_cast<int>(*interrupt);
}

Status unknown(TaskCore* task) {
    return lib::fail(task, err::ERR_UNKINO,
                     "the interrupt is not connected with a trap routine; use CONNECT first");
}

struct SignalOrder {
    Handle signal;
    bool single, safe;
    const float* interrupt;
    bool (*wanted)(double oldValue, double newValue);
};

/// Posts the interrupt at every change of the signal that `wanted` accepts.
Status orderSignal(TaskCore* core, const SignalOrder& what) {
    Task& task = taskOf(core);
    IoSystem& io = task.controller().io();
    Status status = kOk;
    const SignalId id = lib::signalOf(core, what.signal, status);
    if (status != kOk) return status;
    const int number = numberOf(what.interrupt);
    if (!task.interrupts().isDefined(number)) return unknown(core);
    const auto wanted = what.wanted;
    const uint64_t listener =
        io.addListener(id, [&task, number, wanted](SignalId, double before, double now) {
            if (wanted(before, now)) task.interrupts().post(number);
        });
    const auto disarm = [&io, listener] { io.removeListener(listener); };
    if (task.interrupts().order(number, disarm, what.single || what.safe, what.safe)) return kOk;
    disarm();
    return unknown(core);
}

Status orderDigital(TaskCore* task, Handle signal, float value, bool single, bool safe,
                    const float* interrupt) {
    const auto rises = [](double, double now) { return now == 1; };
    const auto falls = [](double, double now) { return now == 0; };
    const auto either = [](double, double) { return true; };
    if (value != k::low && value != k::high && value != k::edge)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the value that raises the interrupt must be low, high or edge");
    return orderSignal(task, {signal, single, safe, interrupt,
                              value == k::high  ? +rises
                              : value == k::low ? +falls
                                                : +either});
}

/// A timer that orders itself again until it is disarmed.
struct Timer {
    Task& task;
    int number;
    Time period;
    bool single;
    EventToken event = 0;

    static void arm(const std::shared_ptr<Timer>& timer) {
        timer->event = timer->task.scheduler().after(timer->period, [timer] {
            timer->event = 0;
            // First the next round: the trap may delete the interrupt.
            if (!timer->single) arm(timer);
            timer->task.interrupts().post(timer->number);
        });
    }
    void disarm() {
        if (event != 0) task.scheduler().cancel(event);
        event = 0;
        single = true;
    }
};

} // namespace

extern "C" {

Status rt_connect(TaskCore* task, float* interrupt, void* trap) {
    InterruptTable& table = taskOf(task).interrupts();
    if (*interrupt != 0 && table.isDefined(numberOf(interrupt)))
        return lib::fail(task, err::ERR_ALRDYCNT,
                         "the interrupt variable is connected already; use IDelete first");
    const int number = table.connect({reinterpret_cast<EntryFunction>(trap), nullptr});
    if (number == 0)
        return lib::fail(task, err::ERR_INOMAX, "100 interrupts are defined in this task, which is the most");
    *interrupt = static_cast<float>(number);
    return kOk;
}

Status rt_ISignalDI(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float TriggValue,
                    float* Interrupt) {
    return orderDigital(task, *Signal, TriggValue, Single, SingleSafe, Interrupt);
}
Status rt_ISignalDO(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float TriggValue,
                    float* Interrupt) {
    return orderDigital(task, *Signal, TriggValue, Single, SingleSafe, Interrupt);
}
Status rt_ISignalGI(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float* Interrupt) {
    return orderSignal(task, {*Signal, Single, SingleSafe, Interrupt, [](double, double) { return true; }});
}
Status rt_ISignalGO(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float* Interrupt) {
    return orderSignal(task, {*Signal, Single, SingleSafe, Interrupt, [](double, double) { return true; }});
}

Status rt_ITimer(TaskCore* task, bool Single, bool SingleSafe, float Time, float* Interrupt) {
    Task& owner = taskOf(task);
    const bool single = Single || SingleSafe;
    if (!(Time >= (single ? kShortestSingle : kShortestCycle)))
        return lib::fail(task, err::ERR_ARGVALERR, "ITimer: at least 0.1 s, with \\Single 0.01 s");
    const int number = numberOf(Interrupt);
    if (!owner.interrupts().isDefined(number)) return unknown(task);
    const auto timer = std::make_shared<Timer>(Timer{owner, number, fromSeconds(Time), single});
    if (!owner.interrupts().order(number, [timer] { timer->disarm(); }, single, SingleSafe))
        return unknown(task);
    Timer::arm(timer);
    return kOk;
}

Status rt_IDelete(TaskCore* task, float* Interrupt) {
    // Programs begin with IDelete, CONNECT: a variable that was never connected, or is deleted already, is no error.
    if (*Interrupt == 0) return kOk;
    if (!taskOf(task).interrupts().remove(numberOf(Interrupt))) return unknown(task);
    *Interrupt = 0;
    return kOk;
}

Status rt_ISleep(TaskCore* task, float* Interrupt) {
    InterruptTable& table = taskOf(task).interrupts();
    if (!table.isDefined(numberOf(Interrupt))) return unknown(task);
    if (table.isSafe(numberOf(Interrupt)))
        return lib::fail(task, err::ERR_INOISSAFE, "a safe interrupt cannot be put to sleep");
    table.sleep(numberOf(Interrupt));
    return kOk;
}

Status rt_IWatch(TaskCore* task, float* Interrupt) {
    return taskOf(task).interrupts().watch(numberOf(Interrupt)) ? kOk : unknown(task);
}

Status rt_IDisable(TaskCore* task) {
    taskOf(task).interrupts().disable();
    return kOk;
}

Status rt_IEnable(TaskCore* task) {
    taskOf(task).interrupts().enable();
    return kOk;
}
}

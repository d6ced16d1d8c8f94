// Manual 1.11: connecting, ordering and switching interrupts.

#include "stdlib/impl/interrupts/ordering.h"
#include "runtime/abi/support_natives.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/queues/message_queue.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"

#include "natives/interrupts.h"
#include "stdlib_constants.h"

#include <array>
#include <memory>
#include <string>
#include <utility>

using namespace rt;

namespace {

constexpr float kShortestCycle = 0.1F;   // s, ITimer
constexpr float kShortestSingle = 0.01F; // s, ITimer \Single
// InterruptOrder::kind
constexpr const char* kDigital = "ISignalDI";
constexpr const char* kGroup = "ISignalGI";
constexpr const char* kTimer = "ITimer";

Status tooMany(TaskCore* task) {
    return lib::fail(task, err::ERR_INOMAX, "100 interrupts are defined in this task, the maximum");
}

struct SignalOrder {
    Handle signal;
    lib::OrderKind kind;
    float* interrupt;
    bool (*wanted)(double newValue);
    InterruptOrder again;
};

/// Posts the interrupt at every change of the signal that `wanted` accepts.
Status orderSignal(TaskCore* core, SignalOrder what) {
    Task& task = taskOf(core);
    IoSystem& io = task.controller().io();
    Status status = kOk;
    const SignalId id = lib::usableSignal(core, what.signal, status);
    if (status != kOk) return status;
    const int number = lib::numberToOrder(core, what.interrupt, status);
    if (status != kOk) return status;
    const auto wanted = what.wanted;
    const uint64_t listener = io.addListener(id, [&task, number, wanted](SignalId, double, double now) {
        if (wanted(now)) task.interrupts().post(number);
    });
    what.again.object = io.config(id).name;
    return lib::orderInterrupt(
        core, number, what.kind, [&io, listener] { io.removeListener(listener); }, std::move(what.again));
}

Status orderDigital(TaskCore* task, Handle signal, float value, lib::OrderKind kind, float* interrupt) {
    const auto rises = [](double now) { return now == 1; };
    const auto falls = [](double now) { return now == 0; };
    const auto either = [](double) { return true; };
    if (value != k::low && value != k::high && value != k::edge)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the value that raises the interrupt must be low, high or edge");
    return orderSignal(task, {signal,
                              kind,
                              interrupt,
                              value == k::high  ? +rises
                              : value == k::low ? +falls
                                                : +either,
                              {kDigital, {}, {value}}});
}

Status orderGroup(TaskCore* task, Handle signal, lib::OrderKind kind, float* interrupt) {
    return orderSignal(task, {signal, kind, interrupt, [](double) { return true; }, {kGroup, {}, {}}});
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

namespace rt::lib {

int numberOf(const float* interrupt) {
    return *interrupt >= 0 && *interrupt < 1e6F ? static_cast<int>(*interrupt) : 0;
}

int numberToOrder(TaskCore* task, float* interrupt, Status& status) {
    InterruptTable& table = taskOf(task).interrupts();
    if (table.isDefined(numberOf(interrupt))) return numberOf(interrupt);
    const int number = table.define();
    if (number == 0)
        status = tooMany(task);
    else
        *interrupt = static_cast<float>(number);
    return number;
}

Status orderInterrupt(TaskCore* task, int number, OrderKind kind, std::function<void()> disarm,
                      InterruptOrder what) {
    taskOf(task).interrupts().order(number, std::move(disarm), kind.single || kind.safe, kind.safe,
                                    std::move(what));
    return kOk;
}

bool orderAgain(Task& task, int number, bool single, bool safe, const InterruptOrder& order) {
    auto interrupt = static_cast<float>(number);
    std::array<float, kMostArguments> a{};
    for (std::size_t i = 0; i < a.size() && i < order.numbers.size(); ++i)
        a[i] = static_cast<float>(order.numbers[i]);
    Handle signal = IoSystem::handleOf(task.controller().io().find(order.object));
    const bool flagged = single && !safe;
    if (order.kind == kTimer) return rt_ITimer(&task, flagged, safe, a[0], &interrupt) == kOk;
    if (order.kind == kDigital) return rt_ISignalDI(&task, flagged, safe, &signal, a[0], &interrupt) == kOk;
    if (order.kind == kGroup) return rt_ISignalGI(&task, flagged, safe, &signal, &interrupt) == kOk;
    if (order.kind == kAnalogOrder)
        return rt_ISignalAI(&task, flagged, safe, &signal, a[0], a[1], a[2], a[3], a[4] != 0, a[5] != 0,
                            &interrupt) == kOk;
    if (order.kind == kErrorOrder)
        return rt_IError(&task, a[0], a[2] != 0 ? &a[3] : nullptr, a[1], &interrupt) == kOk;
    if (order.kind == kTriggerOrder) return orderInterrupt(&task, number, {single, safe}, {}, order) == kOk;
    if (order.kind == kMessageOrder) {
        orderMessages(task, number, order.object);
        return true;
    }
    if (order.kind != kPersistentOrder) return false;
    const AnyRef data = dataByName(task, order.object);
    return data.data != nullptr && rt_IPers(&task, flagged, safe, data.data, data.type, &interrupt) == kOk;
}

Status unknownInterrupt(TaskCore* task) {
    return fail(task, err::ERR_UNKINO,
                "the interrupt is not connected with a trap routine; use CONNECT first");
}

} // namespace rt::lib

extern "C" {

Status rt_connect(TaskCore* task, float* interrupt, void* trap) {
    InterruptTable& table = taskOf(task).interrupts();
    const Trap routine{reinterpret_cast<EntryFunction>(trap), nullptr, {}};
    if (table.attach(lib::numberOf(interrupt), routine)) return kOk; // ordered before it was connected
    if (table.isDefined(lib::numberOf(interrupt)))
        return lib::fail(task, err::ERR_ALRDYCNT,
                         "the interrupt variable is connected already; use IDelete first");
    const int number = table.connect(routine);
    if (number == 0) return tooMany(task);
    *interrupt = static_cast<float>(number);
    return kOk;
}

Status rt_ISignalDI(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float TriggValue,
                    float* Interrupt) {
    return orderDigital(task, *Signal, TriggValue, {Single, SingleSafe}, Interrupt);
}
Status rt_ISignalDO(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float TriggValue,
                    float* Interrupt) {
    return orderDigital(task, *Signal, TriggValue, {Single, SingleSafe}, Interrupt);
}
Status rt_ISignalGI(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float* Interrupt) {
    return orderGroup(task, *Signal, {Single, SingleSafe}, Interrupt);
}
Status rt_ISignalGO(TaskCore* task, bool Single, bool SingleSafe, Handle* Signal, float* Interrupt) {
    return orderGroup(task, *Signal, {Single, SingleSafe}, Interrupt);
}

Status rt_ITimer(TaskCore* task, bool Single, bool SingleSafe, float Time, float* Interrupt) {
    Task& owner = taskOf(task);
    const bool single = Single || SingleSafe;
    if (!(Time >= (single ? kShortestSingle : kShortestCycle)))
        return lib::fail(task, err::ERR_ARGVALERR, "ITimer: at least 0.1 s, with \\Single 0.01 s");
    Status status = kOk;
    const int number = lib::numberToOrder(task, Interrupt, status);
    if (status != kOk) return status;
    const auto timer = std::make_shared<Timer>(Timer{owner, number, fromSeconds(Time), single});
    Timer::arm(timer);
    return lib::orderInterrupt(task, number, {Single, SingleSafe}, [timer] { timer->disarm(); },
                               {kTimer, {}, {Time}});
}

Status rt_IDelete(TaskCore* task, float* Interrupt) {
    // Programs begin with IDelete, CONNECT: a variable that is not connected, whatever it holds, has nothing to delete.
    (void)taskOf(task).interrupts().remove(lib::numberOf(Interrupt));
    *Interrupt = 0;
    return kOk;
}

Status rt_ISleep(TaskCore* task, float* Interrupt) {
    InterruptTable& table = taskOf(task).interrupts();
    if (!table.isDefined(lib::numberOf(Interrupt))) return lib::unknownInterrupt(task);
    if (table.isSafe(lib::numberOf(Interrupt)))
        return lib::fail(task, err::ERR_INOISSAFE, "a safe interrupt cannot be put to sleep");
    table.sleep(lib::numberOf(Interrupt));
    return kOk;
}

Status rt_IWatch(TaskCore* task, float* Interrupt) {
    return taskOf(task).interrupts().watch(lib::numberOf(Interrupt)) ? kOk : lib::unknownInterrupt(task);
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

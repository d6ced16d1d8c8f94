// Manual 1.6 and 1.9: waiting for signals. A task wakes when the signal changes; nothing is polled.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/fail.h"

#include "natives/waiting.h"
#include "stdlib_constants.h"

#include <functional>

using namespace rt;

namespace {

struct SignalWait {
    Handle signal = 0;
    std::function<bool(double)> condition;
    const float* maxTime = nullptr; ///< s; null: for ever
    bool* timeFlag = nullptr;       ///< gets TRUE instead of ERR_WAIT_MAXTIME being raised
};

/// `last` gets the value at the end of the wait.
Status waitSignal(TaskCore* core, const SignalWait& wait, double& last) {
    Task& task = taskOf(core);
    IoSystem& io = task.controller().io();
    Status status = kOk;
    const SignalId id = lib::signalOf(core, wait.signal, status);
    if (status != kOk) return status;
    WaitSpec spec;
    spec.queues = {&io.changed(id)};
    const auto isReadable = [&] { return io.access(wait.signal) == IoResult::Ok; };
    spec.condition = [&] { return !isReadable() || wait.condition(io.value(id)); };
    if (wait.maxTime) spec.deadline = addTime(task.now(), fromSeconds(*wait.maxTime));
    WaitResult result = WaitResult::Done;
    status = task.waitFor(spec, result);
    last = io.value(id);
    if (status != kOk) return status;
    if (!isReadable()) return lib::ioStatus(core, io.access(wait.signal), wait.signal);
    if (wait.timeFlag) *wait.timeFlag = result == WaitResult::Timeout;
    if (result == WaitResult::Done || wait.timeFlag != nullptr) return kOk;
    return lib::fail(core, err::ERR_WAIT_MAXTIME,
                     "signal " + io.config(id).name + " did not get the value within \\MaxTime");
}

Status waitDigital(TaskCore* task, Handle signal, float value, const float* maxTime, bool* timeFlag) {
    const double wanted = value != 0 ? 1 : 0;
    double last = 0;
    return waitSignal(task, {signal, [wanted](double now) { return now == wanted; }, maxTime, timeFlag},
                      last);
}

enum class Relation { Equal, NotEqual, Less, Greater };

struct ValueWait {
    Handle signal;
    Relation relation;
    double value;
    const float* maxTime;
    Status limitError; ///< raised when the value lies outside the limits of the signal
};

Status waitValue(TaskCore* task, const ValueWait& wait, float* numAtTimeout, double* dnumAtTimeout) {
    Status status = kOk;
    const SignalId id = lib::signalOf(task, wait.signal, status);
    if (status != kOk) return status;
    const SignalConfig& config = taskOf(task).controller().io().config(id);
    if (wait.value < config.minValue || wait.value > config.maxValue)
        return lib::fail(task, wait.limitError,
                         "the value to wait for is outside the limits of signal " + config.name);
    const auto condition = [&wait](double now) {
        switch (wait.relation) {
        case Relation::Equal: return now == wait.value;
        case Relation::NotEqual: return now != wait.value;
        case Relation::Less: return now < wait.value;
        case Relation::Greater: return now > wait.value;
        }
        return false;
    };
    double last = 0;
    status = waitSignal(task, {wait.signal, condition, wait.maxTime, nullptr}, last);
    if (status == err::ERR_WAIT_MAXTIME) {
        if (numAtTimeout) *numAtTimeout = static_cast<float>(last);
        if (dnumAtTimeout) *dnumAtTimeout = last;
    }
    return status;
}

Status waitGroup(TaskCore* task, Handle signal, Relation relation, const float* num, const double* dnum,
                 const float* maxTime, float* numAtTimeout, double* dnumAtTimeout) {
    const double value = num ? static_cast<double>(*num) : *dnum;
    return waitValue(task, {signal, relation, value, maxTime, err::ERR_GO_LIM}, numAtTimeout, dnumAtTimeout);
}

Relation groupRelation(bool notEqual, bool less, bool greater) {
    return notEqual  ? Relation::NotEqual
           : less    ? Relation::Less
           : greater ? Relation::Greater
                     : Relation::Equal;
}

Status waitAnalog(TaskCore* task, Handle signal, bool less, bool greater, float value, const float* maxTime,
                  float* atTimeout) {
    if (less == greater)
        return lib::fail(task, err::ERR_ARGVALERR, "waiting for an analog signal needs one of \\LT and \\GT");
    const Relation relation = less ? Relation::Less : Relation::Greater;
    return waitValue(task, {signal, relation, value, maxTime, err::ERR_AO_LIM}, atTimeout, nullptr);
}

} // namespace

// The arguments of the message box (\Visualize ...) have no effect here: no FlexPendant shows it.
extern "C" {

Status rt_WaitDI(TaskCore* task, Handle* Signal, float Value, const float* MaxTime, bool* TimeFlag, bool,
                 const String*, const String*, const String*, int32_t, bool, const float*, const String*,
                 const float*, Handle*) {
    return waitDigital(task, *Signal, Value, MaxTime, TimeFlag);
}

Status rt_WaitDO(TaskCore* task, Handle* Signal, float Value, const float* MaxTime, bool* TimeFlag, bool,
                 const String*, const String*, const String*, int32_t, bool, const float*, const String*,
                 const float*, Handle*) {
    return waitDigital(task, *Signal, Value, MaxTime, TimeFlag);
}

Status rt_WaitGI(TaskCore* task, Handle* Signal, bool NOTEQ, bool LT, bool GT, const float* Value,
                 const double* Dvalue, const float* MaxTime, float* ValueAtTimeout, double* DvalueAtTimeout,
                 bool, const String*, const String*, const String*, int32_t, bool, const float*,
                 const String*, const float*, Handle*) {
    return waitGroup(task, *Signal, groupRelation(NOTEQ, LT, GT), Value, Dvalue, MaxTime, ValueAtTimeout,
                     DvalueAtTimeout);
}

Status rt_WaitGO(TaskCore* task, Handle* Signal, bool NOTEQ, bool LT, bool GT, const float* Value,
                 const double* Dvalue, const float* MaxTime, float* ValueAtTimeout, double* DvalueAtTimeout,
                 bool, const String*, const String*, const String*, int32_t, bool, const float*,
                 const String*, const float*, Handle*) {
    return waitGroup(task, *Signal, groupRelation(NOTEQ, LT, GT), Value, Dvalue, MaxTime, ValueAtTimeout,
                     DvalueAtTimeout);
}

Status rt_WaitAI(TaskCore* task, Handle* Signal, bool LT, bool GT, float Value, const float* MaxTime,
                 float* ValueAtTimeout, bool, const String*, const String*, const String*, int32_t, bool,
                 const float*, const String*, const float*, Handle*) {
    return waitAnalog(task, *Signal, LT, GT, Value, MaxTime, ValueAtTimeout);
}

Status rt_WaitAO(TaskCore* task, Handle* Signal, bool LT, bool GT, float Value, const float* MaxTime,
                 float* ValueAtTimeout, bool, const String*, const String*, const String*, int32_t, bool,
                 const float*, const String*, const float*, Handle*) {
    return waitAnalog(task, *Signal, LT, GT, Value, MaxTime, ValueAtTimeout);
}
}

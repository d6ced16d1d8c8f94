// Manual 1.8: definition of triggers.

#include "stdlib/impl/motion/triggers.h"

#include "runtime/log/event_log.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/interrupts/ordering.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/motion/speed_outputs.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/relation.h"

#include "natives/triggers.h"
#include "stdlib_constants.h"

#include <cmath>
#include <cstring>
#include <memory>

using namespace rt;
using lib::TriggerDefinition;

namespace {

template <class T> double numberAt(const void* data) {
    T value{};
    std::memcpy(&value, data, sizeof value);
    return static_cast<double>(value);
}

/// Value of a persistent of a type that a signal can have; 0 when there is none.
double signalValue(const void* data, const TypeDesc* type) {
    if (data == nullptr) return 0;
    switch (type->kind) {
    case DescKind::Bool: return numberAt<bool>(data) ? 1 : 0;
    case DescKind::Num: return numberAt<float>(data);
    case DescKind::Dnum: return numberAt<double>(data);
    default: return 0;
    }
}

/// `wanted`, unless the trigger is inhibited.
double valueAtPlace(const TriggerDefinition& trigger, double wanted) {
    const bool inhibited = trigger.inhibit != nullptr && *trigger.inhibit;
    return inhibited ? signalValue(trigger.inhibitValue, trigger.inhibitType) : wanted;
}

void setOutput(Task& task, const TriggerDefinition& trigger, double wanted) {
    IoSystem& io = task.controller().io();
    const double value = valueAtPlace(trigger, wanted);
    const IoResult result = io.set(trigger.signal, value);
    if (result == IoResult::Ok) return;
    const std::string& name = io.config(io.idOf(trigger.signal)).name;
    if (result == IoResult::OutOfRange)
        task.report(EventId::TriggerValue, {name, formatDnum(value)});
    else
        task.report(EventId::TriggerAccess,
                    {name, formatDnum(value),
                     result == IoResult::DeviceOff ? "its device has no contact" : "it is not valid"});
}

void checkSignal(Task& task, const TriggerDefinition& trigger) {
    IoResult result = IoResult::Ok;
    const double value = task.controller().io().read(trigger.signal, result);
    if (lib::related(value, trigger.relation, trigger.value).value_or(false)) return;
    if (trigger.stopMove) task.controller().motion(task).stopMove();
    task.interrupts().post(trigger.interrupt);
}

void execute(Task& task, const TriggerDefinition& trigger) {
    if (trigger.kind == TriggerDefinition::Kind::Output) return setOutput(task, trigger, trigger.value);
    if (trigger.kind == TriggerDefinition::Kind::Speed)
        return lib::followSpeed(
            task, trigger.signal,
            {valueAtPlace(trigger, trigger.value), fromSeconds(trigger.dipLag), trigger.errorSignal});
    if (trigger.inhibit != nullptr && *trigger.inhibit) return;
    if (trigger.kind == TriggerDefinition::Kind::Check) return checkSignal(task, trigger);
    task.interrupts().post(trigger.interrupt);
}

/// A ramp is a flight of this many equal steps, each at its own place of the path.
constexpr int kRampSteps = 50;

/// The place of a step `mm` after that of the trigger.
motion::PathTrigger later(motion::PathTrigger place, double mm) {
    if (place.fromStart || place.nextMove) {
        place.amount += mm;
        return place;
    }
    place.amount -= mm;
    if (place.amount >= 0) return place;
    place.amount = -place.amount; // past the end of the movement
    place.nextMove = true;
    return place;
}

/// The first step notes the value from which the ramp starts.
void addRamp(Task* owner, const TriggerDefinition& ramp, std::vector<PathAction>& actions) {
    const auto from = std::make_shared<double>(0);
    const auto start = [owner, ramp, from] {
        const IoSystem& io = owner->controller().io();
        *from = io.value(io.idOf(ramp.signal));
    };
    actions.push_back({ramp.place, 0, start});
    for (int i = 1; i <= kRampSteps; ++i) {
        const double share = static_cast<double>(i) / kRampSteps;
        PathAction step{ramp.place, 0, [owner, ramp, from, share] {
                            setOutput(*owner, ramp, *from + share * (ramp.value - *from));
                        }};
        if (ramp.rampInTime)
            step.delay = fromSeconds(share * ramp.rampLength);
        else
            step.place = later(ramp.place, share * ramp.rampLength);
        actions.push_back(std::move(step));
    }
}

constexpr float kLongestExtension = -0.1F; // s, ScaleLag of TriggSpeed

/// The place of a trigger, as the instructions that define one give it.
struct Place {
    float distance = 0;
    bool start = false, next = false, time = false;
    float lag = 0;
};

Status setPlace(TaskCore* task, TriggerDefinition& trigger, const Place& place) {
    if (const Status status = lib::checkDistance(task, place.distance)) return status;
    if (!std::isfinite(place.lag))
        return lib::fail(task, err::ERR_ARGVALERR, "the lag must be a number of seconds");
    trigger.place.amount = place.distance;
    trigger.place.fromStart = place.start;
    trigger.place.inTime = place.time;
    trigger.place.nextMove = place.next;
    trigger.place.lag = place.lag;
    return kOk;
}

/// \Mode selects how to treat corner paths; the robot stops at every point, so the modes do not differ.
Status define(TaskCore* task, Handle* variable, const TriggerDefinition& trigger) {
    *variable = lib::triggerStore(task).intern(trigger);
    return kOk;
}

/// Arguments of TriggIO and TriggEquip that tell what is set.
struct OutputArguments {
    const Handle *digital, *group, *analog;
    const float* process;
    const float* value;
    const double* dnumValue;
    const bool* inhibit;
    const void* inhibitValue;
    const TypeDesc* inhibitType;
};

Status defineOutput(TaskCore* task, Handle* variable, TriggerDefinition trigger,
                    const OutputArguments& args) {
    if (args.process != nullptr)
        return taskOf(task).fatal(
            static_cast<int>(EventId::NotImplemented),
            "\\ProcID of TriggIO and TriggEquip, which addresses a process of ABB's own "
            "application software (arc, spot, dispense),");
    const Handle* signal = args.digital != nullptr ? args.digital
                           : args.group != nullptr ? args.group
                                                   : args.analog;
    if (signal == nullptr)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the trigger needs an output: one of \\DOp, \\GOp and \\AOp");
    trigger.signal = *signal;
    trigger.value = args.value != nullptr ? static_cast<double>(*args.value) : *args.dnumValue;
    if (const Status status = lib::checkOutput(task, trigger.signal, trigger.value)) return status;
    trigger.inhibit = args.inhibit;
    trigger.inhibitValue = args.inhibitValue;
    trigger.inhibitType = args.inhibitValue != nullptr ? args.inhibitType : nullptr;
    return define(task, variable, trigger);
}

/// The interrupt is ordered from now on; it occurs when a movement with the trigger passes the place.
Status orderByPlace(TaskCore* task, float* interrupt, TriggerDefinition& trigger) {
    Status status = kOk;
    trigger.interrupt = lib::numberToOrder(task, interrupt, status);
    return status != kOk ? status
                         : lib::orderInterrupt(task, trigger.interrupt, {}, {}, {lib::kTriggerOrder, {}, {}});
}

} // namespace

namespace rt::lib {

Handle TriggerStore::intern(const TriggerDefinition& definition) {
    const auto [at, isNew] = handles_.try_emplace(definition, static_cast<Handle>(definitions_.size()) + 1);
    if (isNew) definitions_.push_back(&at->first);
    return at->second;
}

const TriggerDefinition* TriggerStore::find(Handle handle) const {
    return handle < 1 || static_cast<std::size_t>(handle) > definitions_.size()
               ? nullptr
               : definitions_[static_cast<std::size_t>(handle) - 1];
}

void addActions(TaskCore* task, const TriggerDefinition& definition, std::vector<PathAction>& actions) {
    Task* const owner = &taskOf(task);
    if (definition.kind == TriggerDefinition::Kind::Ramp) return addRamp(owner, definition, actions);
    actions.push_back(
        {definition.place, definition.delay, [owner, definition] { execute(*owner, definition); }});
}

Status checkOutput(TaskCore* task, Handle signal, double value) {
    const IoSystem& io = taskOf(task).controller().io();
    const SignalId id = io.idOf(signal);
    if (id >= 0 && isGroup(io.config(id).type)) {
        if (const Status status = checkWhole(task, value)) return status;
    }
    return ioStatus(task, io.check(signal, value, true), signal);
}

Status checkOutputNow(TaskCore* task, Handle signal, double value) {
    if (const Status status = checkOutput(task, signal, value)) return status;
    return ioStatus(task, taskOf(task).controller().io().access(signal), signal);
}

Status checkDistance(TaskCore* task, float distance) {
    if (distance >= 0 && std::isfinite(distance)) return kOk;
    return fail(
        task, err::ERR_ARGVALERR,
        "the distance of a trigger must not be negative: it counts back from the end of the movement, or "
        "forward from its start with \\Start");
}

} // namespace rt::lib

extern "C" {

Status rt_TriggIO(TaskCore* task, Handle* TriggData, float Distance, bool Start, bool Time, Handle* DOp,
                  Handle* GOp, Handle* AOp, const float* ProcID, const float* SetValue,
                  const double* SetDvalue, const float* DODelay, bool* Inhib, void* InhibSetValue,
                  const TypeDesc* InhibSetValueType, const float*) {
    TriggerDefinition trigger;
    if (const Status status = setPlace(task, trigger, {Distance, Start, false, Time, 0})) return status;
    if (DODelay != nullptr) {
        if (!(*DODelay >= 0) || !std::isfinite(*DODelay))
            return lib::fail(task, err::ERR_ARGVALERR, "\\DODelay must be a time in s, not negative");
        trigger.delay = fromSeconds(*DODelay);
    }
    return defineOutput(
        task, TriggData, trigger,
        {DOp, GOp, AOp, ProcID, SetValue, SetDvalue, Inhib, InhibSetValue, InhibSetValueType});
}

Status rt_TriggEquip(TaskCore* task, Handle* TriggData, float Distance, bool Start, bool Next, float EquipLag,
                     Handle* DOp, Handle* GOp, Handle* AOp, const float* ProcID, const float* SetValue,
                     const double* SetDvalue, bool* Inhib, void* InhibSetValue,
                     const TypeDesc* InhibSetValueType, const float*) {
    TriggerDefinition trigger;
    if (const Status status = setPlace(task, trigger, {Distance, Start, Next, false, EquipLag}))
        return status;
    return defineOutput(
        task, TriggData, trigger,
        {DOp, GOp, AOp, ProcID, SetValue, SetDvalue, Inhib, InhibSetValue, InhibSetValueType});
}

Status rt_TriggRampAO(TaskCore* task, Handle* TriggData, float Distance, bool Start, bool Next,
                      float EquipLag, Handle* AOutput, float SetValue, float RampLength, bool Time,
                      bool* Inhib, void* InhibSetValue, const TypeDesc* InhibSetValueType, const float*) {
    TriggerDefinition trigger;
    trigger.kind = TriggerDefinition::Kind::Ramp;
    if (!(RampLength >= 0) || !std::isfinite(RampLength))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the length of a ramp must be in mm (in s with \\Time), not negative");
    trigger.rampLength = RampLength;
    trigger.rampInTime = Time;
    if (const Status status = setPlace(task, trigger, {Distance, Start, Next, false, EquipLag}))
        return status;
    return defineOutput(
        task, TriggData, trigger,
        {nullptr, nullptr, AOutput, nullptr, &SetValue, nullptr, Inhib, InhibSetValue, InhibSetValueType});
}

Status rt_TriggSpeed(TaskCore* task, Handle* TriggData, float Distance, bool Start, bool Next, float ScaleLag,
                     Handle* AOp, float ScaleValue, const float* DipLag, Handle* ErrDO, bool* Inhib,
                     void* InhibSetValue, const TypeDesc* InhibSetValueType, const float*) {
    TriggerDefinition trigger;
    trigger.kind = TriggerDefinition::Kind::Speed;
    if (const Status status = setPlace(task, trigger, {Distance, Start, Next, false, ScaleLag}))
        return status;
    if (ScaleLag < kLongestExtension)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "a negative ScaleLag keeps the output for at most 0.1 s after the place");
    if (!std::isfinite(ScaleValue))
        return lib::fail(task, err::ERR_ARGVALERR, "the scale of an output must be a number");
    if (DipLag != nullptr && (!(*DipLag >= 0) || !std::isfinite(*DipLag)))
        return lib::fail(task, err::ERR_DIPLAG_LIM, "\\DipLag must be a time in s, not negative");
    const IoSystem& io = taskOf(task).controller().io();
    Status status = kOk;
    const SignalId output = lib::signalOf(task, *AOp, status);
    if (status != kOk) return status;
    const double possible = std::clamp(0.0, io.config(output).minValue, io.config(output).maxValue);
    if (const IoResult result = io.check(*AOp, possible, true); result != IoResult::Ok)
        return lib::ioStatus(task, result, *AOp);
    if (ErrDO != nullptr)
        if (const IoResult result = io.check(*ErrDO, 1, true); result != IoResult::Ok)
            return lib::ioStatus(task, result, *ErrDO);
    trigger.signal = *AOp;
    trigger.value = ScaleValue;
    trigger.dipLag = DipLag != nullptr ? *DipLag : 0;
    trigger.errorSignal = ErrDO != nullptr ? *ErrDO : 0;
    trigger.inhibit = Inhib;
    trigger.inhibitValue = InhibSetValue;
    trigger.inhibitType = InhibSetValue != nullptr ? InhibSetValueType : nullptr;
    return define(task, TriggData, trigger);
}

Status rt_TriggInt(TaskCore* task, Handle* TriggData, float Distance, bool Start, bool Next, bool Time,
                   float* Interrupt, bool* Inhib, const float*) {
    TriggerDefinition trigger;
    trigger.kind = TriggerDefinition::Kind::Interrupt;
    trigger.inhibit = Inhib;
    if (const Status status = setPlace(task, trigger, {Distance, Start, Next, Time, 0})) return status;
    if (const Status status = orderByPlace(task, Interrupt, trigger)) return status;
    return define(task, TriggData, trigger);
}

Status rt_TriggCheckIO(TaskCore* task, Handle* TriggData, float Distance, bool Start, bool Next, bool Time,
                       void* Signal, const TypeDesc*, float Relation, const float* CheckValue,
                       const double* CheckDvalue, bool StopMove, float* Interrupt, bool* Inhib,
                       const float*) {
    TriggerDefinition trigger;
    trigger.kind = TriggerDefinition::Kind::Check;
    trigger.signal = *static_cast<const Handle*>(Signal);
    trigger.value = CheckValue != nullptr ? static_cast<double>(*CheckValue) : *CheckDvalue;
    trigger.relation = Relation;
    trigger.stopMove = StopMove;
    trigger.inhibit = Inhib;
    if (const Status status = setPlace(task, trigger, {Distance, Start, Next, Time, 0})) return status;
    if (!lib::related(0.0, Relation, 0.0)) return lib::fail(task, err::ERR_ARGVALERR, lib::kRelationNames);
    const IoResult limits = taskOf(task).controller().io().check(trigger.signal, trigger.value, false);
    if (limits != IoResult::Ok) return lib::ioStatus(task, limits, trigger.signal);
    if (const Status status = orderByPlace(task, Interrupt, trigger)) return status;
    return define(task, TriggData, trigger);
}

Status rt_TriggDataCopy(TaskCore*, Handle* Source, Handle* Destination) {
    *Destination = *Source;
    return kOk;
}

Status rt_TriggDataReset(TaskCore*, Handle* TriggData) {
    *TriggData = 0;
    return kOk;
}

Status rt_TriggDataValid(TaskCore* task, bool* result, Handle* TriggData) {
    *result = lib::triggerStore(task).find(*TriggData) != nullptr;
    return kOk;
}
}

// Manual 1.8: movements with triggers.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/motion/triggers.h"
#include "stdlib/impl/strings/digits.h"
#include "stdlib/impl/support/fail.h"

#include "natives/trigger_moves.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>

using namespace rt;
using Actions = std::vector<PathAction>;

namespace {

constexpr int kMostTriggers = 25; // in a triggdata array

/// The triggers of TriggL and its like: Trigg_1 and \T2 to \T8, or an array.
struct TriggerArguments {
    const Handle* first;
    const Handle* array;
    int32_t arraySize;
    std::array<const Handle*, 7> others;
};

/// Event Preset Time of MOC.cfg in s: how long before its place the robot knows of an event. None: without a limit.
std::optional<double> eventPresetTime(const Controller& controller) {
    double time = 0;
    for (const char* type : {"MOTION_SYSTEM", "MOTION_PLANNER"})
        for (const CfgInstance* instance : controller.instances("MOC", type))
            if (instance->number("event_preset_time", time)) return time;
    return {};
}

Status checkLag(TaskCore* task, double lag) {
    if (lag == 0) return kOk;
    const std::optional<double> preset = eventPresetTime(taskOf(task).controller());
    if (!preset || lag <= *preset) return kOk;
    return lib::failWith(
        task, err::ERR_DIPLAG_LIM,
        "\\DipLag of TriggSpeed is {} s, but event_preset_time of MOC.cfg is {} s: enlarge it", lag, *preset);
}

/// Its signal can be used, and the output of a TriggSpeed can follow the programmed speed.
Status checkSignal(TaskCore* task, const lib::TriggerDefinition& trigger, const data::Speeddata& speed) {
    Status status = kOk;
    if (trigger.signal != 0) (void)lib::usableSignal(task, trigger.signal, status);
    if (status != kOk || trigger.kind != lib::TriggerDefinition::Kind::Speed) return status;
    if ((status = checkLag(task, trigger.dipLag)) != kOk) return status;
    // As a num: 0.1 times 100 is 10.
    return lib::checkOutput(task, trigger.signal, static_cast<float>(trigger.value) * speed.v_tcp);
}

Status addTrigger(TaskCore* task, Handle variable, const char* name, const data::Speeddata& speed,
                  Actions& actions) {
    const lib::TriggerDefinition* definition = lib::triggerStore(task).find(variable);
    if (definition == nullptr)
        return lib::fail(
            task, err::ERR_ARGVALERR,
            fmt::format("the trigger of argument {} has no contents; define it with TriggIO, TriggEquip, "
                        "TriggSpeed, TriggRampAO, TriggInt or TriggCheckIO first",
                        name));
    if (const Status status = checkSignal(task, *definition, speed)) return status;
    lib::addActions(task, *definition, actions);
    return kOk;
}

/// Elements without contents are skipped.
Status addArray(TaskCore* task, const TriggerArguments& args, const data::Speeddata& speed,
                Actions& actions) {
    for (const Handle* other : args.others)
        if (other != nullptr)
            return lib::fail(task, err::ERR_ARGVALERR,
                             "\\T2 to \\T8 cannot be combined with an array of triggers");
    int count = 0;
    for (int32_t i = 0; i < args.arraySize; ++i) {
        const lib::TriggerDefinition* definition = lib::triggerStore(task).find(args.array[i]);
        if (definition == nullptr) continue;
        if (const Status status = checkSignal(task, *definition, speed)) return status;
        lib::addActions(task, *definition, actions);
        ++count;
    }
    if (count <= kMostTriggers) return kOk;
    return lib::fail(
        task, err::ERR_ARGVALERR,
        fmt::format("the array has {} triggers; a movement takes at most {}", count, kMostTriggers));
}

Status collect(TaskCore* task, const TriggerArguments& args, const data::Speeddata& speed, Actions& actions) {
    static constexpr std::array<const char*, 7> kNames{"\\T2", "\\T3", "\\T4", "\\T5",
                                                       "\\T6", "\\T7", "\\T8"};
    if (args.first == nullptr) return addArray(task, args, speed, actions);
    if (const Status status = addTrigger(task, *args.first, "Trigg_1", speed, actions)) return status;
    for (std::size_t i = 0; i < args.others.size(); ++i) {
        if (args.others[i] == nullptr) continue;
        if (const Status status = addTrigger(task, *args.others[i], kNames[i], speed, actions)) return status;
    }
    return kOk;
}

Status moveWithTriggers(TaskCore* task, motion::MoveCommand command, const lib::MoveArguments& arguments,
                        const TriggerArguments& triggers) {
    Actions actions;
    if (const Status status = collect(task, triggers, *arguments.speed, actions)) return status;
    return lib::orderMove(task, std::move(command), arguments, std::move(actions));
}

/// One element of the arrays of TriggLIOs and TriggJIOs.
struct NamedOutput {
    float distance;
    bool start;
    float lag;
    std::string_view signal;
    double value;
};

Status addOutput(TaskCore* task, const NamedOutput& output, Actions& actions) {
    const IoSystem& io = taskOf(task).controller().io();
    const SignalId id = io.find(output.signal);
    if (id < 0)
        return lib::fail(task, err::ERR_SIG_NAME,
                         fmt::format("there is no signal named \"{}\"", output.signal));
    if (const Status status = lib::checkDistance(task, output.distance)) return status;
    if (!std::isfinite(output.lag))
        return lib::fail(task, err::ERR_ARGVALERR, "equiplag must be a number of seconds");
    lib::TriggerDefinition trigger;
    trigger.signal = IoSystem::handleOf(id);
    trigger.value = output.value;
    trigger.place.amount = output.distance;
    trigger.place.fromStart = output.start;
    trigger.place.lag = output.lag;
    if (const Status status = lib::checkOutputNow(task, trigger.signal, trigger.value)) return status;
    lib::addActions(task, trigger, actions);
    return kOk;
}

/// Adds the elements in use; `valueOf` gives the value of one, or raises an error.
template <class Element, class Value>
Status addElements(TaskCore* task, const Element* elements, int32_t count, Actions& actions, Value valueOf) {
    for (int32_t i = 0; elements != nullptr && i < count; ++i) {
        const Element& e = elements[i];
        if (!e.used) continue;
        double value = 0;
        if (const Status status = valueOf(e, value)) return status;
        const NamedOutput output{e.distance, e.start, e.equiplag, e.signalname.view(), value};
        if (const Status status = addOutput(task, output, actions)) return status;
    }
    return kOk;
}

struct OutputArrays {
    const data::Triggios* numbers;
    int32_t numberCount;
    const data::Triggstrgo* digits;
    int32_t digitCount;
    const data::Triggiosdnum* dnums;
    int32_t dnumCount;
};

Status collect(TaskCore* task, const OutputArrays& arrays, Actions& actions) {
    const auto number = [](const data::Triggios& e, double& value) {
        value = e.setvalue;
        return kOk;
    };
    const auto digits = [task](const data::Triggstrgo& e, double& value) {
        uint64_t whole = 0;
        if (!lib::readDigits(e.setvalue.view(), 10, lib::kLargestDigitString, whole))
            return lib::fail(task, err::ERR_INT_NOTVAL,
                             "setvalue must be digits of a number from 0 to 4294967295");
        value = static_cast<double>(whole);
        return kOk;
    };
    // The record has room for both: setdvalue is for what a num cannot hold.
    const auto dnum = [](const data::Triggiosdnum& e, double& value) {
        value = e.setdvalue != 0 ? e.setdvalue : static_cast<double>(e.setvalue);
        return kOk;
    };
    if (const Status status = addElements(task, arrays.numbers, arrays.numberCount, actions, number))
        return status;
    if (const Status status = addElements(task, arrays.digits, arrays.digitCount, actions, digits))
        return status;
    return addElements(task, arrays.dnums, arrays.dnumCount, actions, dnum);
}

Status moveWithOutputs(TaskCore* task, motion::MoveCommand command, const lib::MoveArguments& arguments,
                       const OutputArrays& arrays) {
    Actions actions;
    if (const Status status = collect(task, arrays, actions)) return status;
    return lib::orderMove(task, std::move(command), arguments, std::move(actions));
}

lib::MoveArguments arguments(bool conc, const data::Speeddata* speed, const float* t,
                             const data::Zonedata* zone, const data::Stoppointdata* inpos,
                             const data::Tooldata* tool, const data::Wobjdata* workObject,
                             const data::Loaddata* totalLoad) {
    return {conc, speed, nullptr, t, zone, nullptr, inpos, tool, workObject, false, totalLoad};
}

} // namespace

extern "C" {

Status rt_TriggL(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                 const data::Speeddata* Speed, const float* T, Handle* Trigg_1, Handle* TriggArray,
                 int32_t TriggArrayDim1, Handle* T2, Handle* T3, Handle* T4, Handle* T5, Handle* T6,
                 Handle* T7, Handle* T8, const data::Zonedata* Zone, const data::Stoppointdata* Inpos,
                 data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr, data::Loaddata* TLoad) {
    return moveWithTriggers(task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),
                            arguments(Conc, Speed, T, Zone, Inpos, Tool, WObj, TLoad),
                            {Trigg_1, TriggArray, TriggArrayDim1, {T2, T3, T4, T5, T6, T7, T8}});
}

Status rt_TriggJ(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                 const data::Speeddata* Speed, const float* T, Handle* Trigg_1, Handle* TriggArray,
                 int32_t TriggArrayDim1, Handle* T2, Handle* T3, Handle* T4, Handle* T5, Handle* T6,
                 Handle* T7, Handle* T8, const data::Zonedata* Zone, const data::Stoppointdata* Inpos,
                 data::Tooldata* Tool, data::Wobjdata* WObj, data::Loaddata* TLoad) {
    return moveWithTriggers(task, lib::jointMove(task, *ToPoint, ID),
                            arguments(Conc, Speed, T, Zone, Inpos, Tool, WObj, TLoad),
                            {Trigg_1, TriggArray, TriggArrayDim1, {T2, T3, T4, T5, T6, T7, T8}});
}

Status rt_TriggC(TaskCore* task, bool Conc, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                 const float* ID, const data::Speeddata* Speed, const float* T, Handle* Trigg_1,
                 Handle* TriggArray, int32_t TriggArrayDim1, Handle* T2, Handle* T3, Handle* T4, Handle* T5,
                 Handle* T6, Handle* T7, Handle* T8, const data::Zonedata* Zone,
                 const data::Stoppointdata* Inpos, data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr,
                 data::Loaddata* TLoad) {
    return moveWithTriggers(task,
                            lib::corrected(task, lib::circularMove(task, *CirPoint, *ToPoint, ID), Corr),
                            arguments(Conc, Speed, T, Zone, Inpos, Tool, WObj, TLoad),
                            {Trigg_1, TriggArray, TriggArrayDim1, {T2, T3, T4, T5, T6, T7, T8}});
}

Status rt_TriggAbsJ(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float* ID,
                    bool NoEOffs, const data::Speeddata* Speed, const float* T, Handle* Trigg_1,
                    Handle* TriggArray, int32_t TriggArrayDim1, Handle* T2, Handle* T3, Handle* T4,
                    Handle* T5, Handle* T6, Handle* T7, Handle* T8, const data::Zonedata* Zone,
                    const data::Stoppointdata* Inpos, data::Tooldata* Tool, data::Wobjdata* WObj,
                    data::Loaddata* TLoad) {
    return moveWithTriggers(task, lib::absoluteMove(task, *ToJointPos, NoEOffs, ID),
                            arguments(Conc, Speed, T, Zone, Inpos, Tool, WObj, TLoad),
                            {Trigg_1, TriggArray, TriggArrayDim1, {T2, T3, T4, T5, T6, T7, T8}});
}

Status rt_TriggLIOs(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                    const data::Speeddata* Speed, const float* T, const data::Triggios* TriggData1,
                    int32_t TriggData1Dim1, const data::Triggstrgo* TriggData2, int32_t TriggData2Dim1,
                    const data::Triggiosdnum* TriggData3, int32_t TriggData3Dim1, const data::Zonedata* Zone,
                    const data::Stoppointdata* Inpos, data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr,
                    data::Loaddata* TLoad) {
    return moveWithOutputs(
        task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),
        arguments(Conc, Speed, T, Zone, Inpos, Tool, WObj, TLoad),
        {TriggData1, TriggData1Dim1, TriggData2, TriggData2Dim1, TriggData3, TriggData3Dim1});
}

Status rt_TriggJIOs(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                    const data::Speeddata* Speed, const float* T, const data::Triggios* TriggData1,
                    int32_t TriggData1Dim1, const data::Triggstrgo* TriggData2, int32_t TriggData2Dim1,
                    const data::Triggiosdnum* TriggData3, int32_t TriggData3Dim1, const data::Zonedata* Zone,
                    const data::Stoppointdata* Inpos, data::Tooldata* Tool, data::Wobjdata* WObj,
                    data::Loaddata* TLoad) {
    return moveWithOutputs(
        task, lib::jointMove(task, *ToPoint, ID), arguments(Conc, Speed, T, Zone, Inpos, Tool, WObj, TLoad),
        {TriggData1, TriggData1Dim1, TriggData2, TriggData2Dim1, TriggData3, TriggData3Dim1});
}
}

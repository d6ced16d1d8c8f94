// Manual 1.8: movements that set an output in the middle of the corner path of their point; at a stop point, when it is
// reached. Executed backwards they set nothing.

#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/motion/triggers.h"
#include "stdlib/impl/support/fail.h"

#include "natives/move.h"
#include "stdlib_constants.h"

#include <utility>

using namespace rt;

namespace {

/// The value is checked before the movement is ordered: an error leaves robot and output as they are.
Status moveAndSet(TaskCore* task, motion::MoveCommand command, const lib::MoveArguments& arguments,
                  Handle signal, double value) {
    if (const Status status = lib::checkOutputNow(task, signal, value)) return status;
    lib::TriggerDefinition atPoint; // 0 mm before the end of the movement
    atPoint.signal = signal;
    atPoint.value = value;
    std::vector<PathAction> actions;
    lib::addActions(task, atPoint, actions);
    return lib::orderMove(task, std::move(command), arguments, std::move(actions));
}

/// The arguments of a group output: exactly one of \Value and \DValue.
Status moveAndSetGroup(TaskCore* task, motion::MoveCommand command, const lib::MoveArguments& arguments,
                       Handle signal, const float* num, const double* dnum) {
    if (num == nullptr && dnum == nullptr)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the group output needs a value: one of \\Value and \\DValue");
    return moveAndSet(task, std::move(command), arguments, signal,
                      num != nullptr ? static_cast<double>(*num) : *dnum);
}

} // namespace

extern "C" {

Status rt_MoveLDO(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                  const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, float Value,
                  data::Loaddata* TLoad) {
    return moveAndSet(task, lib::linearMove(task, *ToPoint, ID),
                      lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value);
}

Status rt_MoveJDO(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                  const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, float Value,
                  data::Loaddata* TLoad) {
    return moveAndSet(task, lib::jointMove(task, *ToPoint, ID),
                      lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value);
}

Status rt_MoveCDO(TaskCore* task, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                  const float* ID, const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, float Value,
                  data::Loaddata* TLoad) {
    return moveAndSet(task, lib::circularMove(task, *CirPoint, *ToPoint, ID),
                      lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value);
}

Status rt_MoveLAO(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                  const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, float Value,
                  data::Loaddata* TLoad) {
    return moveAndSet(task, lib::linearMove(task, *ToPoint, ID),
                      lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value);
}

Status rt_MoveJAO(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                  const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, float Value,
                  data::Loaddata* TLoad) {
    return moveAndSet(task, lib::jointMove(task, *ToPoint, ID),
                      lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value);
}

Status rt_MoveCAO(TaskCore* task, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                  const float* ID, const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, float Value,
                  data::Loaddata* TLoad) {
    return moveAndSet(task, lib::circularMove(task, *CirPoint, *ToPoint, ID),
                      lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value);
}

Status rt_MoveLGO(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                  const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, const float* Value,
                  const double* DValue, data::Loaddata* TLoad) {
    return moveAndSetGroup(task, lib::linearMove(task, *ToPoint, ID),
                           lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value, DValue);
}

Status rt_MoveJGO(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,
                  const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, const float* Value,
                  const double* DValue, data::Loaddata* TLoad) {
    return moveAndSetGroup(task, lib::jointMove(task, *ToPoint, ID),
                           lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value, DValue);
}

Status rt_MoveCGO(TaskCore* task, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                  const float* ID, const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                  data::Tooldata* Tool, data::Wobjdata* WObj, Handle* Signal, const float* Value,
                  const double* DValue, data::Loaddata* TLoad) {
    return moveAndSetGroup(task, lib::circularMove(task, *CirPoint, *ToPoint, ID),
                           lib::plainArguments(Speed, T, Zone, Tool, WObj, TLoad), *Signal, Value, DValue);
}
}

// Manual 1.8: movements that search for the place at which a signal or a persistent changes.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/motion/search.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/finite.h"

#include "natives/search.h"
#include "stdlib_constants.h"

#include <memory>
#include <utility>

using namespace rt;

namespace {

/// The switches of a search instruction, as they are written.
struct SearchSwitches {
    bool stop, pStop, sStop, sup;
    bool flanks, posFlank, negFlank, highLevel, lowLevel;
};

/// Without a switch for the flank: as \HighLevel.
lib::SearchConditions conditionsOf(const SearchSwitches& given) {
    lib::SearchConditions conditions;
    conditions.rising = !given.negFlank && !given.lowLevel;
    conditions.falling = given.flanks || given.negFlank || given.lowLevel;
    if (given.lowLevel) conditions.activeLevel = false;
    if (!given.flanks && !given.posFlank && !given.negFlank && !given.lowLevel) conditions.activeLevel = true;
    conditions.stops = given.stop || given.pStop || given.sStop;
    if (given.stop) conditions.stop = BreakOff::Stiff;
    if (given.sStop) conditions.stop = BreakOff::QuicklyOnPath;
    return conditions;
}

struct SearchArguments {
    SearchSwitches switches;
    const Handle* signal;
    const bool* persistent;
};

/// The value searched for at the beginning, or several hits.
Status failSupervision(TaskCore* task, const SearchArguments& args, std::string_view text) {
    return lib::fail(task, args.persistent != nullptr ? err::ERR_PERSSUPSEARCH : err::ERR_SIGSUPSEARCH, text);
}

/// Moves and searches; `place` gets the axes at the first hit, nothing when the instruction is executed backwards.
/// Positive: the robot is at the end of the movement, or at rest where it was stopped.
Status search(TaskCore* task, motion::MoveCommand command, const SearchArguments& args,
              const lib::MoveArguments& move, std::optional<motion::JointTarget>& place) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Task& owner = taskOf(task);
    MotionDriver& driver = owner.controller().motion(owner);
    lib::SearchSource source{-1, args.persistent};
    Status status = kOk;
    if (args.persistent == nullptr) source.signal = lib::usableSignal(task, *args.signal, status);
    if (status != kOk) return status;
    if (driver.isBackward()) return lib::orderMove(task, std::move(command), move);
    const auto watch = std::make_shared<lib::Search>(owner, conditionsOf(args.switches), source);
    if (driver.continuesMovement(owner)) watch->watch();
    PathAction start;
    start.place.fromStart = true;
    start.act = [watch] { watch->begin(); };
    status = lib::orderMove(task, std::move(command), move, {std::move(start)});
    watch->end();
    if (status == kOk && watch->wasBrokenOff()) status = driver.waitZeroSpeed(owner);
    if (status != kOk) return status;
    if (watch->wasActive())
        return failSupervision(
            task, args,
            "the signal or persistent had the value searched for already when the movement began");
    if (watch->hits() == 0)
        return lib::fail(task, err::ERR_WHLSEARCH,
                         "the signal or persistent did not change during the movement");
    if (watch->hits() > 1 && args.switches.sup)
        return failSupervision(task, args,
                               "the signal or persistent changed more than once during the movement");
    place = watch->place();
    return kOk;
}

/// A search ends at a stop point.
const data::Zonedata& fine() {
    static const data::Zonedata kFine{true, 0, 0, 0, 0, 0, 0};
    return kFine;
}

lib::MoveArguments moveArguments(const data::Speeddata* speed, const float* v, const float* t,
                                 const data::Tooldata* tool, const data::Wobjdata* workObject,
                                 const data::Loaddata* totalLoad = nullptr) {
    return {false, speed, v, t, &fine(), nullptr, nullptr, tool, workObject, false, totalLoad};
}

/// The TCP as the instruction would program it: in its work object, with displacement and axis offsets in force.
Status giveTarget(TaskCore* task, const motion::JointTarget& place, const lib::MoveArguments& move,
                  data::Robtarget* result) {
    const lib::MotionState& state = lib::motionState(task);
    const data::Wobjdata world = lib::MotionState().workObject;
    motion::FrameSetup frames;
    if (const Status status =
            lib::frameSetup(task, move.tool, move.workObject != nullptr ? move.workObject : &world, frames))
        return status;
    const motion::MotionSystem& system = lib::motionSystemOf(task);
    motion::RobTarget target = system.toRobTarget(place, frames);
    lib::addOffsets(target.extax, state.axisOffsets, -1);
    return lib::give(task, result, lib::toRobtarget(target, system.kinematics()));
}

Status searchTarget(TaskCore* task, motion::MoveCommand command, const SearchArguments& args,
                    const lib::MoveArguments& move, data::Robtarget* result) {
    std::optional<motion::JointTarget> place;
    if (const Status status = search(task, std::move(command), args, move, place)) return status;
    return place ? giveTarget(task, *place, move, result) : kOk;
}

/// `offsets`: of the additional axes, in force for the movement.
Status searchJoints(TaskCore* task, motion::MoveCommand command, const SearchArguments& args,
                    const lib::MoveArguments& move, bool offsets, data::Jointtarget* result) {
    std::optional<motion::JointTarget> place;
    if (const Status status = search(task, std::move(command), args, move, place)) return status;
    if (!place) return kOk;
    if (offsets) lib::addOffsets(place->extax, lib::motionState(task).axisOffsets, -1);
    const robot::Kinematics& arm = lib::motionSystemOf(task).kinematics();
    return lib::give(task, result, lib::toJointtarget(*place, arm));
}

} // namespace

extern "C" {

Status rt_SearchL(TaskCore* task, bool Stop, bool PStop, bool SStop, bool Sup, Handle* Signal, bool* PersBool,
                  bool Flanks, bool PosFlank, bool NegFlank, bool HighLevel, bool LowLevel,
                  data::Robtarget* SearchPoint, const data::Robtarget* ToPoint, const float* ID,
                  const data::Speeddata* Speed, const float* V, const float* T, data::Tooldata* Tool,
                  data::Wobjdata* WObj, bool Corr, data::Loaddata* TLoad) {
    return searchTarget(
        task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),
        {{Stop, PStop, SStop, Sup, Flanks, PosFlank, NegFlank, HighLevel, LowLevel}, Signal, PersBool},
        moveArguments(Speed, V, T, Tool, WObj, TLoad), SearchPoint);
}

Status rt_SearchC(TaskCore* task, bool Stop, bool PStop, bool SStop, bool Sup, Handle* Signal, bool* PersBool,
                  bool Flanks, bool PosFlank, bool NegFlank, bool HighLevel, bool LowLevel,
                  data::Robtarget* SearchPoint, const data::Robtarget* CirPoint,
                  const data::Robtarget* ToPoint, const float* ID, const data::Speeddata* Speed,
                  const float* V, const float* T, data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr,
                  data::Loaddata* TLoad) {
    return searchTarget(
        task, lib::corrected(task, lib::circularMove(task, *CirPoint, *ToPoint, ID), Corr),
        {{Stop, PStop, SStop, Sup, Flanks, PosFlank, NegFlank, HighLevel, LowLevel}, Signal, PersBool},
        moveArguments(Speed, V, T, Tool, WObj, TLoad), SearchPoint);
}

Status rt_SearchJ(TaskCore* task, bool Stop, bool PStop, bool SStop, bool Sup, Handle* Signal, bool* PersBool,
                  bool Flanks, bool PosFlank, bool NegFlank, bool HighLevel, bool LowLevel,
                  data::Jointtarget* SearchJointPos, data::Robtarget* SearchPoint,
                  const data::Robtarget* ToPoint, const data::Jointtarget* ToJointPos, const float* ID,
                  const data::Speeddata* Speed, const float* V, const float* T, data::Tooldata* Tool,
                  data::Wobjdata* WObj, data::Loaddata* TLoad) {
    const SearchArguments args{
        {Stop, PStop, SStop, Sup, Flanks, PosFlank, NegFlank, HighLevel, LowLevel}, Signal, PersBool};
    const lib::MoveArguments move = moveArguments(Speed, V, T, Tool, WObj, TLoad);
    motion::MoveCommand command = ToPoint != nullptr ? lib::jointMove(task, *ToPoint, ID)
                                                     : lib::absoluteMove(task, *ToJointPos, false, ID);
    if (SearchPoint != nullptr) return searchTarget(task, std::move(command), args, move, SearchPoint);
    return searchJoints(task, std::move(command), args, move, true, SearchJointPos);
}

Status rt_SearchExtJ(TaskCore* task, bool Stop, bool PStop, bool SStop, bool Sup, Handle* Signal,
                     bool* PersBool, bool Flanks, bool PosFlank, bool NegFlank, bool HighLevel, bool LowLevel,
                     data::Jointtarget* SearchJointPos, const data::Jointtarget* ToJointPos, const float* ID,
                     bool UseEOffs, const data::Speeddata* Speed, const float* T) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    const lib::MotionState& state = lib::motionState(task);
    const data::Tooldata tool = state.tool;
    const data::Wobjdata workObject = state.workObject;
    return searchJoints(
        task, lib::externalMove(task, *ToJointPos, UseEOffs, ID),
        {{Stop, PStop, SStop, Sup, Flanks, PosFlank, NegFlank, HighLevel, LowLevel}, Signal, PersBool},
        moveArguments(Speed, nullptr, T, &tool, &workObject), UseEOffs, SearchJointPos);
}
}

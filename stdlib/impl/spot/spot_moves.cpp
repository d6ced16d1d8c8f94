// SpotL, SpotJ, SpotML, SpotMJ, CalibL, CalibJ: a movement to a stop point, and what guns do there.

#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/spot/gun_orders.h"
#include "stdlib/impl/spot/spot_gun.h"
#include "stdlib/impl/support/fail.h"

#include "natives/spot.h"
#include "stdlib_constants.h"

#include <cmath>
#include <utility>
#include <vector>

using namespace rt;
using lib::SpotGun;

namespace {

/// The arguments of the movement.
struct SpotMove {
    const data::Speeddata* speed;
    const data::Tooldata* tool;
    const data::Wobjdata* workObject;
    const data::Loaddata* totalLoad;
};

/// A weld of one gun.
struct Weld {
    SpotGun* gun;
    const data::Spotdata* spot;
    data::Gundata* data; ///< null: not given
};

struct SpotSwitches {
    bool inPos, openLift, closeLift, quickRelease;
};

constexpr data::Zonedata kStopPoint{true, 0, 0, 0, 0, 0, 0};

Status moveTo(TaskCore* task, motion::MoveCommand command, const SpotMove& move,
              std::vector<PathAction> actions) {
    lib::MoveArguments arguments;
    arguments.speed = move.speed;
    arguments.zone = &kStopPoint;
    arguments.tool = move.tool;
    arguments.workObject = move.workObject;
    arguments.totalLoad = move.totalLoad;
    return lib::orderMove(task, std::move(command), arguments, std::move(actions));
}

PathAction beforeEnd(double seconds, std::function<void()> act) {
    PathAction action;
    action.place.inTime = true;
    action.place.amount = seconds;
    action.act = std::move(act);
    return action;
}

PathAction atStart(std::function<void()> act) {
    PathAction action;
    action.place.fromStart = true;
    action.act = std::move(act);
    return action;
}

Status checkWeld(TaskCore* task, const Weld& weld) {
    if (!(weld.spot->tip_force >= 0) || !(weld.spot->prog_no >= 0))
        return lib::fail(task, err::ERR_ARGVALERR, "prog_no and tip_force of spotdata must not be negative");
    if (weld.data == nullptr) return kOk;
    for (const float time : {weld.data->pre_close_time, weld.data->pre_equ_time, weld.data->weld_timeout})
        if (!(time >= 0 && std::isfinite(time)))
            return lib::fail(task, err::ERR_ARGVALERR,
                             "the times of gundata must be numbers of seconds from 0 on");
    return kOk;
}

/// The guns on the way: program, high lift, and closing early.
std::vector<PathAction> onTheWay(Controller& controller, const std::vector<Weld>& welds,
                                 const SpotSwitches& how) {
    std::vector<PathAction> actions;
    for (const Weld& weld : welds) {
        SpotGun* gun = weld.gun;
        actions.push_back(atStart([gun, spot = weld.spot, how] {
            gun->weldError(false);
            gun->select(spot->prog_no, spot->tip_force);
            if (how.openLift || how.closeLift) gun->highLift(how.openLift);
        }));
        if (weld.data == nullptr) continue;
        if (weld.data->pre_equ_time > 0)
            actions.push_back(beforeEnd(weld.data->pre_equ_time, [gun] { gun->equalise(true); }));
        if (weld.data->pre_close_time > 0 && !how.inPos)
            actions.push_back(beforeEnd(weld.data->pre_close_time,
                                        [gun, &controller] { gun->close(controller.scheduler().now()); }));
    }
    return actions;
}

/// With the robot at the point: all guns at the same time.
Status weldHere(TaskCore* task, const std::vector<Weld>& welds, bool quickRelease) {
    Task& owner = taskOf(task);
    Status status = kOk;
    const auto each = [&](auto action) {
        for (const Weld& weld : welds)
            if (status == kOk) status = action(weld);
    };
    for (const Weld& weld : welds) {
        weld.gun->weldError(false);
        weld.gun->select(weld.spot->prog_no, weld.spot->tip_force); // also when RETRY has nothing to move
        weld.gun->equalise(true);
        weld.gun->close(owner.now());
    }
    each([&](const Weld& weld) { return weld.gun->waitClosed(task); });
    each([&](const Weld& weld) { return weld.gun->checkReady(task); });
    if (status == kOk)
        for (const Weld& weld : welds)
            weld.gun->startWeld(owner.now());
    each([&](const Weld& weld) {
        return weld.gun->waitWelded(task, weld.data != nullptr ? weld.data->weld_timeout : 0);
    });
    if (status == kOk)
        for (const Weld& weld : welds) {
            ++weld.gun->weldsSinceCalibration;
            if (weld.data != nullptr) ++weld.data->weld_counter;
            weld.gun->open(owner.now());
            weld.gun->equalise(false);
        }
    if (!quickRelease) each([&](const Weld& weld) { return weld.gun->waitOpen(task); });
    if (status == kOk) return kOk;
    for (const Weld& weld : welds) {
        weld.gun->abandon(owner.now());
        weld.gun->equalise(false);
    }
    return status;
}

Status spot(TaskCore* task, motion::MoveCommand command, const SpotMove& move, const std::vector<Weld>& welds,
            const SpotSwitches& how) {
    for (const Weld& weld : welds)
        if (const Status status = checkWeld(task, weld)) return status;
    lib::superviseGuns(task);
    std::vector<PathAction> actions = onTheWay(taskOf(task).controller(), welds, how);
    if (const Status status = moveTo(task, std::move(command), move, std::move(actions))) {
        for (const Weld& weld : welds)
            weld.gun->giveUpClosing();
        return status;
    }
    return weldHere(task, welds, how.quickRelease);
}

Status spotOne(TaskCore* task, motion::MoveCommand command, const SpotMove& move, const float* number,
               data::Gundata* data, const data::Spotdata* weld, const SpotSwitches& how) {
    Status status = kOk;
    SpotGun* gun = lib::spotGunOf(task, number, data, status);
    return gun == nullptr ? status : spot(task, std::move(command), move, {{gun, weld, data}}, how);
}

Status spotSeveral(TaskCore* task, motion::MoveCommand command, const SpotMove& move,
                   std::initializer_list<const data::Spotdata*> spots, const SpotSwitches& how) {
    std::vector<Weld> welds;
    Status status = kOk;
    float number = 0;
    for (const data::Spotdata* each : spots) {
        number += 1;
        if (each == nullptr) continue;
        SpotGun* gun = lib::spotGunOf(task, &number, nullptr, status);
        if (gun == nullptr) return status;
        welds.push_back({gun, each, nullptr});
    }
    if (welds.empty())
        return lib::fail(task, err::ERR_ARGVALERR, "no gun welds: give \\G1, \\G2, \\G3 or \\G4");
    return spot(task, std::move(command), move, welds, how);
}

Status calibrateAt(TaskCore* task, motion::MoveCommand command, const SpotMove& move, const float* number,
                   data::Gundata* data, lib::Calibration how) {
    Status status = kOk;
    SpotGun* gun = lib::spotGunOf(task, number, data, status);
    if (gun == nullptr) return status;
    if ((status = moveTo(task, std::move(command), move, {})) != kOk) return status;
    return lib::calibrateGun(task, *gun, data, how, nullptr);
}

} // namespace

// The instructions come in pairs that differ in the path alone.
#define SPOT_PATH(SUFFIX, MOVE)                                                                              \
    Status rt_Spot##SUFFIX(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,                  \
                           const data::Speeddata* Speed, const float* Gun, data::Gundata* GunData,           \
                           data::Spotdata* Spot, bool InPos, bool OpenHLift, bool CloseHLift,                \
                           bool QuickRelease, data::Tooldata* Tool, data::Wobjdata* WObj,                    \
                           data::Loaddata* TLoad) {                                                          \
        if (const Status status = lib::requireMotionTask(task)) return status;                               \
        return spotOne(task, lib::MOVE(task, *ToPoint, ID), {Speed, Tool, WObj, TLoad}, Gun, GunData, Spot,  \
                       {InPos, OpenHLift, CloseHLift, QuickRelease});                                        \
    }                                                                                                        \
    Status rt_SpotM##SUFFIX(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,                 \
                            const data::Speeddata* Speed, data::Spotdata* G1, data::Spotdata* G2,            \
                            data::Spotdata* G3, data::Spotdata* G4, bool InPos, bool OpenHLift,              \
                            bool CloseHLift, bool QuickRelease, data::Tooldata* Tool, data::Wobjdata* WObj,  \
                            data::Loaddata* TLoad) {                                                         \
        if (const Status status = lib::requireMotionTask(task)) return status;                               \
        return spotSeveral(task, lib::MOVE(task, *ToPoint, ID), {Speed, Tool, WObj, TLoad},                  \
                           {G1, G2, G3, G4}, {InPos, OpenHLift, CloseHLift, QuickRelease});                  \
    }                                                                                                        \
    Status rt_Calib##SUFFIX(TaskCore* task, const data::Robtarget* ToPoint, const float* ID,                 \
                            const data::Speeddata* Speed, const float* Gun, data::Gundata* GunData,          \
                            bool TipChg, bool TipWear, bool FirstCal, data::Tooldata* Tool,                  \
                            data::Wobjdata* WObj, data::Loaddata* TLoad) {                                   \
        if (const Status status = lib::requireMotionTask(task)) return status;                               \
        return calibrateAt(task, lib::MOVE(task, *ToPoint, ID), {Speed, Tool, WObj, TLoad}, Gun, GunData,    \
                           lib::calibrationOf(TipChg, TipWear, FirstCal));                                   \
    }

extern "C" {
SPOT_PATH(L, linearMove)
SPOT_PATH(J, jointMove)
}

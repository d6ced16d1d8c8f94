// Welds (ArcL, ArcC and their like): movements as MoveL and MoveC, with the speed of welddata and the process of ArcProcess.
// Weaving and \Corr displace the path of the seam; tracking does not.

#include "stdlib/impl/arc/arc_process.h"
#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/motion/triggers.h"
#include "stdlib/impl/support/fail.h"

#include "natives/arc.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

using namespace rt;
using lib::ArcProcess;

namespace {

/// The arguments of all weld instructions.
struct WeldArguments {
    int system;
    const data::Speeddata* speed;
    const float* v;
    data::Seamdata* seam;
    data::Welddata* weld;
    const data::Zonedata* zone;
    const float* z;
    const data::Tooldata* tool;
    const data::Wobjdata* workObject;
    const data::Weavedata* weave;
};
using Triggers = std::array<const Handle*, 7>;

lib::MoveArguments moveArguments(const WeldArguments& args, const data::Zonedata* zone) {
    return {false, args.speed, args.v, nullptr, zone, args.z, nullptr, args.tool, args.workObject};
}

/// The weld begins and ends at stop points.
data::Zonedata stopPoint(const data::Zonedata& zone) {
    data::Zonedata stop = zone;
    stop.finep = true;
    return stop;
}

Status addTriggers(TaskCore* task, const Triggers& triggers, std::vector<PathAction>& actions) {
    for (std::size_t i = 0; i < triggers.size(); ++i) {
        if (triggers[i] == nullptr) continue;
        const lib::TriggerDefinition* definition = lib::triggerStore(task).find(*triggers[i]);
        if (definition == nullptr)
            return lib::fail(
                task, err::ERR_ARGVALERR,
                fmt::format("the trigger of argument \\T{} has no contents; define it with TriggIO, "
                            "TriggEquip or TriggInt first",
                            i + 1));
        lib::addActions(task, *definition, actions);
    }
    return kOk;
}

/// ArcLStart: to the beginning of the seam with the speed of the movement; the gas flows before the robot is there.
Status startWeld(TaskCore* task, motion::MoveCommand command, const WeldArguments& args) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    ArcProcess& process = ArcProcess::of(task);
    if (const Status status = process.prepare(task, args.system, *args.seam, args.weld)) return status;
    PathAction gas;
    gas.place.inTime = true;
    gas.place.amount = process.gasTime();
    gas.act = [&process] { process.openGas(); };
    const data::Zonedata zone = stopPoint(*args.zone);
    if (const Status status = lib::orderMove(task, std::move(command), moveArguments(args, &zone), {gas})) {
        process.kill();
        return status;
    }
    return process.ignite(task, err::AW_START_ERR);
}

/// ArcL and ArcLEnd: along the seam.
Status weldOn(TaskCore* task, motion::MoveCommand command, const WeldArguments& args,
              const Triggers& triggers, bool isEnd) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    ArcProcess& process = ArcProcess::of(task);
    if (!process.isActive())
        return taskOf(task).fatal(static_cast<int>(EventId::ArcMisused),
                                  "No weld has been started. Begin the seam with ArcLStart or ArcCStart.");
    if (process.system() != args.system)
        return taskOf(task).fatal(
            static_cast<int>(EventId::ArcMisused),
            fmt::format("The seam was started with power source {}, and this instruction uses "
                        "power source {}. Use one for the whole seam.",
                        process.system(), args.system));
    const double speed = process.speed(*args.weld);
    if (!process.isInhibited() && !(speed > 0 && std::isfinite(speed)))
        return lib::fail(task, err::ERR_ARGVALERR, "weld_speed of welddata must be a speed above 0 mm/s");
    std::shared_ptr<const motion::Modification> weave;
    if (!process.isInhibited())
        if (const Status status = process.weave(task, args.weave, speed, isEnd, weave)) return status;
    if (weave != nullptr) command.modifications.push_back(weave);
    std::vector<PathAction> actions;
    if (const Status status = addTriggers(task, triggers, actions)) return status;
    if (const Status status = process.resume(task)) return status;
    data::Speeddata weldSpeed = *args.speed;
    weldSpeed.v_tcp = static_cast<float>(speed);
    const data::Zonedata zone = isEnd ? stopPoint(*args.zone) : *args.zone;
    lib::MoveArguments move = moveArguments(args, &zone);
    if (!process.isInhibited()) {
        move.speed = &weldSpeed;
        move.v = nullptr;
    }
    PathAction change;
    change.place.fromStart = true;
    change.act = [&process, weld = args.weld] { process.weldWith(weld); };
    actions.push_back(change);
    if (const Status status = lib::orderMove(task, std::move(command), move, std::move(actions))) {
        process.putOut(); // the robot will stand still
        return status;
    }
    return isEnd ? process.close(task, *args.seam) : kOk;
}

} // namespace

// The instructions for power source 1 (ArcL and ArcL1) and 2 (ArcL2), which differ in name and number only.
#define ARC_COMMON                                                                                           \
    const float *ID, const data::Speeddata *Speed, const float *V, data::Seamdata *Seam,                     \
        data::Welddata *Weld, data::Weavedata *Weave, const data::Zonedata *Zone, const float *Z,            \
        data::Tooldata *Tool, data::Wobjdata *WObj, data::Trackdata *, bool Corr
#define ARC_TRIGGERS Handle *T1, Handle *T2, Handle *T3, Handle *T4, Handle *T5, Handle *T6, Handle *T7
#define ARC_INSTRUCTIONS(SUFFIX, SYSTEM)                                                                     \
    Status rt_ArcL##SUFFIX##Start(TaskCore* task, const data::Robtarget* ToPoint, ARC_COMMON, bool,          \
                                  const String*, data::Loaddata*) {                                          \
        return startWeld(task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),              \
                         {SYSTEM, Speed, V, Seam, Weld, Zone, Z, Tool, WObj, Weave});                        \
    }                                                                                                        \
    Status rt_ArcC##SUFFIX##Start(TaskCore* task, const data::Robtarget* CirPoint,                           \
                                  const data::Robtarget* ToPoint, ARC_COMMON, bool, const String*,           \
                                  data::Loaddata*) {                                                         \
        return startWeld(task, lib::corrected(task, lib::circularMove(task, *CirPoint, *ToPoint, ID), Corr), \
                         {SYSTEM, Speed, V, Seam, Weld, Zone, Z, Tool, WObj, Weave});                        \
    }                                                                                                        \
    ARC_SEAM(SUFFIX, SYSTEM, , false)                                                                        \
    ARC_SEAM(SUFFIX, SYSTEM, End, true)
#define ARC_SEAM(SUFFIX, SYSTEM, END, IS_END)                                                                \
    Status rt_ArcL##SUFFIX##END(TaskCore* task, const data::Robtarget* ToPoint, ARC_COMMON, ARC_TRIGGERS,    \
                                data::Loaddata*) {                                                           \
        return weldOn(task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),                 \
                      {SYSTEM, Speed, V, Seam, Weld, Zone, Z, Tool, WObj, Weave},                            \
                      {T1, T2, T3, T4, T5, T6, T7}, IS_END);                                                 \
    }                                                                                                        \
    Status rt_ArcC##SUFFIX##END(TaskCore* task, const data::Robtarget* CirPoint,                             \
                                const data::Robtarget* ToPoint, ARC_COMMON, ARC_TRIGGERS, data::Loaddata*) { \
        return weldOn(task, lib::corrected(task, lib::circularMove(task, *CirPoint, *ToPoint, ID), Corr),    \
                      {SYSTEM, Speed, V, Seam, Weld, Zone, Z, Tool, WObj, Weave},                            \
                      {T1, T2, T3, T4, T5, T6, T7}, IS_END);                                                 \
    }

extern "C" {

ARC_INSTRUCTIONS(, 1)
ARC_INSTRUCTIONS(1, 1)
ARC_INSTRUCTIONS(2, 2)

/// The speed holds for the movements ordered from now on; settings of the arc change at once.
Status rt_ArcRefresh(TaskCore* task, const float* WeldSpeed, const float* WeaveWidth) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    if (WeldSpeed != nullptr && !(*WeldSpeed > 0 && std::isfinite(*WeldSpeed)))
        return lib::fail(task, err::ERR_ARGVALERR, "\\WeldSpeed must be a speed above 0 mm/s");
    if (WeaveWidth != nullptr && !(*WeaveWidth >= 0 && std::isfinite(*WeaveWidth)))
        return lib::fail(task, err::ERR_ARGVALERR, "\\WeaveWidth must be a width in mm from 0 on");
    return ArcProcess::of(task).refresh(task, WeldSpeed != nullptr ? *WeldSpeed : 0,
                                        WeaveWidth != nullptr ? std::optional<double>(*WeaveWidth)
                                                              : std::nullopt);
}

Status rt_ArcKill(TaskCore* task) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    ArcProcess::of(task).kill();
    return kOk;
}
}

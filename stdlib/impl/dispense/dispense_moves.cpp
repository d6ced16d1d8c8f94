// DispL and DispC: movements with a bead. \Corr changes the path as it does for MoveL.

#include "stdlib/impl/dispense/dispense_process.h"
#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/support/fail.h"

#include "natives/dispense.h"
#include "stdlib_constants.h"

#include <cmath>
#include <utility>
#include <vector>

using namespace rt;
using lib::DispenseProcess;

namespace {

struct DispenseArguments {
    bool on, off;
    const data::Speeddata* speed;
    data::Beaddata* bead;
    const float* distance;
    const data::Zonedata* zone;
    const data::Tooldata* tool;
    const data::Wobjdata* workObject;
    const data::Loaddata* totalLoad;
};

/// At the destination, or `distance` mm before it, and `early` s before that.
PathAction nearEnd(const float* distance, double early, std::function<void()> act) {
    PathAction action;
    action.place.amount = distance != nullptr && *distance > 0 ? *distance : 0;
    action.place.lag = early;
    if (distance != nullptr && *distance < 0) {
        action.place.nextMove = true;
        action.place.amount = -*distance;
    }
    action.act = std::move(act);
    return action;
}

Status dispense(TaskCore* task, motion::MoveCommand command, const DispenseArguments& args) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    DispenseProcess& process = DispenseProcess::of(task);
    if (!args.on && !process.isOrdered())
        return lib::fail(task, err::ERR_ARGVALERR,
                         "no bead has been begun: begin it with DispL \\On or DispC \\On");
    if (args.distance != nullptr && !std::isfinite(*args.distance))
        return lib::fail(task, err::ERR_ARGVALERR, "\\D must be a distance in mm");
    if (const Status status = process.prepare(task, *args.bead)) return status;
    if (const Status status = process.resume(task)) return status;
    const double speed = args.speed->v_tcp;
    std::vector<PathAction> actions;
    if (args.on) {
        actions.push_back(nearEnd(args.distance, process.onTime(),
                                  [&process, bead = args.bead, speed] { process.begin(*bead, speed); }));
    } else {
        PathAction change;
        change.place.fromStart = true;
        change.act = [&process, bead = args.bead, speed] { process.begin(*bead, speed); };
        actions.push_back(change);
    }
    if (args.off) actions.push_back(nearEnd(args.distance, process.offTime(), [&process] { process.end(); }));
    lib::MoveArguments move;
    move.speed = args.speed;
    move.zone = args.zone;
    move.tool = args.tool;
    move.workObject = args.workObject;
    move.totalLoad = args.totalLoad;
    process.setOrdered(!args.off);
    const Status status = lib::orderMove(task, std::move(command), move, std::move(actions));
    if (status != kOk) {
        process.interrupt();          // the robot is at rest
        process.setOrdered(!args.on); // executed again it is the same instruction
    }
    return status;
}

} // namespace

extern "C" {

Status rt_DispL(TaskCore* task, bool On, bool Off, const data::Robtarget* ToPoint, const float* ID,
                const data::Speeddata* Speed, data::Beaddata* Bead, const float* D,
                const data::Zonedata* Zone, data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr,
                data::Loaddata* TLoad) {
    return dispense(task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),
                    {On, Off, Speed, Bead, D, Zone, Tool, WObj, TLoad});
}

Status rt_DispC(TaskCore* task, bool On, bool Off, const data::Robtarget* CirPoint,
                const data::Robtarget* ToPoint, const float* ID, const data::Speeddata* Speed,
                data::Beaddata* Bead, const float* D, const data::Zonedata* Zone, data::Tooldata* Tool,
                data::Wobjdata* WObj, bool Corr, data::Loaddata* TLoad) {
    return dispense(task, lib::corrected(task, lib::circularMove(task, *CirPoint, *ToPoint, ID), Corr),
                    {On, Off, Speed, Bead, D, Zone, Tool, WObj, TLoad});
}
}

// Manual 1.8: positioning instructions.

#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;

namespace {

constexpr int kMostConcurrent = 5; // \Conc moves in succession

/// The arguments every positioning instruction has.
struct Common {
    bool conc;
    const data::Speeddata* speed;
    const float* v; ///< \V, may be null, as those below
    const float* t;
    const data::Zonedata* zone;
    const float* z;
    const data::Stoppointdata* inpos;
    const data::Tooldata* tool;
    const data::Wobjdata* workObject;
};

motion::SpeedData speedOf(const Common& args) {
    const data::Speeddata& s = *args.speed;
    return {args.v ? static_cast<double>(*args.v) : s.v_tcp, s.v_ori, s.v_leax, s.v_reax};
}

motion::ZoneData zoneOf(const Common& args) {
    const data::Zonedata& z = *args.zone;
    motion::ZoneData zone{z.finep,    z.pzone_tcp, z.pzone_ori, z.pzone_eax,
                          z.zone_ori, z.zone_leax, z.zone_reax};
    if (args.z) zone.pzoneTcp = *args.z;
    if (args.inpos) zone.finep = true;
    return zone;
}

Status checkConcurrent(TaskCore* task, lib::MotionState& state, bool conc) {
    if (!conc) {
        state.concurrentMoves = 0;
        return kOk;
    }
    if (state.concurrentMoves < kMostConcurrent) {
        ++state.concurrentMoves;
        return kOk;
    }
    return lib::fail(task, err::ERR_CONC_MAX,
                     "at most 5 movement instructions with \\Conc may follow each other");
}

/// Completes the command with what is common, orders it and waits until the program may go on.
Status order(TaskCore* task, motion::MoveCommand& command, const Common& args) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Task& owner = taskOf(task);
    lib::MotionState& state = lib::motionState(task);
    if (args.t && !(*args.t > 0)) return lib::fail(task, err::ERR_ARGVALERR, "\\T must be a time above 0 s");
    if (const Status status = checkConcurrent(task, state, args.conc)) return status;
    static const data::Wobjdata kWorld = lib::MotionState().workObject;
    const data::Wobjdata* workObject = args.workObject ? args.workObject : &kWorld;
    command.frames = lib::frameSetup(state, args.tool, workObject);
    command.speed = speedOf(args);
    command.duration = args.t ? static_cast<double>(*args.t) : 0.0;
    command.zone = zoneOf(args);
    command.confJ = state.confJ;
    command.confL = state.confL;
    command.concurrent = args.conc;
    command.settings = state.settings;
    motion::MoveId id = 0;
    std::optional<motion::MotionError> error;
    const Status status = owner.controller().motion().order(owner, command, id, error);
    if (status != kOk) return status;
    if (error) return lib::fail(task, lib::motionErrno(*error), error->message());
    state.tool = *args.tool;
    state.workObject = *workObject;
    // A stop point by time: the program goes on when the robot has stood there that long.
    if (args.inpos && args.inpos->type == k::stoptime)
        return owner.sleepFor(fromSeconds(args.inpos->stoptime));
    return kOk;
}

motion::RobTarget programmed(TaskCore* task, const data::Robtarget& target) {
    motion::RobTarget out = lib::toTarget(target);
    lib::addOffsets(out.extax, lib::motionState(task).axisOffsets, 1);
    return out;
}

} // namespace

extern "C" {

Status rt_MoveAbsJ(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float*, bool NoEOffs,
                   const data::Speeddata* Speed, const float* V, const float* T, const data::Zonedata* Zone,
                   const float* Z, const data::Stoppointdata* Inpos, data::Tooldata* Tool,
                   data::Wobjdata* WObj, data::Loaddata*) {
    motion::MoveCommand command;
    command.kind = motion::MoveKind::AbsJoint;
    command.joints = lib::toJoints(*ToJointPos);
    if (!NoEOffs) lib::addOffsets(command.joints.extax, lib::motionState(task).axisOffsets, 1);
    return order(task, command, {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

Status rt_MoveJ(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float*,
                const data::Speeddata* Speed, const float* V, const float* T, const data::Zonedata* Zone,
                const float* Z, const data::Stoppointdata* Inpos, data::Tooldata* Tool, data::Wobjdata* WObj,
                data::Loaddata*) {
    motion::MoveCommand command;
    command.kind = motion::MoveKind::Joint;
    command.target = programmed(task, *ToPoint);
    return order(task, command, {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

Status rt_MoveL(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float*,
                const data::Speeddata* Speed, const float* V, const float* T, const float*, const float*,
                const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                data::Tooldata* Tool, data::Wobjdata* WObj, bool, data::Loaddata*) {
    motion::MoveCommand command;
    command.kind = motion::MoveKind::Linear;
    command.target = programmed(task, *ToPoint);
    return order(task, command, {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

Status rt_MoveC(TaskCore* task, bool Conc, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                const float*, const data::Speeddata* Speed, const float* V, const float* T,
                const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                data::Tooldata* Tool, data::Wobjdata* WObj, bool, data::Loaddata*) {
    motion::MoveCommand command;
    command.kind = motion::MoveKind::Circular;
    command.circlePoint = lib::toFrame(*CirPoint);
    command.target = programmed(task, *ToPoint);
    return order(task, command, {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj});
}

Status rt_MoveExtJ(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float*,
                   bool UseEOffs, const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                   const data::Stoppointdata* Inpos) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    motion::MoveCommand command;
    command.kind = motion::MoveKind::AbsJoint;
    // The arm stays where the last movement ends; only the additional axes move.
    command.joints = taskOf(task).controller().motion().system().plannedEnd();
    command.joints.extax = lib::toAxes(ToJointPos->extax);
    const lib::MotionState& state = lib::motionState(task);
    if (UseEOffs) lib::addOffsets(command.joints.extax, state.axisOffsets, 1);
    const data::Tooldata tool = state.tool;
    const data::Wobjdata workObject = state.workObject;
    return order(task, command, {Conc, Speed, nullptr, T, Zone, nullptr, Inpos, &tool, &workObject});
}
}

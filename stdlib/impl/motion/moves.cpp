// Manual 1.8: positioning instructions.

#include "stdlib/impl/conveyor/sensor_sync.h"
#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/corrections.h"
#include "stdlib/impl/motion/lowest_speed.h"
#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/support/fail.h"

#include "natives/move.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <utility>

using namespace rt;

namespace {

constexpr int kMostConcurrent = 5; // \Conc moves in succession

motion::SpeedData speedOf(const lib::MoveArguments& args) {
    const data::Speeddata& s = *args.speed;
    return {args.v ? static_cast<double>(*args.v) : s.v_tcp, s.v_ori, s.v_leax, s.v_reax};
}

motion::ZoneData zoneOf(const lib::MoveArguments& args) {
    const data::Zonedata& z = *args.zone;
    motion::ZoneData zone{z.finep,    z.pzone_tcp, z.pzone_ori, z.pzone_eax,
                          z.zone_ori, z.zone_leax, z.zone_reax};
    if (args.z) zone.pzoneTcp = *args.z;
    if (args.inpos) zone.finep = true;
    return zone;
}

/// The stop point of \Inpos.
Status stopOf(TaskCore* task, const data::Stoppointdata* inpos, motion::StopPoint& stop) {
    stop = {};
    if (inpos == nullptr) return kOk;
    constexpr float kLongest = 20; // s
    const data::Stoppointdata& s = *inpos;
    stop.isAwaited = s.progsynch;
    if (s.type == k::inpos) {
        const data::Inposdata& c = s.inpos;
        if (!(c.position >= 0 && c.speed >= 0 && c.mintime >= 0 && c.maxtime >= c.mintime))
            return lib::fail(
                task, err::ERR_ARGVALERR,
                "\\Inpos: position, speed and mintime must not be negative, and maxtime must not be "
                "shorter than mintime");
        stop.positionPercent = c.position;
        stop.speedPercent = c.speed;
        stop.minTime = c.mintime;
        stop.maxTime = c.maxtime;
        return kOk;
    }
    if (s.type != k::stoptime && s.type != k::fllwtime)
        return lib::fail(task, err::ERR_ARGVALERR, "\\Inpos: the type must be inpos, stoptime or fllwtime");
    const float seconds = s.type == k::stoptime ? s.stoptime : s.followtime;
    if (!(seconds >= 0 && seconds <= kLongest))
        return lib::failWith(task, err::ERR_ARGVALERR,
                             "\\Inpos: stoptime and followtime must lie between {} and {} s", 0, kLongest);
    stop.standTime = seconds;
    return kOk;
}

/// The inertia that a part adds is the one about the flange; load0, which has 1 g, means none.
void addLoad(motion::CarriedLoad& sum, const data::Loaddata& part, const motion::Pose& frame) {
    constexpr float kNone = 0.001F; // kg
    if (!(part.mass > kNone)) return;
    const motion::Vec3 centre = frame.pos + robot::rotate(frame.rot, {part.cog.x, part.cog.y, part.cog.z});
    const double distance = 0.001 * norm(centre);
    sum.mass += part.mass;
    sum.inertia += part.mass * distance * distance + std::max({part.ix, part.iy, part.iz, 0.0F});
}

/// A load that is given with the movement takes the place of the tool's and of GripLoad's.
motion::CarriedLoad carriedBy(const lib::MotionState& state, const lib::MoveArguments& args) {
    motion::CarriedLoad sum;
    if (args.totalLoad != nullptr && args.totalLoad->mass > 0.001F) {
        addLoad(sum, *args.totalLoad, {});
        return sum;
    }
    const bool isToolHeld = args.tool->robhold;
    if (isToolHeld) addLoad(sum, args.tool->tload, {});
    addLoad(sum, state.gripLoad, isToolHeld ? lib::toFrame(args.tool->tframe) : motion::Pose{});
    return sum;
}

Status checkConcurrent(TaskCore* task, lib::MotionState& state, bool conc) {
    if (!conc) {
        state.concurrentMoves = 0;
        return kOk;
    }
    if (lib::motionOf(task).pathLevel() > 1)
        return lib::fail(task, err::ERR_CONC_MAX,
                         "movement instructions with \\Conc are not allowed between StorePath and RestoPath");
    if (state.concurrentMoves < kMostConcurrent) {
        ++state.concurrentMoves;
        return kOk;
    }
    return lib::fail(task, err::ERR_CONC_MAX,
                     "at most 5 movement instructions with \\Conc may follow each other");
}

int64_t identOf(const float* id) {
    return id != nullptr ? static_cast<int64_t>(std::clamp(*id, 0.0F, 1e9F)) : motion::kNoIdent;
}

/// As programmed, with the axis offsets in force.
motion::MoveCommand moveTo(TaskCore* task, motion::MoveKind kind, const data::Robtarget& target,
                           const float* id) {
    motion::MoveCommand command;
    command.ident = identOf(id);
    command.kind = kind;
    command.target = lib::toTarget(target, lib::motionSystemOf(task).kinematics());
    lib::addOffsets(command.target.extax, lib::motionState(task).axisOffsets, 1);
    return command;
}

} // namespace

namespace rt::lib {

MoveArguments plainArguments(const data::Speeddata* speed, const float* t, const data::Zonedata* zone,
                             const data::Tooldata* tool, const data::Wobjdata* workObject,
                             const data::Loaddata* totalLoad) {
    return {false, speed, nullptr, t, zone, nullptr, nullptr, tool, workObject, false, totalLoad};
}

motion::MoveCommand jointMove(TaskCore* task, const data::Robtarget& target, const float* id) {
    return moveTo(task, motion::MoveKind::Joint, target, id);
}

motion::MoveCommand linearMove(TaskCore* task, const data::Robtarget& target, const float* id) {
    return moveTo(task, motion::MoveKind::Linear, target, id);
}

motion::MoveCommand circularMove(TaskCore* task, const data::Robtarget& circlePoint,
                                 const data::Robtarget& target, const float* id) {
    motion::MoveCommand command = moveTo(task, motion::MoveKind::Circular, target, id);
    command.circlePoint = toMovePose(circlePoint);
    return command;
}

motion::MoveCommand absoluteMove(TaskCore* task, const data::Jointtarget& target, bool noOffsets,
                                 const float* id) {
    motion::MoveCommand command;
    command.ident = identOf(id);
    command.kind = motion::MoveKind::AbsJoint;
    command.joints = toJoints(target, lib::motionSystemOf(task).kinematics());
    if (!noOffsets) addOffsets(command.joints.extax, motionState(task).axisOffsets, 1);
    return command;
}

motion::MoveCommand externalMove(TaskCore* task, const data::Jointtarget& target, bool withOffsets,
                                 const float* id) {
    motion::MoveCommand command;
    command.ident = identOf(id);
    command.kind = motion::MoveKind::AbsJoint;
    command.joints = lib::motionSystemOf(task).plannedEnd();
    command.joints.extax = toAxes(target.extax);
    if (withOffsets) addOffsets(command.joints.extax, motionState(task).axisOffsets, 1);
    return command;
}

Status orderMove(TaskCore* task, motion::MoveCommand command, const MoveArguments& args,
                 std::vector<PathAction> actions) {
    if (const Status status = requireMotionTask(task)) return status;
    Task& owner = taskOf(task);
    if (command.ident != motion::kNoIdent && owner.controller().motions().size() > 1 &&
        motionOf(task).synchronised() == nullptr) {
        if (motionOf(task).refusesBackward(owner)) return kAgain;
        return owner.fatal(
            static_cast<int>(EventId::SyncMisused),
            "A movement instruction with \\ID is not between SyncMoveOn and SyncMoveOff. Remove "
            "\\ID, or synchronise the tasks first.");
    }
    MotionState& state = motionState(task);
    if (args.t && !(*args.t > 0)) return fail(task, err::ERR_ARGVALERR, "\\T must be a time above 0 s");
    if (const Status status = checkConcurrent(task, state, args.conc)) return status;
    static const data::Wobjdata kWorld = MotionState().workObject;
    const data::Wobjdata* workObject = args.workObject ? args.workObject : &kWorld;
    if (const Status status = frameSetup(task, args.tool, workObject, command.frames)) return status;
    command.speed = speedOf(args);
    command.duration = args.t ? static_cast<double>(*args.t) : 0.0;
    command.zone = zoneOf(args);
    if (const Status status = stopOf(task, args.inpos, command.stop)) return status;
    command.load = carriedBy(state, args);
    for (std::size_t i = 0; i < state.independentExternal.size() && !args.movesGun; ++i)
        if (state.independentExternal[i])
            command.joints.extax[i] = command.target.extax[i] = motion::kNotConnected;
    command.confJ = state.confJ;
    command.confL = state.confL || args.exactConfiguration;
    command.circleOrientation = state.circleOrientation;
    command.singularity = state.singWrist       ? motion::SingularityMode::Wrist
                          : state.singLockAxis4 ? motion::SingularityMode::LockAxis4
                                                : motion::SingularityMode::Off;
    command.concurrent = args.conc;
    command.settings = state.settings;
    motion::MoveId id = 0;
    std::optional<motion::MotionError> error;
    if (const Status status = trackConveyor(task, *workObject, command)) return status;
    if (const Status status = followSensor(task, command)) return status;
    warnOfNoSpeed(task, command);
    const Status status =
        owner.controller().motion(owner).order(owner, std::move(command), id, error, std::move(actions));
    if (status != kOk) return status;
    if (error) return failMotion(task, *error);
    state.tool = *args.tool;
    state.workObject = *workObject;
    return kOk;
}

} // namespace rt::lib

extern "C" {

Status rt_MoveAbsJ(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float* ID,
                   bool NoEOffs, const data::Speeddata* Speed, const float* V, const float* T,
                   const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                   data::Tooldata* Tool, data::Wobjdata* WObj, data::Loaddata* TLoad) {
    return lib::orderMove(task, lib::absoluteMove(task, *ToJointPos, NoEOffs, ID),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj, false, TLoad});
}

/// The line to where the tool is at these axis angles, which the robot must reach in just that configuration.
Status rt_MoveAbsL(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float* ID,
                   bool NoEOffs, const data::Speeddata* Speed, const float* V, const float* T,
                   const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                   data::Tooldata* Tool, data::Wobjdata* WObj, data::Loaddata* TLoad) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    const motion::MoveCommand absolute = lib::absoluteMove(task, *ToJointPos, NoEOffs, ID);
    motion::MoveCommand command;
    command.kind = motion::MoveKind::Linear;
    command.ident = absolute.ident;
    const data::Wobjdata world = lib::MotionState().workObject;
    motion::FrameSetup frames;
    if (const Status status = lib::frameSetup(task, Tool, WObj != nullptr ? WObj : &world, frames))
        return status;
    command.target = lib::motionSystemOf(task).toRobTarget(absolute.joints, frames);
    return lib::orderMove(task, command, {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj, true, TLoad});
}

Status rt_MoveJ(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                const data::Speeddata* Speed, const float* V, const float* T, const data::Zonedata* Zone,
                const float* Z, const data::Stoppointdata* Inpos, data::Tooldata* Tool, data::Wobjdata* WObj,
                data::Loaddata* TLoad) {
    return lib::orderMove(task, lib::jointMove(task, *ToPoint, ID),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj, false, TLoad});
}

Status rt_MoveL(TaskCore* task, bool Conc, const data::Robtarget* ToPoint, const float* ID,
                const data::Speeddata* Speed, const float* V, const float* T, const float*, const float*,
                const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr, data::Loaddata* TLoad) {
    return lib::orderMove(task, lib::corrected(task, lib::linearMove(task, *ToPoint, ID), Corr),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj, false, TLoad});
}

Status rt_MoveC(TaskCore* task, bool Conc, const data::Robtarget* CirPoint, const data::Robtarget* ToPoint,
                const float* ID, const data::Speeddata* Speed, const float* V, const float* T,
                const data::Zonedata* Zone, const float* Z, const data::Stoppointdata* Inpos,
                data::Tooldata* Tool, data::Wobjdata* WObj, bool Corr, data::Loaddata* TLoad) {
    return lib::orderMove(task, lib::corrected(task, lib::circularMove(task, *CirPoint, *ToPoint, ID), Corr),
                          {Conc, Speed, V, T, Zone, Z, Inpos, Tool, WObj, false, TLoad});
}

Status rt_MoveExtJ(TaskCore* task, bool Conc, const data::Jointtarget* ToJointPos, const float* ID,
                   bool UseEOffs, const data::Speeddata* Speed, const float* T, const data::Zonedata* Zone,
                   const data::Stoppointdata* Inpos) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    const lib::MotionState& state = lib::motionState(task);
    const data::Tooldata tool = state.tool;
    const data::Wobjdata workObject = state.workObject;
    // The movement has no TCP: that of a robot which a track carries along has no programmed speed (vlin, vrot).
    data::Speeddata speed = *Speed;
    speed.v_tcp = speed.v_ori = 1e6F;
    return lib::orderMove(task, lib::externalMove(task, *ToJointPos, UseEOffs, ID),
                          {Conc, &speed, nullptr, T, Zone, nullptr, Inpos, &tool, &workObject});
}
}

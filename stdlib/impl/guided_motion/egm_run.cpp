// EGM: guidance itself (EGMRun..., EGMWaitCond, EGMStop) and movements with path correction.

#include "stdlib/impl/guided_motion/egm_asked.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/support/fail.h"

#include "natives/guided_motion.h"
#include "stdlib_constants.h"

#include <cmath>
#include <utility>

using namespace rt;
using lib::EgmProcess;
using lib::EgmProcesses;
using lib::GuidanceMode;
using lib::GuidanceOrder;

namespace {

struct RunArguments {
    float mode;
    bool noWait;
    const float *conditionTime, *rampIn, *rampOut, *gain;
};

Status stopMode(TaskCore* task, float mode, bool& rampDown) {
    rampDown = mode == k::EGM_STOP_RAMP_DOWN;
    if (rampDown || mode == k::EGM_STOP_HOLD) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR, "the stop mode must be EGM_STOP_HOLD or EGM_STOP_RAMP_DOWN");
}

/// The process, activated in this mode and not guiding yet, and the robot free. Null with the reason reported.
EgmProcess* activatedProcess(TaskCore* task, Handle identity, GuidanceMode mode, Status& status) {
    EgmProcess* process = lib::egmProcess(task, identity, status);
    if (process == nullptr) return nullptr;
    EgmProcesses& all = EgmProcesses::of(taskOf(task).controller());
    const char* const remedy = mode == GuidanceMode::Joint  ? "Use EGMActJoint before EGMRunJoint."
                               : mode == GuidanceMode::Pose ? "Use EGMActPose before EGMRunPose."
                                                            : "Use EGMActMove before EGMMoveL and EGMMoveC.";
    if (!process->isActivated())
        status = lib::egmMisused(task, remedy);
    else if (process->settings().mode != mode)
        status = taskOf(task).fatal(static_cast<int>(EventId::EgmModeMismatch), remedy);
    else if (all.guiding(lib::motionOf(task)) != nullptr)
        status = lib::egmMisused(task, "The robot is guided already. Use EGMStop or EGMWaitCond first.");
    else
        return process;
    return nullptr;
}

Status readOrder(TaskCore* task, const EgmProcess& process, const RunArguments& args, GuidanceOrder& order) {
    if (const Status status = stopMode(task, args.mode, order.rampDown)) return status;
    const std::pair<const char*, const float*> numbers[] = {{"\\CondTime", args.conditionTime},
                                                            {"\\RampInTime", args.rampIn},
                                                            {"\\RampOutTime", args.rampOut},
                                                            {"\\PosCorrGain", args.gain}};
    for (const auto& [name, value] : numbers)
        if (const Status status = lib::egmNotNegative(task, name, value)) return status;
    const auto given = [](const float* value, double usual) {
        return value != nullptr ? static_cast<double>(*value) : usual;
    };
    order.continues = args.noWait;
    order.conditionTime = given(args.conditionTime, 1);
    order.rampIn = given(args.rampIn, 0);
    order.rampOut = given(args.rampOut, process.defaults().rampTime);
    order.gain = process.defaults().gain * given(args.gain, 1);
    return kOk;
}

/// Until the guidance ends. When the task is unwound meanwhile, so does the guidance.
Status waitFinished(TaskCore* task, Handle identity) {
    Task& owner = taskOf(task);
    EgmProcesses& all = EgmProcesses::of(owner.controller());
    EgmProcess* process = all.find(identity);
    WaitResult result{};
    // A trap routine may release the process while the task waits.
    const auto isOver = [&] {
        const EgmProcess* waited = all.find(identity);
        return waited == nullptr || waited->hasFinished();
    };
    const Status status = owner.waitFor({{&process->changed()}, isOver}, result);
    process = all.find(identity);
    if (process == nullptr) return status;
    if (status != kOk) {
        process->stop(false, std::nullopt);
        return status;
    }
    if (!process->takeTimeout()) return kOk;
    return lib::fail(task, err::ERR_UDPUC_COMM,
                     "no data came from the UdpUc device within \\CommTimeout, or the power failed");
}

/// The manual: the robot does not move, and execution continues.
void noteNothingNamed(TaskCore* task, GuidanceMode mode) {
    const Task& owner = taskOf(task);
    owner.controller().log().write(
        EventId::EgmNothingNamed, &owner,
        {mode == GuidanceMode::Joint ? "EGMRunJoint" : "EGMRunPose",
         mode == GuidanceMode::Joint ? "\\J1 to \\J7" : "\\x, \\y, \\z, \\rx, \\ry, \\rz"});
}

Status run(TaskCore* task, Handle identity, GuidanceMode mode, const RunArguments& args,
           GuidanceOrder order) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    EgmProcess* process = activatedProcess(task, identity, mode, status);
    if (process == nullptr) return status;
    if ((status = readOrder(task, *process, args, order)) != kOk) return status;
    if (!order.movesRobot()) {
        noteNothingNamed(task, mode);
        return kOk;
    }
    if ((status = taskOf(task).requireMovementAllowed()) != kOk) return status;
    MotionDriver& motion = lib::motionOf(task);
    if ((status = motion.waitIdle(taskOf(task))) != kOk) return status;
    if ((status = motion.waitZeroSpeed(taskOf(task))) != kOk) return status;
    process->run(order);
    return args.noWait ? kOk : waitFinished(task, identity);
}

/// The movement, corrected by what the sensor of the process sends.
Status moveCorrected(TaskCore* task, Handle identity, motion::MoveCommand command,
                     const lib::MoveArguments& arguments, bool isCorrected) {
    Status status = kOk;
    EgmProcess* process = activatedProcess(task, identity, GuidanceMode::PathCorrection, status);
    if (process == nullptr) return status;
    if (isCorrected) command = process->corrected(std::move(command));
    process->beginMove(lib::toFrame(arguments.tool->tframe));
    status = lib::orderMove(task, std::move(command), arguments);
    // A trap routine may have released the process while the task waited.
    process = EgmProcesses::of(taskOf(task).controller()).find(identity);
    if (process != nullptr) process->endMove();
    return status;
}

} // namespace

extern "C" {

Status rt_EGMRunJoint(TaskCore* task, Handle* EGMid, float Mode, bool NoWaitCond, bool J1, bool J2, bool J3,
                      bool J4, bool J5, bool J6, bool J7, const float* CondTime, const float* RampInTime,
                      const float* RampOutTime, const float* PosCorrGain) {
    GuidanceOrder order;
    order.named = {J1, J2, J3, J4, J5, J6, J7};
    return run(task, *EGMid, GuidanceMode::Joint,
               {Mode, NoWaitCond, CondTime, RampInTime, RampOutTime, PosCorrGain}, order);
}

Status rt_EGMRunPose(TaskCore* task, Handle* EGMid, float Mode, bool NoWaitCond, bool x, bool y, bool z,
                     bool rx, bool ry, bool rz, const float* CondTime, const float* RampInTime,
                     const float* RampOutTime, const data::Pose* Offset, const float* PosCorrGain) {
    GuidanceOrder order;
    order.named = {x, y, z, rx, ry, rz, false};
    if (Offset != nullptr) order.offset = lib::toFrame(*Offset);
    return run(task, *EGMid, GuidanceMode::Pose,
               {Mode, NoWaitCond, CondTime, RampInTime, RampOutTime, PosCorrGain}, order);
}

/// At once when the guidance is over already.
Status rt_EGMWaitCond(TaskCore* task, Handle* EGMid) {
    Status status = kOk;
    EgmProcess* process = lib::egmProcess(task, *EGMid, status);
    if (process == nullptr) return status;
    process->awaitCondition();
    return waitFinished(task, *EGMid);
}

/// Waits until the robot is at rest. No effect when the process does not guide it.
Status rt_EGMStop(TaskCore* task, Handle* EGMid, float Mode, const float* RampOutTime) {
    Status status = kOk;
    EgmProcess* process = lib::egmProcess(task, *EGMid, status);
    if (process == nullptr) return status;
    bool rampDown = false;
    if ((status = stopMode(task, Mode, rampDown)) != kOk) return status;
    if ((status = lib::egmNotNegative(task, "\\RampOutTime", RampOutTime)) != kOk) return status;
    process->stop(rampDown, RampOutTime != nullptr ? std::optional<double>(*RampOutTime) : std::nullopt);
    if (process->hasFinished()) return kOk;
    return waitFinished(task, *EGMid);
}

Status rt_EGMMoveL(TaskCore* task, Handle* EGMid, const data::Robtarget* ToPoint,
                   const data::Speeddata* Speed, const data::Zonedata* Zone, data::Tooldata* Tool,
                   data::Wobjdata* WObj, data::Loaddata* TLoad, bool NoCorr) {
    return moveCorrected(task, *EGMid, lib::linearMove(task, *ToPoint, nullptr),
                         {false, Speed, nullptr, nullptr, Zone, nullptr, nullptr, Tool, WObj, false, TLoad},
                         !NoCorr);
}

Status rt_EGMMoveC(TaskCore* task, Handle* EGMid, const data::Robtarget* CirPoint,
                   const data::Robtarget* ToPoint, const data::Speeddata* Speed, const data::Zonedata* Zone,
                   data::Tooldata* Tool, data::Wobjdata* WObj, data::Loaddata* TLoad, bool NoCorr) {
    return moveCorrected(task, *EGMid, lib::circularMove(task, *CirPoint, *ToPoint, nullptr),
                         {false, Speed, nullptr, nullptr, Zone, nullptr, nullptr, Tool, WObj, false, TLoad},
                         !NoCorr);
}
}

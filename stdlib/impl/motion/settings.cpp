// Manual 1.7: motion settings. They hold for all movements ordered afterwards.

#include "runtime/base/text_util.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "natives/additional.h"
#include "natives/axes.h"
#include "natives/motion_misc.h"
#include "natives/motion_settings.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <cmath>

using namespace rt;

namespace {

constexpr double kLeastAcceleration = 0.1; // m/s^2, PathAccLim and WorldAccLim

Status tooLow(TaskCore* task) {
    return lib::fail(task, err::ERR_ACC_TOO_LOW, "the limit of acceleration must be at least 0.1 m/s2");
}

/// The limit when it is switched on; ERR_ACC_TOO_LOW when it is too small.
Status pathLimit(TaskCore* task, bool on, const float* value, double& limit) {
    if (on && !value)
        return lib::fail(task, err::ERR_ARGVALERR, "PathAccLim: TRUE needs \\AccMax or \\DecelMax");
    if (on && *value < kLeastAcceleration) return tooLow(task);
    limit = on ? static_cast<double>(*value) : 0.0;
    return kOk;
}

} // namespace

extern "C" {

Status rt_MaxRobSpeed(TaskCore* task, float* result) {
    *result = static_cast<float>(lib::motionSystemOf(task).model().maxTcpSpeed);
    return kOk;
}

/// The value of vmax for these speeds.
Status rt_MaxRobReorientSpeed(TaskCore*, float* result) {
    *result = 500;
    return kOk;
}
Status rt_MaxExtLinearSpeed(TaskCore*, float* result) {
    *result = 5000;
    return kOk;
}
Status rt_MaxExtReorientSpeed(TaskCore*, float* result) {
    *result = 1000;
    return kOk;
}

/// SYS_MISC ModalPayLoadMode of SYS.cfg; 1 when it is not given.
Status rt_GetModalPayLoadMode(TaskCore* task, float* result) {
    double mode = 1;
    for (const CfgInstance* instance : taskOf(task).controller().instances("SYS", "SYS_MISC"))
        if (sameName(instance->text("Name"), "ModalPayLoadMode")) instance->number("Value", mode);
    *result = static_cast<float>(mode);
    return kOk;
}

Status rt_SYS_RESET(TaskCore* task) {
    lib::restoreDefaults(taskOf(task));
    return kOk;
}

Status rt_VelSet(TaskCore* task, float Override, float Max) {
    motion::MotionSettings& settings = lib::motionState(task).settings;
    settings.velocityPercent = std::clamp(static_cast<double>(Override), 0.0, 100.0);
    settings.maxTcpSpeed = std::max(static_cast<double>(Max), 0.0);
    return kOk;
}

Status rt_AccSet(TaskCore* task, float Acc, float Ramp, const float* FinePointRamp) {
    motion::MotionSettings& settings = lib::motionState(task).settings;
    settings.finePointRampPercent =
        FinePointRamp != nullptr ? std::clamp(static_cast<double>(*FinePointRamp), 10.0, 100.0) : 100.0;
    settings.accelerationPercent = std::clamp(static_cast<double>(Acc), 20.0, 100.0);
    settings.rampPercent = std::clamp(static_cast<double>(Ramp), 10.0, 100.0);
    return kOk;
}

Status rt_WorldAccLim(TaskCore* task, const float* On, bool Off) {
    if ((On != nullptr) == Off)
        return lib::fail(task, err::ERR_ARGVALERR, "WorldAccLim needs one of \\On and \\Off");
    if (On && *On < kLeastAcceleration) return tooLow(task);
    lib::motionState(task).settings.worldAcceleration = On ? static_cast<double>(*On) : 0.0;
    return kOk;
}

Status rt_PathAccLim(TaskCore* task, bool AccLim, const float* AccMax, bool DecelLim, const float* DecelMax) {
    motion::MotionSettings settings = lib::motionState(task).settings;
    if (const Status status = pathLimit(task, AccLim, AccMax, settings.pathAcceleration)) return status;
    if (const Status status = pathLimit(task, DecelLim, DecelMax, settings.pathDeceleration)) return status;
    lib::motionState(task).settings = settings;
    return kOk;
}

/// Without a switch: on.
Status rt_ConfJ(TaskCore* task, bool, bool Off) {
    lib::motionState(task).confJ = !Off;
    return kOk;
}

Status rt_ConfL(TaskCore* task, bool, bool Off) {
    lib::motionState(task).confL = !Off;
    return kOk;
}

Status rt_SpeedRefresh(TaskCore* task, float Override) {
    if (!(Override >= 0 && Override <= 100))
        return lib::fail(task, err::ERR_SPEED_REFRESH_LIM, "the override must lie between 0 and 100 percent");
    lib::motionOf(task).setProgramOverride(Override);
    return kOk;
}

Status rt_CSpeedOverride(TaskCore* task, float* result, bool CTask) {
    const motion::MotionSystem& arm = lib::motionSystemOf(task);
    *result = static_cast<float>(CTask ? arm.programOverride() : arm.speedOverride());
    return kOk;
}

Status rt_PDispSet(TaskCore* task, const data::Pose* DispFrame) {
    lib::motionState(task).displacement = lib::toFrame(*DispFrame);
    return kOk;
}

Status rt_PDispOff(TaskCore* task) {
    lib::motionState(task).displacement = {};
    return kOk;
}

/// From the programmed point to the executed one (default: where the robot is), both in the work object.
Status rt_PDispOn(TaskCore* task, bool Rot, const data::Robtarget* ExeP, const data::Robtarget* ProgPoint,
                  data::Tooldata* Tool, data::Wobjdata* WObj) {
    lib::MotionState& state = lib::motionState(task);
    static const data::Wobjdata kWorld = lib::MotionState().workObject;
    motion::FrameSetup frames;
    if (const Status status = lib::frameSetup(task, Tool, WObj ? WObj : &kWorld, frames)) return status;
    frames.displacement = {};
    motion::Pose executed;
    if (ExeP) {
        executed = lib::toFrame(*ExeP);
    } else {
        executed = lib::motionSystemOf(task).currentTarget(frames).pose;
    }
    const motion::Pose point = lib::toFrame(*ProgPoint);
    state.displacement = Rot ? executed * robot::inverse(point) : motion::Pose{executed.pos - point.pos, {}};
    return kOk;
}

Status rt_EOffsSet(TaskCore* task, const data::Extjoint* EAxOffs) {
    motion::ExternalAxes offsets = lib::toAxes(*EAxOffs);
    for (double& offset : offsets)
        if (!motion::isConnected(offset)) offset = 0;
    lib::motionState(task).axisOffsets = offsets;
    return kOk;
}

Status rt_EOffsOff(TaskCore* task) {
    lib::motionState(task).axisOffsets = {};
    return kOk;
}

Status rt_EOffsOn(TaskCore* task, const data::Robtarget* ExeP, const data::Robtarget* ProgPoint) {
    const motion::ExternalAxes executed =
        ExeP ? lib::toAxes(ExeP->extax) : lib::motionSystemOf(task).currentJoints().extax;
    const motion::ExternalAxes point = lib::toAxes(ProgPoint->extax);
    motion::ExternalAxes offsets{};
    for (size_t i = 0; i < offsets.size(); ++i)
        if (motion::isConnected(executed[i]) && motion::isConnected(point[i]))
            offsets[i] = executed[i] - point[i];
    lib::motionState(task).axisOffsets = offsets;
    return kOk;
}

Status rt_SingArea(TaskCore* task, bool Wrist, bool LockAxis4, bool Off) {
    if (Wrist + LockAxis4 + Off > 1)
        return lib::fail(task, err::ERR_ARGVALERR, "SingArea takes one of \\Wrist, \\LockAxis4 and \\Off");
    lib::MotionState& state = lib::motionState(task);
    state.singWrist = Wrist;
    state.singLockAxis4 = LockAxis4;
    return kOk;
}

/// The event buffer lets outputs of triggers come at the right time in spite of servo delays; here they always do.
Status rt_ActEventBuffer(TaskCore* task) {
    lib::motionState(task).eventBuffer = true;
    return kOk;
}
Status rt_DeactEventBuffer(TaskCore* task) {
    lib::motionState(task).eventBuffer = false;
    return kOk;
}

/// The modes differ in servo behaviour, which the simulated arm does not have.
Status rt_MotionProcessModeSet(TaskCore* task, float Mode) {
    if (!(Mode >= k::OPTIMAL_CYCLE_TIME_MODE && Mode <= k::MPM_USER_MODE_4 && Mode == std::floor(Mode)))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "MotionProcessModeSet: the mode must be one of OPTIMAL_CYCLE_TIME_MODE to "
                         "MPM_USER_MODE_4 (1 to 8)");
    if (const Status status = lib::requireMotionTask(task)) return status;
    lib::motionState(task).processMode = Mode;
    return kOk;
}

/// Near singular points the wrist is computed exactly: there is nothing to optimise.
Status rt_WristOpt(TaskCore* task, bool On, bool Off) {
    if (On == Off) return lib::fail(task, err::ERR_ARGVALERR, "WristOpt needs one of \\On and \\Off");
    return kOk;
}

/// None of the simulated robots has such a wrist.
Status rt_HollowWristReset(TaskCore*) {
    return kOk;
}

/// The simulated path is exact; the resolution shows in C_MOTSET only.
Status rt_PathResol(TaskCore* task, float PathSampleTime) {
    lib::motionState(task).pathResolution = std::clamp(static_cast<double>(PathSampleTime), 25.0, 400.0);
    return kOk;
}
Status rt_MotionSup(TaskCore* task, bool, bool Off, const float* TuneValue, bool NoBackoff) {
    if (Off && TuneValue != nullptr)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "MotionSup: \\TuneValue has no meaning together with \\Off");
    if (TuneValue != nullptr && !(*TuneValue >= 1 && *TuneValue <= 300))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "MotionSup: \\TuneValue must lie between 1 and 300 percent");
    lib::MotionState& state = lib::motionState(task);
    state.motionSupervision = !Off;
    state.backsOff = !NoBackoff;
    state.supervisionLevel = TuneValue != nullptr ? static_cast<double>(*TuneValue) : 100.0;
    return kOk;
}
Status rt_CornerPathWarning(TaskCore* task, bool Active) {
    lib::motionOf(task).setCornerWarning(Active);
    return kOk;
}
Status rt_GripLoad(TaskCore* task, data::Loaddata* Load) {
    if (!(Load->mass >= 0))
        return lib::fail(task, err::ERR_ARGVALERR, "GripLoad: the mass must not be negative");
    lib::motionState(task).gripLoad = *Load;
    return kOk;
}

Status rt_CirPathMode(TaskCore* task, bool PathFrame, bool ObjectFrame, bool CirPointOri, bool Wrist45,
                      bool Wrist46, bool Wrist56) {
    if (PathFrame + ObjectFrame + CirPointOri + Wrist45 + Wrist46 + Wrist56 > 1)
        return lib::fail(task, err::ERR_ARGVALERR, "CirPathMode takes one mode only");
    using Mode = motion::CircleOrientation;
    lib::motionState(task).circleOrientation = ObjectFrame   ? Mode::ObjectFrame
                                               : CirPointOri ? Mode::CirclePoint
                                               : Wrist45     ? Mode::Wrist45
                                               : Wrist46     ? Mode::Wrist46
                                               : Wrist56     ? Mode::Wrist56
                                                             : Mode::PathFrame;
    return kOk;
}
}

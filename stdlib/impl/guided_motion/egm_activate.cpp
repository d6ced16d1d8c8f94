// EGM: what is guided and how (EGMAct...), and streaming of positions.

#include "stdlib/impl/guided_motion/egm_asked.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"

#include "natives/guided_motion.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

using namespace rt;
using lib::EgmProcess;
using lib::GuidanceMode;
using lib::GuidanceSettings;
using lib::Window;

namespace {

constexpr Window kAngle{-0.5, 0.5}; // deg, when no window is given
constexpr Window kLength{-1, 1};    // mm

/// The arguments that EGMActJoint and EGMActPose share.
struct ActArguments {
    bool stream;
    const data::Tooldata* tool;
    const data::Wobjdata* workObject;
    Handle* output;
    Handle* input;
    double* sent;
    double* received;
    const float *filter, *sampleRate, *maxDeviation, *maxSpeed;
};

const char* nameOf(GuidanceMode mode) {
    return mode == GuidanceMode::Joint ? "\\Joint" : mode == GuidanceMode::Pose ? "\\Pose" : "\\PathCorr";
}

/// The process, set up in this mode and not guiding. Null with the reason reported.
EgmProcess* connectedProcess(TaskCore* task, Handle identity, GuidanceMode mode, Status& status) {
    EgmProcess* process = lib::egmProcess(task, identity, status);
    if (process == nullptr) return nullptr;
    if (process->state() == EgmProcess::State::Disconnected)
        status = lib::egmMisused(task, "The EGM process has no source of data. Use EGMSetupUC, EGMSetupAI, "
                                       "EGMSetupAO, EGMSetupGI or EGMSetupLTAPP first.");
    else if (process->state() == EgmProcess::State::Running)
        status = lib::egmMisused(task, "The EGM process guides the robot now. Use EGMStop first.");
    else if (process->mode() != mode)
        status = lib::egmMisused(
            task, fmt::format("The EGM process was set up with {}, and this instruction needs {}.",
                              nameOf(process->mode()), nameOf(mode)));
    else
        return process;
    return nullptr;
}

Status setWindow(TaskCore* task, const data::Egm_minmax* given, Window usual, Window& window) {
    window = given == nullptr ? usual : Window{given->min, given->max};
    if (window.low <= window.high) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR, "min of a convergence window must not be above max");
}

Status setLimit(TaskCore* task, const char* name, const float* given, double& limit) {
    if (given == nullptr) return kOk;
    limit = *given;
    if (limit > 0 && std::isfinite(limit)) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR, fmt::format("{} must be a number above 0", name));
}

/// The persistent that an argument is; "" when it is left out.
Status nameOfNumbers(TaskCore* task, const char* argument, const double* numbers, std::string& name) {
    if (numbers == nullptr) return kOk;
    name = lib::nameOfData(taskOf(task).controller(), numbers);
    if (!name.empty()) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR,
                     fmt::format("{} must be a whole persistent array of a module", argument));
}

/// Signals and data that travel with the messages.
Status exchangeOf(TaskCore* task, const ActArguments& args, lib::RapidExchange& exchange) {
    Status status = kOk;
    if (args.output != nullptr && (exchange.output = lib::signalOf(task, *args.output, status)) < 0)
        return status;
    if (args.input != nullptr && (exchange.input = lib::signalOf(task, *args.input, status)) < 0)
        return status;
    if ((status = nameOfNumbers(task, "\\DataToSensor", args.sent, exchange.sent)) != kOk) return status;
    return nameOfNumbers(task, "\\DataFromSensor", args.received, exchange.received);
}

Status activate(TaskCore* task, EgmProcess& process, const ActArguments& args, GuidanceSettings& settings) {
    static const data::Wobjdata kWorld = lib::MotionState().workObject;
    const data::Wobjdata* workObject = args.workObject != nullptr ? args.workObject : &kWorld;
    if (const Status status = lib::frameSetup(task, args.tool, workObject, settings.frames)) return status;
    settings.filterHz = process.defaults().filterHz;
    if (const Status status = lib::egmNotNegative(task, "\\LpFilter", args.filter)) return status;
    if (args.filter != nullptr) settings.filterHz = *args.filter;
    if (const Status status = setLimit(task, "\\MaxPosDeviation", args.maxDeviation, settings.maxDeviation))
        return status;
    if (const Status status = setLimit(task, "\\MaxSpeedDeviation", args.maxSpeed, settings.maxSpeed))
        return status;
    Time period = 0;
    if (const Status status = lib::egmPeriod(task, args.sampleRate, period)) return status;
    lib::RapidExchange exchange;
    if (const Status status = exchangeOf(task, args, exchange)) return status;
    process.activate(settings, exchange, period);
    if (!args.stream) return kOk;
    const std::string problem = process.startStream(period);
    return problem.empty() ? kOk : lib::fail(task, err::ERR_UDPUC_COMM, problem);
}

/// egmframetype of a pose: base, tool, work object or world.
Status frameType(TaskCore* task, float type, int& result) {
    result = type >= 0 && type <= k::EGM_FRAME_WORLD ? static_cast<int>(type) : -1;
    if (result >= 0 && static_cast<float>(result) == type) return kOk;
    return lib::fail(
        task, err::ERR_ARGVALERR,
        "a frame of EGM must be EGM_FRAME_BASE, EGM_FRAME_TOOL, EGM_FRAME_WOBJ or EGM_FRAME_WORLD");
}

} // namespace

extern "C" {

Status rt_EGMActJoint(TaskCore* task, Handle* EGMid, bool StreamStart, data::Tooldata* Tool,
                      data::Wobjdata* WObj, data::Loaddata*, Handle* DOToSensor, double* DataToSensor,
                      int32_t, Handle* DIFromSensor, double* DataFromSensor, int32_t,
                      const data::Egm_minmax* J1, const data::Egm_minmax* J2, const data::Egm_minmax* J3,
                      const data::Egm_minmax* J4, const data::Egm_minmax* J5, const data::Egm_minmax* J6,
                      const data::Egm_minmax* J7, const float* LpFilter, const float* SampleRate,
                      const float* MaxPosDeviation, const float* MaxSpeedDeviation) {
    Status status = kOk;
    EgmProcess* process = connectedProcess(task, *EGMid, GuidanceMode::Joint, status);
    if (process == nullptr) return status;
    GuidanceSettings settings;
    const data::Egm_minmax* const windows[] = {J1, J2, J3, J4, J5, J6, J7};
    for (std::size_t i = 0; i < std::size(windows); ++i)
        if ((status = setWindow(task, windows[i], kAngle, settings.windows[i])) != kOk) return status;
    return activate(task, *process,
                    {StreamStart, Tool, WObj, DOToSensor, DIFromSensor, DataToSensor, DataFromSensor,
                     LpFilter, SampleRate, MaxPosDeviation, MaxSpeedDeviation},
                    settings);
}

Status rt_EGMActPose(TaskCore* task, Handle* EGMid, bool StreamStart, data::Tooldata* Tool,
                     data::Wobjdata* WObj, data::Loaddata*, Handle* DOToSensor, double* DataToSensor, int32_t,
                     Handle* DIFromSensor, double* DataFromSensor, int32_t, const data::Pose* CorrFrame,
                     float CorrFrType, const data::Pose* SensorFrame, float SensorFrType,
                     const data::Egm_minmax* x, const data::Egm_minmax* y, const data::Egm_minmax* z,
                     const data::Egm_minmax* rx, const data::Egm_minmax* ry, const data::Egm_minmax* rz,
                     const float* LpFilter, const float* SampleRate, const float* MaxPosDeviation,
                     const float* MaxSpeedDeviation) {
    Status status = kOk;
    EgmProcess* process = connectedProcess(task, *EGMid, GuidanceMode::Pose, status);
    if (process == nullptr) return status;
    GuidanceSettings settings;
    settings.mode = GuidanceMode::Pose;
    settings.correctionFrame = lib::toFrame(*CorrFrame);
    settings.sensorFrame = lib::toFrame(*SensorFrame);
    if ((status = frameType(task, CorrFrType, settings.correctionType)) != kOk) return status;
    if ((status = frameType(task, SensorFrType, settings.sensorType)) != kOk) return status;
    const data::Egm_minmax* const windows[] = {x, y, z, rx, ry, rz};
    for (std::size_t i = 0; i < std::size(windows); ++i)
        if ((status = setWindow(task, windows[i], i < 3 ? kLength : kAngle, settings.windows[i])) != kOk)
            return status;
    return activate(task, *process,
                    {StreamStart, Tool, WObj, DOToSensor, DIFromSensor, DataToSensor, DataFromSensor,
                     LpFilter, SampleRate, MaxPosDeviation, MaxSpeedDeviation},
                    settings);
}

Status rt_EGMActMove(TaskCore* task, Handle* EGMid, const data::Pose* SensorFrame, const float* SampleRate) {
    Status status = kOk;
    EgmProcess* process = connectedProcess(task, *EGMid, GuidanceMode::PathCorrection, status);
    if (process == nullptr) return status;
    GuidanceSettings settings;
    settings.mode = GuidanceMode::PathCorrection;
    settings.sensorFrame = lib::toFrame(*SensorFrame);
    ActArguments arguments{};
    arguments.sampleRate = SampleRate;
    return activate(task, *process, arguments, settings);
}

Status rt_EGMStreamStart(TaskCore* task, Handle* EGMid, const float* SampleRate) {
    Status status = kOk;
    EgmProcess* process = lib::egmProcess(task, *EGMid, status);
    if (process == nullptr) return status;
    if (process->state() != EgmProcess::State::Connected)
        return lib::egmMisused(
            task, "Streaming needs an EGM process that is set up (EGMSetupUC) and does not guide "
                  "the robot.");
    Time period = 0;
    if ((status = lib::egmPeriod(task, SampleRate, period)) != kOk) return status;
    const std::string problem = process->startStream(period);
    return problem.empty() ? kOk : lib::fail(task, err::ERR_UDPUC_COMM, problem);
}

Status rt_EGMStreamStop(TaskCore* task, Handle* EGMid) {
    Status status = kOk;
    EgmProcess* process = lib::egmProcess(task, *EGMid, status);
    if (process == nullptr) return status;
    process->stopStream();
    return kOk;
}
}

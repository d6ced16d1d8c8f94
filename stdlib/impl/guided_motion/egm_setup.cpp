// EGM: identities and sources of data (EGMGetId, EGMReset, EGMGetState, EGMSetup...).

#include "stdlib/impl/guided_motion/egm_asked.h"
#include "stdlib/impl/guided_motion/signal_partner.h"
#include "stdlib/impl/guided_motion/udp_partner.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/sockets/sockets.h"
#include "stdlib/impl/support/fail.h"

#include "natives/guided_motion.h"
#include "stdlib_constants.h"

#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>

using namespace rt;
using lib::EgmProcess;
using lib::EgmProcesses;
using lib::GuidanceMode;

namespace {

constexpr int kDefaultPort = 6510;

EgmProcesses& processesOf(TaskCore* task) {
    return EgmProcesses::of(taskOf(task).controller());
}

/// The arguments that all EGMSetup... have.
struct SetupArguments {
    Handle unit;
    Handle identity;
    std::string_view configuration;
    bool joint, pose, pathCorrection;
    bool looksAhead = false; ///< \LATR
};

SetupArguments common(const Handle* unit, const Handle* identity, const String* configuration, bool joint,
                      bool pose, bool pathCorrection, bool looksAhead) {
    return {*unit, *identity, configuration->view(), joint, pose, pathCorrection, looksAhead};
}

bool isNamed(const CfgInstance& instance, std::string_view name) {
    return rapid::config::sameName(instance.text("name"), name);
}

/// The names that a controller with the option has as long as its MOC.cfg does not define external motion data.
bool isPredefined(std::string_view name) {
    constexpr const char* kNames[] = {"default", "raw", "joint", "pose", "pathcorr", "path_corr"};
    return std::any_of(std::begin(kNames), std::end(kNames),
                       [&](const char* each) { return rapid::config::sameName(each, name); });
}

/// EXT_MOTION_DATA with this name; "default" is always there.
Status motionData(TaskCore* task, std::string_view name, lib::ExternalMotionData& data) {
    bool hasAny = false;
    for (const char* domain : {"MOC", "ROBOT"}) {
        for (const CfgInstance* instance : taskOf(task).controller().instances(domain, "EXT_MOTION_DATA")) {
            hasAny = true;
            if (!isNamed(*instance, name)) continue;
            double level = 1;
            (void)instance->number("ext_motion_level", level);
            (void)instance->number("ext_motion_filter_bandwidth", data.filterHz);
            (void)instance->number("ext_motion_Kp", data.gain);
            if (!instance->number("ramp_time", data.rampTime))
                (void)instance->number("ext_motion_ramp_time", data.rampTime);
            if (level == 0) data.filterHz = 0;
            return kOk;
        }
    }
    if (rapid::config::sameName(name, "default")) return kOk;
    if (!hasAny && isPredefined(name)) {
        if (rapid::config::sameName(name, "raw")) data.filterHz = 0;
        return kOk;
    }
    return lib::egmMisused(
        task, fmt::format("The configuration does not have external motion data named \"{}\". "
                          "Define EXT_MOTION_DATA with that name in MOC.cfg, or use \"default\".",
                          name));
}

/// Connects the process with what `makePartner` gives.
template <class MakePartner>
Status setUp(TaskCore* task, const SetupArguments& args, const float* timeout, MakePartner makePartner) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    EgmProcess* process = lib::egmProcess(task, args.identity, status);
    if (process == nullptr) return status;
    const MechanicalUnit* unit = lib::unitOf(task, args.unit, status);
    if (unit == nullptr) return status;
    if (!unit->isRobot || unit->group != lib::motionOf(task).group())
        return lib::egmMisused(task, unit->name +
                                         " is not the robot of this task, so this task cannot let it be "
                                         "guided. Name the robot of the task.");
    if (args.joint + args.pose + args.pathCorrection != 1)
        return lib::fail(task, err::ERR_ARGVALERR, "EGMSetup... needs one of \\Joint, \\Pose and \\PathCorr");
    if (timeout != nullptr && !(*timeout > 0 && std::isfinite(*timeout)))
        return lib::fail(task, err::ERR_ARGVALERR, "\\CommTimeout must be a time above 0 s");
    lib::ExternalMotionData data;
    if ((status = motionData(task, args.configuration, data)) != kOk) return status;
    const GuidanceMode mode = args.joint  ? GuidanceMode::Joint
                              : args.pose ? GuidanceMode::Pose
                                          : GuidanceMode::PathCorrection;
    std::unique_ptr<lib::Partner> partner;
    if ((status = makePartner(mode, *process, partner)) != kOk) return status;
    process->setLookAhead(args.looksAhead);
    process->connect(mode, std::move(partner), data, timeout != nullptr ? fromSeconds(*timeout) : kSecond);
    return kOk;
}

Status setUpSignals(TaskCore* task, const SetupArguments& args, const std::array<Handle*, 12>& variables) {
    lib::GuidingSignals signals{};
    IoSystem& io = taskOf(task).controller().io();
    for (std::size_t i = 0; i < variables.size(); ++i) {
        if (variables[i] == nullptr) continue;
        signals[i] = *variables[i];
        Status status = kOk;
        if (lib::signalOf(task, signals[i], status) < 0) return status;
    }
    return setUp(task, args, nullptr,
                 [&](GuidanceMode mode, EgmProcess& process, std::unique_ptr<lib::Partner>& partner) {
                     partner = std::make_unique<lib::SignalPartner>(io, signals, mode,
                                                                    [&process] { process.wake(); });
                     return kOk;
                 });
}

/// The device of SIO.cfg: UDPUC_HOST (RobotWare 7), or COM_TRP of type UDPUC. A colon after its name does not count.
const CfgInstance* findDevice(Controller& controller, std::string_view name) {
    if (name.ends_with(':')) name.remove_suffix(1);
    for (const CfgInstance* instance : controller.instances("SIO", "UDPUC_HOST"))
        if (isNamed(*instance, name)) return instance;
    for (const CfgInstance* instance : controller.instances("SIO", "COM_TRP"))
        if (isNamed(*instance, name) && rapid::config::sameName(instance->text("type"), "UDPUC"))
            return instance;
    return nullptr;
}

Status portOf(TaskCore* task, const CfgInstance& device, const char* name, int fallback, uint16_t& port) {
    double number = fallback;
    (void)device.number(name, number);
    if (!(number >= (fallback == 0 ? 0 : 1) && number <= UINT16_MAX && std::trunc(number) == number))
        return lib::fail(task, err::ERR_UDPUC_COMM,
                         fmt::format("{} of the device in SIO.cfg must be a port from 1 to 65535", name));
    port = static_cast<uint16_t>(number);
    return kOk;
}

Status addressOf(TaskCore* task, const CfgInstance& device, net::Address& address, uint16_t& localPort) {
    const std::string ip = device.text("RemoteAdress", device.text("RemoteAddress"));
    if (!net::parseIp(ip, address.ip) || address.ip == net::kAnyAddress)
        return lib::fail(
            task, err::ERR_UDPUC_COMM,
            fmt::format("RemoteAdress of the device in SIO.cfg is \"{}\"; write an address such as "
                        "\"127.0.0.1\"",
                        ip));
    const char* const portName =
        device.find("RemotePortNumber") != nullptr ? "RemotePortNumber" : "RemotePort";
    if (const Status status = portOf(task, device, portName, kDefaultPort, address.port)) return status;
    return portOf(task, device, "LocalPortNumber", 0, localPort);
}

} // namespace

extern "C" {

/// A variable that has an identity already keeps it.
Status rt_EGMGetId(TaskCore* task, Handle* EGMid) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    EgmProcesses& processes = processesOf(task);
    if (processes.find(*EGMid) != nullptr || processes.reserve(taskOf(task), *EGMid) != nullptr) return kOk;
    return lib::egmMisused(task, "All 4 EGM processes are in use. Release one with EGMReset first.");
}

/// No effect on a variable without identity.
Status rt_EGMReset(TaskCore* task, Handle* EGMid) {
    Status status = kOk;
    if (processesOf(task).find(*EGMid) != nullptr) {
        if (lib::egmProcess(task, *EGMid, status) == nullptr) return status;
        processesOf(task).release(*EGMid);
    }
    *EGMid = 0;
    return kOk;
}

Status rt_EGMGetState(TaskCore* task, float* result, Handle* EGMid) {
    const EgmProcess* process = processesOf(task).find(*EGMid);
    *result = process == nullptr ? k::EGM_STATE_DISCONNECTED : static_cast<float>(process->state());
    return kOk;
}

Status rt_EGMSetupUC(TaskCore* task, Handle* MecUnit, Handle* EGMid, const String* ExtConfigName,
                     const String* UCDevice, bool Joint, bool Pose, bool PathCorr, bool, bool LATR,
                     const float* CommTimeout) {
    return setUp(
        task, common(MecUnit, EGMid, ExtConfigName, Joint, Pose, PathCorr, LATR), CommTimeout,
        [&](GuidanceMode mode, EgmProcess&, std::unique_ptr<lib::Partner>& partner) -> Status {
            Task& owner = taskOf(task);
            const CfgInstance* device = findDevice(owner.controller(), UCDevice->view());
            if (device == nullptr)
                return lib::fail(
                    task, err::ERR_UDPUC_COMM,
                    fmt::format("SIO.cfg has no UDPUC_HOST, and no COM_TRP of type UDPUC, named \"{}\"",
                                UCDevice->view()));
            net::Address address;
            uint16_t localPort = 0;
            if (const Status status = addressOf(task, *device, address, localPort)) return status;
            partner = std::make_unique<lib::UdpPartner>(
                lib::Sockets::of(owner.controller()).network(), owner.controller().service<lib::UdpDevices>(),
                owner, lib::UdpDevice{device->text("name"), address, localPort}, mode);
            return kOk;
        });
}

Status rt_EGMSetupAI(TaskCore* task, Handle* MecUnit, Handle* EGMid, const String* ExtConfigName, bool Joint,
                     bool Pose, bool PathCorr, bool, bool LATR, Handle* aiR1x, Handle* aiR2y, Handle* aiR3z,
                     Handle* aiR4rx, Handle* aiR5ry, Handle* aiR6rz, Handle* aiE1, Handle* aiE2, Handle* aiE3,
                     Handle* aiE4, Handle* aiE5, Handle* aiE6) {
    return setUpSignals(task, common(MecUnit, EGMid, ExtConfigName, Joint, Pose, PathCorr, LATR),
                        {aiR1x, aiR2y, aiR3z, aiR4rx, aiR5ry, aiR6rz, aiE1, aiE2, aiE3, aiE4, aiE5, aiE6});
}

Status rt_EGMSetupAO(TaskCore* task, Handle* MecUnit, Handle* EGMid, const String* ExtConfigName, bool Joint,
                     bool Pose, bool PathCorr, bool, bool LATR, Handle* aoR1x, Handle* aoR2y, Handle* aoR3z,
                     Handle* aoR4rx, Handle* aoR5ry, Handle* aoR6rz, Handle* aoE1, Handle* aoE2, Handle* aoE3,
                     Handle* aoE4, Handle* aoE5, Handle* aoE6) {
    return setUpSignals(task, common(MecUnit, EGMid, ExtConfigName, Joint, Pose, PathCorr, LATR),
                        {aoR1x, aoR2y, aoR3z, aoR4rx, aoR5ry, aoR6rz, aoE1, aoE2, aoE3, aoE4, aoE5, aoE6});
}

Status rt_EGMSetupGI(TaskCore* task, Handle* MecUnit, Handle* EGMid, const String* ExtConfigName, bool Joint,
                     bool Pose, bool PathCorr, bool, bool LATR, Handle* giR1x, Handle* giR2y, Handle* giR3z,
                     Handle* giR4rx, Handle* giR5ry, Handle* giR6rz, Handle* giE1, Handle* giE2, Handle* giE3,
                     Handle* giE4, Handle* giE5, Handle* giE6) {
    return setUpSignals(task, common(MecUnit, EGMid, ExtConfigName, Joint, Pose, PathCorr, LATR),
                        {giR1x, giR2y, giR3z, giR4rx, giR5ry, giR6rz, giE1, giE2, giE3, giE4, giE5, giE6});
}

/// No sensor with this protocol can be connected: the path is not corrected.
Status rt_EGMSetupLTAPP(TaskCore* task, Handle* MecUnit, Handle* EGMid, const String* ExtConfigName,
                        const String*, float, bool, bool) {
    return setUp(task, common(MecUnit, EGMid, ExtConfigName, false, false, true, false), nullptr,
                 [](GuidanceMode, EgmProcess&, std::unique_ptr<lib::Partner>&) { return kOk; });
}
}

#include "runtime/host/system_outputs.h"

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "runtime/host/panel_switches.h"
#include "runtime/host/system_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rt {
namespace {

constexpr Time kSpeedPeriod = 24 * kMillisecond; // of analog signals

} // namespace

SystemOutputs::State SystemOutputs::stateOf(std::string_view word) {
    static constexpr std::pair<const char*, State> kStates[] = {
        {"AutoOn", State::Auto},
        {"CycleOn", State::CycleOn},
        {"TaskExecuting", State::TaskExecuting},
        {"ProdExec", State::Production},
        {"ProductionExec", State::Production},
        {"MechUnitNotMoving", State::NotMoving},
        {"MechUnitActive", State::UnitActive},
        {"Error", State::Error},
        {"ExecutionError", State::Error},
        {"ProdExecError", State::ProductionError},
        {"MotorOn", State::MotorsOn},
        {"MotOnState", State::MotorsOn},
        {"MotorOff", State::MotorsOff},
        {"MotOffState", State::MotorsOff},
        {"EmStop", State::EmergencyStop},
        {"MotSupTrigg", State::SupervisionTriggered},
        {"MotSupOn", State::Always},
        {"RunchOk", State::Always},
        {"PathReturnRegion", State::Always},
        {"AbsAcc", State::Always},
        {"LimitSpeed", State::SpeedLimited},
        {"PPMoved", State::PointerMoved},
        {"PowerFail", State::PathLost},
        {"PowerFailError", State::PathLost},
        {"PFError", State::PathLost},
        {"SimMode", State::SimulationMode},
        {"TCPSpeed", State::Speed},
        {"TCPSpeedRef", State::Speed},
        {"SpeedOverride", State::SpeedOverride},
        {"BackupError", State::BackupError},
        {"BackupInProgress", State::BackupInProgress},
        {"Blocked I/O", State::Never},
        {"CollAvoidance", State::Never},
        {"CPUFanNotRun", State::Never},
        {"EnergySaving", State::Never},
        {"EnergySavingBlocked", State::Never},
        {"SMBBatteryLow", State::Never},
        {"SysInputBusy", State::Never},
        {"TempWarning", State::Never},
        {"WriteAccess", State::Never},
    };
    return wordIn(kStates, word);
}

void SystemOutputs::configure(const CfgFile& file, std::vector<CfgProblem>& problems) {
    for (const CfgSection* section : file.find("SYSSIG_OUT")) {
        for (const CfgInstance& instance : section->instances) {
            const std::string word = instance.text("Status");
            Output output{systemSignal(controller_.io(), file.name, instance, problems), stateOf(word),
                          instance.text("Arg2"), instance.text("Arg1")};
            if (output.state == State::Unknown)
                problems.push_back({file.name, instance.line,
                                    fmt::format("system output: status '{}' is not known here; its signal "
                                                "keeps its value",
                                                word),
                                    true});
            if (output.signal >= 0 && output.state != State::Unknown) outputs_.push_back(std::move(output));
        }
    }
    if (!outputs_.empty() && !std::exchange(listens_, true)) listen();
}

void SystemOutputs::listen() {
    controller_.log().addListener([this](const Event& event) { note(event); });
}

/// Keeps what no state shows afterwards.
void SystemOutputs::note(const Event& event) {
    if (event.number == static_cast<int>(EventId::ProgramPointerReset)) pointerMoved_ = true;
    if (event.number == static_cast<int>(EventId::Collision) && event.arguments.size() > 1)
        triggered_.insert(upperCase(event.arguments[1]));
}

bool SystemOutputs::isExecuting(const std::string& task) const {
    const auto& tasks = controller_.tasks();
    return std::any_of(tasks.begin(), tasks.end(), [&](const std::unique_ptr<Task>& one) {
        return (task.empty() ? one->kind() == TaskKind::Normal : sameName(one->name(), task)) &&
               one->isExecuting();
    });
}

/// Until the next start, or until the system input ResetError.
bool SystemOutputs::hasError(const std::string& task) {
    bool& isReset = controller_.service<PanelSwitches>().errorReset;
    const bool anyError = controller_.stoppedByError();
    if (!anyError) isReset = false;
    if (!anyError || isReset) return false;
    const Task* one = task.empty() ? nullptr : controller_.findTask(task);
    return one == nullptr || one->stopCause() == StopCause::Error;
}

/// A unit of the configuration moves with its group; a name that is not known there concerns all.
bool SystemOutputs::concerns(const Output& output, const MotionDriver& motion) const {
    const MechanicalUnit* unit = controller_.units().find(output.unit);
    return unit == nullptr || unit->isConveyor || unit->group == motion.group();
}

double SystemOutputs::valueOfMotion(const Output& output) const {
    double speed = 0;
    bool moves = false, limited = true, lost = false;
    int percent = 100;
    for (const auto& motion : controller_.motions()) {
        if (output.unit.empty() || sameName(output.unit, motion->unitName()))
            limited = limited && motion->isSpeedLimited();
        if (!concerns(output, *motion)) continue;
        moves = moves || motion->isMoving();
        lost = lost || motion->hasLostIndependentAxis();
        percent = static_cast<int>(motion->system().speedOverride());
        speed = std::max(speed, motion->system().current().tcpSpeed / 1000);
    }
    switch (output.state) {
    case State::NotMoving: return moves ? 0 : 1;
    case State::SpeedLimited: return limited ? 1 : 0;
    case State::PathLost: return lost ? 1 : 0;
    case State::SpeedOverride: return percent;
    default: return speed;
    }
}

double SystemOutputs::valueOf(const Output& output) {
    const PanelSwitches& panel = controller_.service<PanelSwitches>();
    switch (output.state) {
    case State::Unknown:
    case State::Never: return 0;
    case State::Always: return 1;
    case State::Auto: return panel.mode == OperatingMode::Auto ? 1 : 0;
    case State::CycleOn: return isExecuting("") ? 1 : 0;
    case State::TaskExecuting: return isExecuting(output.task) ? 1 : 0;
    case State::Production: return panel.mode == OperatingMode::Auto && isExecuting("") ? 1 : 0;
    case State::Error: return hasError(output.task) ? 1 : 0;
    case State::ProductionError: return panel.mode == OperatingMode::Auto && hasError("") ? 1 : 0;
    case State::MotorsOn: return controller_.motorsOn() ? 1 : 0;
    case State::MotorsOff: return controller_.motorsOn() ? 0 : 1;
    case State::EmergencyStop: return panel.emergencyStop ? 1 : 0;
    case State::SupervisionTriggered:
        return output.unit.empty()                           ? !triggered_.empty()
               : triggered_.contains(upperCase(output.unit)) ? 1
                                                             : 0;
    case State::UnitActive: return isActive(output.unit) ? 1 : 0;
    case State::PointerMoved: return pointerMoved_ ? 1 : 0;
    case State::SimulationMode: return panel.simulationMode ? 1 : 0;
    case State::BackupInProgress: return panel.backupInProgress ? 1 : 0;
    case State::BackupError: return panel.backupFailed ? 1 : 0;
    case State::NotMoving:
    case State::SpeedLimited:
    case State::PathLost:
    case State::Speed:
    case State::SpeedOverride: return valueOfMotion(output);
    }
    return 0;
}

/// Robots always are.
bool SystemOutputs::isActive(const std::string& unit) const {
    const MechanicalUnit* found = controller_.units().find(unit);
    return found != nullptr && (found->isRobot || found->isActive);
}

void SystemOutputs::update() {
    if (outputs_.empty()) return;
    const bool executes = isExecuting("");
    if (executes && !std::exchange(wasExecuting_, executes)) {
        triggered_.clear();
        pointerMoved_ = false;
    }
    wasExecuting_ = executes;
    const Time now = controller_.scheduler().now();
    const bool speeds = now >= nextSpeed_;
    if (speeds) nextSpeed_ = addTime(now, kSpeedPeriod);
    for (const Output& output : outputs_)
        if (output.state != State::Speed || speeds)
            (void)controller_.io().force(output.signal, valueOf(output));
}

} // namespace rt

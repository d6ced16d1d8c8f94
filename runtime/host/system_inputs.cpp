#include "runtime/host/system_inputs.h"

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "runtime/host/panel_switches.h"
#include "runtime/host/system_orders.h"
#include "runtime/host/system_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rt {
namespace {

constexpr std::size_t kArguments = 6;

bool isPath(const std::string& text) {
    return text.find_first_of(":/\\") != std::string::npos;
}

} // namespace

bool SystemInputs::Input::isOnce() const {
    return std::any_of(arguments.begin(), arguments.end(),
                       [](const std::string& text) { return sameName(text, "CYCLE"); });
}

SystemInputs::Order SystemInputs::orderOf(std::string_view action) {
    static constexpr std::pair<const char*, Order> kOrders[] = {
        {"Start", Order::Start},
        {"StartMain", Order::StartMain},
        {"Stop", Order::Stop},
        {"QuickStop", Order::QuickStop},
        {"SoftStop", Order::Stop},
        {"StopCycle", Order::StopCycle},
        {"StopInstr", Order::StopInstruction},
        {"MotorOn", Order::MotorOn},
        {"MotOn", Order::MotorOn},
        {"MotorOff", Order::MotorOff},
        {"MotOff", Order::MotorOff},
        {"MotorOnStart", Order::MotorOnStart},
        {"MotOnStart", Order::MotorOnStart},
        {"PPtoMain", Order::PpToMain},
        {"ResetError", Order::ResetError},
        {"ResetEstop", Order::ResetEmergencyStop},
        {"LimitSpeed", Order::LimitSpeed},
        {"SimMode", Order::SimulationMode},
        {"Interrupt", Order::Interrupt},
        {"Load", Order::Load},
        {"LoadStart", Order::LoadStart},
        {"Backup", Order::Backup},
        {"SysReset", Order::Restart},
        {"DisableBackup", Order::None},
        {"EnergySaving", Order::None},
        {"CollAvoidance", Order::None},
        {"WriteAccess", Order::None},
        {"Verify", Order::None},
        {"ProfiSafeOpAck", Order::None},
    };
    return wordIn(kOrders, action);
}

/// An input whose action is not known keeps its signal.
void SystemInputs::configure(const CfgFile& file, std::vector<CfgProblem>& problems) {
    for (const CfgSection* section : file.find("SYSSIG_IN")) {
        for (const CfgInstance& instance : section->instances) {
            Input input;
            input.signal = systemSignal(controller_.io(), file.name, instance, problems);
            input.action = instance.text("Action");
            input.order = orderOf(input.action);
            for (std::size_t i = 1; i <= kArguments; ++i)
                input.arguments.push_back(instance.text(fmt::format("Arg{}", i)));
            if (input.order == Order::Unknown)
                problems.push_back(
                    {file.name, instance.line,
                     fmt::format("system input: action '{}' is not known here and does nothing",
                                 input.action),
                     true});
            if (input.signal < 0 || input.order == Order::Unknown || input.order == Order::None) continue;
            inputs_.push_back(input);
            // From the scheduler, since a task may have caused the change by a cross connection.
            controller_.io().addListener(input.signal, [this, input](SignalId, double, double value) {
                const bool isLevel = input.order == Order::LimitSpeed || input.order == Order::SimulationMode;
                if (!isLevel && controller_.service<SystemOrdersSlot>().valuesAreKept) return;
                controller_.scheduler().after(0, [this, input, value] { change(input, value != 0); });
            });
        }
    }
}

bool SystemInputs::isStart(SignalId signal) const {
    return std::any_of(inputs_.begin(), inputs_.end(), [signal](const Input& input) {
        return input.signal == signal && input.order >= Order::Start && input.order <= Order::LoadStart;
    });
}

/// Orders that make the robot move need automatic mode.
bool SystemInputs::worksInManualMode(Order order) {
    switch (order) {
    case Order::Start:
    case Order::StartMain:
    case Order::MotorOnStart:
    case Order::LoadStart:
    case Order::Load:
    case Order::MotorOn:
    case Order::PpToMain:
    case Order::Interrupt:
    case Order::Restart: return false;
    default: return true;
    }
}

void SystemInputs::change(const Input& input, bool on) {
    if (input.order == Order::LimitSpeed) return limitSpeed(input.argument(6), on);
    if (input.order == Order::SimulationMode) {
        controller_.service<PanelSwitches>().simulationMode = on;
        return;
    }
    if (!on) return;
    std::string why = "the controller is in manual mode";
    if (controller_.service<PanelSwitches>().mode == OperatingMode::Auto || worksInManualMode(input.order))
        why = carryOut(input);
    if (!why.empty())
        controller_.log().write(EventId::SystemInputRefused, nullptr,
                                {input.action, controller_.io().config(input.signal).name, why});
}

std::string SystemInputs::carryOut(const Input& input) {
    SystemOrders& orders = systemOrders(controller_);
    switch (input.order) {
    case Order::Start: return start(input);
    case Order::StartMain: {
        std::string why = orders.pointersToMain();
        return why.empty() ? start(input) : why;
    }
    case Order::MotorOnStart: {
        std::string why = orders.motors(true);
        return why.empty() ? start(input) : why;
    }
    case Order::LoadStart:
    case Order::Load: return loadProgram(input);
    case Order::Stop: return orders.stop(SystemOrders::Stop::Normal);
    case Order::QuickStop: return orders.stop(SystemOrders::Stop::Quick);
    case Order::StopCycle: return orders.stop(SystemOrders::Stop::Cycle);
    case Order::StopInstruction: return orders.stop(SystemOrders::Stop::Instruction);
    case Order::MotorOn: return orders.motors(true);
    case Order::MotorOff: return orders.motors(false);
    case Order::PpToMain: return orders.pointersToMain();
    case Order::ResetError: controller_.service<PanelSwitches>().errorReset = true; return {};
    case Order::ResetEmergencyStop: return orders.resetEmergencyStop();
    case Order::Interrupt: return interrupt(input);
    case Order::Backup: {
        const auto path = std::find_if(input.arguments.begin(), input.arguments.end(), isPath);
        return orders.backup(path != input.arguments.end() ? *path : "BACKUP:/" + input.argument(1));
    }
    case Order::Restart: return orders.restart();
    case Order::Unknown:
    case Order::None:
    case Order::LimitSpeed:
    case Order::SimulationMode: break;
    }
    return {};
}

std::string SystemInputs::start(const Input& input) {
    return systemOrders(controller_).start(input.isOnce());
}

/// Arg1: the file; Arg2: the task.
std::string SystemInputs::loadProgram(const Input& input) {
    SystemOrders& orders = systemOrders(controller_);
    const std::string file = input.argument(1);
    if (file.empty()) return "Arg1 names no program file";
    if (std::string why = orders.loadProgram(input.argument(2), file); !why.empty()) return why;
    return input.order == Order::LoadStart ? start(input) : std::string();
}

/// The task of that name; "": the first NORMAL one.
Task* SystemInputs::taskNamed(const std::string& name) const {
    if (!name.empty()) return controller_.findTask(name);
    for (const auto& task : controller_.tasks())
        if (task->kind() == TaskKind::Normal) return task.get();
    return nullptr;
}

/// Arg1: a routine without parameters, Arg2: the task. An executing task executes it as a trap routine, a stopped one as an event
/// routine, and both are afterwards where they were.
std::string SystemInputs::interrupt(const Input& input) {
    Task* task = taskNamed(input.argument(2));
    if (task == nullptr) return fmt::format("there is no task {}", input.argument(2));
    const RoutineEntry* routine = controller_.findRoutine(input.argument(1), "", *task);
    if (routine == nullptr || routine->address == nullptr || routine->desc->callable == 0)
        return fmt::format("task {} has no routine {} without parameters", task->name(), input.argument(1));
    const auto call = [name = input.argument(1)](Task& owner, Frame* caller) -> Status {
        // It may have been unloaded meanwhile.
        const RoutineEntry* found = owner.controller().findRoutine(name, "", owner);
        if (found == nullptr || found->address == nullptr || found->desc->callable == 0) return kOk;
        return reinterpret_cast<EntryFunction>(found->address)(&owner, caller);
    };
    if (!task->isStopped())
        task->interrupts().postCall(call);
    else if (task->state() == TaskState::Finished || task->events().isVisited())
        return fmt::format("task {} cannot execute a routine now", task->name());
    else
        task->events().order(call);
    return {};
}

void SystemInputs::limitSpeed(const std::string& unit, bool on) {
    for (const auto& motion : controller_.motions())
        if (unit.empty() || sameName(unit, motion->unitName())) motion->limitSpeed(on);
}

} // namespace rt

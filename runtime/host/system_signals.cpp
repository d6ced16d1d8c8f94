#include "runtime/host/system_signals.h"

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rt {
namespace {

/// Looks a word of the configuration up; the first entry of the enumeration when it is not in the table.
template <class T, std::size_t N>
T lookUp(const std::pair<const char*, T> (&table)[N], std::string_view word) {
    for (const auto& [name, value] : table) {
        if (sameName(name, word)) return value;
    }
    return T{};
}

} // namespace

void SystemSignals::configure(const CfgFile& file, std::vector<CfgProblem>& problems) {
    static constexpr std::pair<const char*, Order> kOrders[] = {
        {"Start", Order::Start},         {"StartMain", Order::StartMain},   {"Stop", Order::Stop},
        {"QuickStop", Order::QuickStop}, {"SoftStop", Order::Stop},         {"StopInstr", Order::Stop},
        {"PPtoMain", Order::PpToMain},   {"LimitSpeed", Order::LimitSpeed},
    };
    static constexpr std::pair<const char*, State> kStates[] = {
        {"CycleOn", State::CycleOn},
        {"TaskExecuting", State::TaskExecuting},
        {"MechUnitNotMoving", State::NotMoving},
        {"MechUnitActive", State::UnitActive},
        {"Error", State::Error},
        {"ExecutionError", State::Error},
        {"AutoOn", State::On},
        {"MotorOn", State::MotorsOn},
        {"MotOnState", State::MotorsOn},
        {"MotorOff", State::MotorsOff},
        {"MotOffState", State::MotorsOff},
        {"RunchOk", State::On},
        {"MotSupOn", State::On},
        {"LimitSpeed", State::SpeedLimited},
    };
    const auto signalOf = [&](const CfgInstance& instance) {
        const std::string name = instance.text("Signal");
        const SignalId id = controller_.io().find(name);
        if (id < 0) {
            problems.push_back(
                {file.name, instance.line,
                 name.empty()
                     ? "system signal without a signal: add -Signal and its name"
                     : fmt::format("system signal: signal '{}' is not defined; add it to EIO_SIGNAL", name),
                 true});
        }
        return id;
    };
    for (const CfgSection* section : file.find("SYSSIG_IN")) {
        for (const CfgInstance& instance : section->instances) {
            const Input input{signalOf(instance), lookUp(kOrders, instance.text("Action")),
                              instance.text("Arg6")};
            if (input.signal < 0 || input.order == Order::None) continue;
            inputs_.push_back(input);
            controller_.io().addListener(input.signal, [this, input](SignalId, double, double value) {
                // From the scheduler, since a task may have caused the change by a cross connection.
                if (input.order == Order::LimitSpeed)
                    controller_.scheduler().after(0, [=, this] { limitSpeed(input.unit, value != 0); });
                else if (value != 0)
                    controller_.scheduler().after(0, [this, input] { carryOut(input.order); });
            });
        }
    }
    for (const CfgSection* section : file.find("SYSSIG_OUT")) {
        for (const CfgInstance& instance : section->instances) {
            Output output{signalOf(instance), lookUp(kStates, instance.text("Status")), instance.text("Arg2"),
                          instance.text("Arg1")};
            if (output.signal >= 0 && output.state != State::None) outputs_.push_back(std::move(output));
        }
    }
}

bool SystemSignals::isStart(SignalId signal) const {
    return std::any_of(inputs_.begin(), inputs_.end(), [signal](const Input& input) {
        return input.signal == signal && (input.order == Order::Start || input.order == Order::StartMain);
    });
}

void SystemSignals::carryOut(Order order) {
    switch (order) {
    case Order::None:
    case Order::LimitSpeed: return;
    case Order::Stop: controller_.actionStop(); return;
    case Order::QuickStop: controller_.actionStop(SystemEvent::QuickStop); return;
    case Order::Start: controller_.actionStart(); return;
    case Order::PpToMain: controller_.actionPpToMain(); return;
    case Order::StartMain:
        controller_.actionPpToMain();
        controller_.actionStart();
        return;
    }
}

void SystemSignals::limitSpeed(const std::string& unit, bool on) {
    for (const auto& motion : controller_.motions())
        if (unit.empty() || sameName(unit, motion->unitName())) motion->limitSpeed(on);
    update();
}

double SystemSignals::stateValue(const Output& output) const {
    const auto executing = [](const std::unique_ptr<Task>& task) {
        return task->kind() == TaskKind::Normal && task->isExecuting();
    };
    // A unit of the configuration moves with its group; a name that is not known there concerns all.
    const MechanicalUnit* unit = controller_.units().find(output.unit);
    const auto concerns = [unit](const auto& motion) {
        return unit == nullptr || unit->isConveyor || unit->group == motion->group();
    };
    const auto& tasks = controller_.tasks();
    switch (output.state) {
    case State::CycleOn: return std::any_of(tasks.begin(), tasks.end(), executing) ? 1 : 0;
    case State::TaskExecuting: {
        const Task* task = controller_.findTask(output.task);
        return task != nullptr && task->isExecuting() ? 1 : 0;
    }
    case State::NotMoving:
        return std::any_of(controller_.motions().begin(), controller_.motions().end(),
                           [&](const auto& motion) { return motion->isMoving() && concerns(motion); })
                   ? 0
                   : 1;
    case State::UnitActive: return isActive(output.unit) ? 1 : 0;
    case State::SpeedLimited:
        return std::all_of(controller_.motions().begin(), controller_.motions().end(),
                           [&](const auto& motion) {
                               return motion->isSpeedLimited() ||
                                      !(output.unit.empty() || sameName(output.unit, motion->unitName()));
                           })
                   ? 1
                   : 0;
    case State::Error: return controller_.stoppedByError() ? 1 : 0;
    case State::MotorsOn: return controller_.motorsOn() ? 1 : 0;
    case State::MotorsOff: return controller_.motorsOn() ? 0 : 1;
    case State::None:
    case State::On: break;
    }
    return 1;
}

/// Robots always are.
bool SystemSignals::isActive(const std::string& unit) const {
    const MechanicalUnit* found = controller_.units().find(unit);
    return found != nullptr && (found->isRobot || found->isActive);
}

void SystemSignals::update() {
    for (const Output& output : outputs_)
        (void)controller_.io().force(output.signal, stateValue(output));
}

} // namespace rt

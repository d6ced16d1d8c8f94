#include "runtime/host/system_orders.h"

#include "runtime/host/controller.h"
#include "runtime/host/panel_switches.h"

#include <fmt/format.h>

namespace rt {
namespace {

/// Orders of a run from beginning to end.
class RunOrders final : public SystemOrders {
  public:
    explicit RunOrders(Controller& controller) : controller_(controller) {}

    std::string motors(bool on) override {
        controller_.actionMotors(on);
        return {};
    }
    std::string resetEmergencyStop() override {
        controller_.service<PanelSwitches>().emergencyStop = false;
        return {};
    }
    std::string start(bool once) override {
        controller_.setRunOnce(once);
        controller_.actionStart();
        return {};
    }
    std::string stop(Stop kind) override {
        switch (kind) {
        case Stop::Cycle: controller_.setRunOnce(true); break;
        case Stop::Quick: controller_.actionStop(SystemEvent::QuickStop); break;
        case Stop::Instruction:
        case Stop::Normal: controller_.actionStop(); break;
        }
        return {};
    }
    std::string pointersToMain() override {
        controller_.actionPpToMain();
        return {};
    }
    std::string loadProgram(const std::string& /*task*/, const std::string& file) override {
        return fmt::format("{} cannot be loaded during a run; rapidc serve can", file);
    }
    std::string backup(const std::string& /*folder*/) override {
        return "a run writes no backups; rapidc serve does";
    }
    std::string restart() override { return "a run is not restarted; rapidc serve does that"; }

  private:
    Controller& controller_;
};

} // namespace

SystemOrders& systemOrders(Controller& controller) {
    auto& slot = controller.service<SystemOrdersSlot>();
    if (slot.host != nullptr) return *slot.host;
    if (slot.run == nullptr) slot.run = std::make_unique<RunOrders>(controller);
    return *slot.run;
}

} // namespace rt

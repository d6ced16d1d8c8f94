#pragma once
// PanelOrders: what system inputs order, carried out by the long-lived controller.

#include "runtime/host/system_orders.h"

#include <functional>
#include <string>

namespace rapidc::service {

class VirtualController;

class PanelOrders final : public rt::SystemOrders {
  public:
    explicit PanelOrders(VirtualController& controller) : controller_(controller) {}

    /// The writer of backups: gets the folder as RAPID names it, answers why not, or "".
    void setBackup(std::function<std::string(const std::string& folder)> write) {
        backup_ = std::move(write);
    }

    std::string motors(bool on) override;
    std::string resetEmergencyStop() override;
    std::string start(bool once) override;
    std::string stop(Stop kind) override;
    std::string pointersToMain() override;
    std::string loadProgram(const std::string& task, const std::string& file) override;
    std::string backup(const std::string& folder) override;
    std::string restart() override;

  private:
    VirtualController& controller_;
    std::function<std::string(const std::string& folder)> backup_;
};

} // namespace rapidc::service

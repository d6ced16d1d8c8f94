#pragma once
// SystemOrders: what system inputs order (SYSSIG_IN). A host that keeps a controller for long (its panel, its program memory) gives its
// own; otherwise the run carries them out as far as it can.

#include <cstdint>
#include <memory>
#include <string>

namespace rt {

class Controller;

/// Each order returns why it cannot be carried out, or "".
class SystemOrders {
  public:
    enum class Stop : uint8_t { Normal, Quick, Cycle, Instruction };

    SystemOrders() = default;
    virtual ~SystemOrders() = default;
    SystemOrders(const SystemOrders&) = delete;
    SystemOrders& operator=(const SystemOrders&) = delete;

    virtual std::string motors(bool on) = 0;
    /// After the button of the emergency stop was released.
    virtual std::string resetEmergencyStop() = 0;
    /// `once`: one cycle; else for ever.
    virtual std::string start(bool once) = 0;
    virtual std::string stop(Stop kind) = 0;
    virtual std::string pointersToMain() = 0;
    /// A program file or a module, as RAPID names it ("HOME:/main.pgf"), in place of the program of the task. `task` "": the first one.
    virtual std::string loadProgram(const std::string& task, const std::string& file) = 0;
    /// Into a new folder of that name, as RAPID names it ("BACKUP:/line1").
    virtual std::string backup(const std::string& folder) = 0;
    /// Of the controller; takes effect soon.
    virtual std::string restart() = 0;
};

/// A service of the Controller.
struct SystemOrdersSlot {
    SystemOrders* host = nullptr; ///< outlives the controller
    bool valuesAreKept = false;   ///< signals get values that they had before: a change to 1 gives no order
    std::unique_ptr<SystemOrders> run;
};

/// The orders of the host, else those of the run.
SystemOrders& systemOrders(Controller& controller);

} // namespace rt

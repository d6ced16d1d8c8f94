#pragma once
// SimulatedSensor: a sensor of the option Sensor Interface. It has variables, numbered from 0 to 65535, and data blocks.

#include "runtime/host/controller.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace rt::lib {

class SimulatedSensor {
  public:
    SimulatedSensor(Controller& controller, std::string device)
        : controller_(controller), device_(std::move(device)) {}

    /// Without its colon.
    const std::string& device() const { return device_; }
    /// The SEN_ error that it answers with now; kOk: none.
    Status fault() const;
    /// The latest value given by the stimulus or written by a program; nothing when there was none.
    std::optional<double> variable(int number) const;
    void setVariable(int number, double value);
    /// Null when it was never written.
    const std::string* block(int number) const;
    void setBlock(int number, std::string bytes) { blocks_[number] = std::move(bytes); }

  private:
    Controller& controller_;
    std::string device_;
    std::map<int, std::string> blocks_;
};

/// The sensors that programs have connected with SenDevice. A service of the controller.
class SimulatedSensors {
  public:
    /// False when SIO.cfg has no such device.
    bool connect(Controller& controller, std::string_view device);
    /// Null when it is not connected. A colon after the name does not count, nor does case.
    SimulatedSensor* find(std::string_view device) const;

  private:
    std::map<std::string, std::unique_ptr<SimulatedSensor>> sensors_; // names in capitals
};

} // namespace rt::lib

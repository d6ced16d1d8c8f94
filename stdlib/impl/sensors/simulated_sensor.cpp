#include "stdlib/impl/sensors/simulated_sensor.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/surroundings.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace rt::lib {
namespace {

/// In the order of the numbers that a stimulus gives `fault`, from 1.
constexpr Status kFaults[] = {err::SEN_NO_MEAS, err::SEN_NOREADY,  err::SEN_GENERRO, err::SEN_BUSY,
                              err::SEN_UNKNOWN, err::SEN_EXALARM,  err::SEN_CAALARM, err::SEN_TEMP,
                              err::SEN_VALUE,   err::SEN_CAMCHECK, err::SEN_TIMEOUT};

std::string_view plain(std::string_view device) {
    return device.substr(0, device.find(':'));
}

} // namespace

Status SimulatedSensor::fault() const {
    const double number = controller_.service<Surroundings>().value(device_, Surroundings::kFault);
    if (!(number >= 1)) return kOk;
    const auto index = static_cast<std::size_t>(number) - 1;
    return index < std::size(kFaults) ? kFaults[index] : err::SEN_GENERRO;
}

std::optional<double> SimulatedSensor::variable(int number) const {
    return controller_.service<Surroundings>().find(device_, Surroundings::kVariable, number);
}

void SimulatedSensor::setVariable(int number, double value) {
    controller_.service<Surroundings>().set({device_, fmt::format("{}_{}", Surroundings::kVariable, number)},
                                            value);
}

const std::string* SimulatedSensor::block(int number) const {
    const auto found = blocks_.find(number);
    return found == blocks_.end() ? nullptr : &found->second;
}

bool SimulatedSensors::connect(Controller& controller, std::string_view device) {
    for (const CfgInstance* instance : controller.instances("SIO", "COM_TRP")) {
        const std::string name = instance->text("name");
        if (!sameName(plain(name), plain(device)) || sameName(instance->text("type"), "UDPUC")) continue;
        std::unique_ptr<SimulatedSensor>& sensor = sensors_[upperCase(plain(device))];
        if (!sensor) sensor = std::make_unique<SimulatedSensor>(controller, std::string(plain(name)));
        return true;
    }
    return false;
}

SimulatedSensor* SimulatedSensors::find(std::string_view device) const {
    const auto found = sensors_.find(upperCase(plain(device)));
    return found == sensors_.end() ? nullptr : found->second.get();
}

} // namespace rt::lib

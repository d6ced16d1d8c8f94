#pragma once
// Conveyors: those of a controller, from PROC.cfg and MOC.cfg or from --conveyor. A service of the controller.

#include "runtime/host/conveyor.h"
#include "runtime/host/mechanical_units.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt {

class Controller;

class Conveyors {
  public:
    /// Null when no conveyor has this name; without regard to case.
    Conveyor* find(std::string_view name) const;
    const std::vector<std::unique_ptr<Conveyor>>& all() const { return all_; }
    void add(std::unique_ptr<Conveyor> conveyor) { all_.push_back(std::move(conveyor)); }

  private:
    std::vector<std::unique_ptr<Conveyor>> all_;
};

/// Reads "NAME=KEY:VALUE,KEY:VALUE ..." of --conveyor into settings. Returns what is wrong, or "".
std::string readConveyorOption(const std::string& text, ConveyorSettings& settings);
/// Names of the signals of a conveyor, with their RAPID types.
std::vector<std::pair<std::string, std::string>> conveyorSignals(const ConveyorSettings& settings);
/// Makes the conveyors of the controller, their units and signals: what --conveyor says counts more than the configuration.
/// Before signals and units are connected with the program. Returns what is wrong with the options, or "".
std::string openConveyors(Controller& controller, const std::vector<std::string>& options);

} // namespace rt

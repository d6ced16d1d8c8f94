#pragma once
// What programs are judged with and the front end does not know itself: the declarations of everything predefined, which of
// it is implemented, robots, conveyors, and the controller's own opinion of its configuration. Handed in by tools.

#include "config/cfg_parser.h"
#include "frontend/sema/checker.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::workspace {

/// A conveyor of the simulation: its mechanical unit, and its signals with their RAPID types.
struct ConveyorNames {
    std::string problem; ///< what cannot be read, for people; empty: success
    std::string unit;
    std::vector<sema::SignalInfo> signals;
};

/// A robtarget in numbers: mm, a unit quaternion, quarter revolutions.
struct TargetNumbers {
    double position[3] = {}, rotation[4] = {1, 0, 0, 0};
    int configuration[4] = {};
    double eaxA = 9e9; ///< arm angle of seven axes
};

class Environment {
  public:
    Environment() = default;
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    virtual ~Environment() = default;

    /// The declarations of everything predefined, with the same lines whether `documented` or without the text of the
    /// documentation. Good as long as the environment.
    virtual std::vector<sema::LibraryText> library(bool documented) const = 0;
    /// Names of the predefined routines that are declared and not implemented. Good as long as the environment.
    virtual std::vector<std::string_view> declaredOnly() const = 0;
    /// Why a robot model cannot be used, for people; empty when it is known.
    virtual std::string robotProblem(const std::string& model) const = 0;
    /// Whether a robot at the origin of the world reaches a target with its flange (tool0, wobj0), for people: the angles of its
    /// axes, or why it does not. Empty when the model is not known.
    virtual std::string reach(const std::string& model, const TargetNumbers& target) const = 0;
    /// Adds what a controller that starts with these files would find wrong with signals and cross connections.
    virtual void judgeSignals(std::vector<config::CfgProblem>& problems,
                              const std::vector<std::string>& names,
                              const std::vector<std::string>& texts) const = 0;
    /// Whether a mechanical unit of this name is a conveyor without any further configuration.
    virtual bool isConveyor(std::string_view unit) const = 0;
    /// Reads UNIT or UNIT=KEY:VALUE,...
    virtual ConveyorNames conveyor(const std::string& text) const = 0;
};

} // namespace rapid::workspace

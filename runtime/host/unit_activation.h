#pragma once
// Activation of external units: what ActUnit and DeactUnit do, and an operator by hand (manual 2.2).

#include <string>

namespace rt {

class Controller;
struct MechanicalUnit;

/// "" or why the unit cannot be activated or deactivated, for people.
std::string refusalOfActivation(const Controller& controller, const MechanicalUnit& unit, bool active);
/// Activates or deactivates it at once. refusalOfActivation() allows it, and its group is at rest.
void activateUnit(Controller& controller, MechanicalUnit& unit, bool active);

} // namespace rt

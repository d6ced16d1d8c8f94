#include "runtime/host/unit_activation.h"

#include "runtime/host/controller.h"

namespace rt {

std::string refusalOfActivation(const Controller& controller, const MechanicalUnit& unit, bool active) {
    if (unit.isRobot)
        return unit.name + " is a robot: it is always active, and only additional axes can be activated and "
                           "deactivated";
    if (!active && unit.staysActive)
        return unit.name + " must not be deactivated (MOC.cfg, deactivation_forbidden)";
    if (unit.isConveyor || unit.isActive == active) return {};
    if (const MechanicalUnit* other = active ? controller.units().sharesAxes(unit) : nullptr)
        return unit.name + " shares a logical axis with " + other->name +
               ", which is active: deactivate that first (DeactUnit)";
    for (const MechanicalUnit::Axis& axis : unit.own)
        if (controller.motions()[unit.group]->system().independent({true, axis.index}) != nullptr)
            return unit.name + " has an axis in independent mode: execute IndReset first";
    return {};
}

void activateUnit(Controller& controller, MechanicalUnit& unit, bool active) {
    MotionDriver& driver = *controller.motions()[unit.group];
    motion::JointTarget here = driver.system().currentJoints();
    controller.units().setActive(unit, active, here.extax);
    for (const MechanicalUnit::Axis& axis : unit.own) {
        motion::ExternalAxisModel model = axis.limits;
        model.present = active;
        driver.system().setExternalAxis(axis.index, model);
    }
    driver.system().placeAt(here);
    driver.refresh();
}

} // namespace rt

// Manual 1.8: mechanical units. The robot is always active. Activating and deactivating another unit changes nothing but
// what IsMechUnitActive and GetNextMechUnit say, for its axes are not simulated.

#include "stdlib/impl/motion/units.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace rt;

namespace {

/// Units that have been activated or deactivated since the controller was started.
struct UnitActivity {
    std::map<Handle, bool> active;
};

bool isActive(Controller& controller, const lib::MechanicalUnit& unit, Handle handle) {
    const auto& changed = controller.service<UnitActivity>().active;
    const auto found = changed.find(handle);
    return found == changed.end() ? unit.activeAtStart : found->second;
}

/// The unit of a variable; ERR_REFUNKDAT when the configuration does not define it.
Status unitOf(TaskCore* task, Handle handle, lib::MechanicalUnit& unit) {
    const std::vector<lib::MechanicalUnit> units = lib::mechanicalUnits(taskOf(task).controller());
    const auto index = static_cast<std::size_t>(handle - 1);
    if (handle < 1 || index >= units.size())
        return lib::fail(task, err::ERR_REFUNKDAT, "the configuration does not define this mechanical unit");
    unit = units[index];
    return kOk;
}

/// When the robot stands at a stop point.
Status setActive(TaskCore* task, Handle handle, bool active) {
    lib::MechanicalUnit unit;
    if (const Status status = unitOf(task, handle, unit)) return status;
    if (unit.tcpRobot)
        return lib::fail(task, err::ERR_ARGVALERR,
                         unit.name + " is a robot: it is always active, and only additional axes can be "
                                     "activated and deactivated");
    if (!active && unit.staysActive)
        return lib::fail(task, err::ERR_ARGVALERR,
                         unit.name + " must not be deactivated (MOC.cfg, deactivation_forbidden)");
    Controller& controller = taskOf(task).controller();
    if (const Status status = controller.motion().waitIdle(taskOf(task))) return status;
    controller.service<UnitActivity>().active[handle] = active;
    return kOk;
}

template <class T, class Value> void give(T* result, Value value) {
    if (result != nullptr) *result = static_cast<T>(value);
}

} // namespace

namespace rt::lib {

std::vector<MechanicalUnit> mechanicalUnits(Controller& controller) {
    constexpr int kRobotAxes = 6;
    std::vector<MechanicalUnit> units;
    for (const std::string& name : controller.mechanicalUnits())
        units.push_back({name, units.empty(), units.empty(), kRobotAxes, units.empty(), units.empty()});
    std::size_t next = 1;
    for (const char* type : {"ROBOT", "MECHANICAL_UNIT"}) {
        for (const CfgInstance* instance : controller.instances("MOC", type)) {
            if (next >= units.size() || instance->text("name") != units[next].name) continue;
            MechanicalUnit& unit = units[next++];
            unit.tcpRobot = type == std::string_view("ROBOT");
            unit.activeAtStart = unit.tcpRobot || instance->flag("activate_at_start_up");
            unit.staysActive = unit.tcpRobot || instance->flag("deactivation_forbidden");
            if (unit.tcpRobot) continue;
            unit.axes = static_cast<int>(std::count_if(
                instance->attributes.begin(), instance->attributes.end(),
                [](const auto& attribute) { return attribute.name.starts_with("use_single_"); }));
        }
    }
    return units;
}

int robotAxis(TaskCore* task, const Handle* unit, float axis, Status& status) {
    MechanicalUnit asked;
    asked.simulated = true;
    asked.axes = 6;
    status = unit == nullptr ? kOk : unitOf(task, *unit, asked);
    if (status != kOk) return -1;
    const bool isThere = axis == std::floor(axis) && axis >= 1 && axis <= static_cast<float>(asked.axes);
    if (isThere && asked.simulated) return static_cast<int>(axis) - 1;
    status = fail(task, err::ERR_AXIS_PAR,
                  isThere ? "the axes of this mechanical unit are not simulated"
                          : "the mechanical unit has no such axis");
    return -1;
}

} // namespace rt::lib

extern "C" {

Status rt_ActUnit(TaskCore* task, Handle* MechUnit) {
    return setActive(task, *MechUnit, true);
}

Status rt_DeactUnit(TaskCore* task, Handle* MechUnit) {
    return setActive(task, *MechUnit, false);
}

Status rt_IsMechUnitActive(TaskCore* task, bool* result, Handle* MechUnit) {
    lib::MechanicalUnit unit;
    if (const Status status = unitOf(task, *MechUnit, unit)) return status;
    *result = isActive(taskOf(task).controller(), unit, *MechUnit);
    return kOk;
}

/// One motion task and planner moves everything; units that are not simulated belong to drive module 1 as well.
Status rt_GetNextMechUnit(TaskCore* task, bool* result, float* ListNumber, String* UnitName, Handle* MecRef,
                          bool* TCPRob, float* NoOfAxes, float* MecTaskNo, float* MotPlanNo, bool* Active,
                          float* DriveModule, bool* OKToDeact) {
    Controller& controller = taskOf(task).controller();
    const std::vector<lib::MechanicalUnit> units = lib::mechanicalUnits(controller);
    *result = *ListNumber >= 0 && *ListNumber < static_cast<float>(units.size());
    if (!*result) return kOk;
    const auto index = static_cast<std::size_t>(*ListNumber);
    const auto handle = static_cast<Handle>(index + 1);
    const lib::MechanicalUnit& unit = units[index];
    *ListNumber = static_cast<float>(index + 1);
    UnitName->assign(unit.name);
    give(MecRef, handle);
    give(TCPRob, unit.tcpRobot);
    give(NoOfAxes, unit.axes);
    give(MecTaskNo, 1);
    give(MotPlanNo, 1);
    give(Active, isActive(controller, unit, handle));
    give(DriveModule, 1);
    give(OKToDeact, !unit.staysActive);
    return kOk;
}
}

// Manual 1.8: mechanical units. A robot is always active. The axes of a unit that is deactivated keep their position and read
// 9E9; what the unit carries stays where it is.

#include "stdlib/impl/motion/units.h"

#include "runtime/host/unit_activation.h"
#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "natives/axes.h"
#include "natives/multitasking.h"
#include "stdlib_constants.h"

#include <cmath>

using namespace rt;

namespace {

/// When the robot is at a stop point.
Status setActive(TaskCore* task, Handle handle, bool active) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    MechanicalUnit* unit = lib::unitOf(task, handle, status);
    if (unit == nullptr) return status;
    Controller& controller = taskOf(task).controller();
    if (const std::string refusal = refusalOfActivation(controller, *unit, active); !refusal.empty())
        return lib::fail(task, err::ERR_ARGVALERR, refusal);
    if (unit->isConveyor) return lib::activateConveyor(task, *unit, active);
    MotionDriver& driver = lib::motionOf(task);
    if (unit->group != driver.group())
        return lib::fail(task, err::ERR_ARGVALERR,
                         unit->name + " belongs to the mechanical unit group of another task");
    if (unit->isActive == active) return kOk;
    status = driver.waitIdle(taskOf(task));
    if (status == kOk) status = driver.waitZeroSpeed(taskOf(task));
    if (status != kOk) return status;
    activateUnit(controller, *unit, active);
    return kOk;
}

template <class T, class Value> void give(T* result, Value value) {
    if (result != nullptr) *result = static_cast<T>(value);
}

/// Number of the task that controls the group, from 1; 0 when none does.
float taskOfGroup(const Controller& controller, std::size_t group) {
    for (const auto& task : controller.tasks())
        if (task->motionGroup() == static_cast<int>(group)) return static_cast<float>(task->index() + 1);
    return 0;
}

} // namespace

namespace rt::lib {

MechanicalUnit* unitOf(TaskCore* task, Handle handle, Status& status) {
    const auto& units = taskOf(task).controller().units().all();
    const auto index = static_cast<std::size_t>(handle - 1);
    if (handle >= 1 && index < units.size()) return units[index].get();
    status = fail(task, err::ERR_REFUNKDAT, "the configuration does not define this mechanical unit");
    return nullptr;
}

int robotAxis(TaskCore* task, const Handle* unit, float axis, Status& status) {
    status = kOk;
    const MotionDriver& driver = motionOf(task);
    bool isRobot = true;
    auto axes = static_cast<int>(driver.model().lowerDeg.size());
    if (unit != nullptr) {
        const MechanicalUnit* asked = unitOf(task, *unit, status);
        if (asked == nullptr) return -1;
        isRobot = asked->isRobot && asked->group == driver.group();
        axes = asked->axes;
    }
    const bool isThere = axis == std::floor(axis) && axis >= 1 && axis <= static_cast<float>(axes);
    if (isThere && isRobot) return static_cast<int>(axis) - 1;
    status = fail(task, err::ERR_AXIS_PAR,
                  isThere ? "the mechanical unit is not the robot of this task"
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
    Status status = kOk;
    const MechanicalUnit* unit = lib::unitOf(task, *MechUnit, status);
    if (unit != nullptr) *result = unit->isActive;
    return status;
}

Status rt_GetMecUnitName(TaskCore* task, String* result, Handle* MechUnit) {
    Status status = kOk;
    const MechanicalUnit* unit = lib::unitOf(task, *MechUnit, status);
    if (unit != nullptr) result->assign(unit->name);
    return status;
}

/// A motion group has a planner and a drive module of its own.
Status rt_GetNextMechUnit(TaskCore* task, bool* result, float* ListNumber, String* UnitName, Handle* MecRef,
                          bool* TCPRob, float* NoOfAxes, float* MecTaskNo, float* MotPlanNo, bool* Active,
                          float* DriveModule, bool* OKToDeact) {
    Controller& controller = taskOf(task).controller();
    const auto& units = controller.units().all();
    *result = *ListNumber >= 0 && *ListNumber < static_cast<float>(units.size());
    if (!*result) return kOk;
    const auto index = static_cast<std::size_t>(*ListNumber);
    const MechanicalUnit& unit = *units[index];
    *ListNumber = static_cast<float>(index + 1);
    UnitName->assign(unit.name);
    give(MecRef, static_cast<Handle>(index + 1));
    give(TCPRob, unit.isRobot);
    give(NoOfAxes, unit.axes);
    give(MecTaskNo, taskOfGroup(controller, unit.group));
    give(MotPlanNo, unit.group + 1);
    give(Active, unit.isActive);
    give(DriveModule, unit.group + 1);
    give(OKToDeact, !unit.staysActive);
    return kOk;
}
}

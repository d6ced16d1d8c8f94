#include "stdlib/impl/axis_service/axis_values.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/torques.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <cmath>

namespace rt::lib {

bool axisPlace(TaskCore* task, const Handle* unit, float axis, Status unitError, AxisPlace& place,
               Status& status) {
    Controller& controller = taskOf(task).controller();
    place = {&motionOf(task), true, 0};
    auto axes = place.motion->model().lowerDeg.size();
    const MechanicalUnit* asked = nullptr;
    if (unit != nullptr) {
        const auto& units = controller.units().all();
        const auto index = static_cast<std::size_t>(*unit - 1);
        if (*unit < 1 || index >= units.size()) {
            status = fail(task, unitError, "the configuration does not define this mechanical unit");
            return false;
        }
        asked = units[index].get();
        place.motion = controller.motions()[asked->group].get();
        place.isRobot = asked->isRobot;
        axes = static_cast<std::size_t>(asked->axes);
    }
    if (!(axis >= 1 && axis <= static_cast<float>(axes) && axis == std::floor(axis))) {
        status = fail(task, err::ERR_AXIS_PAR, "the mechanical unit has no such axis");
        return false;
    }
    place.index = static_cast<std::size_t>(axis) - 1;
    if (!place.isRobot) place.index = asked->own[place.index].index;
    return true;
}

AxisValues axisValues(Controller& controller, const AxisPlace& place) {
    constexpr Time kApart = kMillisecond;
    const motion::MotionSystem& arm = place.motion->system();
    const motion::MotionState now = arm.current();
    AxisValues values;
    if (!place.isRobot) {
        values.position = now.extax[place.index];
        const double later = arm.sample(arm.now() + kApart).extax[place.index];
        if (motion::isConnected(values.position))
            values.speed = (later - values.position) / toSeconds(kApart);
        return values;
    }
    values.position = now.joints[place.index];
    values.speed = now.jointSpeed[place.index];
    values.externalTorque = externalTorque(controller, *place.motion, place.index);
    values.torque =
        torqueShare(arm, place.index) * greatestTorque(arm.model(), place.index) - values.externalTorque;
    return values;
}

} // namespace rt::lib

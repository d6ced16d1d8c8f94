// Frames of a movement: tool, work object, program displacement, and the mechanical unit that moves the work object
// (manual 2.1; wobjdata ufprog and ufmec).

#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

namespace rt::lib {

namespace {

/// The frame that a unit of another motion group moves, where it is now.
motion::Pose frameOfOther(Controller& controller, const MechanicalUnit& unit) {
    const motion::MotionSystem& other = controller.motions()[unit.group]->system();
    const motion::JointTarget here = other.currentJoints();
    if (unit.isRobot) return other.flangeInWorld(here);
    return unit.geometry.frame(here.extax);
}

/// The user frame is moved by a mechanical unit. One of the own group is followed all the time; one of another group has to
/// stand still (semi-coordinated movement).
Status moveUserFrame(TaskCore* task, std::string_view name, motion::FrameSetup& frames) {
    Controller& controller = taskOf(task).controller();
    const MechanicalUnit* unit = controller.units().find(name);
    const std::string quoted = "'" + std::string(name) + "'";
    if (unit == nullptr)
        return fail(task, err::ERR_ARGVALERR,
                    "the work object is moved by mechanical unit " + quoted +
                        ", which the configuration does not define (MOC.cfg)");
    if (unit->isConveyor) return placeOnConveyor(task, name, frames);
    MotionDriver& own = motionOf(task);
    if (unit->group == own.group()) {
        if (unit->isRobot)
            return fail(task, err::ERR_ARGVALERR,
                        "the work object is moved by " + quoted + ", the robot of this task itself");
        frames.userMover = &unit->geometry;
        return kOk;
    }
    MotionDriver& other = *controller.motions()[unit->group];
    frames.workObject.uframe = frameOfOther(controller, *unit);
    if (own.synchronised() != nullptr && own.synchronised() == other.synchronised()) {
        frames.carrier = &other.system();
        frames.carrierGroup = static_cast<int>(other.group());
        frames.carrierUnit = unit->isRobot ? nullptr : &unit->geometry;
        return kOk;
    }
    if (other.isMoving() && !other.isIdle()) // in position at a stop point it counts as arrived
        return fail(
            task, err::ERR_WOBJ_MOVING,
            "mechanical unit " + quoted +
                " of the work object moves: wait until it is at rest, or synchronise the tasks (SyncMoveOn)");
    return kOk;
}

} // namespace

Status frameSetup(TaskCore* task, const data::Tooldata* tool, const data::Wobjdata* workObject,
                  motion::FrameSetup& frames) {
    const MotionState& state = motionState(task);
    const data::Tooldata& t = tool ? *tool : state.tool;
    const data::Wobjdata& w = workObject ? *workObject : state.workObject;
    frames = {};
    frames.tool = {t.robhold, toFrame(t.tframe)};
    frames.workObject = {w.robhold, toFrame(w.uframe), toFrame(w.oframe)};
    frames.displacement = state.displacement;
    const std::string_view unit = w.ufmec.view();
    return w.ufprog || unit.empty() ? kOk : moveUserFrame(task, unit, frames);
}

} // namespace rt::lib

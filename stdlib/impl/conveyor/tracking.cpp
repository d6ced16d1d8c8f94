#include "stdlib/impl/conveyor/tracking.h"

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

namespace rt::lib {

namespace {

constexpr Time kLook = 4 * kMillisecond;

/// The tracking of a robot; made when it is needed for the first time.
struct RobotTracking {
    std::shared_ptr<motion::ConveyorTracking> modifier;
};

/// The object that the robot follows is lost: it stops on its path.
void stopFollowing(Controller& controller, MotionDriver& motion, const motion::ConveyorTracking& tracking,
                   const std::string& why) {
    const motion::OnConveyor* ordered = tracking.ordered();
    if (ordered == nullptr || ordered->object->isConnected() || motion.isIdle()) return;
    const std::string reason = "the object on the conveyor that it follows is not connected any more: " + why;
    controller.log().write(EventId::ConveyorTrackingStopped, nullptr, {motion.unitName(), reason});
    motion.raiseProcessError(err::ERR_CNV_DROPPED, reason);
}

motion::ConveyorTracking& trackingOf(Controller& controller, MotionDriver& motion) {
    auto& own = motion.service<RobotTracking>();
    if (own.modifier) return *own.modifier;
    motion::MotionSystem& system = motion.system();
    own.modifier = std::make_shared<motion::ConveyorTracking>([&system] { return system.now(); },
                                                              [&system] { return system.isStopRequested(); });
    system.addModifier(own.modifier);
    for (const auto& conveyor : controller.service<Conveyors>().all())
        conveyor->onLost([&controller, &motion, tracking = own.modifier](const std::string& why) {
            stopFollowing(controller, motion, *tracking, why);
        });
    return *own.modifier;
}

/// Until the robot is in position and at rest on its path, or a movement instruction would raise an error.
Status waitAtRest(Task& task, MotionDriver& motion, const motion::ConveyorTracking& tracking) {
    const auto isOver = [&] {
        const bool isIdle = motion.system().isIdle(); // brings the arm up to now
        return motion.hasProcessError() || (isIdle && (!tracking.isPathMoving() || !motion.isMoving()));
    };
    if (isOver()) return kOk;
    WaitResult result{};
    WaitSpec spec;
    spec.condition = [&] {
        motion.refresh();
        return isOver();
    };
    spec.pollPeriod = kLook;
    return task.waitFor(spec, result);
}

/// The planned path begins again where the arm is.
void beginFromHere(MotionDriver& motion, motion::ConveyorTracking& tracking) {
    const motion::MotionState here = motion.system().current();
    tracking.beginFromHere();
    motion.system().placeAt({here.joints, here.extax});
    motion.refresh();
}

bool canFollow(const motion::MoveCommand& command) {
    return command.kind != motion::MoveKind::AbsJoint && !command.frames.workObject.robotHeld;
}

} // namespace

Conveyor* conveyorOf(Controller& controller, const data::Wobjdata& workObject) {
    const std::string_view unit = workObject.ufmec.view();
    return workObject.ufprog || unit.empty() ? nullptr : controller.service<Conveyors>().find(unit);
}

Conveyor* conveyorUnit(TaskCore* task, Handle handle, Status& status) {
    const MechanicalUnit* unit = unitOf(task, handle, status);
    if (unit == nullptr) return nullptr;
    Conveyor* conveyor = taskOf(task).controller().service<Conveyors>().find(unit->name);
    status = conveyor != nullptr ? kOk : fail(task, err::ERR_ARGVALERR, unit->name + " is not a conveyor");
    return conveyor;
}

Status placeOnConveyor(TaskCore* task, std::string_view unit, motion::FrameSetup& frames) {
    const Conveyor* conveyor = taskOf(task).controller().service<Conveyors>().find(unit);
    if (conveyor != nullptr) frames.workObject.uframe = conveyor->frame(conveyor->connectedPosition());
    return kOk;
}

Status activateConveyor(TaskCore* task, MechanicalUnit& unit, bool active) {
    Controller& controller = taskOf(task).controller();
    Conveyor* conveyor = controller.service<Conveyors>().find(unit.name);
    if (conveyor == nullptr || unit.isActive == active) return kOk;
    if (const Status status = motionOf(task).waitIdle(taskOf(task))) return status;
    unit.isActive = active;
    conveyor->setActive(active);
    return kOk;
}

bool isFollowed(const MotionDriver& motion, const motion::TrackedObject& object) {
    auto& own = const_cast<MotionDriver&>(motion).service<RobotTracking>();
    const motion::OnConveyor* ordered = own.modifier ? own.modifier->ordered() : nullptr;
    return ordered != nullptr && ordered->object.get() == &object && !motion.isIdle();
}

Status trackConveyor(TaskCore* task, const data::Wobjdata& workObject, motion::MoveCommand& command) {
    Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    if (controller.service<Conveyors>().all().empty()) return kOk;
    MotionDriver& motion = motionOf(task);
    if (motion.hasProcessError() || motion.continuesMovement(owner)) return kOk; // nothing is ordered
    const Conveyor* conveyor = canFollow(command) ? conveyorOf(controller, workObject) : nullptr;
    if (conveyor != nullptr && !conveyor->isActive())
        return fail(task, err::ERR_CNV_NOT_ACT,
                    conveyor->name() + " carries the work object and is not activated; use ActUnit first");
    const auto object = conveyor == nullptr ? nullptr : conveyor->connected();
    motion::ConveyorTracking& tracking = trackingOf(controller, motion);
    const motion::OnConveyor* before = tracking.ordered();
    if (before != nullptr && before->object == object) {
        command.frames.workObject.uframe = object->frame(before->planned);
        command.modifications.push_back(std::make_shared<const motion::OnConveyor>(*before));
        return kOk;
    }
    if (tracking.isDisplaced() || before != nullptr) {
        if (const Status status = waitAtRest(owner, motion, tracking)) return status;
        if (motion.hasProcessError()) return kOk;
        if (tracking.isDisplaced()) beginFromHere(motion, tracking);
    }
    if (object == nullptr) {
        tracking.setOrdered(nullptr);
        return kOk;
    }
    auto on = std::make_shared<motion::OnConveyor>();
    on->object = object;
    on->planned = object->position(owner.now());
    command.frames.workObject.uframe = object->frame(on->planned);
    tracking.setOrdered(on);
    command.modifications.push_back(std::move(on));
    return kOk;
}

} // namespace rt::lib

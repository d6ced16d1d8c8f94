#pragma once
// Movements that follow an object on a conveyor.

#include "runtime/host/controller.h"
#include "runtime/host/conveyors.h"
#include "runtime/motion/conveyor_tracking.h"

#include "stdlib_types.h"

#include <string_view>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// The conveyor that moves the work object; null when none does.
Conveyor* conveyorOf(Controller& controller, const data::Wobjdata& workObject);
/// The conveyor of a mechanical unit; null, and the status of the error raised, for others.
Conveyor* conveyorUnit(TaskCore* task, Handle unit, Status& status);

/// The user frame of a work object on a conveyor: where the connected object is now, else the origin of the conveyor.
Status placeOnConveyor(TaskCore* task, std::string_view unit, motion::FrameSetup& frames);
/// ActUnit and DeactUnit of a conveyor.
Status activateConveyor(TaskCore* task, MechanicalUnit& unit, bool active);

/// Before the order of a movement: lets it follow the object that carries its work object. Where the robot changes from one object
/// to another, or to or from a work object at rest, it waits until the robot is in position, relative to what it follows.
Status trackConveyor(TaskCore* task, const data::Wobjdata& workObject, motion::MoveCommand& command);
/// A movement that follows the object is not finished.
bool isFollowed(const MotionDriver& motion, const motion::TrackedObject& object);

/// Conveyors and their objects between two processes (--state).
void keepConveyors(Controller& controller, StateKeepers& kept);

} // namespace rt::lib

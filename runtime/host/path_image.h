#pragma once
// Movements and ordered interrupts as JSON, parts of the state file. The readers throw an exception of the JSON library, or
// std::invalid_argument, when it is something else.

#include "runtime/host/motion_driver.h"
#include "runtime/sched/interrupts.h"

#include <nlohmann/json_fwd.hpp>

namespace rt {

/// Without triggers, which are functions of the running process.
nlohmann::json jsonOf(const motion::MoveCommand& command);
motion::MoveCommand moveFrom(const nlohmann::json& json, const robot::UnitLookup& units);
motion::CircleOrientation circleOrientationFrom(int number);
nlohmann::json jsonOf(const motion::Pose& pose);
motion::Pose poseFrom(const nlohmann::json& json);
nlohmann::json jsonOf(const motion::MotionSettings& settings);
motion::MotionSettings settingsFrom(const nlohmann::json& json);
/// The paths of all levels.
nlohmann::json jsonOf(const MotionDriver::EarlierPath& path);
MotionDriver::EarlierPath earlierPathFrom(const nlohmann::json& json, const robot::UnitLookup& units);
/// Without the trap routine, whose address means nothing to another process.
nlohmann::json jsonOf(const SavedInterrupt& interrupt);
SavedInterrupt interruptFrom(const nlohmann::json& json);

} // namespace rt

#pragma once
// Tools and work objects of a robot: those in program memory, and those in force. On the controller's thread.

#include "runtime/robot/frames.h"
#include "tools/pendant/protocol.h"
#include "tools/service/virtual_controller.h"

#include <string>
#include <vector>

namespace rapidc::pendant {

struct NamedFrame {
    std::string name, module;
    robot::Pose
        pose; ///< tool: TCP in the flange, or in world when the robot does not hold it; work object: in world, or in the flange
    bool isHeld = false; ///< by the robot
    double massKg = 0;   ///< of a tool
};

NamedFrame tool0();
NamedFrame workObject0();
/// The task that moves the robot; null when none does.
rt::Task* taskMoving(service::VirtualController& controller, const rt::MotionDriver& motion);
/// Persistent tooldata (wobjdata) that the task declares.
std::vector<NamedFrame> toolsOf(service::VirtualController& controller, const rt::Task& task);
std::vector<NamedFrame> workObjectsOf(service::VirtualController& controller, const rt::Task& task);
/// Of the movement executed last, named "" when no data have these values.
NamedFrame toolInForce(service::VirtualController& controller, rt::Task& task);
NamedFrame workObjectInForce(service::VirtualController& controller, rt::Task& task);

/// Poses of both, without their names: costs little.
struct FramesInForce {
    robot::Pose tool, workObject;
    bool operator==(const FramesInForce&) const = default;
};
FramesInForce framesInForce(rt::Task& task);

Json frameJson(const NamedFrame& frame);

} // namespace rapidc::pendant

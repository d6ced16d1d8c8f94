#pragma once
// ArmBodies: what a robot looks like, from its kinematics alone: bodies that axes move against each other, and simple solids. Lengths mm,
// angles degrees.

#include "runtime/robot/robot_model.h"

#include <string>
#include <utility>
#include <vector>

namespace rapidc::pendant {

struct Solid {
    enum class Kind : uint8_t {
        Capsule,
        Cylinder,
        Rod, ///< from a point of this body to one of another
    };
    enum class Role : uint8_t { Arm, Joint, Flange };
    Kind kind = Kind::Capsule;
    Role role = Role::Arm;
    robot::Vec3 from, to; ///< in the frame of the body; of a rod, `to` in that of `toBody`
    double radius = 0;
    int toBody = -1;
};

/// The pose in the parent is origin * (turn about `axis`, or shift along it, by constant + the sum of factor * joint).
struct Body {
    enum class Motion : uint8_t {
        Fixed,
        Rotary,
        Linear,
        Flange, ///< the flange pose in the base frame, which the motion gives
    };
    std::string name;
    int parent = -1; ///< index of an earlier body; -1: the base frame
    robot::Pose origin;
    robot::Vec3 axis{0, 0, 1};
    Motion motion = Motion::Fixed;
    double constant = 0;
    std::vector<std::pair<int, double>> terms; ///< joint index from 0, factor
    std::vector<Solid> solids;
};

/// The last body, "flange", is the flange frame. Empty for a model without an arm.
std::vector<Body> bodiesOf(const robot::RobotModel& model);

/// Poses of the bodies in the base frame at these joints.
std::vector<robot::Pose> posesOf(const std::vector<Body>& bodies, const robot::Joints& joints,
                                 const robot::Pose& flange);

} // namespace rapidc::pendant

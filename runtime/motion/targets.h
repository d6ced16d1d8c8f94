#pragma once
// Targets, tools and work objects: how a programmed position becomes a flange pose in the robot's base frame
// and back. Lengths mm, angles degrees, quaternions w x y z.

#include "runtime/robot/expected.h"
#include "runtime/robot/external_unit.h"
#include "runtime/robot/frames.h"
#include "runtime/robot/kinematics.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace motion {

class MotionSystem;

using robot::ConfData;
using robot::Expected;
using robot::Joints;
using robot::Pose;
using robot::Quat;
using robot::Unexpected;
using robot::Vec3;

using robot::ExternalAxes;
using robot::isConnected;
using robot::kExternalCount;
using robot::kNoExternalAxes;
using robot::kNotConnected;

/// RAPID's jointtarget. Axis 7 of a seven-axis arm, eax_a there, is the last of robax; external axis a is not connected.
struct JointTarget {
    Joints robax{};
    ExternalAxes extax = kNoExternalAxes;
};

/// RAPID's robtarget: pose in the (displaced) object frame.
struct RobTarget {
    Pose pose;
    ConfData conf;
    ExternalAxes extax = kNoExternalAxes;
    double armAngle = robot::kSeedArmAngle; ///< seven axes: eax_a, deg; not a number: free, the arm chooses
};

/// The geometric part of RAPID's tooldata: tframe is given in the wrist frame (flange) when the robot holds
/// the tool, in world when the tool is stationary.
struct ToolFrame {
    bool robotHeld = true;
    Pose tframe;
};

/// The geometric part of RAPID's wobjdata: uframe is given in world, or in the wrist frame when the robot
/// holds the work object.
struct WorkObjectFrame {
    bool robotHeld = false;
    Pose uframe, oframe;
};

/// Everything between a programmed pose and the flange. Exactly one of tool and work object is held by the
/// robot. Units that move the base or the user frame make it depend on the external axes.
struct FrameSetup {
    ToolFrame tool;
    WorkObjectFrame workObject;
    Pose displacement; ///< program displacement, in the object frame
    Pose baseFrame;    ///< robot base in world, of a unit that moves it at 0; MotionSystem sets both
    const robot::ExternalUnit* baseMover = nullptr; ///< moves the base frame (track motion)
    /// Moves the user frame, whose own pose does not count then (wobjdata with ufprog FALSE and the unit's name in ufmec).
    const robot::ExternalUnit* userMover = nullptr;

    bool isConsistent() const { return tool.robotHeld != workObject.robotHeld; }
    /// Flange in base for a TCP pose in the displaced object frame.
    /// `user`: the user frame in world at that moment, for one that another robot carries.
    Pose toFlange(const Pose& target, const ExternalAxes& axes, const Pose* user = nullptr) const;
    /// The reverse: TCP pose in the displaced object frame.
    Pose fromFlange(const Pose& flange, const ExternalAxes& axes, const Pose* user = nullptr) const;
    /// TCP in world for a flange pose in base (a stationary tool does not move).
    Pose tcpInWorld(const Pose& flange, const ExternalAxes& axes) const;
    /// Robot base in world.
    Pose base(const ExternalAxes& axes) const {
        return baseMover == nullptr ? baseFrame : baseMover->carry(baseFrame, axes);
    }
    /// A robot, or a unit of a robot's group, that carries the work object while both move together (MultiMove); the pose of
    /// the user frame is the present one.
    const MotionSystem* carrier = nullptr;
    int carrierGroup = -1; ///< number of the motion group of `carrier`, by which a state file knows it
    const robot::ExternalUnit* carrierUnit = nullptr; ///< null: the robot itself
    /// The user frame after a share of the carrier's movement, 0 to 1; set with the order of a movement.
    std::shared_ptr<const std::function<Pose(double)>> userCourse;
    bool dependsOnAxes() const { return baseMover != nullptr || userMover != nullptr; }
    /// External axes or another robot move a frame.
    bool isMoved() const { return dependsOnAxes() || userCourse != nullptr; }

  private:
    /// The displaced object frame, in world or in the wrist frame.
    Pose object(const ExternalAxes& axes, const Pose* user) const;
};

/// The same tool, held in the same way, and the same unit that moves the user frame: the TCP does not jump between moves
/// with these two, nor does its way relative to the work object.
bool sameTool(const FrameSetup& a, const FrameSetup& b);
/// Coordinates mean the same place.
bool sameFrames(const FrameSetup& a, const FrameSetup& b);

/// Pose from RAPID-like plain figures (trans[3] mm, rot[4] as q1..q4); the quaternion is scaled to unit
/// length, which binary32 components never have exactly.
Pose poseFromFloats(const float* trans, const float* rot);
/// The reverse.
void poseToFloats(const Pose& pose, float* trans, float* rot);

enum class MotionErrorKind : uint8_t {
    BadArgument,     ///< not a number, speed or time not positive, frames contradict each other
    Unreachable,     ///< position outside the reach of the arm
    JointOutOfRange, ///< an axis (1..7, external 8..13) would leave its range
    ElbowOutOfRange, ///< the rods do not let axes 2 and 3 be there together; `value` is the angle of the elbow
    NoSuchConfiguration,   ///< confdata asks for a configuration the position does not have (ConfJ)
    ConfigurationMismatch, ///< a line or circle would arrive in another configuration than programmed (ConfL)
    Singularity,           ///< path too close to a singularity
    CirclePointsTooClose,  ///< points of a circle closer than 0.1 mm
    CirclePointsCollinear, ///< all points on one line, the circle point not between start and end
    CircleTooLarge,        ///< more than 240 degrees in one move
    QueueFull,             ///< too many moves ordered ahead
};

/// Why a move cannot be made. A value; the controller turns it into an ERRNO and an event.
struct MotionError {
    MotionErrorKind kind = MotionErrorKind::BadArgument;
    int joint = 0;           ///< 1..7, external axes 8..13, 0 = does not concern one axis
    double value = 0;        ///< what the axis, the angle or the argument would have been
    double pathFraction = 0; ///< where on the path, 0 = start, 1 = end
    Vec3 position;           ///< TCP there, in the object frame of the move
    const char* what = "";   ///< BadArgument: which argument
    /// One sentence with the figures and a remedy.
    std::string message() const;
};

/// Axis angles for a target whose flange is `flange`, in the configuration it names (`exactConf`), else those nearest to the
/// seed. A free arm angle is that of the seed or, where the arm cannot be there with it, the nearest one with which it can
/// (in steps of 5 degrees).
Expected<Joints, robot::IkError> solveTarget(const robot::Kinematics& kinematics, const Pose& flange,
                                             const RobTarget& target, bool exactConf, const Joints& seed);
/// The meaning of an error of the inverse for a move to this position, at the end of its path.
MotionError targetError(const robot::IkError& error, const Vec3& position);

/// Length of a quaternion that still counts as 1, and what is wrong with others.
inline constexpr double kUnitTolerance = 1e-3;
inline constexpr const char* kNoOrientation =
    "an orientation whose quaternion has not the length 1 but this one";

/// RAPID's CalcJointT: axis angles for a robtarget, with the configuration it names; `seed` breaks ties at
/// singularities.
Expected<JointTarget, MotionError> calcJointTarget(const robot::Kinematics& kinematics,
                                                   const RobTarget& target, const FrameSetup& frames,
                                                   const Joints& seed);
/// RAPID's CalcRobT and CRobT: robtarget in the displaced object frame, with its configuration.
RobTarget calcRobTarget(const robot::Kinematics& kinematics, const JointTarget& joints,
                        const FrameSetup& frames);

} // namespace motion

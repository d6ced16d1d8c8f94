#pragma once
// The common part of motion instructions: the settings in force (manual 1.7), frames, errors.

#include "runtime/host/controller.h"

#include "stdlib_types.h"

#include <bitset>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// The motion group that the task controls, or, if it controls none, the first one, which it may ask.
inline MotionDriver& motionOf(TaskCore* task) {
    const Task& owner = taskOf(task);
    return owner.controller().motion(owner);
}

/// The path and the axes of that group.
inline motion::MotionSystem& motionSystemOf(TaskCore* task) {
    return motionOf(task).system();
}

/// The task controls a robot with a TCP, not only external units.
inline bool movesRobot(const Task& task) {
    return task.isMotionTask() &&
           task.controller().motion(task).model().kinematics != robot::KinematicsKind::NoArm;
}

/// Settings of a motion group. The defaults are those SYS_RESET restores.
struct MotionState {
    motion::MotionSettings settings;
    bool confJ = true, confL = true;
    motion::CircleOrientation circleOrientation = motion::CircleOrientation::PathFrame; ///< CirPathMode
    bool singWrist = false, singLockAxis4 = false; ///< SingArea; kept for C_MOTSET
    motion::Pose displacement;                     ///< program displacement (PDisp...), in the object frame
    motion::ExternalAxes axisOffsets{};            ///< EOffs..., deg or mm
    data::Tooldata tool{true, {{0, 0, 0}, {1, 0, 0, 0}}, {0.001F, {0, 0, 0.001F}, {1, 0, 0, 0}, 0, 0, 0}};
    data::Wobjdata workObject{false, true, {}, {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
    data::Loaddata gripLoad{0.001F, {0, 0, 0.001F}, {1, 0, 0, 0}, 0, 0, 0}; ///< GripLoad
    motion::SpeedLimits speedLimits; ///< SpeedLimAxis, SpeedLimCheckPoint
    bool motionSupervision = true;   ///< MotionSup, kept for C_MOTSET
    double supervisionLevel = 100;   ///< percent
    double pathResolution = 100;     ///< PathResol, percent; kept for C_MOTSET
    bool backsOff = true;            ///< after a collision; MotionSup \NoBackoff
    bool eventBuffer = true;         ///< ActEventBuffer, DeactEventBuffer; kept for C_MOTSET
    float processMode = 1;           ///< MotionProcessModeSet
    std::bitset<robot::kExternalCount>
        independentExternal; ///< robot movements leave these axes where they are (STIndGun)
    int concurrentMoves = 0; ///< \Conc moves in succession
};
MotionState& motionState(TaskCore* task);
/// SYS_RESET: the default settings; tool and work object stay.
void restoreDefaults(Task& task);
/// The settings when the program of a motion task begins again (manual 1.7): defaults; tool and work object stay.
void resetSettings(Task& task);
/// The program begins again: TriggStopProc supervises no more.
void endStopSupervision(Task& task);
/// The settings are kept between two processes (--state).
void keepSettings(Controller& controller, StateKeepers& kept);

/// kOk, or ERR_NOT_MOVETASK raised: only a task that controls the robot may move it.
Status requireMotionTask(TaskCore* task);

/// Frames for a tool and a work object; null = the one in force. With the program displacement. ERR_ARGVALERR when the work
/// object is moved by a mechanical unit that is not there, ERR_WOBJ_MOVING when one of another task moves.
Status frameSetup(TaskCore* task, const data::Tooldata* tool, const data::Wobjdata* workObject,
                  motion::FrameSetup& frames);

/// Pose of a target for a movement: an orientation that is far from a unit quaternion (a robtarget without value has zeros)
/// stays as it is, so that the movement refuses it.
motion::Pose toMovePose(const data::Robtarget& target);
/// Positions as programmed; axis offsets are not looked at. eax_a is the arm angle of a seven-axis arm, free with 9E9.
motion::RobTarget toTarget(const data::Robtarget& target, const robot::Kinematics& arm);
data::Robtarget toRobtarget(const motion::RobTarget& target, const robot::Kinematics& arm);
/// Axes by their numbers: a palletiser has no axes 4 and 5, and eax_a is axis 7 of a seven-axis arm (kNotConnected for 9E9:
/// stays where it is).
motion::JointTarget toJoints(const data::Jointtarget& target, const robot::Kinematics& arm);
data::Jointtarget toJointtarget(const motion::JointTarget& joints, const robot::Kinematics& arm);
/// Adds `sign` times the offsets to the external axes that are connected.
void addOffsets(motion::ExternalAxes& axes, const motion::ExternalAxes& offsets, double sign);
motion::ExternalAxes toAxes(const data::Extjoint& axes);

/// The ERRNO for a target that cannot be reached or a move that cannot be made.
Status motionErrno(const motion::MotionError& error);
/// Raises it in the task. When no robot was named, the message names the model in use and the option that selects one.
Status failMotion(TaskCore* task, const motion::MotionError& error);

} // namespace rt::lib

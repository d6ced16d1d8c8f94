#pragma once
// Stage 3 of motion: time. A path and the speed at which it is run, within the limits of program and robot.

#include "runtime/motion/path.h"
#include "runtime/motion/profile.h"
#include "runtime/robot/robot_model.h"

#include <array>
#include <cstdint>

namespace motion {

/// What the planner needs to know about an external axis; not present unless configured.
struct ExternalAxisModel {
    bool present = false;
    bool rotating = true; ///< degrees, else mm
    double lower = -1e6, upper = 1e6;
    double maxSpeed = 100; ///< deg/s or mm/s
    double maxAcceleration = 500;
    double maxJerk = 5000;
};
using ExternalAxisModels = std::array<ExternalAxisModel, kExternalCount>;

/// What decides the duration of a move.
enum class Limiter : uint8_t { None, TcpSpeed, OrientationSpeed, JointSpeed, ExternalSpeed, Duration };

/// State of the arm at one moment.
struct MotionState {
    Joints joints{};     ///< deg
    Joints jointSpeed{}; ///< deg/s
    ExternalAxes extax = kNoExternalAxes;
    Pose tcp;                ///< TCP of the active tool in world
    double tcpSpeed = 0;     ///< mm/s relative to the work object
    double pathFraction = 0; ///< 0..1 on the current move
    int64_t move = 0;        ///< id of the move in progress or finished last; 0 = none yet
    uint64_t tag = 0;        ///< its tag
    bool moving = false;
};

/// One move, timed. The path parameter's bounds hold anywhere on the path, so that any jerk-limited profile
/// within them respects every joint limit: stopping, restarting and changing speed never leave the path.
class PlannedMotion {
  public:
    /// Times the path: joint speed, acceleration and jerk, TCP and reorientation speed, external axes,
    /// settings. `overridePercent` is the operator's speed override (1..100).
    static PlannedMotion plan(MotionPath path, const robot::RobotModel& model,
                              const ExternalAxisModels& external, const MoveCommand& command,
                              double overridePercent = 100);

    double duration() const { return profile_.duration(); } ///< s
    const MotionPath& path() const { return path_; }
    const Profile& profile() const { return profile_; }
    const ProfileLimits& limits() const { return limits_; } ///< of s, at 100 % override
    Limiter limiter() const { return limiter_; }
    int limitingAxis() const {
        return limitingAxis_;
    } ///< 1..6 or external 7..12 for the axis limiters, else 0

    /// State `time` seconds after the start, clamped to the motion. `move`, `tag` are left to the caller.
    MotionState sample(double time) const;
    /// State for a given state of the path parameter.
    MotionState sampleAt(const ProfileState& state) const;
    /// Time at which the TCP has travelled this many mm (clamped).
    double timeAtDistance(double mm) const;
    /// Path parameter at which the TCP has travelled this many mm (clamped).
    double parameterAtDistance(double mm) const;

  private:
    MotionPath path_;
    Profile profile_;
    ProfileLimits limits_;
    Limiter limiter_ = Limiter::None;
    int limitingAxis_ = 0;
};

} // namespace motion

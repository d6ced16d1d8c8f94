#pragma once
// Stage 3 of motion: time. A path and the speed at which it is run, within the limits of program and robot.

#include "runtime/motion/path.h"
#include "runtime/motion/profile.h"
#include "runtime/motion/warp.h"
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

/// One move, timed. The motion is a jerk-limited profile of a parameter u (0..1) that a warp maps to the path
/// parameter. The bounds of u's derivatives hold anywhere on the path, so that any profile within them
/// respects every limit: stopping, restarting and changing speed never leave the path.
class PlannedMotion {
  public:
    PlannedMotion() = default;
    /// Times the path: joint speed and acceleration, jerk along the path, TCP and reorientation speed,
    /// external axes, settings of the program.
    static PlannedMotion plan(MotionPath path, const robot::RobotModel& model,
                              const ExternalAxisModels& external, const MoveCommand& command);

    double duration() const { return profile_.duration(); } ///< s, at 100 % override
    const MotionPath& path() const { return path_; }
    const Profile& profile() const { return profile_; }     ///< of u, at 100 % override
    const ProfileLimits& limits() const { return limits_; } ///< of u, at 100 % override
    Limiter limiter() const { return limiter_; }
    int limitingAxis() const {
        return limitingAxis_;
    } ///< 1..6 or external 7..12 for the axis limiters, else 0

    /// Bounds and profile under the operator's speed override (above 0, to 100 percent): a slower pace on the
    /// same path.
    ProfileLimits limitsAt(double overridePercent) const;
    Profile profileAt(double overridePercent) const;

    /// State `time` seconds after the start, clamped to the motion. `move`, `tag` are left to the caller.
    MotionState sample(double time) const;
    /// State for a given state of u.
    MotionState sampleAt(const ProfileState& state) const;
    /// u at which the TCP has travelled this many mm (clamped).
    double parameterAtDistance(double mm) const;
    /// The reverse: mm of TCP path from the start to u.
    double distanceAt(double u) const { return path_.distanceAt(warp_.at(u).s); }
    /// Time at which the TCP has travelled this many mm (clamped), at 100 % override.
    double timeAtDistance(double mm) const { return profile_.timeAt(parameterAtDistance(mm)); }

  private:
    MotionPath path_;
    Warp warp_;
    Profile profile_;
    ProfileLimits limits_;
    double programmedDuration_ = 0;
    Limiter limiter_ = Limiter::None;
    int limitingAxis_ = 0;
};

} // namespace motion

#pragma once
// The movements of a run as its samples show them: when each one ran, how fast it became, and what made it slower than
// programmed. From samples and limits alone, so that it is true of any planner.

#include "runtime/report/run_record.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rt::report {

/// The limit that a stretch of a movement was at.
enum class Cause : uint8_t {
    Programmed,       ///< nothing: the programmed speed (TCP or reorientation) was reached
    Duration,         ///< nothing: the programmed time (\T) was kept
    JointSpeed,       ///< an axis at its speed limit
    RobotSpeed,       ///< the robot's largest TCP speed was reached, less than programmed
    Acceleration,     ///< an axis at its acceleration limit
    PathAcceleration, ///< the limit of PathAccLim
    StopPoint,        ///< starting or braking at a point where the robot comes to rest
    Zone,             ///< slower round a fly-by point
    OtherRobots,      ///< none of these, and another robot of the synchronised movement sets the time
    Other,            ///< none of these: jerk, the shape of the path, an order from outside
};

/// Shares of a limit from which on it counts as reached. Differences of samples round the peaks of accelerations off.
inline constexpr double kSpeedReached = 0.98, kAccelerationReached = 0.95;

/// Loss::axis of external axis eax_a; the other ones follow.
inline constexpr int kFirstExternal = 11;

/// Time that a movement took longer than at its programmed speed.
struct Loss {
    Cause cause = Cause::Other;
    int axis = 0; ///< of JointSpeed and Acceleration: from 1, or from kFirstExternal; else 0
    double seconds = 0;
};

struct MoveResult {
    const Move* move = nullptr;
    std::size_t first = 0, last = 0; ///< samples; the movement begins at the first and ends at the last
    double start = 0, end = 0;       ///< s
    double moving = 0;               ///< s of these with the arm moving
    double length = 0;               ///< mm of TCP path
    double reached = 0;              ///< largest TCP speed, mm/s
    double turnReached = 0;          ///< largest reorientation speed, deg/s
    double atProgrammed = 0;         ///< s at the programmed speed
    std::vector<Loss> losses;        ///< largest first
    Loss main;                       ///< what decided its duration
};

struct Analysis {
    std::vector<MoveResult> moves;             ///< that have moved the arm
    double cycle = 0, moving = 0, waiting = 0; ///< s
    double length = 0;                         ///< mm
    std::vector<Loss> losses;                  ///< of all movements, largest first
};

Analysis analyse(const RobotRecord& record);

/// Adds to the loss of the same cause; the largest stays first.
void addLoss(std::vector<Loss>& losses, const Loss& loss);
/// "speed limit of axis 3".
std::string causeText(const Loss& loss);
/// The limit that decided the duration, for people: "programmed speed", "speed limit of axis 2 (-0.310 s)".
std::string verdict(const MoveResult& result);

/// Rotation between two orientations, deg.
double turnBetween(const motion::Quat& a, const motion::Quat& b);
/// The arm is elsewhere, or turned.
bool hasMoved(const Sample& before, const Sample& after);
/// The TCP is elsewhere without having moved there: another tool.
bool toolChanged(const Sample& before, const Sample& after);

} // namespace rt::report

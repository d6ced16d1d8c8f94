#pragma once
// MoveCommand: one move instruction, in the units and frames of the program (mm, deg, s), independent of any
// language.

#include "runtime/motion/targets.h"

#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

namespace motion {

/// Something that displaces the TCP from the path of a movement on purpose (path_modifier.h).
struct Modification;
using Modifications = std::vector<std::shared_ptr<const Modification>>;

enum class MoveKind : uint8_t {
    AbsJoint, ///< to axis angles, axis by axis
    Joint,    ///< to a pose, axis by axis
    Linear,   ///< TCP on a straight line, orientation turned evenly
    Circular, ///< TCP on a circle through start, circle point and target
};

/// How the tool turns on a circle (CirPathMode, manual 1.7).
enum class CircleOrientation : uint8_t {
    PathFrame, ///< evenly relative to the circle, so that a tool held towards its centre stays so
    ObjectFrame, ///< evenly relative to the work object, about one axis; the circle point's orientation has no influence
    CirclePoint, ///< relative to the work object, through the orientation of the circle point
    Wrist45, ///< only axes 4 and 5 move: the z axis of the tool meets the plane of the circle on the circle (thin sheets)
    Wrist46, ///< the same with axes 4 and 6
    Wrist56  ///< the same with axes 5 and 6
};
/// Whether two axes of the wrist alone run the circle; the orientation is what comes of it.
inline bool isByWrist(CircleOrientation orientation) {
    return orientation >= CircleOrientation::Wrist45;
}

/// How lines and circles pass singularities of the wrist (SingArea, manual 1.7).
enum class SingularityMode : uint8_t {
    Off,      ///< the orientation is kept; a path through a singularity is refused
    Wrist,    ///< axes 4 to 6 turn evenly, and the orientation deviates on the way
    LockAxis4 ///< axis 4 stays at 0 or 180 degrees and the orientation comes as near as it can
};

/// RAPID's speeddata.
struct SpeedData {
    double vTcp = 100;   ///< mm/s
    double vOri = 500;   ///< deg/s
    double vLeax = 5000; ///< linear external axes, mm/s
    double vReax = 1000; ///< rotating external axes, deg/s
};

/// RAPID's zonedata.
struct ZoneData {
    bool finep = true;
    double pzoneTcp = 0, pzoneOri = 0, pzoneEax = 0; ///< mm of TCP path
    double zoneOri = 0;                              ///< deg
    double zoneLeax = 0, zoneReax = 0;               ///< mm, deg
};

/// How a movement ends at its stop point (RAPID's stoppointdata, manual 1.8). The default is that of fine.
struct StopPoint {
    double positionPercent = 100; ///< in position: nearer than this share of the distance that fine allows,
    double speedPercent = 100;    ///< ... and slower than this share of the speed that a fine point has there
    double minTime = 0,
           maxTime = 1e9; ///< s after a fine point would be in position: not before, and at the latest
    double standTime = 0; ///< s at standstill before anything else moves
    bool isAwaited =
        true; ///< the program continues after it; else as at a fly-by point, before the arm brakes
};
/// The stop point that meets the conditions of both: of robots that move together.
StopPoint strictest(const StopPoint& a, const StopPoint& b);

/// The load of the robot: tool and payload together.
struct CarriedLoad {
    double mass = 0;    ///< kg
    double inertia = 0; ///< kg m^2, the greatest about an axis through the flange
};

/// AccSet, VelSet, PathAccLim, WorldAccLim in force for the move.
struct MotionSettings {
    double velocityPercent = 100;      ///< VelSet Override
    double maxTcpSpeed = 1e9;          ///< VelSet Max, mm/s; no effect on moves with a duration
    double accelerationPercent = 100;  ///< AccSet Acc; below 20 acts as 20
    double rampPercent = 100;          ///< AccSet Ramp; below 10 acts as 10
    double pathAcceleration = 0;       ///< PathAccLim \AccMax, m/s^2 along the path; 0 = no limit
    double pathDeceleration = 0;       ///< PathAccLim \DecelMax; 0 = no limit
    double worldAcceleration = 0;      ///< WorldAccLim, m/s^2; 0 = no limit
    double finePointRampPercent = 100; ///< AccSet \FinePointRamp; below 10 acts as 10
};

/// Something to be reported when the TCP passes a place on the path (TriggIO and friends). A place before the start of
/// the path is its start, one after its end is its end.
struct PathTrigger {
    uint32_t id = 0;        ///< the caller's name for it
    bool fromStart = false; ///< measured from the start of the move instead of its end
    bool inTime = false; ///< `amount` is seconds before the end (after the start) instead of mm of TCP path
    double amount = 0;
    double lag = 0; ///< EquipLag, s: positive fires earlier, even while the move before is still running
    bool nextMove = false; ///< on the move that follows, `amount` mm after its start
    friend auto operator<=>(const PathTrigger&, const PathTrigger&) = default;
};

inline constexpr int64_t kNoIdent = -1; ///< a movement without \ID

struct MoveCommand {
    MoveKind kind = MoveKind::AbsJoint;
    JointTarget joints; ///< AbsJoint; a kNotConnected axis keeps its place
    RobTarget target;   ///< Joint, Linear, Circular
    Pose circlePoint;   ///< Circular
    CircleOrientation circleOrientation = CircleOrientation::PathFrame;
    SingularityMode singularity = SingularityMode::Off; ///< Linear, Circular
    FrameSetup frames; ///< tool, work object, displacement; the base frame comes from the model
    SpeedData speed;
    double duration = 0; ///< s, RAPID's \T; 0 = not given. Limits still hold: the move may take longer
    ZoneData zone;
    StopPoint stop; ///< of a move whose zone is finep
    CarriedLoad load;
    bool confJ = true;       ///< ConfJ\On: Joint moves take the programmed configuration
    bool confL = true;       ///< ConfL\On: lines and circles must arrive in the programmed configuration
    bool concurrent = false; ///< \Conc: the program continues when the move starts
    MotionSettings settings;
    std::vector<PathTrigger> triggers;
    Modifications modifications; ///< what displaces the TCP from this path
    int64_t ident = kNoIdent;    ///< RAPID's \ID, the same for all robots of a synchronised movement
    uint64_t tag = 0; ///< the caller's, given back in samples and events (number of the move instruction)
};

} // namespace motion

#pragma once
// Inside MotionSystem: the path of each level with its moves, what the arm does at the moment, and what happens when.

#include "runtime/motion/coast.h"
#include "runtime/motion/motion_system.h"
#include "runtime/motion/path_modifiers.h"
#include "runtime/motion/trajectory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace motion {

/// Nanoseconds that are not before the given seconds, so that what is promised for a time has happened by
/// then. At most 4e9 s (126 years) from the beginning, in both directions (infinity is a time, too): a sum of two such times is
/// still a time.
inline TimeNs toNs(double seconds) {
    constexpr double kLongest = 4e9;
    return static_cast<TimeNs>(std::ceil(std::clamp(seconds, -kLongest, kLongest) * 1e9 - 1e-6));
}
inline double toSeconds(TimeNs time) {
    return static_cast<double>(time) * 1e-9;
}

struct Trigger {
    PathTrigger wanted;
    bool fired = false;
};

struct Move {
    MoveId id = 0;
    uint64_t tag = 0;
    LegRef leg;
    bool isPoint = false; // no way of its own: the end of the leg
    bool isFlyBy = false;
    bool isConcurrent = false;
    bool isAwaited = true; // the program waits for its stop point
    std::vector<Trigger> triggers;
    Modifications modifications;
    bool isStarted = false;
    bool isReleased = false;
};

/// The moves of one path level and where they lie.
struct Level {
    std::shared_ptr<Trajectory> path;
    std::deque<std::shared_ptr<Move>> queue;    // unfinished, in order
    std::deque<std::shared_ptr<Move>> finished; // the most recent
    std::vector<Trigger> carried;               // of a finished move, for the one that begins next
    bool isStopRequested = false;
};

/// The arm's activity from a time on, until the next span begins.
struct Span {
    TimeNs start = 0;
    std::shared_ptr<const Trajectory> path; // follows it ...
    std::shared_ptr<const Coast> coast;     // ... or brakes off its path, and rests there
    MotionState still;                      // ... or rests; also the state before the first move of a path
    std::optional<Pose> shift;              // in world: the path was abandoned while displaced by this
    TimeNs ledUntil = 0;                    // led from outside with the speeds of `still` until then
};

// Size: one method for each method of the interface; paths, plans and modifiers are classes of their own.
struct MotionSystem::Impl {
    robot::RobotModel model;
    MotionOptions options;
    robot::Kinematics kinematics;

    TimeNs now = 0;
    double override = 100, programOverride = 100; // percent, of the operator and of SpeedRefresh
    SpeedLimits speedLimits;
    bool isStopRequested = false;
    bool isStopAnnounced = true;
    bool isRestAnnounced = true;
    bool isHalted = false;              // off the path, braking or standing
    bool isCoasting = false;            // braking there
    bool isStepping = false;            // going back along the path
    std::shared_ptr<Trajectory> detour; // back to the path, axis by axis

    std::vector<std::pair<GroupAxis, AxisCourse>> independents; // axes that move for themselves

    PathModifiers modifiers;

    FrameSetup lastFrames; // of the latest movement of a path that is no more
    Level level;           // the one in use
    std::vector<Level> stored;
    std::deque<Span> spans;
    std::vector<MotionEvent> events;
    MoveId nextId = 1;
    MoveId lastDone = 0;
    std::deque<std::pair<MoveId, MoveId>> cleared; // first and last of each range, the most recent
    std::deque<std::pair<MoveId, TimeNs>> reached; // the most recent

    /// nextEvent() as it was found last, while nothing has changed since and nothing has happened.
    struct KnownEvent {
        bool isKnown = false;
        std::optional<TimeNs> time;
    };
    mutable KnownEvent known;

    double seconds() const { return toSeconds(now); }
    /// The same frames on the base of this robot.
    FrameSetup based(FrameSetup frames) const {
        frames.baseFrame = model.baseFrame;
        frames.baseMover = options.baseMover;
        return frames;
    }
    Trajectory& path() const { return *level.path; }
    bool isHeld() const { return isStopRequested || overrideShare() <= 0; }
    double overrideShare() const { return 1e-4 * override * programOverride; }
    double speedShare() const { return std::clamp(overrideShare(), 1e-4, 1.0); }
    const Span& span() const { return *spanAt(now); }
    std::deque<Span>::const_iterator spanAt(TimeNs time) const;
    bool isMoving() const;
    TimeNs restTime() const;
    /// The arm may have begun to move: when it is at rest again is reported.
    void noteMotion() { isRestAnnounced = isRestAnnounced && !isMoving(); }

    // Orders
    std::optional<MotionError> externalOutOfRange(const MoveCommand& command) const;
    Expected<Trajectory::Ordered, MotionError> prepared(const MoveCommand& command) const;
    MoveId registerMove(const MoveCommand& command, const Trajectory::Appended& appended);
    bool isResting() const { return level.queue.empty() && !isMoving() && !isHalted && detour == nullptr; }
    std::shared_ptr<Trajectory> newPath(const JointTarget& start, double earliest) const;
    void follow(std::shared_ptr<const Trajectory> what, TimeNs from);
    void beginPath(std::shared_ptr<Trajectory> path);
    void abandonPath(StopKind kind);
    /// Tool and work object of the latest movement.
    FrameSetup framesNow() const {
        return level.path == nullptr || path().isEmpty() ? based(lastFrames) : path().framesAt(path().end());
    }
    void noteCleared(MoveId first);
    void holdOrRelease(StopKind kind = StopKind::Normal);
    void obeyOverride();
    std::optional<PathPlace> placeAfter(double covered, std::size_t moves) const;
    void beginUnderWay(const std::vector<std::pair<MoveCommand, Trajectory::Appended>>& appended,
                       OrderedUnderWay& ordered);
    /// The beginning of the path of a robot: its axes, and the frames of its first movement.
    struct PathStart {
        JointTarget axes;
        FrameSetup frames;
    };
    static std::vector<std::shared_ptr<Trajectory>> pathsTogether(const std::vector<MotionSystem*>& systems,
                                                                  const std::vector<PathStart>& starts);
    static bool standTogether(const std::vector<MotionSystem*>& systems, const std::vector<JointTarget>& here,
                              std::size_t moves, double covered);
    static Expected<std::vector<Trajectory::Ordered>, TogetherError>
    preparedTogether(const std::vector<MotionSystem*>& systems, const std::vector<MoveCommand>& commands);
    void coastNow();
    void resume();
    bool startDetour();
    void finishDetour();
    void finishStepping();
    std::optional<PathPlace> placeBack(double mm) const;

    // Places and moves
    /// The first unfinished move; null when there is none.
    const Move* front() const { return level.queue.empty() ? nullptr : level.queue.front().get(); }
    const Move* findUnfinished(MoveId id) const;
    const Move* moveAt(const PathPlace& place) const;
    PathPlace startOf(const Move& move) const;
    PathPlace endOf(const Move& move) const;
    PathPlace placeOf(const Move& move, const PathTrigger& wanted) const;

    // Events
    void report(MotionEventKind kind, const Move* move, uint32_t trigger = 0);
    std::optional<double> startTime(const Move& move) const;
    bool isPassed(const Move& move) const; // on a curve
    /// When the arm is there, and when the movement ends: later at a stop point that asks for more.
    std::optional<double> arrivalTime(const Move& move) const;
    std::optional<double> reachTime(const Move& move) const;
    std::optional<double> releaseTime(const Move& move) const;
    std::optional<double> triggerTime(const Move& move, const PathTrigger& wanted) const;
    /// When something happens next, not before now; nothing when that depends on an order.
    std::optional<TimeNs> nextEvent() const;
    std::optional<TimeNs> findNextEvent() const;
    bool keepsNextEvent() const;
    void forgetNextEvent() { known.isKnown = false; }
    bool isDue(std::optional<double> time) const { return time && toNs(*time) <= now; }
    void handleEventsNow();
    bool handleMoves();
    bool fireTriggers();
    void finishFront();

    // States
    MotionState stateAt(TimeNs time) const;
    MotionState stateOn(const Trajectory& trajectory, const Span& span, TimeNs time) const;
    MotionState plannedAt(const Trajectory& trajectory, const Span& span, const Trajectory::Moment& at,
                          TimeNs time) const;
    MotionState stateAtPlace(const Trajectory& trajectory, const Span& span, const PathPlace& place) const;
    MotionState pathStateNow() const;

    // Displacement from the path
    bool isModified(const Span& span) const {
        return span.path != nullptr && span.path == level.path && !span.path->isEmpty() &&
               modifiers.areActive();
    }
    PlannedMoment momentOf(const MotionState& planned, const Trajectory::Moment& at, TimeNs time) const;
    void displace(MotionState& state, const Trajectory::Moment& at, TimeNs time) const;
    void measureSpeeds(MotionState& state, const PlannedMoment& planned, TimeNs time) const;
    std::optional<MotionError> shiftArm(MotionState& state, const FrameSetup& frames,
                                        const Pose& wanted) const;
    std::optional<TimeNs> nextAdvance() const;
    void advanceModifiers(TimeNs time);
    void reportOutOfReach();
    Pose shiftNow() const;
    MotionState shown(MotionState state, TimeNs time) const;
    JointTarget shown(JointTarget joints) const;
    MotionState stateIfStopped(TimeNs time) const;
    MotionState stillAt(const JointTarget& joints) const;
    JointTarget standing() const;
    void forgetBefore(TimeNs time);
};

} // namespace motion

#pragma once
// Inside MotionSystem: a queue of planned moves, the stretch of motion in progress, and what happens when.

#include "runtime/motion/coast.h"
#include "runtime/motion/motion_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace motion {

/// Nanoseconds that are not before the given seconds, so that what is promised for a time has happened by
/// then. At most 4e9 s (126 years): a sum of two such times is still a time.
inline TimeNs toNs(double seconds) {
    constexpr double kLongest = 4e9;
    return static_cast<TimeNs>(std::ceil(std::min(seconds, kLongest) * 1e9 - 1e-6));
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
    bool isFlyBy = false;
    bool isConcurrent = false;
    bool isReturn = false;   // back to an interrupted path, on behalf of the move that goes on there
    bool isRetraced = false; // ... the rest of a finished move on which the arm has stepped back
    double zone = 0;         // mm, the largest
    std::vector<Trigger> triggers;
    PlannedMotion plan;
    bool isStarted = false;
    bool isReleased = false;
    double doneSeconds = 0; // time spent on the path before the stretch in progress
    double pausedAt = 0;    // profile parameter at which it was put aside
};

/// What storePath() puts aside.
struct Level {
    std::deque<std::shared_ptr<Move>> queue;
    std::vector<Trigger> carried;
    bool isStopRequested = false;
    bool isBraking = false;
};

/// A piece of the past, present or planned future: one move run by one profile, or standing still (no move).
struct Stretch {
    TimeNs start = 0;
    TimeNs end = 0;
    std::shared_ptr<const Move> move;
    Profile profile;
    double backFrom = -1;               // >= 0: backwards from this parameter, by as much as the profile says
    MotionState still;                  // without a move
    std::shared_ptr<const Coast> coast; // without a move: braking off the path
};

struct MotionSystem::Impl {
    robot::RobotModel model;
    MotionOptions options;
    robot::Kinematics kinematics;

    TimeNs now = 0;
    double override = 100;
    bool isStopRequested = false;
    bool isBraking = false;   // the current stretch ends before the end of the path
    bool isAbandoned = false; // ... and the rest of its move has been thrown away
    bool isStopAnnounced = true;
    bool isHalted = false;    // off the path: the first move goes on at its pausedAt
    bool isCoasting = false;  // braking there
    bool isExcursion = false; // moves although it is held: back on its path or back to it

    std::deque<std::shared_ptr<Move>> queue; // the first may be in progress
    std::vector<Trigger> carried;            // of a finished move, for the one that begins next
    std::vector<Level> levels;
    std::deque<Stretch> stretches; // in order of time; the last one is valid from its start on
    std::vector<MotionEvent> events;
    MoveId nextId = 1;
    MoveId lastDone = 0;
    std::shared_ptr<const Move> finished;          // the move before, as long as the arm may step back on it
    std::deque<std::pair<MoveId, MoveId>> cleared; // first and last of each range, the most recent
    std::deque<std::pair<MoveId, TimeNs>> reached; // the most recent

    const Stretch& stretch() const { return stretches.back(); }
    const Move* findUnfinished(MoveId id) const;
    bool isOnPath() const { return stretch().move != nullptr && now < stretch().end; } // and moving
    bool isMoving() const { return isOnPath() || (stretch().coast != nullptr && now < stretch().end); }
    bool isHeld() const { return isStopRequested || override <= 0; }

    void report(MotionEventKind kind, const Move* move, TimeNs time, uint32_t trigger = 0);
    ProfileState profileState(TimeNs time) const;
    void begin(const std::shared_ptr<Move>& move, const Profile& profile);
    void startNext();
    bool replaceProfile(bool toStop);
    void hold();
    void goOn();
    void noteCleared(MoveId first);
    void coastNow();
    void resume();
    void orderReturnToPath();
    std::optional<TimeNs> nextEvent() const;
    std::optional<TimeNs> triggerTime(const Move& move, const Trigger& trigger) const;
    std::optional<TimeNs> timeOnPath(const PathTrigger& wanted) const;
    std::optional<TimeNs> timeAheadOf(const Move& move, const PathTrigger& wanted) const;
    std::vector<Move*> movesWithTriggers() const;
    void passTriggersOn(const Move& move);
    std::optional<TimeNs> releaseTime() const;
    /// The front of the queue is being run, or was until it stopped.
    bool isOnFront() const {
        return !queue.empty() && stretch().move == queue.front() && stretch().backFrom < 0;
    }
    /// Profile parameter at which the begun front of the queue goes on.
    double pausedAt() const { return isOnFront() ? profileState(now).s : queue.front()->pausedAt; }
    void stepBackOnFront(double from, double mm, double mmPerSecond);
    void finishExcursion();
    bool happensNow(std::optional<TimeNs> time) const { return time && *time <= now; }
    void handleEventsNow();
    void finishStretch();
    MotionState stateAt(TimeNs time) const;
    JointTarget standing() const;
    JointTarget plannedEnd() const;
    void forgetBefore(TimeNs time);
};

} // namespace motion

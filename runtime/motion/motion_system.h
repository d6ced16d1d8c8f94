#pragma once
// MotionSystem: the arm of one robot on the controller's clock. Moves are ordered before they are run, one
// after another; everything that happens is reported as events with exact times. Deterministic: the state
// depends only on the calls made and the times given. Time is int64 nanoseconds of the virtual clock; no call
// goes back in time.

#include "runtime/motion/axis_course.h"
#include "runtime/motion/motion_state.h"
#include "runtime/motion/move_command.h"
#include "runtime/motion/move_limits.h"
#include "runtime/motion/path_modifier.h"
#include "runtime/motion/planner.h"
#include "runtime/motion/stop_kind.h"
#include "runtime/motion/targets.h"
#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace motion {

/// Number of a move, from 1 in the order of enqueue.
using MoveId = int64_t;

enum class MoveStatus : uint8_t {
    Unknown, ///< never ordered
    Queued,  ///< waiting for its turn
    Moving,  ///< on its path (even while stopped there)
    Done,    ///< its point has been reached
    Cleared, ///< thrown away by clear()
};

enum class MotionEventKind : uint8_t {
    Started,  ///< the move has begun
    Released, ///< a program that ordered this move and waits for it may continue (see releaseTime)
    Trigger,  ///< a PathTrigger fired; `trigger` is its id
    Reached,  ///< a stop point: in position; a fly-by point: in the middle of its corner
    Stopped,  ///< standing still after stop()
    AtRest,   ///< no axis moves any more and nothing that is ordered makes one move
    CornerLost, ///< the fly-by point of the move has become a stop point: the next move came too late, or no corner fits
    OutOfReach, ///< a path modifier asked for a place that the arm cannot reach; it brakes on its path as after stop()
};

struct MotionEvent {
    TimeNs time = 0;
    MotionEventKind kind = MotionEventKind::Started;
    MoveId move = 0;
    uint64_t tag = 0;
    uint32_t trigger = 0;
};

struct MotionOptions {
    ExternalAxisModels external{};
    const robot::ExternalUnit* baseMover =
        nullptr;                ///< moves the base of the robot; outlives the motion system
    std::size_t maxQueued = 64; ///< moves ordered ahead; more is QueueFull
    /// How long before its zone is entered, or braking for its point has to begin, a fly-by move lets the program continue.
    TimeNs programLead = 100'000'000;
    Planner planner = Planner::Measured;
};

// Size: the interface of motion: each order, question and event of an arm is a method.
class MotionSystem {
  public:
    /// The arm is at joints 0, joint 5 at 30 degrees, at time 0.
    explicit MotionSystem(robot::RobotModel model, MotionOptions options = {});
    ~MotionSystem();
    MotionSystem(MotionSystem&&) noexcept;
    MotionSystem& operator=(MotionSystem&&) noexcept;

    const robot::RobotModel& model() const;
    const robot::Kinematics& kinematics() const;
    Planner planner() const;
    const ExternalAxisModels& externalAxes() const;

    // ---- ordering moves ----
    /// Orders a move from where the last ordered one ends. Returns at once; the move starts now if the arm
    /// is idle, otherwise after the moves before it. All geometric errors are found here and leave the
    /// queue as it was.
    Expected<MoveId, MotionError> enqueue(const MoveCommand& command);
    // ---- synchronised movements ----
    /// From now on these robots move together (MultiMove): every move is ordered for all of them. False, with nothing done,
    /// unless all of them are idle and at rest.
    static bool beginTogether(const std::vector<MotionSystem*>& systems);
    /// Each robot moves for itself again. One that still moves brakes on its path, and what is left of it is cleared.
    static void endTogether(const std::vector<MotionSystem*>& systems);
    /// Can the robots still order together: none of them has thrown away its path or put it aside.
    static bool areTogether(const std::vector<MotionSystem*>& systems);
    /// A move for each of the systems of beginTogether, in the same order. They begin and end together, and their speeds are in
    /// proportion all the way. An error concerns the command with that number, and nothing happens then.
    struct TogetherError {
        std::size_t command = 0;
        MotionError error;
    };
    static Expected<std::vector<MoveId>, TogetherError>
    enqueueTogether(const std::vector<MotionSystem*>& systems, const std::vector<MoveCommand>& commands);

    /// Throws away all moves not finished (ClearPath, program pointer moved). The arm must stand still: a
    /// moving arm is stopped on its path first and the rest is dropped when it is at rest.
    void clear(StopKind kind = StopKind::Normal);
    /// Brings the arm to these angles without motion (start of a simulation). Only when idle; false
    /// otherwise.
    bool placeAt(const JointTarget& joints);
    /// Leads the arm from outside, without a path: its axes are there now and move with these speeds (deg/s, mm/s) until the next
    /// call, at most for `period`. Only when idle and on no path; false otherwise.
    bool leadTo(const JointTarget& joints, const JointTarget& speed, TimeNs period);
    /// leadTo() moves it.
    bool isLed() const;

    // ---- a path that an earlier process left (--state) ----
    /// The place of the arm on its path.
    struct PlaceUnderWay {
        MoveId move = 0; ///< the one in progress; in a zone the one whose point the curve passes
        bool isInZone = false;
        JointTarget from; ///< where the move begins as programmed
        /// mm of path since then; in a zone since its beginning. Of robots that move together: of the leader's path; in a
        /// zone of any of them since the beginning of the leader's, possibly before or after it.
        double covered = 0;
    };
    /// Nothing beside the path, when the arm is led, and when it is at the beginning of a move.
    std::optional<PlaceUnderWay> placeUnderWay() const;
    struct OrderedUnderWay {
        MoveId before = 0, move = 0;
        JointTarget start; ///< the axes where `move` begins as programmed
    };
    /// Orders a move that the arm, idle and at rest, has covered a part of, and continues from there. `before`: the arm is in
    /// the zone of the point between this move, which begins at `from` then, and the other. Null: it is on the move, outside
    /// zones. Nothing, and nothing has changed, when the path does not lead through where the arm is.
    std::optional<OrderedUnderWay> enqueueUnderWay(const JointTarget& from, double covered,
                                                   const MoveCommand* before, const MoveCommand& command);
    struct UnderWay {
        JointTarget from;
        std::optional<MoveCommand> before;
        MoveCommand command;
    };
    /// The same for robots that move together from now on, the leader's movement first; `covered` of its path.
    static std::optional<std::vector<OrderedUnderWay>>
    enqueueTogetherUnderWay(const std::vector<MotionSystem*>& systems, const std::vector<UnderWay>& orders,
                            double covered);

    // ---- away from the planned path ----
    /// The modifier acts from now on, after those that were added before.
    void addModifier(std::shared_ptr<PathModifier> modifier);
    /// Modifiers follow the plan up to this time, before which nothing changes, so that sample() has an answer there.
    void advanceModifiers(TimeNs time);
    /// Why the latest OutOfReach event happened.
    const std::optional<MotionError>& outOfReachError() const;

    /// The external axis (0 is eax_a) is that of another unit from now on, with limits of its own. Only when idle.
    void setExternalAxis(std::size_t axis, const ExternalAxisModel& model);

    // ---- path levels ----
    /// Puts the unfinished moves aside (StorePath): moves ordered next run from where the arm is, also
    /// after a stop(). False while the arm moves. Levels nest.
    bool storePath();
    /// Restores the path that was put aside last (RestoPath), stopped as it was then. If the arm is elsewhere it
    /// first goes back to the path axis by axis when motion continues. False while moves of this level are
    /// unfinished or when nothing was put aside.
    bool restorePath();
    /// Throws away the unfinished moves of every level that was put aside, and those levels.
    void clearStored();
    /// How far the arm is from where its path continues: place of the TCP and turn of the tool. Nothing when it is
    /// on its path, or there is none to continue.
    struct PathGap {
        double mm = 0, degrees = 0;
    };
    std::optional<PathGap> gapToPath() const;

    // ---- stopping on the path ----
    /// Brakes on the path as fast as the limits allow; a Stopped event follows. No effect when stopped
    /// already, but a quick stop shortens the braking of a normal one.
    void stop(StopKind kind = StopKind::Normal);
    /// Motors off (emergency stop, power failure): each axis brakes for itself, which takes the arm off its path. start()
    /// brings it back, axis by axis, to where stop() would have left it, and continues from there.
    void halt();
    /// Continues from where stop() left the path.
    void start();
    bool isStopRequested() const; ///< between stop() and start()
    /// Takes an arm that halt() left beside its path back to it, axis by axis, and holds it there. While it is at rest
    /// between halt() and start(); otherwise nothing happens.
    void returnToPath();
    /// Moves the arm, stopped and standing on its path, back along it by `mm` of TCP path, at most at `mmPerSecond` and the
    /// programmed speed; a Stopped event follows, start() continues from there. At most to the beginning of the interrupted
    /// move; from its beginning, within the move before. False when there is nothing more to step back on, or the arm is
    /// not standing so.
    bool stepBack(double mm, double mmPerSecond);
    /// The triggers of the interrupted move fire again on what remains of its path; those whose place is passed, at once
    /// when it continues (restart after a power failure, manual 2.3). The arm is at rest.
    void rearmTriggers();

    /// Operator's speed override, percent 0..100, from now on; the current move changes speed on its path. 0
    /// stops.
    void setOverride(double percent);
    double speedOverride() const;
    /// The override of the program (SpeedRefresh), percent 0..100; the product of both counts.
    void setProgramOverride(double percent);
    double programOverride() const;
    /// Share of the programmed speed that both overrides leave, 0..1.
    double overrideShare() const;
    /// From now on no movement of any path level is faster; the one in progress slows down, or speeds up, on its path.
    void setSpeedLimits(const SpeedLimits& most);

    // ---- independent axes ----
    /// From now on this axis moves for itself: all questions about the arm show it where the course has it, while the path is
    /// planned and executed as if it were not so. Another course replaces the one before.
    void setIndependent(GroupAxis axis, AxisCourse course);
    /// Back on the path, at this position of the axis (deg, mm). Only while the arm is idle and at rest; false otherwise.
    bool endIndependent(GroupAxis axis, double position);
    /// Null when the axis does not move for itself.
    const AxisCourse* independent(GroupAxis axis) const;
    /// The axes that move for themselves.
    std::vector<GroupAxis> independentAxes() const;

    // ---- time ----
    /// Continues motion until `time`; events up to and including it are collected.
    void advanceTo(TimeNs time);
    TimeNs now() const;
    /// When the next event will happen if nothing is called before; none when nothing moves.
    std::optional<TimeNs> nextEventTime() const;
    /// Events since the last call, in order of time.
    std::vector<MotionEvent> takeEvents();

    // ---- questions ----
    bool isIdle() const;           ///< no move unfinished
    bool isMoving() const;         ///< some axis is moving now
    bool movesBesidesPath() const; ///< a modifier of the path or an independent axis can move it
    std::size_t unfinishedMoves() const;
    bool hasRoom() const; ///< another move can be ordered
    MoveStatus status(MoveId move) const;
    bool isStarted(MoveId move) const;  ///< Moving or Done
    bool isReleased(MoveId move) const; ///< its Released event has happened, or it was cleared
    bool isDone(MoveId move) const;     ///< Done or Cleared
    /// The move ordered last; 0 before the first.
    MoveId lastOrdered() const;
    /// The move in progress or, when idle, the one finished last; 0 before the first.
    MoveId currentMove() const;
    /// When the move is or was reached, if it is being run (and not braking) or ended recently.
    std::optional<TimeNs> reachTime(MoveId move) const;

    /// State at a time not before the one at the previous advanceTo (so that a trace can fill the gap) and
    /// not after the end of the current move.
    MotionState sample(TimeNs time) const;
    MotionState current() const { return sample(now()); }
    /// State at rest if the arm were stopped on its path at that time, for which sample() has an answer: the place where
    /// stop() would leave it.
    MotionState sampleStopped(TimeNs time) const;
    /// CJointT: where the axes are now. `plannedEnd`: where the last ordered move will end.
    JointTarget currentJoints() const;
    JointTarget plannedEnd() const;
    /// Wrist frame of the robot in world.
    Pose flangeInWorld(const JointTarget& joints) const;
    /// CRobT: the TCP now, for a tool and work object.
    RobTarget currentTarget(const FrameSetup& frames) const;
    /// CalcRobT and CalcJointT with the base frame of this robot; the arm's present posture decides where a
    /// singular position leaves a choice.
    RobTarget toRobTarget(const JointTarget& joints, const FrameSetup& frames) const;
    Expected<JointTarget, MotionError> toJointTarget(const RobTarget& target, const FrameSetup& frames) const;

  private:
    struct Impl;
    /// The hidden part. Access that may change it forgets the next event, which is found again when it is asked for.
    class Hidden {
      public:
        explicit Hidden(std::unique_ptr<Impl> impl);
        ~Hidden();
        Hidden(Hidden&&) noexcept;
        Hidden& operator=(Hidden&&) noexcept;
        const Impl& operator*() const { return *impl_; }
        const Impl* operator->() const { return impl_.get(); }
        Impl& operator*() { return *operator->(); }
        Impl* operator->();
        Impl& keepingNextEvent() { return *impl_; }

      private:
        std::unique_ptr<Impl> impl_;
    };
    Hidden impl_;
};

} // namespace motion

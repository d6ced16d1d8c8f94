#pragma once
// MotionDriver: the MotionSystem of the robot on the scheduler's clock: tasks wait for moves, triggers call
// back at their exact times, the trace is sampled.

#include "runtime/debug/stepped_arm.h"
#include "runtime/host/service_table.h"
#include "runtime/host/stop_flags.h"
#include "runtime/motion/motion_system.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/wait_queue.h"

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rt {

class SynchronisedGroup;
class Task;
class TraceSink;

/// Something to do when the TCP passes a place of the path (manual 1.8, TriggIO and friends).
struct PathAction {
    motion::PathTrigger place; ///< its id is given by the driver
    Time delay = 0; ///< after the place has been passed; a negative lag of `place` is such a delay, too
    std::function<void()> act; ///< called by the scheduler, not on a task's fibre
};

/// How a movement in progress is ended by its own instruction (searches).
enum class BreakOff : uint8_t {
    OnPath,        ///< brakes on the path
    QuicklyOnPath, ///< as a quick stop
    Stiff          ///< each axis brakes for itself
};

/// Changes of the arm's state, for services that accompany it (TriggSpeed, TriggStopProc).
enum class ArmChange : uint8_t {
    Event,       ///< a movement has begun or ended, the arm has come to rest or continues
    StopOnPath,  ///< the program stops; the arm is about to brake on its path, or is at rest
    MotorsOff,   ///< the arm is about to brake beside its path
    PowerFailed, ///< follows MotorsOff when the power has failed
    Start,       ///< the program starts again
    CornerLost,  ///< a fly-by point has become a stop point, and warnings of that are on (CornerPathWarning)
    Override,    ///< one of the speed overrides has changed
    OutOfReach   ///< a path modifier asked for a place that the arm cannot reach; it brakes on its path
};

// Size: the interface of a motion group to tasks, modifiers and services; motion itself is below it.
class MotionDriver final : public SteppedArm {
  public:
    /// `unit`: name of the robot; "" for external units alone. `group`: number of the motion group, from 0.
    MotionDriver(Scheduler& scheduler, robot::RobotModel model, motion::MotionOptions options = {},
                 std::string unit = "ROB_1", std::size_t group = 0);
    ~MotionDriver();
    MotionDriver(const MotionDriver&) = delete;
    MotionDriver& operator=(const MotionDriver&) = delete;

    /// The motion system brought up to the present virtual time, for questions (CRobT, CJointT, kinematics).
    /// Orders go through the functions below, so that their events reach the scheduler; after a direct order
    /// call refresh().
    motion::MotionSystem& system();
    void refresh();
    /// The speed override of the operator, and that of the program (SpeedRefresh): percent, from now on.
    void setOverride(double percent);
    void setProgramOverride(double percent);
    const robot::RobotModel& model() const { return system_.model(); }
    /// Name of the robot: "ROB_1"; "" for external units alone.
    const std::string& unitName() const { return unitName_; }
    std::size_t group() const { return group_; }
    /// Data that a part of the standard library keeps per motion group; made on first use.
    template <class T> T& service() { return services_.get<T>(); }
    void dropServices() { services_.clear(); }

    /// Orders a move and suspends the task until the program may continue (fine point reached, look-ahead,
    /// \Conc: started). While the queue is full the task waits first. A move that cannot be made is reported in
    /// `error` and nothing else happens. The command's tag is set here: the number of the move instruction,
    /// counted from 1. `actions` vanish with the move; movements executed backwards have none.
    Status order(Task& task, motion::MoveCommand command, motion::MoveId& id,
                 std::optional<motion::MotionError>& error, std::vector<PathAction> actions = {});
    /// SyncMoveOn: from now on movements are ordered for all robots of the group. Null: this robot moves for itself.
    void joinGroup(std::shared_ptr<SynchronisedGroup> synchronised);
    void leaveGroup();
    /// Null when this robot moves for itself, even while SyncMoveSuspend or a path level of its own lets it.
    const std::shared_ptr<SynchronisedGroup>& synchronised() const;
    /// The group of SyncMoveOn, even while this robot moves for itself.
    const std::shared_ptr<SynchronisedGroup>& joinedGroup() const { return synchronised_; }
    /// SyncMoveSuspend, SyncMoveResume.
    void suspendGroup(bool suspended);
    bool isSuspended() const { return isSuspended_; }
    /// Called between the two parts of a circle that is stepped forward: stops the task there.
    void setCirclePointStop(std::function<Status(Task&)> stop) { circlePointStop_ = std::move(stop); }
    Status waitDone(Task& task, motion::MoveId id);
    /// Until no move is unfinished (WaitRob \InPos) or no axis moves (\ZeroSpeed).
    Status waitIdle(Task& task);
    Status waitZeroSpeed(Task& task);

    /// Notified after every motion event.
    WaitQueue& changed() { return changed_; }
    /// A movement as it has been ordered, with the axes where it begins and ends.
    struct Ordered {
        motion::MoveId id = 0;
        const motion::MoveCommand& command;
        motion::JointTarget from, to;
    };
    /// Called on the fibre of the task after each movement that the program has ordered (path recorder).
    void addOrderListener(std::function<void(const Ordered&)> listener) {
        orderListeners_.push_back(std::move(listener));
    }
    /// Called for the life of the driver, not on a task's fibre.
    void addListener(std::function<void(ArmChange)> listener) { listeners_.push_back(std::move(listener)); }

    /// StopMove / StartMove, and the controller's stop / start. The arm moves when neither holds it.
    /// Motion tasks and other tasks have a stop of their own (IsStopMoveAct); each ends with the start of the same kind.
    void stopMove(StopOrigin origin = StopOrigin::MotionTask,
                  motion::StopKind kind = motion::StopKind::Normal);
    void startMove(StopOrigin origin = StopOrigin::MotionTask);
    bool isStopMoveActive() const { return stopMove_.isSet(); }
    bool isStopMoveActive(StopOrigin origin) const { return stopMove_.of(origin); }
    bool isProgramStopped() const { return programStop_; }
    /// By StopMove, a stop of the program or a path level; not because of another robot.
    bool isHeldItself() const { return stopMove_.isSet() || programStop_ || levelHold_; }
    /// 1 on the base level, one more for each path that is put aside.
    int pathLevel() const { return 1 + static_cast<int>(levels_.size()); }
    /// StorePath: stops the arm on its path, waits until it is at rest, and puts the unfinished movements aside, with StopMove.
    /// `keepSync`: a synchronised robot remains so on the new level, otherwise it moves for itself there.
    Status storePath(Task& task, bool keepSync = false);
    /// RestoPath: waits until the movements of this level are finished (those that StopMove holds are thrown away) and takes
    /// back the path put aside last. It is held until startMove(), RETRY or clearLevel(). Not on the base level.
    Status restorePath(Task& task);
    /// How far StartMove would have to bring the arm back to its path; nothing when it is there.
    std::optional<motion::MotionSystem::PathGap> gapToPath() { return system().gapToPath(); }
    /// An error handler has executed RETRY: a path that was taken back continues.
    void noteRetry();
    void programStop(motion::StopKind kind = motion::StopKind::Normal) override;
    /// The program stops by itself, with the arm standing still.
    void noteStop() { tell(ArmChange::StopOnPath); }
    void programStart() override;
    /// The motors go off: the arm leaves its path; programStart() brings it back first. `powerFailure`: notes that a path
    /// was interrupted.
    void emergencyStop(bool powerFailure);
    /// A power failure interrupted a path on this level, and that path is not finished yet (PFRestart).
    bool pathInterrupted(int level);
    /// StepBwdPath: back on the path while the robot is held there; returns when it is at rest. `possible` is false when there
    /// is nothing more to step back on.
    Status stepBack(Task& task, double mm, double mmPerSecond, bool& possible);
    /// Program pointer moved: the paths of all levels are gone, and StopMove with them.
    void clearPath() override;
    /// ExitCycle: as clearPath() when a path is put aside, else nothing.
    void leaveLevels();
    /// ClearPath: the path of the present level is gone.
    void clearLevel(motion::StopKind kind = motion::StopKind::Normal);
    /// The movement in progress ends here (searches). The next order begins where the arm comes to rest.
    void breakOff(BreakOff how);
    /// Executed now, the instruction would continue the movement that it has ordered already (RETRY after a process error).
    bool continuesMovement(const Task& task);

    /// The place of the arm on the first of the moves, or in the zone between two.
    struct EarlierPlace {
        std::optional<motion::MoveCommand> before; ///< in a zone: the move to the point
        bool isPassed = false;                     ///< that one is none of the unfinished moves any more
        motion::JointTarget from; ///< where `before`, or the first move, begins as programmed
        double covered = 0;       ///< MotionSystem::PlaceUnderWay::covered
    };
    /// A path that an earlier process had put aside (StorePath).
    struct EarlierLevel {
        std::vector<motion::MoveCommand> moves;
        std::optional<motion::Pose> begun; ///< where the first of them began; it is under way
        motion::JointTarget left;          ///< where the arm stood then
        StopFlags stopMove;
        bool isSuspended = false; ///< the robot moved for itself there, not with those of SyncMoveOn
        std::optional<EarlierPlace> place;
    };
    /// The path that an earlier process left.
    struct EarlierPath {
        std::vector<EarlierLevel> stored;       ///< from the base level on
        std::vector<motion::MoveCommand> moves; ///< to be ordered at once
        std::optional<motion::MoveCommand>
            awaited;                       ///< then the one whose instruction the program executes again
        std::optional<motion::Pose> begun; ///< where the first of all these began; it is under way
        StopFlags stopMove;                ///< StopMove holds the arm
        bool levelHold = false;            ///< RestoPath does
        bool isSuspended = false;          ///< as in EarlierLevel
        std::optional<EarlierPlace> place; ///< on the present level
    };
    EarlierPath remainingPath();
    /// From where the arm is. The next movement the program orders is `awaited`, whatever its arguments are now.
    void continuePath(const EarlierPath& path);
    /// The same for the robots of a SynchronisedGroup (joinGroup), in its order: movements they had ordered together they continue
    /// together.
    static void continueTogether(SynchronisedGroup& group, std::vector<EarlierPath> paths);
    /// Orders a movement for each robot of the group, in its order; of one that they are on already, the rest. `tasks`: null for
    /// movements that an earlier process ordered. The commands are those that were ordered. No movements, and nothing has happened, when
    /// a robot that has left the common path moves.
    static motion::Expected<std::vector<motion::MoveId>, motion::MotionSystem::TogetherError>
    orderTogether(const SynchronisedGroup& group, const std::vector<const Task*>& tasks,
                  std::vector<motion::MoveCommand>& commands);
    /// An axis was in independent mode at a power failure, so that the program cannot continue where it was (manual 2.2.4).
    bool hasLostIndependentAxis() const { return lostIndependentAxis_; }
    /// ProcerrRecovery: the arm stops on its path, and the movement instruction that waits, else the next one, raises
    /// `errorNumber`. Executed again (RETRY) such an instruction continues the movement it has ordered.
    /// `why`: a sentence for the event; "": that of ProcerrRecovery.
    void raiseProcessError(Status errorNumber, std::string why = {});
    /// One is raised by the next movement instruction.
    bool hasProcessError() const { return processError_ != kOk; }

    /// The task whose movement is being ordered, which may be too late for the corner before it; null otherwise.
    const Task* orderingTask() const { return ordering_; }
    /// CornerPathWarning: whether a fly-by point that has to become a stop point is reported.
    void setCornerWarning(bool on) { cornerWarning_ = on; }

    const MotionPointer& pointer() const override { return pointer_; }
    /// Movements are executed backwards from now on: to their target, with type and speed of the motion pointer's.
    void setBackward(bool backward) override { backward_ = backward; }
    bool isBackward() const { return backward_; }
    std::vector<Task*> tasksTogether() const override;
    const std::vector<TogetherChange>& togetherChange() const override { return togetherChange_; }
    /// The task executes backwards a movement that it cannot make together with other tasks: it is to return kAgain.
    bool refusesBackward(Task& task) const;

    /// Gets every sample from now on; must outlive the driver.
    void addTrace(TraceSink& trace) { traces_.push_back(&trace); }
    /// ns between samples of the traces and between two looks of a MotionTicker; before the arm moves.
    void setTick(Time tick) { tick_ = tick; }
    Time tick() const { return tick_; }
    /// SpeedLimAxis, SpeedLimCheckPoint: hold while the system input LimitSpeed is set.
    void setSpeedLimits(const motion::SpeedLimits& most);
    void limitSpeed(bool on);
    bool isSpeedLimited() const { return isSpeedLimited_; }
    /// Nothing left to do: idle, or held by a stop and standing still.
    bool isSettled() const;
    bool isMoving() const { return system_.isMoving(); }
    bool isIdle() const { return system_.isIdle(); } ///< no movement unfinished
    /// Samples up to the present are written.
    void finishTrace();

  private:
    /// A move that has been ordered and, as far as anybody has looked, has not reached its point.
    struct UnfinishedMove {
        motion::MoveId id = 0;
        motion::MoveCommand command;
        motion::Pose start; ///< in the frames of the command
        int level = 1;      ///< path level
    };
    /// The movement instruction that raised a process error while it waited.
    struct Interrupted {
        const Frame* frame = nullptr;
        int32_t statement = -1;
        motion::MoveId move = 0;
        int32_t retry = 0; ///< Task::latestRetry at that time
    };
    struct PendingAction {
        PathAction action;
        motion::MoveId move = 0; ///< 0: not ordered yet
        bool fired = false;
    };
    /// The beginning of the movement that is being ordered.
    struct Beginning {
        motion::Pose pose;
        motion::JointTarget joints;
    };
    /// Around each order of a movement: what is known before, and what has to be noted after it.
    Beginning beginOrder(const Task* task, motion::MoveCommand& command);
    /// `task` null: an earlier process ordered it.
    void noteOrdered(const Task* task, const motion::MoveCommand& command, motion::MoveId id,
                     const Beginning& beginning);
    Status orderParts(Task& task, motion::MoveCommand command, const MotionPointer& pointer,
                      motion::MoveId& id, std::optional<motion::MotionError>& error);
    void addActions(motion::MoveCommand& command, std::vector<PathAction> actions);
    template <class Condition> void dropActions(Condition drop);
    Status submit(Task& task, motion::MoveCommand command, motion::MoveId& id,
                  std::optional<motion::MotionError>& error);
    Status submitTogether(Task& task, motion::MoveCommand command, motion::MoveId& id,
                          std::optional<motion::MotionError>& error);
    void refreshAlone();
    void holdOrRelease(motion::StopKind kind);
    void noteTogetherChange(const Task& task);
    Status waitReleased(Task& task, motion::MoveId id);
    motion::Pose startOf(const motion::MoveCommand& command) const;
    /// `task` null: the place of the movement in the program is not known.
    void enqueued(motion::MoveId id, const motion::MoveCommand& command, const motion::Pose& start,
                  const motion::JointTarget& endAxes, const Task* task);
    /// The movement that an earlier process waited for; of a circle that it had begun the rest.
    void continueEarlier(motion::MoveCommand& command);
    void orderEarlier(const std::vector<motion::MoveCommand>& moves);
    void orderRest(std::vector<motion::MoveCommand> moves, bool hasAwaited);
    std::optional<motion::MoveId> orderUnderWay(motion::MoveCommand& command, Beginning& beginning);
    std::optional<EarlierPlace> placeLeft();
    Beginning takeUnderWay(const EarlierPlace& place, const motion::MotionSystem::OrderedUnderWay& ordered,
                           const motion::MoveCommand& command);
    void storeEarlier(const EarlierLevel& level);
    void holdEarlier(const EarlierPath& path);
    struct EarlierOrders;
    static void orderEarlierTogether(SynchronisedGroup& group, const std::vector<EarlierOrders>& orders);
    static std::optional<std::vector<motion::MoveId>>
    continueUnderWay(const SynchronisedGroup& group, const std::vector<const Task*>& tasks,
                     std::vector<motion::MoveCommand>& commands, std::vector<Beginning>& beginnings);
    void finishEarlierLevel(const EarlierPath& path, std::size_t number, bool isOrdered,
                            const motion::JointTarget& here);
    Status takeProcessError(Task& task);
    static bool isSame(const Interrupted& interrupted, const Task& task, const MotionPointer& pointer);
    void advance(Time time);
    void trace(Time time);
    motion::MotionState tracedState(Time time) const;
    void skipStill(const motion::MotionState& state, Time time);
    void handle(const motion::MotionEvent& event);
    void schedule();
    void applyStops(motion::StopKind kind = motion::StopKind::Normal);
    void tell(ArmChange news);

    Scheduler& scheduler_;
    motion::MotionSystem system_;
    std::string unitName_;
    std::size_t group_ = 0;
    ServiceTable services_;
    EventToken next_ = 0;
    Time nextTime_ = kNever;
    uint64_t instructions_ = 0; // move instructions ordered so far
    uint32_t lastTrigger_ = 0;
    std::map<uint32_t, PendingAction> actions_; // by the id of the trigger
    WaitQueue changed_;
    std::vector<TraceSink*> traces_;
    Time nextSample_ = 0;
    Time tick_ = 4 * kMillisecond; // TraceSink::kPeriod
    std::shared_ptr<SynchronisedGroup> synchronised_;
    std::vector<TogetherChange> togetherChange_;
    bool isSuspended_ = false;
    StopFlags stopMove_;
    bool programStop_ = false;
    bool levelHold_ = false; // from StorePath until the arm is at rest; from RestoPath until it may move
    Status processError_ = kOk;
    std::string processErrorText_;
    Interrupted interrupted_;
    struct StoredLevel { // what belongs to a path that is put aside
        StopFlags stopMove;
        Interrupted interrupted;
        motion::JointTarget left;
        bool wasSuspended = false;
        std::optional<EarlierPlace> place;
    };
    std::vector<StoredLevel> levels_;
    motion::MoveId brokenPath_ = 0; // last move of the path at the power failure; 0 = none
    int brokenLevel_ = 1;           // on which it was
    MotionPointer pointer_;
    std::deque<UnfinishedMove> ordered_;
    motion::MoveId awaited_ = 0; // by the instruction that ordered it
    EarlierPath earlier_;        // what is left to be taken over
    bool backward_ = false;
    bool lostIndependentAxis_ = false;
    bool brokenOff_ = false; // the movement of the latest order was
    bool cornerWarning_ = true;
    bool isSpeedLimited_ = false;
    motion::SpeedLimits speedLimits_;
    const Task* ordering_ = nullptr;
    std::function<Status(Task&)> circlePointStop_;
    std::vector<std::function<void(ArmChange)>> listeners_;
    std::vector<std::function<void(const Ordered&)>> orderListeners_;
    bool advancing_ = false;
};

} // namespace rt

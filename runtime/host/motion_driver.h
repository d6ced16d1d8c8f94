#pragma once
// MotionDriver: the MotionSystem of the robot on the scheduler's clock: tasks wait for moves, triggers call
// back at their exact times, the trace is sampled.

#include "runtime/motion/motion_system.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/wait_queue.h"

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace rt {

class Task;
class TraceWriter;

/// The movement instruction executed last: where it stands and what it ordered (manual 1.21).
struct MotionPointer {
    bool valid = false;
    const Frame* frame = nullptr;
    const RoutineDesc* routine = nullptr;
    int32_t statement = -1;
    motion::MoveCommand command;
};

class MotionDriver {
  public:
    MotionDriver(Scheduler& scheduler, robot::RobotModel model);
    ~MotionDriver();
    MotionDriver(const MotionDriver&) = delete;
    MotionDriver& operator=(const MotionDriver&) = delete;

    /// The motion system brought up to the present virtual time, for questions (CRobT, CJointT, kinematics).
    /// Orders go through the functions below, so that their events reach the scheduler; after a direct order
    /// call refresh().
    motion::MotionSystem& system();
    void refresh();
    /// Name of the mechanical unit: "ROB_1".
    const std::string& unitName() const { return unitName_; }

    /// Orders a move and suspends the task until the program may go on (fine point reached, look-ahead,
    /// \Conc: started). While the queue is full the task waits first. A move that cannot be made is told in
    /// `error` and nothing else happens. The command's tag is set here: the number of the move instruction,
    /// counted from 1.
    Status order(Task& task, motion::MoveCommand command, motion::MoveId& id,
                 std::optional<motion::MotionError>& error);
    /// Called between the two parts of a circle that is stepped forward: stops the task there.
    void setCirclePointStop(std::function<Status(Task&)> stop) { circlePointStop_ = std::move(stop); }
    Status waitDone(Task& task, motion::MoveId id);
    /// Until no move is unfinished (WaitRob \InPos) or no axis moves (\ZeroSpeed).
    Status waitIdle(Task& task);
    Status waitZeroSpeed(Task& task);

    /// A trigger for MoveCommand::triggers: `action` is called once, by the scheduler, when it fires.
    uint32_t addTrigger(std::function<void(const motion::MotionEvent&)> action);
    /// Notified after every motion event.
    WaitQueue& changed() { return changed_; }

    /// StopMove / StartMove, and the controller's stop / start. The arm moves when neither holds it.
    void stopMove();
    void startMove();
    bool isStopMoveActive() const { return stopMove_; }
    void programStop();
    void programStart();
    /// The motors go off: the arm leaves its path; programStart() brings it back first. `powerFailure`: notes that a path
    /// was interrupted.
    void emergencyStop(bool powerFailure);
    /// A power failure interrupted a path, and that path is not finished yet (PFRestart).
    bool pathInterrupted();
    /// ClearPath, program pointer moved.
    void clearPath();
    /// ProcerrRecovery: the arm stops on its path, and the movement instruction that waits, else the next one, raises
    /// `errorNumber`. Executed again (RETRY) such an instruction goes on with the movement it has ordered.
    void raiseProcessError(Status errorNumber);

    const MotionPointer& pointer() const { return pointer_; }
    /// Movements are executed backwards from now on: to their target, with type and speed of the motion pointer's.
    void setBackward(bool backward) { backward_ = backward; }

    void setTrace(TraceWriter* trace) { trace_ = trace; }
    /// Nothing left to do: idle, or held by a stop and standing still.
    bool isSettled() const;
    bool isMoving() const { return system_.isMoving(); }
    /// Samples up to the present are written.
    void finishTrace();

  private:
    Status submit(Task& task, motion::MoveCommand command, motion::MoveId& id,
                  std::optional<motion::MotionError>& error);
    Status waitReleased(Task& task, motion::MoveId id);
    Status takeProcessError(Task& task);
    void advance(Time time);
    void handle(const motion::MotionEvent& event);
    void schedule();
    void applyStops();

    Scheduler& scheduler_;
    motion::MotionSystem system_;
    std::string unitName_ = "ROB_1";
    EventToken next_ = 0;
    Time nextTime_ = kNever;
    uint64_t instructions_ = 0; // move instructions ordered so far
    uint32_t lastTrigger_ = 0;
    std::map<uint32_t, std::function<void(const motion::MotionEvent&)>> triggers_;
    WaitQueue changed_;
    TraceWriter* trace_ = nullptr;
    Time nextSample_ = 0;
    bool stopMove_ = false, programStop_ = false;
    Status processError_ = kOk;
    struct { // the movement instruction that raised a process error while it waited
        const Frame* frame = nullptr;
        int32_t statement = -1;
        motion::MoveId move = 0;
        int32_t retry = 0; ///< Task::latestRetry at that time
    } interrupted_;
    motion::MoveId brokenPath_ = 0; // last move of the path at the power failure; 0 = none
    MotionPointer pointer_;
    bool backward_ = false;
    std::function<Status(Task&)> circlePointStop_;
    bool advancing_ = false;
};

} // namespace rt

#pragma once
// Debugger: stepping, breakpoints, the program pointer, backward execution (manual 1.21), looking at and changing data
// of a program made for the stepping profile. One per controller; what shows it to people (a line-mode debugger, an
// editor, a stimulus file) is a DebugClient or calls the orders directly.

#include "runtime/debug/breakpoints.h"
#include "runtime/debug/debug_data.h"
#include "runtime/debug/debug_host.h"
#include "runtime/sched/step_hook.h"
#include "runtime/sched/task.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

class Debugger;

enum class StopReason : uint8_t {
    Entry, ///< before the first statement
    Breakpoint,
    Step,        ///< a step is done
    CirclePoint, ///< a step forward ended at the circle point of a MoveC
    Cursor,      ///< run to cursor
    Order,       ///< stop order
    Stop,        ///< Stop or DebugBreak was executed
    Error,       ///< system handler
    Pointer,     ///< the program pointer was moved
    Routine,     ///< a breakpoint at the beginning of a routine
    Data,        ///< watched data have changed
    Raised,      ///< an error that a handler will take
};

/// Whoever debugs the program.
class DebugClient {
  public:
    /// Called by the scheduler's thread, outside all tasks, when the program has stopped. From now on nothing executes and
    /// virtual time does not pass until an order to the debugger lets the program continue, or `quit`. The order may be given
    /// here or later, by a command from the inbox of the scheduler.
    virtual void stopped(Debugger& debugger, Task& task, StopReason reason) = 0;
    /// Whether the program stops at an error that nothing takes; else the run ends as it does without a client.
    virtual bool stopsAtError(const Task&) { return true; }
    /// Whether it stops when an error is raised that a handler will take.
    virtual bool stopsAtHandledError(const Task&, int) { return false; }

  protected:
    ~DebugClient() = default;
};

/// One routine in progress, innermost first.
struct DebugFrame {
    SourcePlace place;
    Frame* frame = nullptr;
    bool isTrap = false; ///< the system called it: an interrupt or an event
};

// Size: every order to step a program, of one task or of tasks that move together, on one state for each task.
class Debugger final : public StepHook {
  public:
    explicit Debugger(DebugHost& host) : host_(host), breakpoints_(host) {}

    /// Null: none; then only orders of the stimulus step the program.
    void setClient(DebugClient* client);
    bool hasClient() const { return client_ != nullptr; }
    /// Every NORMAL task stops before its first statement.
    void stopAtEntry();
    /// The program was made for the stepping profile.
    bool available() const;
    /// Called between tasks: lets the client speak when the program is halted. True: the run is to end.
    bool poll();
    /// The program is held for the client: nothing executes, virtual time does not pass.
    bool holds() const;
    /// The client knows of the stop, and no order has followed. Code that it lets a task execute does not change that.
    bool standsStill() const { return held_; }
    /// The client may start the tasks that are stopped.
    bool mayStart() const { return client_ != nullptr && !errorEndsRun_; }
    void quit() { quit_ = true; }

    Breakpoints& breakpoints() { return breakpoints_; }
    /// From now on tasks ask before every statement, so that breakpoints stop them; until then, a program pays nothing for an unused
    /// debugger. Orders and a client do it themselves.
    void watch();
    /// A module has come into memory or left it.
    void memoryChanged() { breakpoints_.memoryChanged(); }

    // ---- Orders; each returns "" or why it is refused. The other tasks execute while one is stepped, unless it is to be
    // stepped alone.
    /// Stops everything. If `task` executes, it is stopped before its next statement, as far as that comes soon. The stop is
    /// that of `task`.
    std::string pause(Task& task);
    std::string run();
    /// One task only.
    std::string runAlone(Task& task);
    std::string stepIn(Task& task, bool alone = false) { return begin(task, Mode::In, alone); }
    std::string stepOver(Task& task, bool alone = false) { return begin(task, Mode::Over, alone); }
    /// As stepOver, but until another line is reached.
    std::string stepLine(Task& task, bool intoRoutines, bool alone = false);
    std::string stepOut(Task& task, bool alone = false) { return begin(task, Mode::Out, alone); }
    /// Until the next movement instruction is to be executed.
    std::string stepMove(Task& task, bool alone = false) { return begin(task, Mode::Move, alone); }
    /// With a movement, the tasks whose robots move together with this one (SyncMoveOn) make theirs.
    std::string stepBackward(Task& task);
    /// Each of these tasks steps backward; those that move together make one step.
    std::string stepBackward(const std::vector<Task*>& tasks);
    /// Steps backward until the beginning of the routine or a breakpoint.
    std::string runBackward(Task& task);
    std::string runToLine(Task& task, std::string_view where, uint32_t line);

    // ---- Program pointer (manual 1.2.2, 1.13); the task must stand still.
    /// Within the current routine of the task: nothing is unwound, data are unchanged.
    std::string pointerToLine(Task& task, uint32_t line);
    /// The call chain is left with its UNDO handlers; the next start executes the routine.
    std::string pointerToRoutine(Task& task, std::string_view name);
    std::string pointerToMain();
    /// After pointerToRoutine: the routine is entered, and the task stops before its first statement.
    std::string enterRoutine(Task& task);

    // ---- Looking at things
    std::vector<DebugFrame> frames(const Task& task) const;
    /// Parameters and data of the routine, then, without a frame, data of the modules.
    std::vector<DebugVariable> locals(const DebugFrame& frame) const;
    std::vector<DebugVariable> globals(const Task& task) const;
    /// A name with indices and components: "pos1.x", "list{2,3}.name". Routine data hide data of modules.
    /// Null `data` and a message in `error` when there is none.
    DebugVariable find(const Task& task, const DebugFrame* frame, std::string_view path,
                       std::string& error) const;
    /// Text as in a declaration; "" or what is wrong.
    std::string assign(const Task& task, const DebugFrame* frame, std::string_view path,
                       std::string_view text);

    // ---- Called by the controller
    /// A task has stopped for a reason of its own (error, Stop instruction, stop order).
    void noteStop(Task& task, StopReason reason);
    /// `start` after steps: continuous execution.
    void continuous(Task& task);
    /// A procedure found by name is about to be called. False: its caller is executed backwards and it does not say how
    /// that is done; it is not called.
    bool allowsCall(Task& task, const Frame* caller, const RoutineDesc& callee);
    /// Halts inside an instruction (at the circle point of a MoveC).
    Status stopInside(Task& task);
    /// The system handler has stopped a task because of an error.
    void noteError(Task& task);

    // ---- StepHook
    int32_t beforeStatement(Task& task, Frame* at) override;
    bool isBackward(const Task& task) const override;
    bool refuseBackward(Task& task) override;
    Status handledErrorRaised(Task& task, int number) override;

  private:
    static constexpr const char* kInCircle = "the direction cannot be changed while the robot executes MoveC";
    enum class Mode : uint8_t { Run, In, Over, Out, Move, Cursor, Backward, Line, LineInto, Pause };
    struct State {
        Mode mode = Mode::Run;
        bool passFirst = false;  ///< the first statement, at main or at an error, is the one stepped
        bool entry = false;      ///< this stop is the one before the first statement
        std::size_t depth = 0;   ///< frames when the order was given
        std::string cursorPlace; ///< run to cursor
        uint32_t cursorLine = 0;
        uint32_t fromLine = 0;     ///< Line, LineInto
        Frame* standing = nullptr; ///< the task is halted before a statement of this frame
        bool insideCircle = false; ///< at a circle point
        bool jumped = false;       ///< another statement was chosen; its own question is skipped
        // Backward execution
        bool pendingBackward = false;   ///< ordered while the task stood inside a statement
        bool backwardLast = false;      ///< the last step was a backward one
        bool backwardTop = false;       ///< nothing lies before the program pointer
        Frame* backwardFrame = nullptr; ///< its statement is being executed backwards
        int32_t backwardStatement = -1;
        bool backwardRefused = false; ///< it could not be done
        bool backwardOn = false;      ///< step after step until the beginning of the routine or a breakpoint
    };

    State& stateOf(const Task& task) { return states_[&task]; }
    bool shouldStop(Task& task, State& state, Frame* at, StopReason& reason);
    static Mode runningMode(const State& state, Mode mode);
    static bool stepEnds(const State& state, const Frame* at);
    /// Stops every task where it is; the stop is that of `task`.
    void stopAll(Task& task);
    Status standStill(Task& task, StopReason reason);
    bool isHeldHere(const Task& task) const;
    /// Stopped by an error of the statement at the program pointer, which is executed again.
    static bool isAtFaultyStatement(const Task& task);
    void resumeOthers(const Task& task);
    int32_t stopHere(Task& task, State& state, Frame* at, int32_t here, StopReason reason);
    static int32_t continueAt(State& state, const Frame* at, int32_t here);
    /// `alone`: the other tasks are left as they are.
    std::string begin(Task& task, Mode mode, bool alone = false);
    std::string refusal(const Task& task) const;
    /// The state that belongs to the call chain that was left.
    void forget(const Task& task);
    // debugger_backward.cpp
    struct BackwardPlan {
        enum class Kind : uint8_t {
            Moves,    ///< the program pointer only
            Executes, ///< a movement
            Calls,    ///< a procedure with a BACKWARD handler
            Continues ///< inside of that handler
        };
        std::string problem; ///< it cannot be done; the rest is without meaning
        Kind kind = Kind::Moves;
        int32_t statement = -1; ///< of the program pointer then
        bool isTop = false;     ///< nothing lies before that one
        bool executes() const { return kind != Kind::Moves; }
    };
    /// One step backward; nothing is changed yet.
    BackwardPlan planBackward(Task& task, const State& state, Frame* at);
    /// Moves the program pointer, or begins to execute its statement backwards (then backwardFrame is set).
    void carryOut(Task& task, State& state, Frame* at, const BackwardPlan& plan);
    std::string startBackward(Task& task, State& state, Frame* at);
    /// Writes the reason to the event log, and returns it.
    std::string refusedBackward(const Task& task, std::string problem);
    /// Why the statements from `first` to before `end` cannot be passed backwards because of SyncMoveOn or SyncMoveOff; "" when they can.
    std::string refusalOfSync(const Task& task, const Frame& at, int32_t first, int32_t end);
    // debugger_together.cpp
    /// The tasks that move together with this one, itself included; none when it moves for itself.
    std::vector<Task*> tasksTogether(const Task& task);
    std::string stepTogether(Task& task, const std::vector<Task*>& all);
    std::string refusalTogether(const Task& task);
    std::string turnTogether(const std::vector<Task*>& all);
    void finishTogether(Task& task, std::vector<Task*> inside);
    std::string moveTogether(Task& task, const std::vector<Task*>& all);
    bool endsStepTogether(Task*& task);
    void endMeeting();
    bool continuesBackward(Task& task);
    void finishBackward(Task& task, State& state, Frame* at, bool isTakenBack);
    /// The first step forward after one backward moves the pointer only. False: it is not needed.
    bool turnForward(Task& task, State& state);

    DebugHost& host_;
    DebugClient* client_ = nullptr;
    bool quit_ = false;
    std::map<const Task*, State> states_;
    Breakpoints breakpoints_;
    bool held_ = false;         ///< the client knows that the program has stopped
    bool errorEndsRun_ = false; ///< an error has stopped the program, and the client does not stop at errors
    Task* pausing_ = nullptr;   ///< ordered to pause
    int pausePolls_ = 0;
    struct {
        Task* ordered = nullptr;  ///< the task whose step it is
        std::vector<Task*> tasks; ///< those that have not completed it
        bool isFirstDone = false; ///< one has
    } together_;
    Task* stoppedTask_ = nullptr;
    StopReason stopReason_ = StopReason::Entry;
};

} // namespace rt

#pragma once
// Debugger: stepping, breakpoints, the program pointer, backward execution (manual 1.21), looking at and changing data
// of a program made for the stepping profile. One per controller; what shows it to people (a line-mode debugger, an
// editor, a stimulus file) is a DebugClient or calls the orders directly.

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
    Entry, ///< ahead of the first statement
    Breakpoint,
    Step,        ///< a step is done
    CirclePoint, ///< a step forward ended at the circle point of a MoveC
    Cursor,      ///< run to cursor
    Order,       ///< stop order
    Stop,        ///< Stop or DebugBreak was executed
    Error,       ///< system handler
    Pointer,     ///< the program pointer was moved
};

/// Called by the scheduler's thread, outside all tasks, when the program stands still. Gives orders to the debugger and
/// returns when one of them lets the program go on, or after `quit`.
class DebugClient {
  public:
    virtual void stopped(Debugger& debugger, Task& task, StopReason reason) = 0;

  protected:
    ~DebugClient() = default;
};

struct Breakpoint {
    int id = 0;
    std::string file;        ///< as given: a path, a file name or the name of a module
    uint32_t line = 0;       ///< as given, from 1
    uint32_t actualLine = 0; ///< of the statement that stops; 0: there is none
    bool waits = false;      ///< no module of that name is in memory; it may be loaded later
};

/// One routine in progress, innermost first.
struct DebugFrame {
    SourcePlace place;
    Frame* frame = nullptr;
    bool isTrap = false; ///< the system called it: an interrupt or an event
};

class Debugger final : public StepHook {
  public:
    explicit Debugger(DebugHost& host) : host_(host) {}

    /// Null: nobody looks; then only orders of the stimulus step the program.
    void setClient(DebugClient* client);
    bool hasClient() const { return client_ != nullptr; }
    /// Every NORMAL task stops ahead of its first statement.
    void stopAtEntry();
    /// The program was made for the stepping profile.
    bool available() const;
    /// Called between tasks: lets the client speak when the program stands still. True: the run is to end.
    bool poll();
    void quit() { quit_ = true; }

    // ---- Breakpoints: `where` is a module, a file name or a path; the first statement at or below the line stops.
    Breakpoint addBreakpoint(std::string_view where, uint32_t line);
    bool removeBreakpoint(int id);
    const std::vector<Breakpoint>& breakpoints() const { return breakpoints_; }
    /// A module has come into memory or left it.
    void memoryChanged();

    // ---- Orders; each returns "" or why it is refused. The other NORMAL tasks execute while one is stepped.
    std::string run();
    std::string stepIn(Task& task);
    std::string stepOver(Task& task);
    std::string stepOut(Task& task);
    /// Until the next movement instruction is to be executed.
    std::string stepMove(Task& task);
    std::string stepBackward(Task& task);
    /// As controller actions do it: every NORMAL task makes its step.
    std::string stepTogether(Task& task, bool forward);
    std::string runToLine(Task& task, std::string_view where, uint32_t line);

    // ---- Program pointer (manual 1.2.2, 1.13); the task must stand still.
    /// Within the routine the task stands in: nothing is unwound, data are unchanged.
    std::string pointerToLine(Task& task, uint32_t line);
    /// The call chain is left with its UNDO handlers; the next start executes the routine.
    std::string pointerToRoutine(Task& task, std::string_view name);
    std::string pointerToMain();

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
    /// Stands still inside an instruction (at the circle point of a MoveC).
    Status stopInside(Task& task);

    // ---- StepHook
    int32_t beforeStatement(Task& task, Frame* at) override;
    bool isBackward(const Task& task) const override;

  private:
    enum class Mode : uint8_t { Run, In, Over, Out, Move, Cursor, Backward };
    struct State {
        Mode mode = Mode::Run;
        bool passFirst = false;  ///< the program pointer is at main: the first statement is the one stepped
        bool entry = false;      ///< this stop is the one ahead of the first statement
        std::size_t depth = 0;   ///< frames when the order was given
        std::string cursorPlace; ///< run to cursor
        uint32_t cursorLine = 0;
        Frame* standing = nullptr; ///< the task stands ahead of a statement of this frame
        bool insideCircle = false; ///< at a circle point
        bool jumped = false;       ///< another statement was chosen; its own question is passed over
        // Backward execution
        bool pendingBackward = false;   ///< ordered while the task stood inside a statement
        bool backwardLast = false;      ///< the last step was a backward one
        bool backwardTop = false;       ///< nothing lies before the program pointer
        Frame* backwardFrame = nullptr; ///< its statement is being executed backwards
        int32_t backwardStatement = -1;
        bool backwardRefused = false; ///< it could not be done
    };

    State& stateOf(const Task& task) { return states_[&task]; }
    bool shouldStop(State& state, Frame* at, StopReason& reason);
    bool isBreakpoint(const Frame& at);
    void findLine(Breakpoint& breakpoint) const;
    int32_t stopHere(Task& task, State& state, Frame* at, int32_t here, StopReason reason);
    static int32_t goOn(State& state, const Frame* at, int32_t here);
    /// `alone`: the other tasks are left as they are.
    std::string begin(Task& task, Mode mode, bool alone = false);
    std::string refusal(const Task& task) const;
    /// What belongs to the call chain that was left.
    void forget(const Task& task);
    /// From now on tasks ask ahead of every statement; before, a program pays nothing for what nobody uses.
    void watch();
    // debugger_backward.cpp
    /// Moves the program pointer, or begins to execute its statement backwards (then backwardFrame is set).
    std::string startBackward(Task& task, State& state, Frame* at);
    void finishBackward(Task& task, State& state, Frame* at);
    /// The first step forward after one backward moves the pointer only. False: it is not needed.
    bool turnForward(Task& task, State& state);

    DebugHost& host_;
    DebugClient* client_ = nullptr;
    bool quit_ = false;
    std::map<const Task*, State> states_;
    std::vector<Breakpoint> breakpoints_;
    int lastBreakpoint_ = 0;
    std::map<const RoutineDesc*, std::vector<bool>>
        stops_; ///< statements with a breakpoint; filled on demand
    Task* stoppedTask_ = nullptr;
    StopReason stopReason_ = StopReason::Entry;
};

} // namespace rt

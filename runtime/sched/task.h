#pragma once
// Task: one RAPID task on its own fibre. Natives get it from the TaskCore that compiled code hands them:
//
//     rt::Status rt_WaitTime(rt::TaskCore* core, float seconds) {
//         rt::Task& task = rt::taskOf(core);
//         if (seconds < 0) return task.raise(ERR_ARGVALERR, "WaitTime: the time must not be negative");
//         return task.sleepFor(rt::fromSeconds(seconds));
//     }
//
// Every function that may suspend the task returns a Status. Negative: the task is being unwound; the native
// releases what it holds and returns that very status at once. A native raises an error by returning its
// positive ERRNO.

#include "runtime/abi/rt_abi.h"
#include "runtime/base/source_place.h"
#include "runtime/base/time.h"
#include "runtime/sched/event_routines.h"
#include "runtime/sched/interrupts.h"
#include "runtime/sched/raised_error.h"
#include "runtime/sched/retry_counts.h"

#include <array>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rt {

class Controller;
class EventLog;
class Fibre; // sched/fibre.h
class Scheduler;
class StepHook;
class WaitQueue;
struct ErrorRoute; // sched/error_search.h

enum class EventId : int; // log/event_log.h

enum class TaskKind : uint8_t { Normal, Static, SemiStatic };

enum class TaskState : uint8_t {
    Ready,    ///< can run
    Waiting,  ///< for a time, a WaitQueue or something outside
    Finished, ///< its cycles are over, or EXIT with no start to come
};
class Task;
/// Why a task does not run although it could.
enum class StopCause : uint8_t {
    None,
    Instruction, ///< Stop
    Order,       ///< controller action `stop`
    Error,       ///< system handler; the failing instruction is executed again when the task continues
    Blocked,     ///< SystemStopAction \StopBlock: can continue only from main
    Step,        ///< halted before a statement (stepping profile)
    AtMain,      ///< program pointer at main after pp_to_main or EXIT, not started yet
};

enum class WaitResult : uint8_t { Done, Timeout };

/// The place of a task that does not execute: how a later process treats the statement of its innermost frame.
enum class Standing : uint8_t {
    Between,     ///< somewhere inside a statement
    AtStatement, ///< before a statement (stepping profile)
    InWait,      ///< in an instruction that waits; started again it counts from the beginning
    AfterStop,   ///< Stop has been executed
    AtError,     ///< the statement failed; started again it is executed again
};

/// The errors that a task is handling. Frames are named by their depth, main's is 0.
struct ErrorMemory {
    struct Retries {
        std::size_t depth = 0;
        int32_t statement = -1;
        int number = 0;
        std::map<int, int> counts;
    };
    struct Handled { ///< reported when its handler is left
        std::size_t depth = 0;
        int number = 0;
        std::string text;
        SourcePlace place;
    };
    int32_t errorNumber = 0, interruptNumber = 0;
    std::string text;
    SourcePlace place;
    std::vector<Retries> retries;
    std::optional<Handled> handled;
};

/// Something outside the controller that a waiting task looks at. Virtual time keeps pace with the wall clock meanwhile.
struct OutsideWait {
    int fd = -1;      ///< -1: only time keeps step
    short events = 0; ///< POLLIN, POLLOUT of poll(2)
};

/// The wait of a task: until `condition` is true. It is checked first at once, then whenever one of
/// `queues` is notified, when what is `outside` is ready, and every `pollPeriod` when that is not 0. Without a condition
/// any notification ends the wait.
struct WaitSpec {
    std::vector<WaitQueue*> queues;
    std::function<bool()> condition;
    Time deadline =
        kNever; ///< absolute virtual time; after a stop and start all of it counts again (manual 2.2.6)
    Time pollPeriod = 0;
    /// Asked each time before the task waits on. None, or no function: nothing outside can end the wait.
    std::function<std::optional<OutsideWait>()> outside = {};
    /// The task waits until others are at the same place of their programs, and its instruction has no effect until then: see
    /// Task::takeBack.
    bool isMeeting = false;
};

/// The interface of a task to the controller it belongs to (so that tasks can be tested without one).
class TaskHost {
  public:
    virtual EventLog& log() = 0;
    /// main is to be run (again).
    virtual bool cyclesLeft(const Task& task) const = 0;
    /// Another order to start the NORMAL tasks may come.
    virtual bool startToCome() const = 0;
    /// The cycles of the task are over: it stays with its program pointer at main and can be started again. False: it has ended.
    virtual bool staysAtMain(Task&) { return false; }
    /// No Of Retry.
    virtual int retryLimit() const = 0;
    /// The system handler has stopped this task.
    virtual void taskFailed(Task& task) = 0;
    /// The task executed Stop and is halted now.
    virtual void taskStopped(Task&) {}
    /// The variables of the task have got their initial values because its program begins again.
    virtual void programReset(Task&) {}
    /// Module data outside the program the task was made from (modules loaded later) get their initial values, too.
    virtual Status resetUnits(Task&) { return kOk; }
    /// The routines of this event have ended or were unwound.
    virtual void eventRoutinesEnded(Task&, SystemEvent) {}
    /// The task executed ExitCycle.
    virtual void cycleLeft(Task&) {}
    /// An error handler of the task executed RETRY.
    virtual void retried(Task&) {}
    /// The task executed EXIT and will not continue by itself.
    virtual void taskExited(Task&) {}
    virtual void stopNormalTasks(StopCause cause) = 0;

  protected:
    ~TaskHost() = default;
};

// Size: the interface of compiled code, natives, scheduler and debugger to a task; errors, interrupts and events are parts of it.
class Task : public TaskCore {
  public:
    /// `desc` must outlive the task. Tasks are made by the Controller.
    Task(TaskHost& host, Controller* controller, Scheduler& scheduler, const TaskDesc& desc, uint32_t index);
    ~Task();
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

    // ---- Identity -----------------------------------------------------------------------------------------
    const std::string& name() const { return name_; }
    TaskKind kind() const { return kind_; }
    uint32_t index() const { return index_; } ///< in ProgramDesc::tasks
    /// Controls mechanical units.
    bool isMotionTask() const { return motionGroup_ >= 0; }
    /// Number of the group of mechanical units that it controls, from 0; -1 for none.
    int motionGroup() const { return motionGroup_; }
    void setMotionGroup(int group) { motionGroup_ = group; }
    Controller& controller() const { return *controller_; }
    Scheduler& scheduler() const { return scheduler_; }
    TaskState state() const { return state_; }
    StopCause stopCause() const { return stopCause_; }
    bool isStopped() const { return stopCause_ != StopCause::None; }
    /// Not finished and not stopped.
    bool isExecuting() const { return state_ != TaskState::Finished && !isStopped(); }
    uint64_t cyclesDone() const { return cyclesDone_; }
    /// main has returned as often as asked (not EXIT): a further start is one after a cycle.
    bool endedByItself() const { return state_ == TaskState::Finished && !needsReset_; }
    /// Variables keep the values of an earlier run: they are not initialised before main. Before the task runs.
    void keepVariables() { needsReset_ = false; }
    bool keepsVariables() const { return !needsReset_; }

    // ---- What an earlier process left (--state); before the task runs ---------------------------------------
    /// The task is halted inside its program: `entry` (main, or the procedure the program pointer was moved to) is called,
    /// and `guide` leads from statement to statement until finishReentry() or abandonReentry().
    void reenter(StepHook& guide, EntryFunction entry);
    bool isReentering() const { return nextGuide_ != nullptr || guide_ != nullptr; }
    /// The frames are there again; `afterStop`: the statement to execute next is a Stop that has been executed.
    void finishReentry(const ErrorMemory& errors, bool afterStop);
    /// It cannot be entered: the program pointer goes to main. To be returned by the guide.
    Status abandonReentry();
    /// Its cycles were over, and the run that continues is the one in which they were.
    void stayEnded() { stayEnded_ = true; }
    void setCyclesDone(uint64_t cycles) { cyclesDone_ = cycles; }

    Standing standing() const { return standing_; }
    /// Frame records from main on.
    std::vector<Frame*> frames() const;
    ErrorMemory errorMemory() const;
    /// The address lies on the stack of the task.
    bool ownsAddress(const void* address) const;

    // ---- Time and waiting ---------------------------------------------------------------------------------
    /// Virtual time, instructions executed in this slice included.
    Time now() const;
    /// Interrupts are delivered while the task waits; times are absolute virtual times.
    Status sleepUntil(Time time);
    Status sleepFor(Time span);
    Status waitFor(const WaitSpec& spec, WaitResult& result);
    /// Waits for other tasks at an instruction that has had no effect yet, and can execute it again (stepping profile).
    bool isMeeting() const { return meeting_ != nullptr && meeting_ == frame && canExecuteAgain(); }
    /// Ends that wait when the task executes next, unless the others have come: it is before its instruction again.
    void takeBack();
    /// Whether this has happened; once.
    bool claimTakenBack() { return std::exchange(takenBack_, false); }
    /// Waits until the file descriptor is ready for `pollEvents` (POLLIN, POLLOUT of poll(2)). Virtual time
    /// keeps pace with the wall clock meanwhile. For sockets and the terminal only: files are ready at once.
    Status waitExternal(int fd, short pollEvents, Time deadline, WaitResult& result);
    /// Lets other tasks run, delivers interrupts.
    Status yield();
    /// Charges instructions to the budget, for natives whose cost depends on their arguments.
    void charge(int64_t instructions) { budget -= instructions; }
    /// The instructions granted for this slice are used up.
    bool outOfBudget() const { return budget + stash_ < 0; }
    /// Lets other tasks run and time pass, without delivering interrupts.
    Status letTimePass();

    // ---- Ending and stopping ------------------------------------------------------------------------------
    /// EXIT: UNDO handlers run, the task ends. To be returned by the native: `return task.requestExit();`
    Status requestExit();
    /// ExitCycle: ends this cycle; main begins again when cycles are left. Persistent and module data are
    /// unchanged.
    Status requestExitCycle();
    /// Stop and its like (`instruction` is the name for the event): the task is halted until a `start`; returns kOk
    /// then. `allNormal`: so do all NORMAL tasks. In an UNDO handler it is ignored with a warning.
    Status stopHere(const char* instruction, bool allNormal = false,
                    StopCause cause = StopCause::Instruction);
    /// What ended the program or made it stand, until a start or the next cycle: "ExitCycle", "stop order"; "" when it ended
    /// at the end of main. And where.
    const std::string& endReason() const { return endReason_; }
    const SourcePlace& endPlace() const { return endPlace_; }
    void noteEnd(std::string reason);
    /// True when a warning was written that the instruction is ignored, because an UNDO handler is at work.
    bool ignoredInUndo(const char* instruction);

    // ---- Errors -------------------------------------------------------------------------------------------
    /// Sets the text that the event shows if the error the native returns next is not handled. Any length.
    void setErrorDetail(std::string text) { errorDetail_ = std::move(text); }
    /// setErrorDetail and the number: `return task.raise(ERR_X, "why");`
    Status raise(int number, std::string detail) {
        setErrorDetail(std::move(detail));
        return number;
    }
    /// A native that called a routine of the program returns that routine's status this way: its errors have been raised
    /// there already.
    Status passOn(Status status) {
        raisedBelow_ = status > 0;
        return status;
    }
    /// The same, from an error handler to the routine's caller (RAISE with a number, ErrRaise in a handler).
    Status raiseToCaller(int number);
    /// RaiseToUser \BreakOff: to the innermost routine outside NOSTEPIN. Only for the error handler of a NOSTEPIN routine;
    /// elsewhere, and when nothing takes it there, the system handler. Negative.
    Status breakOffToUser(int number);
    /// RaiseToUser \Continue: executes the error handler of that routine on top of the present one. 0: `decision` is to be
    /// carried out by the present routine, RETRY or TRYNEXT. Negative as above, even when that handler leaves its routine.
    Status continueAtUser(int number, HandlerDecision& decision);
    /// No clause of the error handler at work lists the error: the system handler. Negative; kAgain after a start.
    Status errorNotListed();
    /// The state that a trap routine must leave unchanged: the error that the interrupted code handles.
    struct ErrorInProgress {
        int32_t number = 0;
        RaisedError error;
    };
    ErrorInProgress errorInProgress() const { return {errorNumber, error_}; }
    void setErrorInProgress(ErrorInProgress before) {
        errorNumber = before.number;
        error_ = std::move(before.error);
    }
    /// In that handler: how to continue; it returns to continueAtUser then.
    void endDetached(HandlerDecision decision) { detached_.back().decision = decision; }
    /// The decision of the innermost routine's detached handler, before the stack was unwound to that routine; once.
    HandlerDecision takeDecision() { return std::exchange(decision_, kNotDecided); }
    /// SkipWarn: the error handled last leaves no warning in the event log.
    void skipWarn();
    /// RETRYs that remain for the error being handled (RemainingRetries); ResetRetryCount.
    int remainingRetries();
    /// Changes with every RETRY of the task.
    int32_t latestRetry() const { return lastRetryId_; }
    void resetRetryCount();
    /// Place of the statement in progress / the call chain, innermost first.
    SourcePlace place() const;
    std::vector<SourcePlace> callChain() const;
    /// Sentence about the last error raised in this task ("ERR_DIVZERO (1003): division by zero."); where it was raised.
    std::string errorText() const { return error_.text(host_.log()); }
    SourcePlace errorPlace() const { return error_.place(); }

    InterruptTable& interrupts() { return interrupts_; }
    EventRoutines& events() { return events_; }
    const EventRoutines& events() const { return events_; }
    /// Whether the program pointer was moved (to main) since the task stopped last (IsStopStateEvent).
    bool pointerMoved() const { return pointerMoved_; }
    bool pointerMovedToMain() const { return pointerMovedToMain_; }
    void notePointerMoved(bool toMain);
    /// Movement instructions may not be executed in an UNDO handler, nor in event routines other than START: then the system
    /// handler reports it; negative, as fatal().
    Status requireMovementAllowed();

    /// The task in whose background this one runs: it gets the processor only while that one waits or is halted. Null: none.
    void setForeground(const Task* task) { foreground_ = task; }
    const Task* foreground() const { return foreground_; }

    /// Data that a part of the standard library keeps per task; made on first use, destroyed with the task.
    template <class T> T& local() {
        static char key = 0;
        std::shared_ptr<void>& slot = locals_[&key];
        if (!slot) slot = std::make_shared<T>();
        return *static_cast<T*>(slot.get());
    }

    // ---- Entry points of compiled code (rt_abi.h) --------------------------------------------------------------
    Status safepoint(Frame* at);
    int32_t step(Frame* at);
    void chargeLater(int64_t cost);
    Status raiseAt(Frame* at, int number);
    Status nativeFailedAt(Frame* at, Status status);
    Status landAt(Frame* at, Status status);
    Status propagateFrom(Frame* handler);
    Status handlerEndAt(Frame* handler);
    Status retryAt(Frame* handler);
    Status stackOverflowAt(Frame* at);

    // ---- Used by the scheduler, wait queues, interrupts and the controller ------------------------------------------
    /// A queue the task waits on was notified / is gone.
    void notify();
    void forget(WaitQueue& queue);
    /// An interrupt can be delivered: does not end what the task waits for.
    void interruptPosted();
    /// Lets the next safepoint that costs something go to the scheduler although budget is left.
    void forceSafepoint();
    /// Lets the very next safepoint look for interrupts, also one that costs nothing (after a native call).
    void forceLook();
    /// Writes an event with the place of this task.
    void report(EventId id, std::initializer_list<std::string> arguments);
    /// Stops the task where it is / continues it. resume() is false when it can continue from main only.
    void stop(StopCause cause);
    bool resume();
    bool canResume() const;
    /// Stopped with the program pointer at main: the next start is one from the beginning.
    bool startsAtMain() const { return stopCause_ == StopCause::AtMain && entryOverride_ == nullptr; }
    /// The procedure that the task executes when it begins again: main, or the procedure that the program pointer was moved to.
    EntryFunction nextEntry() const { return entryOverride_ != nullptr ? entryOverride_ : desc_.entry; }
    /// Program pointer to main: the chain is unwound with its UNDO handlers at once; afterwards AtMain.
    void moveToMain();
    /// Program pointer to a procedure without parameters: as moveToMain, but the next start begins there and data
    /// keep their values, as `reset` says.
    void moveToRoutine(EntryFunction entry);
    /// Stepping profile: the hook that is asked before every statement; null: none.
    void setStepHook(StepHook* hook) { stepHook_ = hook; }
    StepHook* stepHook() const { return stepHook_; }
    /// Interrupts are not handled while the task is stepped (manual 1.11).
    void setStepwise(bool stepwise);
    bool isStepwise() const { return stepwise_; }
    /// The next procedure with a BACKWARD part that is called from this frame runs that part (manual 1.21); null: none.
    void orderBackward(const Frame* caller) { backwardCaller_ = caller; }
    /// Asked by that procedure.
    bool takeBackward() {
        const bool order = backwardCaller_ != nullptr && frame != nullptr && frame->caller == backwardCaller_;
        if (order) backwardCaller_ = nullptr;
        return order;
    }
    /// Halts until started again or unwound. Event routines that are due run first.
    Status suspendStopped();
    /// Stopped, and no event routine of the system executes meanwhile.
    bool mustHalt() const { return isStopped() && !events_.executesStopped(); }
    /// The event routine in progress ends here, with its UNDO handlers: at once / was ended so.
    void endEventRoutine();
    void eventRoutinesEnded(SystemEvent event) { host_.eventRoutinesEnded(*this, event); }
    bool takeEventEnd();
    /// Can be given the processor: not waiting and not stopped, or being unwound.
    bool runnable() const;
    /// UNDO handlers or event routines of the system execute, or will before the task halts.
    bool hasWorkWhileStopped() const {
        return isUnwinding() || events_.executesStopped() || (isStopped() && events_.owed());
    }
    bool isUnwinding() const { return pendingUnwind_ != Unwind::None || unwinding_ != Unwind::None; }
    /// An interrupt without a trap routine or another fatal condition: the system handler. Negative; kAgain when the task
    /// was started again.
    Status fatal(int eventNumber, std::string text);

  private:
    friend class Scheduler;

    /// The stepping profile looks at the budget before statements only: charges made while a look is due count after it.
    struct LaterCharges {
        int64_t forcedTo = kNotForced; ///< the budget as forceSafepoint or forceLook left it
        std::vector<int64_t> costs;    ///< in order
        static constexpr int64_t kNotForced = 1;

        int64_t sum() const { return std::accumulate(costs.begin(), costs.end(), int64_t{0}); }
    };

    enum class Unwind : uint8_t { None, Exit, ExitCycle, ToMain, Abandon, Jump, Event };
    /// RETRYs of one statement, for each error number; belongs to a frame record as long as that one carries its id.
    struct RetryCount {
        Frame* frame = nullptr;
        int32_t statement = -1;
        int32_t id = 0;
        int number = 0; ///< of the error being handled
        RetryCounts counts;
    };
    /// A detached error handler at work.
    struct Detached {
        Frame* user = nullptr; ///< whose handler it is
        HandlerDecision decision = kNotDecided;
    };
    /// An error on its way to the handler of `target`. More than one only when an UNDO handler on the way makes another.
    struct Jump {
        Frame* target = nullptr;
        int number = 0;
        RaisedError error;
        HandlerDecision decision = kNotDecided; ///< of the handler, which has been executed already
    };
    struct HandledError {
        Frame* frame = nullptr; ///< of the routine whose handler took it
        const RoutineDesc* routine = nullptr;
        int number = 0;
        RaisedError error;
    };

    void fibreMain();
    void beginReentry();
    void endReentry();
    bool runCycle();
    bool endCycle(Unwind how);
    void setPointerToMain();
    void haltAtMain();
    Status block();
    void countAgain(Time& deadline, Time span, uint64_t& starts) const;
    Status safepointOnce(Frame* at);
    bool yieldsAtStatement(const Frame* at) const;
    Status enterWait();
    Status afterSwitch();
    Status beginUnwind(Unwind cause);
    Status systemHandler(int eventNumber, int number, std::string text, const SourcePlace& where,
                         const std::string& hint = {});
    /// An error goes to its handler at once: the task is not being unwound or led back, and stepping does not ask.
    bool raisesAsUsual() const {
        return unwinding_ == Unwind::None && guide_ == nullptr && askSteps == 0 && !undoAborted_;
    }
    Status raiseOnce(Frame* at, int number);
    Status dispatchError(const ErrorRoute& route, int number, const Frame* from);
    Status startJump(Frame* target, int number, HandlerDecision decision = kNotDecided);
    Frame* findUserLevel(int number);
    Status leaveDetached(int number);
    /// The status that travels up when UNDO handlers are not to run any more.
    Status silentStatus() const { return unwinding_ == Unwind::Jump ? kJumpSilent : kUnwindSilent; }
    void abortUndo(std::string why);
    /// Code of the stepping profile can execute the faulty statement again.
    bool canExecuteAgain() const;
    void noteRaised(int number);
    Status reportUnhandled(int number, const std::string& hint = {});
    RetryCount* nearestRetryCount(const Frame* from);
    RetryCount* retryCountOf(Frame* handler);
    void noteHandled(Frame* handler, int number);
    void flushHandledWarning();
    void writeHandledWarning();
    void writeHandledEvent();
    void dropHandled(const Frame* outermost);
    bool isInside(const HandledError& handled) const;

    TaskHost& host_;
    Controller* controller_;
    Scheduler& scheduler_;
    const TaskDesc& desc_;
    int motionGroup_ = -1;
    uint32_t index_;
    std::string name_;
    TaskKind kind_;
    TaskState state_ = TaskState::Ready;
    StopCause stopCause_ = StopCause::None;
    std::unique_ptr<Fibre> fibre_;
    InterruptTable interrupts_{*this};
    EventRoutines events_{*this};
    const Task* foreground_ = nullptr;
    const Frame* meeting_ = nullptr; // whose instruction waits for other tasks
    bool takingBack_ = false, takenBack_ = false;
    bool pointerMoved_ = false, pointerMovedToMain_ = false; // since the last stop
    std::map<const void*, std::shared_ptr<void>> locals_;

    // kept by the scheduler: charged but not yet paid with time (in 1/rate ns); budget set aside by forceSafepoint
    int64_t debt_ = 0;
    int64_t stash_ = 0;
    LaterCharges later_;
    bool yieldWanted_ = false; // forceSafepoint: the next safepoint is to end the slice

    std::vector<WaitQueue*> waitingOn_;
    bool notified_ = false;

    Unwind pendingUnwind_ = Unwind::None; // to be returned by the call the task is suspended in
    Unwind unwinding_ = Unwind::None;     // a negative status is travelling up
    bool undoAborted_ = false;
    StepHook* stepHook_ = nullptr;
    bool stepwise_ = false;
    const Frame* backwardCaller_ = nullptr;
    EntryFunction entryOverride_ = nullptr; // program pointer moved to a routine: run instead of main once
    uint64_t starts_ = 0;                   // how often the task went on after a stop,
    Time startedAt_ = 0;                    // and when it did so last
    bool needsReset_ = true;                // variables get their initial values before main is entered
    uint64_t cyclesDone_ = 0;

    std::vector<Jump> jumps_;
    std::vector<Detached> detached_; // innermost last
    HandlerDecision decision_ = kNotDecided;
    bool raisedBelow_ = false;   // the error a native returns has been raised by what it called
    bool raiseToCaller_ = false; // the error that comes next leaves the routine although it is its handler's

    std::string endReason_;
    SourcePlace endPlace_;
    std::string errorDetail_; // of the error that is raised next
    RaisedError error_;       // raised last
    std::vector<RetryCount> retries_;
    int32_t lastRetryId_ = 0;
    std::vector<HandledError> handled_; // not reported yet; innermost handler last
    struct Warned {
        HandledError handled;
        uint64_t event = 0; ///< sequence number; 0: not used yet
    };
    static constexpr size_t kWarned = 8; // a loop may handle several errors in turns
    std::array<Warned, kWarned> warned_; // reported lately,
    size_t nextWarned_ = 0;              // and where the next one goes

    static constexpr int32_t kAsksForReentry = 2; // beside what a debugger asks
    Standing standing_ = Standing::Between;
    StepHook* nextGuide_ = nullptr; // leads back to where an earlier process stood,
    StepHook* guide_ = nullptr;     // does so now
    bool passStop_ = false;         // the next Stop has been executed by an earlier process
    bool stayEnded_ = false;
};

static_assert(!std::is_polymorphic_v<Task>, "a Task must begin with its TaskCore: no virtual functions");

/// The task of the pointer that compiled code passes to every native.
inline Task& taskOf(TaskCore* core) {
    return *static_cast<Task*>(core);
}

} // namespace rt

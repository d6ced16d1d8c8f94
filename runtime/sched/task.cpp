// Task: cycles of main on a fibre, waiting, stopping and ending. Errors: task_errors.cpp.

#include "runtime/sched/task.h"

#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"
#include "runtime/sched/fibre.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/step_hook.h"
#include "runtime/sched/wait_queue.h"

#include <poll.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace rt {
namespace {

/// A value that holds as long as this lives: in waits, which those of trap routines may interrupt.
template <class Value> class Meanwhile {
  public:
    Meanwhile(Value& place, Value here) : place_(place), before_(std::exchange(place, here)) {}
    ~Meanwhile() { place_ = before_; }
    Meanwhile(const Meanwhile&) = delete;
    Meanwhile& operator=(const Meanwhile&) = delete;

  private:
    Value& place_;
    Value before_;
};

TaskKind kindFrom(const char* type) {
    if (type != nullptr && std::strcmp(type, "STATIC") == 0) return TaskKind::Static;
    if (type != nullptr && std::strcmp(type, "SEMISTATIC") == 0) return TaskKind::SemiStatic;
    return TaskKind::Normal;
}

} // namespace

Task::Task(TaskHost& host, Controller* controller, Scheduler& scheduler, const TaskDesc& desc, uint32_t index)
    : TaskCore{}, host_(host), controller_(controller), scheduler_(scheduler), desc_(desc), index_(index),
      name_(desc.name), kind_(kindFrom(desc.type)) {
    motionGroup_ = desc.motionTask != 0 ? 0 : -1;
    fibre_ = std::make_unique<Fibre>(scheduler.options().stackBytes, [this] { fibreMain(); });
    stackLimit = fibre_->stackLimit();
}

Task::~Task() {
    for (WaitQueue* queue : waitingOn_)
        queue->remove(*this);
}

// ---- Cycles --------------------------------------------------------------------------------------------------------

void Task::fibreMain() {
    while (pendingUnwind_ != Unwind::Abandon && !stayEnded_) {
        if (!runCycle()) break;
    }
    pendingUnwind_ = Unwind::None;
    state_ = TaskState::Finished;
    interrupts_.clear();
}

/// The program pointer is at main and there is nothing to unwind.
void Task::setPointerToMain() {
    state_ = TaskState::Ready;
    scheduler_.makeReady(*this);
    scheduler_.switchOut(*this);
}

/// False: the task has come to its end.
bool Task::runCycle() {
    pendingUnwind_ = Unwind::None;
    undoAborted_ = false;
    frame = nullptr;
    Status status = kOk;
    if (needsReset_) {
        interrupts_.clear();
        needsReset_ = false;
        if (desc_.reset != nullptr) status = desc_.reset(this, nullptr);
        if (status == kOk) status = host_.resetUnits(*this);
        frame = nullptr; // the record of the routine that did it is gone
        if (entryOverride_ == nullptr) host_.programReset(*this);
    }
    if (status == kOk) status = events_.runPending();
    if (status == kOk && isStopped()) {
        setPointerToMain();
        return true;
    }
    const EntryFunction entry = entryOverride_ != nullptr ? entryOverride_ : desc_.entry;
    entryOverride_ = nullptr;
    backwardCaller_ = nullptr;
    if (status == kOk) endReason_.clear();
    if (status == kOk && nextGuide_ != nullptr) beginReentry();
    if (interrupts_.deliverable()) interruptPosted(); // occurred while the last cycle was left
    if (status == kOk && entry != nullptr) status = entry(this, nullptr);
    if (status == kOk && budget < 0) status = safepoint(nullptr); // charged after the last statement
    if (status > 0) (void)raiseAt(nullptr, status);               // no routine took it, and none reported it
    frame = nullptr;
    endReentry();
    retries_.clear();
    jumps_.clear();
    detached_.clear();
    decision_ = kNotDecided;
    raiseToCaller_ = false;
    flushHandledWarning();
    interrupts_.unwound();
    return endCycle(std::exchange(unwinding_, Unwind::None));
}

void Task::haltAtMain() {
    stopCause_ = StopCause::AtMain;
    notePointerMoved(true);
}

bool Task::endCycle(Unwind how) {
    switch (how) {
    case Unwind::Abandon: return false;
    case Unwind::Exit:
        needsReset_ = true;
        host_.taskExited(*this);
        if (kind_ != TaskKind::Normal || !host_.startToCome()) return false;
        haltAtMain();
        events_.owe(SystemEvent::Reset);
        return true;
    case Unwind::ToMain: return true;
    case Unwind::None:
    case Unwind::Jump:
    case Unwind::Event: break;
    case Unwind::ExitCycle: host_.cycleLeft(*this); break;
    }
    ++cyclesDone_;
    if (!host_.cyclesLeft(*this)) {
        if (!host_.staysAtMain(*this)) return false;
        haltAtMain();
        return true;
    }
    // An empty main costs an instruction as well, so that a cycle without end lets time pass.
    budget -= 1;
    if (budget < 0) (void)safepoint(nullptr);
    return true;
}

// ---- Waiting -------------------------------------------------------------------------------------------------------

Time Task::now() const {
    return scheduler_.now();
}

bool Task::runnable() const {
    return state_ == TaskState::Ready && (!mustHalt() || isUnwinding() || events_.owed());
}

Status Task::beginUnwind(Unwind cause) {
    pendingUnwind_ = Unwind::None;
    const bool silent = cause == Unwind::Abandon || unwinding_ != Unwind::None;
    const bool weaker =
        unwinding_ == Unwind::None || unwinding_ == Unwind::Jump || unwinding_ == Unwind::Event;
    if (weaker || cause == Unwind::Abandon) unwinding_ = cause;
    return silent ? kUnwindSilent : kUnwind;
}

/// The first check of a call that may suspend: the task may be on its way out.
Status Task::enterWait() {
    if (unwinding_ == Unwind::Abandon || undoAborted_) return silentStatus();
    if (pendingUnwind_ != Unwind::None) return beginUnwind(pendingUnwind_);
    if (unwinding_ == Unwind::None && events_.owed()) {
        if (const Status status = suspendStopped(); status < 0) return status;
    }
    scheduler_.lookAtData();
    if (unwinding_ == Unwind::None && !isStopped() && interrupts_.deliverable()) return interrupts_.deliver();
    return kOk;
}

Status Task::afterSwitch() {
    if (undoAborted_) return silentStatus();
    if (pendingUnwind_ != Unwind::None) return beginUnwind(pendingUnwind_);
    return kOk;
}

Status Task::block() {
    state_ = TaskState::Waiting;
    scheduler_.switchOut(*this);
    return afterSwitch();
}

Status Task::letTimePass() {
    state_ = TaskState::Ready;
    scheduler_.makeReady(*this);
    scheduler_.switchOut(*this);
    return afterSwitch();
}

Status Task::yield() {
    if (const Status status = enterWait(); status < 0) return status;
    if (const Status status = letTimePass(); status < 0) return status;
    return enterWait();
}

Status Task::sleepUntil(Time time) {
    WaitResult result{};
    return waitFor({{}, {}, time, 0}, result);
}

Status Task::sleepFor(Time span) {
    return sleepUntil(addTime(now(), std::max<Time>(span, 0)));
}

/// At a start after a stop all times count from the beginning (manual 2.2.6).
void Task::countAgain(Time& deadline, Time span, uint64_t& starts) const {
    if (starts == starts_) return;
    starts = starts_;
    if (deadline != kNever) deadline = addTime(startedAt_, span);
}

Status Task::waitFor(const WaitSpec& spec, WaitResult& result) {
    const Meanwhile standing(standing_, Standing::InWait);
    const Meanwhile<const Frame*> meeting(meeting_, spec.isMeeting ? frame : nullptr);
    if (spec.isMeeting) takingBack_ = takenBack_ = false;
    flushHandledWarning();
    Time deadline = spec.deadline;
    const Time span = deadline == kNever ? 0 : std::max<Time>(deadline - now(), 0);
    uint64_t starts = starts_;
    Time nextPoll = spec.pollPeriod > 0 ? addTime(now(), spec.pollPeriod) : kNever;
    bool notified =
        false; // of what is waited for here: a trap routine that waits has notifications of its own
    for (;;) {
        if (const Status status = enterWait(); status < 0) return status;
        countAgain(deadline, span, starts);
        if (spec.condition ? spec.condition() : notified) {
            result = WaitResult::Done;
            return kOk;
        }
        if (spec.isMeeting && std::exchange(takingBack_, false)) {
            takenBack_ = true;
            return kAgain;
        }
        if (now() >= deadline) {
            result = WaitResult::Timeout;
            return kOk;
        }
        while (nextPoll <= now())
            nextPoll = addTime(nextPoll, spec.pollPeriod);
        notified_ = false;
        waitingOn_ = spec.queues;
        for (WaitQueue* queue : waitingOn_)
            queue->add(*this);
        const Time wakeAt = std::min(deadline, nextPoll);
        const EventToken timer =
            wakeAt == kNever ? 0 : scheduler_.at(wakeAt, [this] { scheduler_.makeReady(*this); });
        const auto outside = spec.outside ? spec.outside() : std::nullopt;
        Scheduler::ExternalWait wait{this, outside ? outside->fd : -1, outside ? outside->events : short{0}};
        if (outside) scheduler_.addExternal(wait);
        const Status status = block();
        if (outside) scheduler_.removeExternal(wait);
        notified = notified_;
        scheduler_.cancel(timer);
        for (WaitQueue* queue : waitingOn_)
            queue->remove(*this);
        waitingOn_.clear();
        if (status < 0) return status;
    }
}

void Task::takeBack() {
    takingBack_ = true;
    if (state_ == TaskState::Waiting) scheduler_.makeReady(*this);
}

Status Task::waitExternal(int fd, short pollEvents, Time deadline, WaitResult& result) {
    WaitSpec spec;
    spec.condition = [fd, pollEvents] { // an error shows itself at the read or write that follows
        pollfd ready{fd, pollEvents, 0};
        return ::poll(&ready, 1, 0) != 0;
    };
    spec.deadline = deadline;
    spec.outside = [fd, pollEvents] { return OutsideWait{fd, pollEvents}; };
    return waitFor(spec, result);
}

void Task::notify() {
    notified_ = true;
    if (state_ == TaskState::Waiting)
        scheduler_.makeReady(*this);
    else if (scheduler_.running() == this)
        forceSafepoint();
}

void Task::interruptPosted() {
    if (state_ == TaskState::Waiting)
        scheduler_.makeReady(*this);
    else if (scheduler_.running() == this)
        forceLook();
}

void Task::report(EventId id, std::initializer_list<std::string> arguments) {
    host_.log().write(id, this, arguments);
}

void Task::forget(WaitQueue& queue) {
    waitingOn_.erase(std::remove(waitingOn_.begin(), waitingOn_.end(), &queue), waitingOn_.end());
    notify();
}

// ---- Safepoints ----------------------------------------------------------------------------------------------------

void Task::forceSafepoint() {
    yieldWanted_ = true;
    if (budget <= 0) return;
    stash_ += budget;
    budget = later_.forcedTo = 0;
}

void Task::forceLook() {
    if (budget < 0) return;
    stash_ += budget + 1;
    budget = later_.forcedTo = -1;
}

void Task::chargeLater(int64_t cost) {
    // When nothing has been charged since the budget was forced, the other profiles look after this charge.
    if (budget == later_.forcedTo)
        budget -= cost;
    else
        later_.costs.push_back(cost);
}

Status Task::safepoint(Frame* at) {
    const auto look = [&] {
        Status status = kAgain;
        // Again: an interrupt without trap routine stopped the task, and it was started again.
        while (status == kAgain)
            status = safepointOnce(at);
        return status;
    };
    std::vector<int64_t> later = std::exchange(later_.costs, {}); // a trap routine has charges of its own
    Status status = look();
    auto next = later.begin();
    for (; next != later.end() && status == kOk && !yieldsAtStatement(at); ++next) {
        budget -= *next;
        if (budget < 0) status = look();
    }
    later_.costs.insert(later_.costs.begin(), next, later.end());
    return status;
}

/// Wants to yield, but a later process could continue only before a statement.
bool Task::yieldsAtStatement(const Frame* at) const {
    return yieldWanted_ && standing_ == Standing::Between && at != nullptr && at->routine->stepping != 0;
}

Status Task::safepointOnce(Frame* at) {
    if (guide_ != nullptr) return kOk; // nothing is executed yet
    frame = at;
    flushHandledWarning();
    budget += stash_;
    stash_ = 0;
    later_.forcedTo = LaterCharges::kNotForced;
    const bool leaving = pendingUnwind_ != Unwind::None || unwinding_ != Unwind::None || mustHalt();
    Status status = kOk;
    if (budget < 0 || leaving || events_.owed()) {
        yieldWanted_ = false;
        status = yield();
    } else {
        // The slice is not over: somebody asked to look for interrupts, or for the end of the slice.
        scheduler_.lookAtData();
        if (interrupts_.deliverable()) {
            if (scheduler_.dataWatched()) forceLook(); // what the trap routine changes is seen at once
            status = interrupts_.deliver();
            if (yieldWanted_) forceSafepoint();
        } else if (yieldWanted_) {
            if (yieldsAtStatement(at)) {
                forceLook();
                later_.forcedTo =
                    LaterCharges::kNotForced; // the other profiles yield here, before any further charge
                return kOk;
            }
            yieldWanted_ = false;
            status = yield();
        }
    }
    if (scheduler_.dataWatched()) forceLook();
    return status;
}

int32_t Task::step(Frame* at) {
    frame = at;
    if (guide_ != nullptr) {
        const int32_t here = at->statement, next = guide_->beforeStatement(*this, at);
        if (guide_ != nullptr || next != here) return next;
    }
    const Meanwhile standing(standing_, Standing::AtStatement);
    if (budget < 0) {
        if (const Status status = safepoint(at); status < 0) return status;
    }
    if (isUnwinding()) {
        if (const Status status = enterWait(); status < 0) return status;
    }
    const bool stepped = stepHook_ != nullptr && events_.running() == SystemEvent::None;
    return stepped ? stepHook_->beforeStatement(*this, at) : at->statement;
}

void Task::setStepwise(bool stepwise) {
    if (stepwise && !stepwise_) interrupts_.taskStopped();
    stepwise_ = stepwise;
    if (!stepwise && interrupts_.deliverable()) interruptPosted();
}

// ---- Ending and stopping -------------------------------------------------------------------------------------------

Status Task::requestExit() {
    if (unwinding_ != Unwind::None) {
        if (unwinding_ != Unwind::Abandon) abortUndo("EXIT was executed.");
        if (unwinding_ == Unwind::Jump) unwinding_ = Unwind::Exit;
        return kUnwindSilent;
    }
    unwinding_ = events_.executesStopped() ? Unwind::Event : Unwind::Exit;
    if (unwinding_ == Unwind::Exit) noteEnd("EXIT");
    return kUnwind;
}

Status Task::requestExitCycle() {
    if (unwinding_ != Unwind::None || events_.executesStopped()) return requestExit();
    unwinding_ = Unwind::ExitCycle;
    noteEnd("ExitCycle");
    return kUnwind;
}

void Task::noteEnd(std::string reason) {
    endReason_ = std::move(reason);
    endPlace_ = place();
}

bool Task::ignoredInUndo(const char* instruction) {
    if (unwinding_ == Unwind::None || unwinding_ == Unwind::Abandon) return false;
    host_.log().write(EventId::UndoIgnored, this, {instruction});
    return true;
}

Status Task::stopHere(const char* instruction, bool allNormal, StopCause cause) {
    if (std::exchange(passStop_, false)) return kOk;
    if (const Status status = enterWait(); status < 0) return status;
    if (ignoredInUndo(instruction)) return kOk;
    if (events_.executesStopped()) return requestExit(); // ends the event routine
    host_.log().write(EventId::ProgramStopped, this, {name_, instruction});
    stop(cause);
    noteEnd(instruction);
    events_.owe(SystemEvent::Stop);
    host_.taskStopped(*this);
    if (allNormal) host_.stopNormalTasks(StopCause::Order);
    const Meanwhile standing(standing_, Standing::AfterStop);
    return suspendStopped();
}

/// Halted until started again or unwound.
Status Task::suspendStopped() {
    for (;;) {
        if (const Status status = events_.runPending(); status < 0) return status;
        if (!mustHalt()) return kOk;
        state_ = TaskState::Ready;
        scheduler_.makeReady(*this);
        scheduler_.switchOut(*this);
        if (const Status status = afterSwitch(); status < 0) return status;
    }
}

void Task::endEventRoutine() {
    pendingUnwind_ = Unwind::Event;
    if (state_ == TaskState::Waiting) scheduler_.makeReady(*this);
}

bool Task::takeEventEnd() {
    if (pendingUnwind_ == Unwind::Event) pendingUnwind_ = Unwind::None; // it came to its end by itself
    if (unwinding_ != Unwind::Event) return false;
    unwinding_ = Unwind::None;
    undoAborted_ = false;
    return true;
}

void Task::notePointerMoved(bool toMain) {
    pointerMoved_ = true;
    pointerMovedToMain_ = toMain;
}

Status Task::requireMovementAllowed() {
    const bool undo = unwinding_ != Unwind::None;
    const SystemEvent event = events_.running();
    if (!undo && (event == SystemEvent::None || event == SystemEvent::Start)) return kOk;
    if (undo) return fatal(static_cast<int>(EventId::MovementForbidden), "an UNDO handler");
    if (event == SystemEvent::Visit)
        return fatal(static_cast<int>(EventId::MovementForbidden),
                     "an expression or the console of the debugger");
    return fatal(static_cast<int>(EventId::MovementForbidden),
                 std::string("a routine of the event ") + nameOf(event));
}

void Task::stop(StopCause cause) {
    if (state_ == TaskState::Finished || isStopped()) return;
    if (unwinding_ != Unwind::None && unwinding_ != Unwind::Abandon) {
        abortUndo("The program was stopped.");
        if (state_ == TaskState::Waiting) scheduler_.makeReady(*this); // in an UNDO handler: the wait is over
    }
    stopCause_ = cause;
    pointerMoved_ = pointerMovedToMain_ = false;
    interrupts_.taskStopped();
    if (scheduler_.running() == this) forceSafepoint();
}

/// Code of the stepping profile can execute the faulty statement again.
bool Task::canExecuteAgain() const {
    const StmtDesc* statement = frame != nullptr ? statementOf(*frame) : nullptr;
    return statement != nullptr && statement->canStart != 0;
}

bool Task::canResume() const {
    return stopCause_ != StopCause::Blocked;
}

bool Task::resume() {
    if (!canResume()) return false;
    stopCause_ = StopCause::None;
    endReason_.clear();
    ++starts_;
    startedAt_ = now();
    return true;
}

void Task::moveToRoutine(EntryFunction entry) {
    moveToMain();
    entryOverride_ = entry;
    notePointerMoved(false);
}

void Task::moveToMain() {
    if (state_ == TaskState::Finished) return;
    needsReset_ = true;
    entryOverride_ = nullptr;
    nextGuide_ = nullptr;
    stopCause_ = StopCause::AtMain;
    notePointerMoved(true);
    if (!fibre_->started()) return;
    pendingUnwind_ = Unwind::ToMain;
    if (state_ == TaskState::Waiting) scheduler_.makeReady(*this);
}

} // namespace rt

// Task: errors, retries and the system handler (manual 1.12).

#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/step_hook.h"
#include "runtime/sched/task.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace rt {
namespace {

/// Callers listed in an event; an endless recursion has a hundred thousand.
constexpr std::size_t kMaxCalls = 24;

/// Records of routines that were compiled into each other lie in any order within one frame of the machine; beyond, those of
/// callers lie above. So a few callers settle where a record is, however long the chain is.
constexpr int kMostMerged = 256;

/// Is `wanted`, a record in use, the frame record `from` or one of its callers'?
bool isAmongCallers(const Frame* from, const Frame* wanted) {
    const Frame* highest = from;
    for (int i = 0; i < kMostMerged; ++i, from = from->caller) {
        if (from == wanted) return true; // a record in use: not null
        if (from == nullptr) return false;
        highest = std::max(highest, from, std::less<>());
    }
    return std::less<>()(highest, wanted);
}

/// The same for a record that may have been left.
bool isInProgress(const Frame* from, const Frame* wanted) {
    int above = 0; // without one that lies below
    for (const Frame* at = from; at != nullptr && above <= kMostMerged; at = at->caller) {
        if (at == wanted) return true;
        above = std::less<>()(wanted, at) ? above + 1 : 0;
    }
    return false;
}

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

/// The names of the routines in progress, each once.
std::vector<std::string> routineNames(const std::vector<const Frame*>& frames, std::size_t most) {
    std::vector<std::string> names;
    for (const Frame* at : frames) {
        const std::string name = at->routine->name;
        if (names.size() < most && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    return names;
}

/// Which callers have a handler that was not asked (manual 1.12), and what would ask it; "" when there is none.
std::string unaskedText(const Frame* from, int number) {
    const Frame* const stopped = callSeenByUser(from);
    const BypassedHandlers unasked = bypassedHandlers(stopped, number);
    if (unasked.callers.empty() || unasked.between.empty()) return {};
    const char* const lack = stopped->routine->hasErrorHandler != 0
                                 ? "The error handler of {0} does not list this error"
                                 : "{0} has no error handler";
    std::vector<std::string> callers = routineNames(unasked.callers, BypassedHandlers::kMost);
    if (unasked.callers.size() > BypassedHandlers::kMost) callers.emplace_back("others");
    const std::vector<std::string> between = routineNames(unasked.between, BypassedHandlers::kMostBetween);
    return fmt::format(fmt::runtime(std::string(lack) +
                                    ", so the error does not go to its callers: the error "
                                    "handler of {1} was not asked. \"ERROR RAISE;\" in "
                                    "{2} passes errors on."),
                       stopped->routine->name, listed(callers), listed(between));
}

} // namespace

SourcePlace Task::place() const {
    for (const Frame* at = callSeenByUser(frame); at != nullptr; at = callSeenByUser(at->caller)) {
        if (!isBoundary(*at)) return placeOf(at);
    }
    return {};
}

std::vector<SourcePlace> Task::callChain() const {
    std::vector<SourcePlace> chain;
    for (const Frame* at = callSeenByUser(frame); at != nullptr && chain.size() <= kMaxCalls;
         at = callSeenByUser(at->caller)) {
        chain.push_back(placeOf(at));
    }
    return chain;
}

/// The error raised last is this one, at the statement in progress.
void Task::noteRaised(int number) {
    const Frame* at = callSeenByUser(frame);
    while (at != nullptr && isBoundary(*at))
        at = callSeenByUser(at->caller);
    error_.set(number, at, errorDetail_);
    scheduler_.errorRaised(*this, number);
}

/// Called by compiled code for a check or RAISE: started again after the system handler, the instruction fails again.
Status Task::raiseAt(Frame* at, int number) {
    // The usual error does what raiseOnce does, without questions whose answers are known: a program may raise millions.
    if (raisesAsUsual() && errorDetail_.empty() && !raiseToCaller_ && at != nullptr && handles(*at, number) &&
        at->routine->isBuiltin == 0) {
        frame = at;
        flushHandledWarning();
        error_.set(number, at, errorDetail_);
        scheduler_.errorRaised(*this, number);
        errorNumber = number;
        noteHandled(at, number);
        return number;
    }
    const std::string detail = errorDetail_;
    Status status = raiseOnce(at, number);
    while (status == kAgain && !canExecuteAgain()) {
        errorDetail_ = detail;
        status = raiseOnce(at, number);
    }
    return status;
}

Status Task::nativeFailedAt(Frame* at, Status status) {
    frame = at;
    if (std::exchange(raisedBelow_, false)) return status;
    return status > 0 ? raiseOnce(at, status) : status;
}

Status Task::raiseOnce(Frame* at, int number) {
    frame = at;
    const bool toCaller = std::exchange(raiseToCaller_, false) && at != nullptr;
    if (!toCaller || errorNumber != number) {
        if (!toCaller) flushHandledWarning();
        noteRaised(number);
    }
    errorDetail_.clear(); // the next error has a reason of its own
    if (toCaller) return dispatchError(routeFromCall(at->caller, number), number, at->caller);
    return dispatchError(routeOfError(at, number), number, at);
}

Status Task::raiseToCaller(int number) {
    if (frame != nullptr && frame->routine->isDetachedHandler != 0) return passOn(leaveDetached(number));
    raiseToCaller_ = true;
    return number;
}

Status Task::propagateFrom(Frame* handler) {
    const int number = errorNumber;
    Frame* const caller = handler->caller;
    const bool detached = handler->routine->isDetachedHandler != 0;
    while (true) {
        frame = handler;
        const Status status =
            detached ? leaveDetached(number) : dispatchError(routeFromCall(caller, number), number, caller);
        if (status != kAgain || canExecuteAgain()) return status;
    }
}

/// `from`: where the search for a handler began. Kept short for the error that a handler takes; the rest lies apart.
Status Task::dispatchError(const ErrorRoute& route, int number, const Frame* from) {
    errorNumber = number;
    if (raisesAsUsual() && route.handler != nullptr && !route.longJump) { // the questions below are answered
        noteHandled(route.handler, number);
        return number;
    }
    if (unwinding_ == Unwind::Abandon || undoAborted_) return silentStatus();
    if (guide_ != nullptr) return guide_->failed(*this);
    bool backward = false;                       // no handler then (manual 1.21)
    if (askSteps != 0 && stepHook_ != nullptr) { // whoever wants to be asked sets askSteps
        backward = stepHook_->isBackward(*this);
        if (route.handler != nullptr && !backward && unwinding_ == Unwind::None &&
            events_.running() == SystemEvent::None) {
            if (const Status status = stepHook_->handledErrorRaised(*this, number); status < 0) return status;
        }
    }
    if (route.handler == nullptr || backward) {
        const auto report = [this, backward, number, from]() __attribute__((noinline, cold)) {
            handled_.clear(); // reported as unhandled instead
            return reportUnhandled(number, backward ? std::string() : unaskedText(from, number));
        };
        return report();
    }
    if (route.longJump) return startJump(route.handler, number);
    noteHandled(route.handler, number);
    return number;
}

Status Task::reportUnhandled(int number, const std::string& hint) {
    return systemHandler(static_cast<int>(EventId::UnhandledError), number, errorText(), errorPlace(), hint);
}

Status Task::errorNotListed() {
    handled_.clear();
    return reportUnhandled(errorNumber);
}

Status Task::handlerEndAt(Frame* handler) {
    const int number = errorNumber;
    Status status = kAgain;
    while (status == kAgain) {
        frame = handler;
        handled_.clear();
        const std::string text = formatEventText(EventId::HandlerEnd, {errorText(), place().routine});
        status = systemHandler(static_cast<int>(EventId::HandlerEnd), number, text, errorPlace());
        if (canExecuteAgain()) break;
    }
    return status;
}

Status Task::stackOverflowAt(Frame* at) {
    Status status = kAgain;
    while (status == kAgain) {
        frame = at;
        status = fatal(static_cast<int>(EventId::StackOverflow), name_);
    }
    return status;
}

Status Task::fatal(int eventNumber, std::string argument) {
    return systemHandler(eventNumber, 0,
                         formatEventText(static_cast<EventId>(eventNumber), {std::move(argument)}), place());
}

[[gnu::noinline, gnu::cold]] Status Task::systemHandler(int eventNumber, int number, std::string text,
                                                        const SourcePlace& where, const std::string& hint) {
    if (unwinding_ == Unwind::Abandon || undoAborted_) return silentStatus();
    if (guide_ != nullptr) return guide_->failed(*this);
    EventLog& log = host_.log();
    if (unwinding_ != Unwind::None) {
        abortUndo(std::move(text));
        return silentStatus();
    }
    Event event;
    event.number = eventNumber;
    event.type = EventType::Error;
    event.title = eventText(static_cast<EventId>(eventNumber)).title;
    event.arguments = {name_, where.reference(), text};
    event.text = std::move(text);
    if (!hint.empty()) event.text += " " + hint;
    event.time = now();
    event.task = name_;
    event.place = where;
    event.calls = callChain();
    // The chain begins with the place itself unless a handler passed the error on.
    if (!event.calls.empty() && event.calls.front().routine == where.routine)
        event.calls.erase(event.calls.begin());
    event.errorNumber = number;
    event.errorName = log.errorName(number);
    log.write(std::move(event));
    if (events_.executesStopped()) { // only the event routine ends
        unwinding_ = Unwind::Event;
        return kUnwind;
    }
    stop(StopCause::Error);
    host_.taskFailed(*this);
    const Standing before = std::exchange(standing_, Standing::AtError);
    const Status status = suspendStopped();
    standing_ = before;
    return status == kOk ? kAgain : status;
}

// ---- Long jumps ----------------------------------------------------------------------------------------------------

/// The stack is unwound with UNDO to the routine of `target`, which asks landAt.
[[gnu::noinline, gnu::cold]] Status Task::startJump(Frame* target, int number, HandlerDecision decision) {
    flushHandledWarning();
    dropHandled(target); // the handlers at work pass it on
    if (unwinding_ == Unwind::None) unwinding_ = Unwind::Jump;
    jumps_.push_back({target, number, error_, decision});
    return kJump;
}

Status Task::landAt(Frame* at, Status status) {
    if (jumps_.empty() || jumps_.back().target != at)
        return status == kJumpPast && at->routine->hasUndo == 0 ? kJump : status;
    Jump jump = std::move(jumps_.back());
    jumps_.pop_back();
    if (jumps_.empty() && unwinding_ == Unwind::Jump) {
        unwinding_ = Unwind::None;
        undoAborted_ = false;
    }
    frame = at;
    errorNumber = jump.number;
    const Status stopped = suspendStopped(); // by an order that came while UNDO handlers ran
    if (stopped < 0) return stopped;
    // Interrupts that occurred meanwhile come before the first instruction of the handler.
    Status delivered = unwinding_ == Unwind::None && !isStopped() ? kAgain : kOk;
    while (delivered == kAgain)
        delivered = interrupts_.deliver();
    if (delivered != kOk) return landAt(at, delivered);
    error_ = std::move(jump.error);
    if (jump.decision == kNotDecided) noteHandled(at, jump.number);
    decision_ = jump.decision;
    return jump.number;
}

// ---- RaiseToUser -----------------------------------------------------------------------------------------------------

/// ERRNO is `number` from now on. Null: the system handler is to report it.
Frame* Task::findUserLevel(int number) {
    const bool allowed = frame != nullptr && frame->routine->noStepIn != 0 && inErrorHandler(*frame);
    if (number != errorNumber) error_.renumber(number, errorDetail_);
    errorNumber = number;
    dropHandled(frame); // the handler at work passes it on
    return allowed ? userLevelHandler(frame, number) : nullptr;
}

Status Task::breakOffToUser(int number) {
    Frame* const user = findUserLevel(number);
    if (user == nullptr) return reportUnhandled(number);
    (void)startJump(user, number);
    return kJumpPast;
}

Status Task::continueAtUser(int number, HandlerDecision& decision) {
    Frame* const from = frame;
    Frame* const user = findUserLevel(number);
    if (user == nullptr) return reportUnhandled(number);
    const RoutineDesc& routine = *user->routine;
    if (routine.detachedHandler == nullptr)
        return fatal(static_cast<int>(EventId::HandlerNotDetached), routine.name);
    handled_.push_back({user, &routine, number, error_});
    detached_.push_back({user});
    void* const* data = static_cast<const SteppingFrame*>(user)->addresses + routine.localCount;
    const Status status = routine.detachedHandler(this, from, data);
    decision = detached_.back().decision;
    detached_.pop_back();
    frame = from;
    if (status < 0) return status;
    if (decision == kDecidedRetry || decision == kDecidedTryNext) return kOk;
    if (decision == kDecidedRaise) dropHandled(user); // reported when it is handled further out
    (void)startJump(user, errorNumber, decision);
    return kJumpPast;
}

/// RAISE in a detached handler: at once to the system handler when no handler further out takes the error. Positive: the handler
/// returns, and its routine raises the error when the stack has been unwound to it.
[[gnu::noinline, gnu::cold]] Status Task::leaveDetached(int number) {
    if (number != errorNumber) noteRaised(number);
    errorNumber = number;
    if (routeFromCall(detached_.back().user->caller, number).handler == nullptr) {
        handled_.clear();
        return reportUnhandled(number);
    }
    detached_.back().decision = kDecidedRaise;
    return number;
}

/// The rest of the UNDO handlers is skipped.
void Task::abortUndo(std::string why) {
    host_.log().write(EventId::UndoSkipped, this, {std::move(why)});
    undoAborted_ = true;
    if (unwinding_ == Unwind::Jump) jumps_.resize(1);
}

// ---- Handled errors ------------------------------------------------------------------------------------------------

void Task::noteHandled(Frame* handler, int number) {
    if (!handled_.empty()) {
        flushHandledWarning();
        dropHandled(handler);
    }
    RetryCount* entry = retryCountOf(handler);
    if (entry == nullptr) {
        entry = &retries_.emplace_back();
        entry->frame = handler;
        entry->statement = handler->statement;
    } else if (entry->statement != handler->statement || entry->id != handler->reserved) {
        entry->statement = handler->statement;
        entry->id = 0;
        entry->counts.clear();
    }
    entry->number = number;
    // Last: the error has just been written in parts and is read as one, which a processor does only after a while.
    handled_.emplace_back(handler, handler->routine, number, error_);
}

/// The count of the handler at work that is nearest to `from`. The counts lie in the order of calls, the innermost last;
/// those of routines that have been left are dropped.
Task::RetryCount* Task::nearestRetryCount(const Frame* from) {
    while (!retries_.empty() && !isAmongCallers(from, retries_.back().frame))
        retries_.pop_back();
    return retries_.empty() ? nullptr : &retries_.back();
}

Task::RetryCount* Task::retryCountOf(Frame* handler) {
    RetryCount* nearest = nearestRetryCount(handler);
    return nearest != nullptr && nearest->frame == handler ? nearest : nullptr;
}

Status Task::retryAt(Frame* handler) {
    frame = handler;
    while (!handled_.empty() && !isAmongCallers(handler->caller, handled_.back().frame))
        writeHandledWarning();
    flushHandledWarning();
    if (undoAborted_ || unwinding_ == Unwind::Abandon) return silentStatus();
    RetryCount* entry = retryCountOf(handler);
    if (entry == nullptr) return kOk;
    int& count = entry->counts.of(entry->number);
    if (count >= host_.retryLimit()) {
        const std::string text =
            formatEventText(EventId::RetryExceeded, {errorText(), std::to_string(count)});
        const Status status =
            systemHandler(static_cast<int>(EventId::RetryExceeded), entry->number, text, errorPlace());
        if (status != kAgain) return status;
        count = 0; // started again
    }
    ++count;
    // The frame record carries the id: a later invocation at the same address starts counting again.
    entry->id = handler->reserved = ++lastRetryId_;
    host_.retried(*this);
    return kOk;
}

int Task::remainingRetries() {
    const int limit = host_.retryLimit();
    RetryCount* const entry = nearestRetryCount(frame);
    if (entry == nullptr) return limit;
    return std::max(0, limit - entry->counts.of(entry->number));
}

void Task::resetRetryCount() {
    if (RetryCount* entry = nearestRetryCount(frame)) entry->counts.clear();
}

/// The warning waits until the handler is left, because SkipWarn in it may take it back.
bool Task::isInside(const HandledError& handled) const {
    const auto isHandled = [&handled](const Detached& handler) { return handler.user == handled.frame; };
    if (std::any_of(detached_.begin(), detached_.end(), isHandled)) return true;
    const bool inProgress = handled.frame == frame || isInProgress(frame, handled.frame);
    return inProgress && handled.frame->routine == handled.routine && inHandler(*handled.frame);
}

void Task::flushHandledWarning() {
    while (!handled_.empty() && !isInside(handled_.back()))
        writeHandledWarning();
}

/// Handlers in this frame and deeper ones have passed their errors on.
void Task::dropHandled(const Frame* outermost) {
    const Frame* const caller = outermost != nullptr ? outermost->caller : nullptr;
    while (!handled_.empty() && !isAmongCallers(caller, handled_.back().frame))
        handled_.pop_back();
}

void Task::skipWarn() {
    const auto isOwn = [this](const HandledError& handled) {
        return handled.frame == frame && handled.routine == frame->routine && inHandler(*frame);
    };
    if (!handled_.empty() && isOwn(handled_.back())) return handled_.pop_back(); // as a rule
    flushHandledWarning();
    if (!handled_.empty()) handled_.pop_back();
}

/// A loop that handles the same errors again and again only counts their events.
void Task::writeHandledWarning() {
    const HandledError& handled = handled_.back();
    for (Warned& warned : warned_) {
        const bool isSame = warned.event != 0 && handled.routine == warned.handled.routine &&
                            handled.number == warned.handled.number &&
                            handled.error.isLike(warned.handled.error);
        if (!isSame) continue;
        if (host_.log().repeat(warned.event, now())) return handled_.pop_back();
        warned.event = 0; // it is written again
    }
    writeHandledEvent();
}

[[gnu::noinline, gnu::cold]] void Task::writeHandledEvent() {
    HandledError handled = std::move(handled_.back());
    handled_.pop_back();
    const std::string text = handled.error.text(host_.log());
    Event event;
    event.number = static_cast<int>(EventId::HandledError);
    event.type = EventType::Warning;
    event.title = eventText(EventId::HandledError).title;
    event.text = formatEventText(EventId::HandledError, {text, handled.routine->name});
    event.place = handled.error.place();
    event.arguments = {name_, event.place.reference(), text, handled.routine->name};
    event.time = now(); // until here SkipWarn may take it back, and the log is in order of time
    event.task = name_;
    event.errorNumber = handled.number;
    event.errorName = host_.log().errorName(handled.number);
    warned_[nextWarned_] = {std::move(handled), host_.log().write(std::move(event))};
    nextWarned_ = (nextWarned_ + 1) % kWarned;
}

} // namespace rt

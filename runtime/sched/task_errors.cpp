// Task: errors, retries and the system handler (manual 1.12).

#include "runtime/log/event_log.h"
#include "runtime/sched/error_search.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/step_hook.h"
#include "runtime/sched/task.h"

#include <fmt/format.h>

#include <algorithm>

namespace rt {
namespace {

/// Callers listed in an event; an endless recursion has a hundred thousand.
constexpr std::size_t kMaxCalls = 24;

} // namespace

SourcePlace Task::place() const {
    for (const Frame* at = frame; at != nullptr; at = at->caller) {
        if (at->routine != &kTrapBoundary) return placeOf(at);
    }
    return {};
}

std::vector<SourcePlace> Task::callChain() const {
    std::vector<SourcePlace> chain;
    for (const Frame* at = frame; at != nullptr && chain.size() <= kMaxCalls; at = at->caller) {
        chain.push_back(placeOf(at));
    }
    return chain;
}

std::string Task::describeError(int number) const {
    const EventLog& log = host_.log();
    const std::string name = log.errorName(number);
    std::string text = name.empty() ? fmt::format("Error {}", number) : fmt::format("{} ({})", name, number);
    const std::string& why = errorDetail_.empty() ? log.errorText(number) : errorDetail_;
    text += why.empty() ? "." : ": " + why;
    if (text.back() != '.' && text.back() != '!' && text.back() != '?') text += '.';
    return text;
}

Status Task::raiseAt(Frame* at, int number) {
    frame = at;
    flushHandledWarning();
    errorPlace_ = place();
    errorText_ = describeError(number);
    errorDetail_.clear(); // the next error has a reason of its own
    return dispatchError(at, number);
}

Status Task::propagateFrom(Frame* handler) {
    frame = handler;
    return dispatchError(handler != nullptr ? handler->caller : nullptr, static_cast<int>(errorNumber));
}

Status Task::dispatchError(Frame* first, int number) {
    errorNumber = static_cast<float>(number);
    if (unwinding_ == Unwind::Abandon || undoAborted_) return kUnwindSilent;
    const bool backward = stepHook_ != nullptr && stepHook_->isBackward(*this);
    if (Frame* handler = backward ? nullptr : findErrorHandler(first, number)) {
        noteHandled(handler, number);
        return number;
    }
    handled_.frame = nullptr; // reported as unhandled instead
    return systemHandler(static_cast<int>(EventId::UnhandledError), number, errorText_, errorPlace_, true);
}

Status Task::handlerEndAt(Frame* handler) {
    frame = handler;
    handled_.frame = nullptr;
    const int number = static_cast<int>(errorNumber);
    const std::string text = formatEventText(EventId::HandlerEnd, {errorText_, place().routine});
    return systemHandler(static_cast<int>(EventId::HandlerEnd), number, text, errorPlace_, true);
}

Status Task::stackOverflowAt(Frame* at) {
    frame = at;
    return fatal(static_cast<int>(EventId::StackOverflow), name_);
}

Status Task::fatal(int eventNumber, std::string argument) {
    return systemHandler(eventNumber, 0,
                         formatEventText(static_cast<EventId>(eventNumber), {std::move(argument)}), place(),
                         false);
}

Status Task::systemHandler(int eventNumber, int number, std::string text, const SourcePlace& where,
                           bool again) {
    if (unwinding_ == Unwind::Abandon || undoAborted_) return kUnwindSilent;
    EventLog& log = host_.log();
    if (unwinding_ != Unwind::None) {
        log.write(EventId::UndoSkipped, this, {std::move(text)});
        undoAborted_ = true;
        return kUnwindSilent;
    }
    Event event;
    event.number = eventNumber;
    event.type = EventType::Error;
    event.title = eventText(static_cast<EventId>(eventNumber)).title;
    event.text = std::move(text);
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
    stop(StopCause::Error);
    host_.taskFailed(*this);
    restartable_ = again && canExecuteAgain();
    const Status status = suspendStopped();
    return status == kOk ? kAgain : status;
}

// ---- Handled errors ------------------------------------------------------------------------------------------------

void Task::noteHandled(Frame* handler, int number) {
    flushHandledWarning();
    handled_ = {handler, handler->routine, number, errorText_, errorPlace_, now()};
    // Counts of frames deeper than the handler's belong to routines that are gone: the stack grows downward.
    std::erase_if(retries_, [handler](const RetryCount& entry) { return entry.frame < handler; });
    if (RetryCount* entry = retryCountOf(handler)) {
        if (entry->statement == handler->statement && entry->id == handler->reserved) return;
        *entry = {handler, handler->statement, 0, 0};
    } else {
        retries_.push_back({handler, handler->statement, 0, 0});
    }
}

Task::RetryCount* Task::retryCountOf(Frame* handler) {
    for (RetryCount& entry : retries_) {
        if (entry.frame == handler) return &entry;
    }
    return nullptr;
}

Status Task::retryAt(Frame* handler) {
    frame = handler;
    writeHandledWarning();
    if (undoAborted_ || unwinding_ == Unwind::Abandon) return kUnwindSilent;
    RetryCount* entry = retryCountOf(handler);
    if (entry == nullptr) return kOk;
    if (entry->count >= host_.retryLimit()) {
        const int number = static_cast<int>(errorNumber);
        const std::string text =
            formatEventText(EventId::RetryExceeded, {errorText_, std::to_string(entry->count)});
        return systemHandler(static_cast<int>(EventId::RetryExceeded), number, text, errorPlace_, false);
    }
    ++entry->count;
    // The frame record carries the id: a later invocation at the same address starts counting anew.
    entry->id = handler->reserved = ++lastRetryId_;
    return kOk;
}

int Task::remainingRetries() const {
    const int limit = host_.retryLimit();
    return retries_.empty() ? limit : std::max(0, limit - retries_.back().count);
}

void Task::resetRetryCount() {
    if (!retries_.empty()) retries_.back().count = 0;
}

/// The warning waits until the handler is left, because SkipWarn in it may take it back.
bool Task::insideHandler() const {
    for (const Frame* at = frame; at != nullptr; at = at->caller) {
        if (at != handled_.frame) continue;
        if (at->routine != handled_.routine) return false;
        const StmtDesc* statement = statementOf(*at);
        return statement != nullptr && !statement->handled;
    }
    return false;
}

void Task::flushHandledWarning() {
    if (handled_.frame != nullptr && !insideHandler()) writeHandledWarning();
}

void Task::writeHandledWarning() {
    if (handled_.frame == nullptr) return;
    Event event;
    event.number = static_cast<int>(EventId::HandledError);
    event.type = EventType::Warning;
    event.title = eventText(EventId::HandledError).title;
    event.text = formatEventText(EventId::HandledError, {handled_.text, handled_.routine->name});
    event.time = handled_.time;
    event.task = name_;
    event.place = handled_.place;
    event.errorNumber = handled_.number;
    event.errorName = host_.log().errorName(handled_.number);
    handled_.frame = nullptr;
    host_.log().write(std::move(event));
}

} // namespace rt

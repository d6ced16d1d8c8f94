// Task: what an earlier process left (--state), and what this one leaves.

#include "runtime/sched/event_routines.h"
#include "runtime/sched/fibre.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/step_hook.h"
#include "runtime/sched/task.h"

#include <algorithm>
#include <utility>

namespace rt {

void Task::reenter(StepHook& guide, EntryFunction entry) {
    keepVariables();
    nextGuide_ = &guide;
    entryOverride_ = entry;
}

void Task::beginReentry() {
    guide_ = std::exchange(nextGuide_, nullptr);
    askSteps += kAsksForReentry;
}

void Task::endReentry() {
    if (std::exchange(guide_, nullptr) != nullptr) askSteps -= kAsksForReentry;
    nextGuide_ = nullptr;
}

void Task::finishReentry(const ErrorMemory& errors, bool afterStop) {
    endReentry();
    passStop_ = afterStop;
    errorNumber = errors.errorNumber;
    interruptNumber = errors.interruptNumber;
    error_ = RaisedError::described(errors.text, errors.place);
    errorDetail_.clear();
    const std::vector<Frame*> chain = frames();
    retries_.clear();
    for (const ErrorMemory::Retries& saved : errors.retries) {
        if (saved.depth >= chain.size()) continue;
        Frame* const at = chain[saved.depth];
        at->reserved = ++lastRetryId_;
        retries_.push_back({at, saved.statement, at->reserved, saved.number, RetryCounts(saved.counts)});
    }
    handled_.clear();
    if (errors.handled && errors.handled->depth < chain.size()) {
        Frame* const at = chain[errors.handled->depth];
        handled_.push_back({at, at->routine, errors.handled->number,
                            RaisedError::described(errors.handled->text, errors.handled->place)});
    }
}

Status Task::abandonReentry() {
    endReentry();
    needsReset_ = true;
    unwinding_ = Unwind::ToMain;
    for (const SystemEvent event : {SystemEvent::Reset, SystemEvent::Start})
        events_.owe(event);
    return kUnwindSilent;
}

std::vector<Frame*> Task::frames() const {
    std::vector<Frame*> chain;
    for (Frame* at = frame; at != nullptr; at = at->caller)
        chain.push_back(at);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

ErrorMemory Task::errorMemory() const {
    ErrorMemory memory;
    memory.errorNumber = errorNumber;
    memory.interruptNumber = interruptNumber;
    const EventLog& log = host_.log();
    memory.text = error_.text(log);
    memory.place = error_.place();
    const std::vector<Frame*> chain = frames();
    for (std::size_t depth = 0; depth < chain.size(); ++depth) {
        for (const RetryCount& entry : retries_)
            if (entry.frame == chain[depth] && entry.id == chain[depth]->reserved)
                memory.retries.push_back({depth, entry.statement, entry.number, entry.counts.all()});
        for (const HandledError& handled : handled_)
            if (handled.frame == chain[depth] && handled.routine == chain[depth]->routine)
                memory.handled = {depth, handled.number, handled.error.text(log), handled.error.place()};
    }
    return memory;
}

bool Task::ownsAddress(const void* address) const {
    return fibre_->owns(address);
}

} // namespace rt

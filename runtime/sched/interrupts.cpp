#include "runtime/sched/interrupts.h"

#include "runtime/log/event_log.h"
#include "runtime/sched/task.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rt {

constinit const RoutineDesc kTrapBoundary = boundary("(interrupt)");

bool InterruptTable::deliverable() const {
    return enabled_ && !running_ && !queue_.empty() && !task_.isStepwise();
}

int InterruptTable::connect(const Trap& trap) {
    if (defined_.size() >= kMaxDefined) return 0;
    defined_[++lastNumber_].trap = trap;
    return lastNumber_;
}

bool InterruptTable::attach(int number, const Trap& trap) {
    const auto found = defined_.find(number);
    if (found == defined_.end() || found->second.trap.function != nullptr) return false;
    found->second.trap = trap;
    return true;
}

void InterruptTable::forEachTrap(const std::function<void(Trap&)>& visit) {
    for (auto& [number, definition] : defined_)
        visit(definition.trap);
}

bool InterruptTable::isOrdered(int number) const {
    const auto found = defined_.find(number);
    return found != defined_.end() && found->second.ordered;
}

bool InterruptTable::order(int number, std::function<void()> disarm, bool single, bool safe,
                           InterruptOrder what) {
    const auto found = defined_.find(number);
    if (found == defined_.end()) return false;
    Definition& definition = found->second;
    if (definition.disarm) definition.disarm();
    definition.disarm = std::move(disarm);
    definition.single = single;
    definition.safe = safe;
    definition.asleep = false;
    definition.ordered = true;
    definition.what = std::move(what);
    return true;
}

std::vector<SavedInterrupt> InterruptTable::saved() const {
    std::vector<SavedInterrupt> all;
    for (const auto& [number, d] : defined_)
        all.push_back({number, d.trap.function, d.single, d.safe, d.asleep, d.ordered, d.what});
    return all;
}

void InterruptTable::restore(const SavedInterrupt& interrupt) {
    Definition& definition = defined_[interrupt.number];
    definition.trap.function = interrupt.trap;
    definition.single = interrupt.single;
    definition.safe = interrupt.safe;
    lastNumber_ = std::max(lastNumber_, interrupt.number);
}

std::vector<int> InterruptTable::queuedSafe() const {
    std::vector<int> numbers;
    for (const Occurrence& occurrence : queue_)
        if (isSafe(occurrence.number)) numbers.push_back(occurrence.number);
    return numbers;
}

void InterruptTable::queueAgain(int number) {
    if (isSafe(number) && queue_.size() < kMaxQueued) queue_.push_back({number, nullptr});
}

bool InterruptTable::remove(int number) {
    const auto found = defined_.find(number);
    if (found == defined_.end()) return false;
    const std::function<void()> disarm = std::move(found->second.disarm);
    defined_.erase(found);
    dropQueued([number](int queued) { return queued == number; });
    if (disarm) disarm();
    return true;
}

template <class Condition> void InterruptTable::dropQueued(Condition drop) {
    const auto gone = [&drop](const Occurrence& occurrence) {
        return !occurrence.call && drop(occurrence.number);
    };
    queue_.erase(std::remove_if(queue_.begin(), queue_.end(), gone), queue_.end());
}

void InterruptTable::forgetQueued(int number) {
    dropQueued([number](int queued) { return queued == number; });
}

void InterruptTable::clear() {
    std::map<int, Definition> all;
    all.swap(defined_);
    queue_.clear();
    enabled_ = true;
    for (auto& [number, definition] : all) {
        if (definition.disarm) definition.disarm();
    }
}

void InterruptTable::post(int number, Cause cause) {
    const auto found = defined_.find(number);
    if (found == defined_.end() || !found->second.ordered || found->second.asleep) return;
    Definition& definition = found->second;
    if (task_.state() == TaskState::Finished ||
        ((task_.isStopped() || task_.isStepwise()) && !definition.safe))
        return;
    if (queue_.size() >= kMaxQueued) {
        if (!std::exchange(overflowReported_, true))
            task_.report(EventId::InterruptsLost, {std::to_string(number)});
        return;
    }
    queue_.push_back({number, std::move(cause)});
    if (definition.single) {
        definition.ordered = false;
        const std::function<void()> disarm = std::move(definition.disarm);
        definition.disarm = nullptr;
        if (disarm) disarm();
    }
    if (deliverable()) task_.interruptPosted();
}

void InterruptTable::postCall(Call call) {
    if (task_.state() == TaskState::Finished || queue_.size() >= kMaxQueued) return;
    queue_.push_back({0, nullptr, std::move(call)});
    if (deliverable()) task_.interruptPosted();
}

bool InterruptTable::sleep(int number) {
    const auto found = defined_.find(number);
    if (found == defined_.end()) return false;
    found->second.asleep = true;
    return true;
}

bool InterruptTable::watch(int number) {
    const auto found = defined_.find(number);
    if (found == defined_.end()) return false;
    found->second.asleep = false;
    return true;
}

bool InterruptTable::isSafe(int number) const {
    const auto found = defined_.find(number);
    return found != defined_.end() && found->second.safe;
}

void InterruptTable::enable() {
    enabled_ = true;
    if (deliverable()) task_.interruptPosted();
}

Status InterruptTable::deliver() {
    while (deliverable()) {
        if (const Status status = deliverFirst(); status != kOk) return status;
        // Traps that cause each other's interrupts must not hold up time.
        if (!deliverable() || !task_.outOfBudget()) continue;
        if (const Status status = task_.letTimePass(); status != kOk) return status;
    }
    return kOk;
}

Status InterruptTable::deliverFirst() {
    const Occurrence occurrence = std::move(queue_.front());
    queue_.pop_front();
    if (queue_.empty()) overflowReported_ = false;
    if (occurrence.call) return callNow(occurrence.call);
    const auto found = defined_.find(occurrence.number);
    if (found == defined_.end()) return kOk;
    const Trap trap = found->second.trap;
    if (!trap.absent.empty())
        return task_.fatal(static_cast<int>(EventId::TrapUnloaded),
                           fmt::format("{}: its trap routine is {}", occurrence.number, trap.absent));
    if (trap.function == nullptr)
        return task_.fatal(static_cast<int>(EventId::TrapMissing), std::to_string(occurrence.number));
    return runOnTop(occurrence.number, occurrence.cause,
                    [&trap](Task& task, Frame* caller) { return trap.function(&task, caller); });
}

Status InterruptTable::callNow(const Call& call) {
    return runOnTop(0, nullptr, call);
}

/// The interrupted code must not see that a trap ran in between: ERRNO and INTNO are its own.
Status InterruptTable::runOnTop(int number, Cause cause, const Call& call) {
    Frame* const interrupted = task_.frame;
    Task::ErrorInProgress error = task_.errorInProgress();
    const int32_t interruptNumber = task_.interruptNumber;
    Frame boundary{interrupted, &kTrapBoundary, -1, 0};
    task_.interruptNumber = number;
    task_.charge(1); // an empty trap costs an instruction as well
    cause_ = std::move(cause);
    running_ = true;
    const Status status = call(task_, &boundary);
    unwound();
    task_.frame = interrupted;
    task_.setErrorInProgress(std::move(error));
    task_.interruptNumber = interruptNumber;
    return status > 0 ? task_.raiseAt(&boundary, status) : status;
}

void InterruptTable::taskStopped() {
    dropQueued([this](int queued) { return !isSafe(queued); });
}

} // namespace rt

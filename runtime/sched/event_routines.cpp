#include "runtime/sched/event_routines.h"

#include "runtime/base/text_util.h"
#include "runtime/sched/task.h"

#include <algorithm>
#include <utility>

namespace rt {
namespace {

constexpr const char* kNames[kSystemEvents] = {"",      "POWER_ON", "START", "STOP",
                                               "QSTOP", "RESTART",  "RESET", "STEP"};

std::size_t indexOf(SystemEvent event) {
    return static_cast<std::size_t>(event);
}

} // namespace

constinit const RoutineDesc kEventBoundary = boundary("(event)");

SystemEvent systemEventOf(std::string_view shelf) {
    for (std::size_t i = 1; i < kSystemEvents; ++i) {
        if (sameName(shelf, kNames[i])) return static_cast<SystemEvent>(i);
    }
    return SystemEvent::None;
}

const char* nameOf(SystemEvent event) {
    return event == SystemEvent::Visit ? "" : kNames[indexOf(event)];
}

void EventRoutines::add(SystemEvent event, EntryFunction routine) {
    routines_[indexOf(event)].push_back(routine);
}

void EventRoutines::owe(SystemEvent event) {
    if (routines_[indexOf(event)].empty() || task_.state() == TaskState::Finished) return;
    const bool continues = running_ != SystemEvent::None && !executesStopped() && !task_.isUnwinding();
    if (continues && !runsWhileStopped(event)) return;
    if (std::find(owed_.begin(), owed_.end(), event) != owed_.end()) return;
    owed_.push_back(event);
    task_.interruptPosted(); // wakes it: its wait continues afterwards
}

bool EventRoutines::owed() const {
    if (owed_.empty() || executesStopped()) return false;
    return runsWhileStopped(owed_.front()) || !task_.isStopped();
}

bool EventRoutines::concerns(SystemEvent event) const {
    return running_ == event || std::find(owed_.begin(), owed_.end(), event) != owed_.end();
}

Status EventRoutines::runPending() {
    while (owed() && !task_.isUnwinding()) {
        const SystemEvent event = owed_.front();
        owed_.pop_front();
        if (const Status status = run(event); status < 0) return status;
    }
    return kOk;
}

void EventRoutines::order(Visit visit) {
    visit_ = std::move(visit);
    owed_.push_front(SystemEvent::Visit);
    task_.interruptPosted();
}

Status EventRoutines::runVisit() {
    const Visit visit = std::exchange(visit_, nullptr);
    const Status status = visitNow(visit);
    return status > 0 ? kOk : status; // whoever visits knows of errors
}

bool EventRoutines::endVisit() {
    if (running_ == SystemEvent::Visit) {
        task_.endEventRoutine();
        return true;
    }
    visit_ = nullptr;
    std::erase(owed_, SystemEvent::Visit);
    return false;
}

Status EventRoutines::visitNow(const Visit& visit) {
    Frame* const interrupted = task_.frame;
    Task::ErrorInProgress error = task_.errorInProgress();
    const int32_t interruptNumber = task_.interruptNumber;
    const SystemEvent outer = std::exchange(running_, SystemEvent::Visit);
    Frame boundary{interrupted, &kEventBoundary, -1, 0};
    task_.frame = &boundary;
    const Status status = visit(task_, &boundary);
    running_ = outer;
    task_.frame = interrupted;
    task_.setErrorInProgress(std::move(error));
    task_.interruptNumber = interruptNumber;
    return task_.takeEventEnd() ? kOk : status;
}

Status EventRoutines::run(SystemEvent event) {
    if (event == SystemEvent::Visit) return runVisit();
    // The interrupted code must not see that something ran in between.
    Frame* const interrupted = task_.frame;
    const int32_t errorNumber = task_.errorNumber;
    const SystemEvent outer = running_;
    Frame boundary{interrupted, &kEventBoundary, -1, 0};
    running_ = event;
    since_ = task_.now();
    Status status = kOk;
    for (const EntryFunction routine : routines_[indexOf(event)]) {
        task_.frame = &boundary;
        status = routine(&task_, &boundary);
        if (task_.takeEventEnd()) status = kOk; // and the next routine has its turn
        if (status != kOk) break;
    }
    running_ = outer;
    task_.eventRoutinesEnded(event);
    task_.frame = interrupted;
    task_.errorNumber = errorNumber;
    return status > 0 ? task_.raiseAt(&boundary, status) : status;
}

bool EventRoutines::breakOff() {
    if (task_.now() - since_ < kPatience) return false;
    task_.endEventRoutine();
    return true;
}

} // namespace rt

// Scheduler: events first, then one task for one slice, then time. See README.md for the rules.

#include "runtime/sched/scheduler.h"

#include "runtime/sched/fibre.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <ctime>

namespace rt {
namespace {

constexpr int64_t kUnitsPerInstruction = 1'000'000;
/// Longest slice: 1000 s of virtual time. Keeps units (span * rate) within 64 bits at every rate.
constexpr Time kLongestSlice = 1000 * kSecond;
/// And so much work, a few hundredths of a second: then somebody may want the run to end (Ctrl-C).
constexpr int64_t kLongestWork = 20'000'000; // instructions
/// A sleep is no longer than this, in case its end was asked for just before it began.
constexpr Time kLongestSleep = 200 * kMillisecond;
/// While the wall is watched a task runs this long before it is looked at again.
constexpr Time kPacedSlice = 10 * kMillisecond;
/// How often a task that will not end is reminded at the end of the run.
constexpr int kAbandonAttempts = 10'000;

int64_t wallNow() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

} // namespace

Scheduler::Scheduler(SchedulerOptions options) : options_(options) {
    options_.rate = std::clamp<int64_t>(options_.rate, 1, kUnlimitedRate);
}

Scheduler::~Scheduler() = default;

// ---- Time ----------------------------------------------------------------------------------------------------------

/// The instructions that the running task owes so far in this slice, its debt included.
int64_t Scheduler::unitsUsed() const {
    const int64_t instructions = granted_ - (running_->budget + running_->stash_) + running_->later_.sum();
    // A counted loop without calls is charged ahead as a whole: a year of it must not overflow.
    constexpr int64_t kMost = INT64_MAX / 4 / kUnitsPerInstruction;
    return debtAtStart_ + std::min(instructions, kMost) * kUnitsPerInstruction;
}

Time Scheduler::now() const {
    if (running_ == nullptr) return now_;
    return now_ + std::min(unitsUsed(), sliceUnits_) / options_.rate;
}

void Scheduler::moveTo(Time time) {
    if (time <= now_) return;
    now_ = time;
    if (observers_.time) observers_.time(now_);
}

EventToken Scheduler::at(Time time, std::function<void()> action) {
    const EventToken token = ++lastToken_;
    events_.emplace(EventKey{time, token}, std::move(action));
    eventTimes_.emplace(token, time);
    if (running_ != nullptr && time < horizon_) running_->forceSafepoint();
    return token;
}

void Scheduler::cancel(EventToken token) {
    const auto found = eventTimes_.find(token);
    if (found == eventTimes_.end()) return;
    events_.erase({found->second, token});
    eventTimes_.erase(found);
}

EventToken Scheduler::watchData(std::function<void()> look) {
    watches_.push_back(std::make_unique<Watch>(Watch{++lastToken_, std::move(look)}));
    if (running_ != nullptr) running_->forceLook();
    return lastToken_;
}

void Scheduler::unwatchData(EventToken token) {
    const auto same = [token](const std::unique_ptr<Watch>& watch) { return watch->token == token; };
    const auto found = std::find_if(watches_.begin(), watches_.end(), same);
    if (found == watches_.end()) return;
    if (looking_)
        (*found)->token = 0; // it may be the one that looks now
    else
        watches_.erase(found);
}

void Scheduler::lookAtAll() {
    if (looking_) return;
    looking_ = true;
    for (std::size_t i = 0; i < watches_.size(); ++i) { // a look may add others
        const Watch& watch = *watches_[i];
        if (watch.token != 0) watch.look();
    }
    looking_ = false;
    const auto gone = [](const std::unique_ptr<Watch>& watch) { return watch->token == 0; };
    watches_.erase(std::remove_if(watches_.begin(), watches_.end(), gone), watches_.end());
}

void Scheduler::fireDueEvents() {
    while (!events_.empty() && events_.begin()->first.first <= now_) {
        const auto first = events_.begin();
        const std::function<void()> action = std::move(first->second);
        eventTimes_.erase(first->first.second);
        events_.erase(first);
        action();
    }
}

// ---- Tasks ---------------------------------------------------------------------------------------------------------

void Scheduler::add(Task& task) {
    tasks_.push_back(&task);
    makeReady(task);
}

void Scheduler::makeReady(Task& task) {
    if (task.state_ == TaskState::Finished) return;
    task.state_ = TaskState::Ready;
    if (std::find(ready_.begin(), ready_.end(), &task) == ready_.end()) ready_.push_back(&task);
    if (running_ != nullptr && running_ != &task) running_->forceSafepoint();
}

void Scheduler::switchOut(Task& task) {
    task.fibre_->suspend();
}

namespace {

/// Can run, and none of the tasks in whose background it is can (manual 1.20).
bool hasItsTurn(const Task* task) {
    if (!task->runnable()) return false;
    for (const Task* other = task->foreground(); other != nullptr; other = other->foreground()) {
        if (other->runnable()) return false;
    }
    return true;
}

} // namespace

bool Scheduler::anyRunnable() const {
    return std::any_of(ready_.begin(), ready_.end(), hasItsTurn);
}

Task* Scheduler::takeRunnable() {
    const auto found = std::find_if(ready_.begin(), ready_.end(), hasItsTurn);
    if (found == ready_.end()) return nullptr;
    Task* task = *found;
    ready_.erase(found);
    return task;
}

void Scheduler::runSlice(Task& task) {
    const Time longest = std::min(kLongestSlice, kLongestWork * kUnitsPerInstruction / options_.rate);
    horizon_ = std::min({nextEventTime(), options_.maxTime, addTime(now_, longest)});
    if (anyRunnable()) horizon_ = std::min(horizon_, addTime(now_, kSlice));
    if (paced()) horizon_ = std::min(horizon_, addTime(now_, kPacedSlice));
    sliceUnits_ = (horizon_ - now_) * options_.rate;
    if (task.debt_ >= sliceUnits_) { // still paying for what it was charged ahead
        task.debt_ -= sliceUnits_;
        makeReady(task);
        moveTo(horizon_);
        return;
    }
    debtAtStart_ = task.debt_;
    granted_ = (sliceUnits_ - task.debt_) / kUnitsPerInstruction;
    task.budget = granted_;
    task.stash_ = 0;
    task.yieldWanted_ = false;
    if (dataWatched()) task.forceLook();
    running_ = &task;
    task.fibre_->resume();
    lookAtData();
    settle(task);
}

/// Turns what the task used into time; what goes beyond the slice stays as debt.
void Scheduler::settle(Task& task) {
    const int64_t used = unitsUsed();
    running_ = nullptr;
    task.stash_ = 0;
    task.later_.costs.clear();
    if (used >= sliceUnits_) {
        task.debt_ = used - sliceUnits_;
        moveTo(horizon_);
    } else {
        task.debt_ = used % options_.rate;
        moveTo(now_ + used / options_.rate);
    }
    horizon_ = kNever;
}

RunEnd Scheduler::run(const std::function<bool()>& isOver) {
    anchorWall();
    for (;;) {
        if (inbox_ != nullptr) inbox_->run();
        if (holds_ && holdStill()) {
            if (isOver()) return RunEnd::Over;
            continue;
        }
        fireDueEvents();
        if (isOver()) return RunEnd::Over;
        if (holds_ && holds_()) continue;
        if (now_ >= options_.maxTime) return RunEnd::MaxTime;
        if (Task* task = takeRunnable()) {
            if (paced()) sleepOutside(now_);
            runSlice(*task);
            continue;
        }
        if (events_.empty() && resident_ && !paced()) {
            waitForCommands();
            continue;
        }
        if (events_.empty() && externals_.empty() && !resident_) {
            if (options_.maxTime != kNever) jumpTo(options_.maxTime);
            return RunEnd::Deadlock;
        }
        jumpTo(std::min(nextEventTime(), options_.maxTime));
    }
}

/// False: the program continues.
bool Scheduler::holdStill() {
    if (!holds_()) return false;
    waitForCommands();
    return true;
}

void Scheduler::waitForCommands() {
    if (observers_.beforeSleep) observers_.beforeSleep();
    if (inbox_ != nullptr) {
        inbox_->wait(static_cast<int>(kLongestSleep / kMillisecond)); // signals are looked at in between
        inbox_->run();
    }
    anchorWall();
}

void Scheduler::abandonTasks() {
    for (Task* task : tasks_) {
        if (task->state_ == TaskState::Finished) continue;
        task->pendingUnwind_ = Task::Unwind::Abandon;
        for (int i = 0; i < kAbandonAttempts && task->fibre_->started() && !task->fibre_->finished(); ++i) {
            task->budget = 0;
            task->fibre_->resume();
        }
        task->state_ = TaskState::Finished;
        task->interrupts_.clear();
    }
    ready_.clear();
}

// ---- The wall clock and things outside -----------------------------------------------------------------------------

void Scheduler::anchorWall() {
    anchorVirtual_ = now_;
    anchorWall_ = wallNow();
}

void Scheduler::setPace(bool paced, int percent) {
    anchorWall();
    options_.realtime = paced;
    pacePercent_ = std::max(percent, 1);
}

/// Virtual time that the wall clock has reached.
Time Scheduler::wallTime() const {
    return addTime(anchorVirtual_, (wallNow() - anchorWall_) / 100 * pacePercent_);
}

void Scheduler::addExternal(ExternalWait& wait) {
    if (!paced()) anchorWall();
    externals_.push_back(&wait);
}

void Scheduler::holdPace() {
    if (!paced()) anchorWall();
    ++paceHolds_;
}

void Scheduler::removeExternal(ExternalWait& wait) {
    externals_.erase(std::remove(externals_.begin(), externals_.end(), &wait), externals_.end());
}

/// Moves on to `time`; in pace with the wall clock when that is asked for or a task waits for something outside.
void Scheduler::jumpTo(Time time) {
    if (paced())
        sleepOutside(time);
    else
        moveTo(time);
}

/// Sleeps until the wall has reached `until`, virtual time following, or something outside is ready.
void Scheduler::sleepOutside(Time until) {
    std::vector<pollfd> files;
    for (const ExternalWait* wait : externals_)
        files.push_back({wait->fd, wait->events, 0});
    if (inbox_ != nullptr) files.push_back({inbox_->descriptor(), POLLIN, 0});
    const Time ahead = until == kNever ? kNever : until - wallTime();
    if (ahead > 0 && observers_.beforeSleep) observers_.beforeSleep();
    timespec span{};
    const Time onWall =
        ahead < kLongestSleep * pacePercent_ / 100 ? ahead * 100 / pacePercent_ : kLongestSleep;
    span.tv_nsec = static_cast<long>(std::clamp<Time>(onWall, 0, kLongestSleep));
    const int ready = ppoll(files.data(), files.size(), &span, nullptr);
    moveTo(std::min(until, std::max(now_, wallTime())));
    if (ready <= 0) return;
    for (std::size_t i = 0; i < externals_.size(); ++i) {
        if (files[i].revents == 0) continue;
        externals_[i]->ready = true;
        makeReady(*externals_[i]->task);
    }
}

} // namespace rt

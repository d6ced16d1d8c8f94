#include "runtime/host/motion_driver.h"

#include "runtime/host/synchronised_group.h"
#include "runtime/log/event_log.h"
#include "runtime/motion/motor_side.h"
#include "runtime/motion/path.h"
#include "runtime/sched/error_search.h"
#include "runtime/sched/step_hook.h"
#include "runtime/sched/task.h"
#include "runtime/sim/trace_sink.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace rt {

namespace {

/// The instruction in the user's program, not one inside a library routine.
const Frame* frameOf(const Task& task) {
    const Frame* frame = task.frame;
    while (frame != nullptr && frame->routine != nullptr && frame->routine->noStepIn != 0 &&
           frame->caller != nullptr)
        frame = frame->caller;
    return frame;
}

MotionPointer pointerOf(const Task& task, const motion::MoveCommand& command) {
    const Frame* frame = frameOf(task);
    MotionPointer pointer;
    pointer.valid = frame != nullptr;
    pointer.frame = frame;
    pointer.routine = frame != nullptr ? frame->routine : nullptr;
    pointer.statement = frame != nullptr ? frame->statement : -1;
    pointer.command = command;
    return pointer;
}

/// The task of a member.
const Task& taskIn(const SynchronisedGroup& group, const MotionDriver& driver) {
    const auto& members = group.members();
    return *std::find_if(members.begin(), members.end(), [&](const auto& member) {
                return member.driver == &driver;
            })->task;
}

/// To the target of `target`, as the movement `as` was made (manual 1.21).
motion::MoveCommand reversed(const motion::MoveCommand& target, const motion::MoveCommand& as) {
    motion::MoveCommand result = target;
    // A target in axis angles has no pose to draw a line to, and none in axis angles can be made of a pose.
    if (target.kind != motion::MoveKind::AbsJoint)
        result.kind = as.kind == motion::MoveKind::AbsJoint ? motion::MoveKind::Joint : as.kind;
    result.circlePoint = as.circlePoint;
    result.speed = as.speed;
    result.duration = as.duration;
    result.settings = as.settings;
    result.zone = {};
    result.stop = {};
    result.concurrent = false;
    return result;
}

} // namespace

MotionDriver::MotionDriver(Scheduler& scheduler, robot::RobotModel model, motion::MotionOptions options,
                           std::string unit, std::size_t group)
    : scheduler_(scheduler), system_(std::move(model), options), unitName_(std::move(unit)), group_(group) {}

MotionDriver::~MotionDriver() = default;

motion::MotionSystem& MotionDriver::system() {
    advance(scheduler_.now());
    return system_;
}

void MotionDriver::refresh() {
    refreshAlone();
    if (synchronised_ == nullptr) return;
    for (const SynchronisedGroup::Member& member :
         synchronised_->members()) // what one does changes the others' times
        if (member.driver != this) member.driver->refreshAlone();
}

void MotionDriver::setOverride(double percent) {
    const double before = system().speedOverride();
    system_.setOverride(percent);
    refresh();
    if (system_.speedOverride() != before) tell(ArmChange::Override);
}

void MotionDriver::setProgramOverride(double percent) {
    std::vector<MotionDriver*> drivers{this};
    if (const auto group = synchronised()) { // they have one speed
        drivers.clear();
        for (const SynchronisedGroup::Member& member : group->members())
            drivers.push_back(member.driver);
    }
    std::vector<MotionDriver*> changed;
    for (MotionDriver* driver : drivers) {
        const double before = driver->system().programOverride();
        driver->system_.setProgramOverride(percent);
        if (driver->system_.programOverride() != before) changed.push_back(driver);
    }
    refresh();
    for (MotionDriver* driver : changed)
        driver->tell(ArmChange::Override);
}

void MotionDriver::refreshAlone() {
    advance(scheduler_.now());
    schedule();
}

/// Event by event, so that samples lie on the move in progress and triggers act before motion continues.
void MotionDriver::advance(Time time) {
    if (advancing_) return; // a trigger's action asks for the motion system
    advancing_ = true;
    for (bool reached = false; !reached;) {
        Time step = time;
        if (const auto next = system_.nextEventTime())
            step = std::min(time, std::max<Time>(*next, system_.now()));
        system_.advanceModifiers(step);
        if (step > 0) trace(step); // at 0 the arm may still be placed
        system_.advanceTo(step);
        const std::vector<motion::MotionEvent> events = system_.takeEvents();
        for (const motion::MotionEvent& event : events)
            handle(event);
        if (!events.empty()) {
            changed_.notifyAll();
            tell(ArmChange::Event);
        }
        reached = step >= time && events.empty();
    }
    advancing_ = false;
}

motion::MotionState MotionDriver::tracedState(Time time) const {
    motion::MotionState state = system_.sample(time);
    if (std::any_of(traces_.begin(), traces_.end(), [](const auto* t) { return t->wantsMotors(); }))
        state.motors = motion::motorSide(system_, state, time);
    return state;
}

/// Writes the samples up to this time.
void MotionDriver::trace(Time time) {
    while (!traces_.empty() && nextSample_ <= time) {
        const motion::MotionState state = tracedState(nextSample_);
        for (TraceSink* trace : traces_)
            trace->sample(nextSample_, unitName_, state);
        nextSample_ += tick_;
        skipStill(state, time);
    }
}

/// Goes to the last sample up to this time when the arm stays where it is for long: a program that polls its inputs passes days
/// within seconds, and millions of equal samples would take minutes and gigabytes.
void MotionDriver::skipStill(const motion::MotionState& state, Time time) {
    constexpr Time kLong = 600 * kSecond;
    if (time - nextSample_ < kLong || state.moving || system_.isLed() || system_.movesBesidesPath()) return;
    const Time last = nextSample_ + (time - nextSample_) / tick_ * tick_;
    if (tracedState(last) == state) nextSample_ = last;
}

void MotionDriver::tell(ArmChange news) {
    for (const auto& listener : listeners_)
        listener(news);
}

void MotionDriver::handle(const motion::MotionEvent& event) {
    if (event.kind == motion::MotionEventKind::Reached)
        dropActions(
            [&event](const PendingAction& pending) { return pending.fired && pending.move == event.move; });
    if (event.kind == motion::MotionEventKind::CornerLost && cornerWarning_) tell(ArmChange::CornerLost);
    if (event.kind == motion::MotionEventKind::OutOfReach) tell(ArmChange::OutOfReach);
    if (event.kind != motion::MotionEventKind::Trigger) return;
    const auto found = actions_.find(event.trigger);
    if (found == actions_.end()) return;
    PendingAction& pending = found->second;
    pending.fired = true; // and kept: after a power failure it is executed again
    const std::function<void()> act = pending.action.act;
    const Time delay = pending.action.delay;
    if (system_.isDone(pending.move)) actions_.erase(found);
    if (delay > 0)
        scheduler_.after(delay, act);
    else
        act();
}

void MotionDriver::addActions(motion::MoveCommand& command, std::vector<PathAction> actions) {
    for (PathAction& action : actions) {
        motion::PathTrigger& place = action.place;
        place.id = ++lastTrigger_;
        if (place.lag < 0) action.delay += fromSeconds(-std::exchange(place.lag, 0));
        command.triggers.push_back(place);
        actions_[place.id].action = std::move(action);
    }
}

template <class Condition> void MotionDriver::dropActions(Condition drop) {
    for (auto at = actions_.begin(); at != actions_.end();)
        at = drop(at->second) ? actions_.erase(at) : std::next(at);
}

void MotionDriver::schedule() {
    const Time next = system_.nextEventTime().value_or(kNever);
    if (next == nextTime_) return;
    scheduler_.cancel(next_);
    const bool continues = std::exchange(nextTime_, next) == kNever;
    next_ = 0;
    if (next == kNever) return;
    next_ = scheduler_.at(next, [this] {
        nextTime_ = kNever;
        refresh();
    });
    if (continues) tell(ArmChange::Event); // also after an override of 0
}

Status MotionDriver::order(Task& task, motion::MoveCommand command, motion::MoveId& id,
                           std::optional<motion::MotionError>& error, std::vector<PathAction> actions) {
    if (const Status status = task.requireMovementAllowed(); status != kOk) return status;
    MotionPointer pointer = pointerOf(task, command);
    if (processError_ != kOk) return takeProcessError(task);
    const auto interrupted = std::exchange(interrupted_, {});
    if (isSame(interrupted, task, pointer) && !system_.isDone(interrupted.move)) {
        id = interrupted.move;
        error.reset();
        const Status status = waitReleased(task, id);
        if (status > 0) interrupted_ = {pointer.frame, pointer.statement, id, task.latestRetry()};
        return status;
    }
    const uint32_t before = lastTrigger_;
    if (!backward_) addActions(command, std::move(actions));
    const Status status = orderParts(task, std::move(command), pointer, id, error);
    for (auto at = actions_.upper_bound(before); at != actions_.end();) // those of a move that was not made
        at = at->second.move == 0 ? actions_.erase(at) : std::next(at);
    if (status == kOk && !error) pointer_ = std::move(pointer);
    return status;
}

bool MotionDriver::isSame(const Interrupted& interrupted, const Task& task, const MotionPointer& pointer) {
    return interrupted.frame != nullptr && interrupted.frame == pointer.frame &&
           interrupted.statement == pointer.statement && interrupted.retry != task.latestRetry();
}

bool MotionDriver::continuesMovement(const Task& task) {
    return isSame(interrupted_, task, pointerOf(task, {})) && !system().isDone(interrupted_.move);
}

Status MotionDriver::orderParts(Task& task, motion::MoveCommand command, const MotionPointer& pointer,
                                motion::MoveId& id, std::optional<motion::MotionError>& error) {
    if (backward_ && pointer_.valid) command = reversed(command, pointer_.command);
    std::vector<motion::MoveCommand> parts;
    if (command.kind == motion::MoveKind::Circular && task.isStepwise() && !backward_ && circlePointStop_)
        parts = motion::splitAtCirclePoint(command, system().currentTarget(command.frames));
    if (parts.empty()) parts.push_back(std::move(command));
    brokenOff_ = false;
    id = 0;
    for (std::size_t i = 0; i < parts.size() && !brokenOff_; ++i) {
        if (i > 0) {
            if (const Status status = circlePointStop_(task); status < 0) return status;
        }
        const Status status = submit(task, std::move(parts[i]), id, error);
        if (status > 0 && id != 0) interrupted_ = {pointer.frame, pointer.statement, id, task.latestRetry()};
        if (status != kOk || error) return status;
    }
    return kOk;
}

Status MotionDriver::submit(Task& task, motion::MoveCommand command, motion::MoveId& id,
                            std::optional<motion::MotionError>& error) {
    error.reset();
    command.tag = instructions_ + 1;
    if (task.isStepwise()) command.zone.finep = true; // each step ends at its point
    continueEarlier(command);
    if (synchronised() != nullptr) return submitTogether(task, std::move(command), id, error);
    WaitResult result{};
    for (;;) {
        refresh();
        Beginning beginning = beginOrder(&task, command);
        const auto underWay = orderUnderWay(command, beginning);
        const auto ordered = underWay ? *underWay : system_.enqueue(command);
        if (ordered) {
            id = *ordered;
            noteOrdered(&task, command, id, beginning);
            break;
        }
        if (ordered.error().kind != motion::MotionErrorKind::QueueFull) {
            error = ordered.error();
            return kOk;
        }
        const std::size_t full = system_.unfinishedMoves();
        const Status status =
            task.waitFor({{&changed_}, [&] { return system().unfinishedMoves() < full; }}, result);
        if (status < 0) return status;
    }
    refresh();
    return waitReleased(task, id);
}

MotionDriver::Beginning MotionDriver::beginOrder(const Task* task, motion::MoveCommand& command) {
    ordering_ = task;
    command.tag = instructions_ + 1;
    return {startOf(command), system_.plannedEnd()};
}

void MotionDriver::noteOrdered(const Task* task, const motion::MoveCommand& command, motion::MoveId id,
                               const Beginning& beginning) {
    enqueued(id, command, beginning.pose, system_.plannedEnd(), task);
    for (const auto& listener : orderListeners_)
        listener({id, command, beginning.joints, system_.plannedEnd()});
    ++instructions_;
    for (const motion::PathTrigger& trigger : command.triggers)
        actions_.at(trigger.id).move = id;
    refreshAlone();
    ordering_ = nullptr;
}

Status MotionDriver::submitTogether(Task& task, motion::MoveCommand command, motion::MoveId& id,
                                    std::optional<motion::MotionError>& error) {
    const std::shared_ptr<SynchronisedGroup> group = synchronised_;
    SynchronisedGroup::Order order;
    order.task = &task;
    order.command = std::move(command);
    // After --state: the calls in which an earlier process executed SyncMoveOn are not known.
    if (togetherChange_.empty()) noteTogetherChange(task);
    if (const std::string problem = group->give(*this, order); !problem.empty()) {
        if (refusesBackward(task)) return kAgain;
        return task.fatal(static_cast<int>(EventId::SyncMisused), problem);
    }
    const auto isOver = [&] { return order.isDone || group->isOver(); };
    Status status = kOk;
    WaitResult result{};
    WaitSpec meeting{group->queues(), [&] { return isOver() || group->isReady() || processError_ != kOk; }};
    meeting.isMeeting = true;
    while (status == kOk && !isOver() && processError_ == kOk) {
        if (group->isReady())
            group->orderStep();
        else
            status = task.waitFor(meeting, result);
    }
    if (status == kOk && !order.isDone) status = takeProcessError(task); // of another robot
    if (!order.isDone) group->withdraw(*this);
    if (status != kOk) return status;
    if (!order.isDone)
        return task.fatal(static_cast<int>(EventId::SyncMisused),
                          "The synchronised movement ended while the task waited for the others. Execute "
                          "SyncMoveOn again.");
    id = order.id;
    error = order.error;
    return error ? kOk : waitReleased(task, id);
}

void MotionDriver::joinGroup(std::shared_ptr<SynchronisedGroup> synchronised) {
    synchronised_ = std::move(synchronised);
    isSuspended_ = false;
    noteTogetherChange(taskIn(*synchronised_, *this));
}

void MotionDriver::suspendGroup(bool suspended) {
    isSuspended_ = suspended;
    applyStops(); // the others wait for this one, or need not any more
}

void MotionDriver::leaveGroup() {
    if (synchronised_ != nullptr) noteTogetherChange(taskIn(*synchronised_, *this));
    synchronised_ = nullptr;
    isSuspended_ = false;
    refreshAlone();
}

const std::shared_ptr<SynchronisedGroup>& MotionDriver::synchronised() const {
    static const std::shared_ptr<SynchronisedGroup> kNone;
    return isSuspended_ ? kNone : synchronised_;
}

bool MotionDriver::refusesBackward(Task& task) const {
    return backward_ && task.stepHook() != nullptr && task.stepHook()->refuseBackward(task);
}

std::vector<Task*> MotionDriver::tasksTogether() const {
    std::vector<Task*> tasks;
    if (synchronised() == nullptr) return tasks;
    for (const SynchronisedGroup::Member& member : synchronised_->members())
        tasks.push_back(member.task);
    return tasks;
}

void MotionDriver::noteTogetherChange(const Task& task) {
    togetherChange_.clear();
    const RoutineDesc* callee = nullptr;
    for (const Frame* frame = frameOf(task); frame != nullptr; frame = frame->caller) {
        togetherChange_.push_back({frame, frame->routine, frame->statement, callee});
        callee = frame->routine;
    }
}

void MotionDriver::setSpeedLimits(const motion::SpeedLimits& most) {
    speedLimits_ = most;
    limitSpeed(isSpeedLimited_);
}

void MotionDriver::limitSpeed(bool on) {
    isSpeedLimited_ = on;
    system().setSpeedLimits(on ? speedLimits_ : motion::SpeedLimits{});
    refresh();
}

/// Until the program may continue; in steps every movement is finished before the next instruction.
Status MotionDriver::waitReleased(Task& task, motion::MoveId id) {
    const auto mayContinue = [&] {
        if (processError_ != kOk) return true;
        return task.isStepwise() ? system().isDone(id) && !system_.isMoving() : system().isReleased(id);
    };
    WaitResult result{};
    const motion::MoveId outer = std::exchange(awaited_, id); // a trap routine moves the robot
    const Status status = task.waitFor({{&changed_}, mayContinue}, result);
    awaited_ = outer;
    return status == kOk ? takeProcessError(task) : status;
}

void MotionDriver::raiseProcessError(Status errorNumber, std::string why) {
    processErrorText_ =
        why.empty() ? "the movement was stopped by a process error (ProcerrRecovery)" : std::move(why);
    processError_ = errorNumber;
    stopMove();
    changed_.notifyAll();
}

Status MotionDriver::takeProcessError(Task& task) {
    const Status number = std::exchange(processError_, kOk);
    return number == kOk ? kOk : task.raise(number, processErrorText_);
}

Status MotionDriver::waitDone(Task& task, motion::MoveId id) {
    WaitResult result{};
    return task.waitFor({{&changed_}, [this, id] { return system().isDone(id); }}, result);
}

Status MotionDriver::waitIdle(Task& task) {
    WaitResult result{};
    return task.waitFor({{&changed_}, [this] { return system().isIdle() && !system_.isLed(); }}, result);
}

Status MotionDriver::waitZeroSpeed(Task& task) {
    WaitResult result{};
    return task.waitFor({{&changed_}, [this] { return !system().isMoving(); }}, result);
}

void MotionDriver::applyStops(motion::StopKind kind) {
    holdOrRelease(kind);
    if (synchronised_ == nullptr) return refresh();
    for (const SynchronisedGroup::Member& member : synchronised_->members())
        member.driver->holdOrRelease(kind);
    refresh();
}

/// Robots that move together stop and start together.
void MotionDriver::holdOrRelease(motion::StopKind kind) {
    advance(scheduler_.now());
    const bool held = synchronised() != nullptr ? synchronised()->isHeld() : isHeldItself();
    if (held && (!system_.isStopRequested() || kind == motion::StopKind::Quick)) system_.stop(kind);
    if (!held && system_.isStopRequested()) system_.start();
}

void MotionDriver::stopMove(StopOrigin origin, motion::StopKind kind) {
    stopMove_.of(origin) = true;
    applyStops(kind);
}

void MotionDriver::startMove(StopOrigin origin) {
    stopMove_.of(origin) = false;
    levelHold_ = false;
    applyStops();
}

void MotionDriver::programStop(motion::StopKind kind) {
    if (!std::exchange(programStop_, true)) tell(ArmChange::StopOnPath);
    applyStops(kind);
}

void MotionDriver::programStart() {
    programStop_ = false;
    tell(ArmChange::Start);
    applyStops();
}

void MotionDriver::emergencyStop(bool powerFailure) {
    advance(scheduler_.now());
    programStop_ = true;
    tell(ArmChange::MotorsOff);
    if (powerFailure) {
        tell(ArmChange::PowerFailed);
        brokenPath_ = system_.isIdle() ? 0 : system_.lastOrdered();
        brokenLevel_ = pathLevel();
    }
    system_.halt();
    if (powerFailure) system_.rearmTriggers();
    if (powerFailure && !system_.independentAxes().empty()) lostIndependentAxis_ = true;
    refresh();
}

Status MotionDriver::stepBack(Task& task, double mm, double mmPerSecond, bool& possible) {
    possible = false;
    if (!system().isStopRequested()) return kOk;
    if (const Status status = waitZeroSpeed(task); status != kOk) return status;
    system().returnToPath();
    refresh();
    if (const Status status = waitZeroSpeed(task); status != kOk) return status;
    possible = system().stepBack(mm, mmPerSecond);
    refresh();
    return waitZeroSpeed(task);
}

void MotionDriver::clearLevel(motion::StopKind kind) {
    advance(scheduler_.now());
    interrupted_ = {};
    earlier_ = {};
    levelHold_ = false;
    system_.clear(kind);
    dropActions(
        [this](const PendingAction& pending) { return pending.move != 0 && system_.isDone(pending.move); });
    if (const auto group = synchronised()) // the others cannot finish the movement alone
        for (const SynchronisedGroup::Member& member : group->members())
            if (member.driver != this && !member.driver->system().isIdle()) member.driver->clearLevel();
    applyStops();
    changed_.notifyAll(); // moves that tasks wait for are gone
}

void MotionDriver::breakOff(BreakOff how) {
    advance(scheduler_.now());
    if (how == BreakOff::Stiff) system_.halt();
    clearLevel(how == BreakOff::QuicklyOnPath ? motion::StopKind::Quick : motion::StopKind::Normal);
    brokenOff_ = true;
}

void MotionDriver::clearPath() {
    if (const auto group = synchronised_) group->end();
    togetherChange_.clear();
    levels_.clear();
    lostIndependentAxis_ = false;
    stopMove_ = {}; // nothing is left that it could hold
    system().clearStored();
    clearLevel();
}

void MotionDriver::leaveLevels() {
    if (!levels_.empty()) clearPath();
}

// ---- Between two processes -----------------------------------------------------------------------------------------

motion::Pose MotionDriver::startOf(const motion::MoveCommand& command) const {
    return system_.toRobTarget(system_.plannedEnd(), command.frames).pose;
}

void MotionDriver::enqueued(motion::MoveId id, const motion::MoveCommand& command, const motion::Pose& start,
                            const motion::JointTarget& endAxes, const Task* task) {
    // The latest one of those that are done remains: the arm may be in the corner after it.
    for (auto at = ordered_.begin(); at != ordered_.end() && std::next(at) != ordered_.end();) {
        const auto next = std::next(at);
        const bool isNextDone = system_.isDone(next->id);
        if (!isNextDone && next->level == pathLevel()) break;                  // so are those after it
        at = isNextDone && system_.isDone(at->id) ? ordered_.erase(at) : next; // a path may be put aside
    }
    ordered_.push_back({id, command, start, pathLevel()});
    if (traces_.empty()) return;
    motion::FrameSetup frames = command.frames;
    frames.workObject = {}; // world
    frames.displacement = {};
    motion::Pose end = frames.tool.tframe; // a stationary tool
    if (frames.tool.robotHeld) end = system_.toRobTarget(endAxes, frames).pose;
    const MoveOrder order{command.tag, command, end, task ? placeOf(frameOf(*task)) : SourcePlace()};
    for (TraceSink* trace : traces_)
        trace->ordered(order);
}

bool MotionDriver::isSettled() const {
    return !system_.isMoving() && (system_.isStopRequested() || system_.isIdle());
}

void MotionDriver::finishTrace() {
    advance(scheduler_.now());
    trace(scheduler_.now());
}

} // namespace rt

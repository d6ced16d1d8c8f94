// The arm on the controller's clock: a queue of planned moves, the stretch of motion in progress, and what
// happens when.

#include "runtime/motion/motion_system.h"

#include "runtime/motion/coast.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace motion {

namespace {

/// Nanoseconds that are not before the given seconds, so that what is promised for a time has happened by
/// then.
TimeNs toNs(double seconds) {
    return static_cast<TimeNs>(std::ceil(seconds * 1e9 - 1e-6));
}
double toSeconds(TimeNs time) {
    return static_cast<double>(time) * 1e-9;
}

constexpr double kReturnSpeed = 250; // mm/s, back to an interrupted path

Joints startPosture() {
    return {0, 0, 0, 0, 30, 0};
}

struct Trigger {
    PathTrigger wanted;
    bool fired = false;
};

struct Move {
    MoveId id = 0;
    uint64_t tag = 0;
    bool isFlyBy = false;
    bool isConcurrent = false;
    bool isReturn = false; // back to an interrupted path, on behalf of the move that goes on there
    double zone = 0;       // mm, the largest
    std::vector<Trigger> triggers;
    PlannedMotion plan;
    bool isStarted = false;
    bool isReleased = false;
    double doneSeconds = 0; // time spent on the path before the stretch in progress
    double pausedAt = 0;    // profile parameter at which it was put aside
};

/// What storePath() puts aside.
struct Level {
    std::deque<std::shared_ptr<Move>> queue;
    bool isStopRequested = false;
    bool isBraking = false;
};

/// A piece of the past, present or planned future: one move run by one profile, or standing still (no move).
struct Stretch {
    TimeNs start = 0;
    TimeNs end = 0;
    std::shared_ptr<const Move> move;
    Profile profile;
    MotionState still;                  // without a move
    std::shared_ptr<const Coast> coast; // without a move: braking off the path
};

} // namespace

struct MotionSystem::Impl {
    robot::RobotModel model;
    MotionOptions options;
    robot::Kinematics kinematics;

    TimeNs now = 0;
    double override = 100;
    bool isStopRequested = false;
    bool isBraking = false;   // the current stretch ends before the end of the path
    bool isAbandoned = false; // ... and the rest of its move has been thrown away
    bool isStopAnnounced = true;
    bool isHalted = false;   // off the path: the first move goes on at its pausedAt
    bool isCoasting = false; // braking there

    std::deque<std::shared_ptr<Move>> queue; // the first may be in progress
    std::vector<Level> levels;
    std::deque<Stretch> stretches; // in order of time; the last one is valid from its start on
    std::vector<MotionEvent> events;
    MoveId nextId = 1;
    MoveId lastDone = 0;
    std::deque<std::pair<MoveId, MoveId>> cleared; // first and last of each range, the most recent
    std::deque<std::pair<MoveId, TimeNs>> reached; // the most recent

    const Stretch& stretch() const { return stretches.back(); }
    const Move* findUnfinished(MoveId id) const;
    bool isOnPath() const { return stretch().move != nullptr && now < stretch().end; } // and moving
    bool isMoving() const { return isOnPath() || (stretch().coast != nullptr && now < stretch().end); }
    bool isHeld() const { return isStopRequested || override <= 0; }

    void report(MotionEventKind kind, const Move* move, TimeNs time, uint32_t trigger = 0);
    ProfileState profileState(TimeNs time) const;
    void begin(const std::shared_ptr<Move>& move, const Profile& profile);
    void startNext();
    bool replaceProfile(bool toStop);
    void hold();
    void goOn();
    void noteCleared(MoveId first);
    void coastNow();
    void resume();
    void orderReturnToPath();
    std::optional<TimeNs> nextEvent() const;
    std::optional<TimeNs> triggerTime(const Trigger& trigger) const;
    std::optional<TimeNs> releaseTime() const;
    bool happensNow(std::optional<TimeNs> time) const { return time && *time <= now; }
    void handleEventsNow();
    void finishStretch();
    MotionState stateAt(TimeNs time) const;
    JointTarget standing() const;
    JointTarget plannedEnd() const;
    void forgetBefore(TimeNs time);
};

const Move* MotionSystem::Impl::findUnfinished(MoveId id) const {
    const auto in = [&](const std::deque<std::shared_ptr<Move>>& moves) -> const Move* {
        const auto found = std::find_if(moves.begin(), moves.end(),
                                        [&](const auto& m) { return m->id == id && !m->isReturn; });
        return found == moves.end() ? nullptr : found->get();
    };
    if (const Move* move = in(queue)) return move;
    for (const Level& level : levels) {
        if (const Move* move = in(level.queue)) return move;
    }
    return nullptr;
}

void MotionSystem::Impl::report(MotionEventKind kind, const Move* move, TimeNs time, uint32_t trigger) {
    events.push_back({time, kind, move == nullptr ? 0 : move->id, move == nullptr ? 0 : move->tag, trigger});
}

ProfileState MotionSystem::Impl::profileState(TimeNs time) const {
    return stretch().profile.at(toSeconds(time - stretch().start));
}

void MotionSystem::Impl::begin(const std::shared_ptr<Move>& move, const Profile& profile) {
    Stretch next;
    next.start = now;
    next.end = now + toNs(profile.duration());
    next.move = move;
    next.profile = profile;
    stretches.push_back(std::move(next));
}

void MotionSystem::Impl::startNext() {
    if (queue.empty() || isHeld() || isMoving() || queue.front()->isStarted) return;
    const std::shared_ptr<Move>& move = queue.front();
    move->isStarted = true;
    begin(move, move->plan.profileAt(override));
    if (!move->isReturn) report(MotionEventKind::Started, move.get(), now);
}

/// Goes on along the path of the current move from the present state: to a stop, or to the end at the present
/// override. False if the motion is already braking for its end and cannot do better than that.
bool MotionSystem::Impl::replaceProfile(bool toStop) {
    const std::shared_ptr<Move> move = queue.front();
    if (!(move->plan.limits().speed > 0)) return false; // a pause has no path
    const bool isRunning = stretch().move == move;      // else it has been put aside meanwhile
    const ProfileState state = isRunning ? profileState(now) : ProfileState{move->pausedAt, 0, 0, 0};
    bool isFeasible = true;
    Profile profile = toStop ? Profile::brake(state, move->plan.limits())
                             : Profile::continueTo(state, 1, move->plan.limitsAt(override), isFeasible);
    if (!isFeasible || (toStop && profile.end() >= 1 - 1e-12)) return false;
    if (isRunning) move->doneSeconds += toSeconds(std::min(now, stretch().end) - stretch().start);
    begin(move, profile);
    isBraking = toStop;
    return true;
}

void MotionSystem::Impl::hold() {
    if (isOnPath() && !isBraking && stretch().profile.end() > 0) replaceProfile(true);
}

/// All moves from this one on. Who asks for one that was cleared long ago is told that it is done.
void MotionSystem::Impl::noteCleared(MoveId first) {
    cleared.emplace_back(first, nextId - 1);
    if (cleared.size() > 64) cleared.pop_front();
}

/// Brakes off the path, and notes where on the path the arm would have stopped.
void MotionSystem::Impl::coastNow() {
    if (queue.front()->isReturn) { // it was on its way back: the move behind knows where to
        queue.pop_front();
    } else {
        Move& move = *queue.front();
        move.pausedAt = std::min(stretch().profile.end(), 1.0); // stop() has been called
        move.doneSeconds += toSeconds(now - stretch().start);
    }
    if (isAbandoned) queue.clear();
    Stretch next;
    next.start = now;
    next.still = stateAt(now);
    const FrameSetup frames = stretch().move->plan.path().frames();
    next.coast = std::make_shared<const Coast>(next.still, model, frames);
    next.end = now + toNs(next.coast->duration());
    stretches.push_back(std::move(next));
    isBraking = isAbandoned = false;
    isHalted = isCoasting = true;
}

/// After a halt by way of the path, else straight on.
void MotionSystem::Impl::resume() {
    if (isCoasting) return; // when it has come to rest
    if (std::exchange(isHalted, false) && !queue.empty() && queue.front()->isStarted) orderReturnToPath();
    goOn();
}

void MotionSystem::Impl::goOn() {
    if (isHeld() || isCoasting) return;
    const bool isUnfinished = !queue.empty() && queue.front()->isStarted;
    if (!isUnfinished) return startNext();
    const bool isInterrupted = isBraking || stretch().move != queue.front();
    if (isInterrupted && !isAbandoned) replaceProfile(false);
}

/// Puts a joint move in front of the queue if the arm does not stand where the first move goes on.
void MotionSystem::Impl::orderReturnToPath() {
    const Move& first = *queue.front();
    MoveCommand back;
    const MotionState goal = first.plan.sampleAt({first.pausedAt, 0, 0, 0});
    back.joints = {goal.joints, goal.extax};
    back.frames = first.plan.path().frames();
    back.speed.vTcp = kReturnSpeed;
    auto path = MotionPath::make(kinematics, standing(), back);
    if (!path || path->isEmpty()) return;
    auto move = std::make_shared<Move>();
    move->id = first.id;
    move->tag = first.tag;
    move->isReturn = true;
    move->isReleased = true;
    move->plan = PlannedMotion::plan(std::move(*path), model, options.external, back);
    queue.push_front(std::move(move));
    isBraking = false;
}

std::optional<TimeNs> MotionSystem::Impl::triggerTime(const Trigger& trigger) const {
    if (trigger.fired || stretch().move == nullptr) return {};
    const PathTrigger& wanted = trigger.wanted;
    const Stretch& current = stretch();
    const PlannedMotion& plan = current.move->plan;
    double seconds = 0;
    if (wanted.inTime && wanted.fromStart) {
        seconds = wanted.amount - current.move->doneSeconds;
    } else if (wanted.inTime) {
        if (isBraking) return {}; // the end of the path is not in sight
        seconds = current.profile.duration() - wanted.amount;
    } else {
        const double mm = wanted.fromStart ? wanted.amount : plan.path().length() - wanted.amount;
        const double place = plan.parameterAtDistance(mm);
        if (place > current.profile.end() + 1e-12) return {};
        seconds = current.profile.timeAt(place);
    }
    const TimeNs time = current.start + toNs(std::max(0.0, seconds - wanted.lag));
    return isBraking && time > current.end ? std::nullopt : std::optional(time);
}

std::optional<TimeNs> MotionSystem::Impl::releaseTime() const {
    const Stretch& current = stretch();
    if (current.move == nullptr || current.move->isReleased || isAbandoned) return {};
    if (current.move->isConcurrent) return current.start;
    if (!current.move->isFlyBy || isBraking) return {}; // with the point itself
    const double length = current.move->plan.path().length();
    const double zone = std::min(current.move->zone, 0.5 * length);
    const double entry = current.profile.timeAt(current.move->plan.parameterAtDistance(length - zone));
    return std::max(current.start, current.start + toNs(entry) - options.programLead);
}

std::optional<TimeNs> MotionSystem::Impl::nextEvent() const {
    const Stretch& current = stretch();
    if (isCoasting) return std::max(current.end, now);
    if (current.move == nullptr) return {};
    const bool isOver = queue.empty() || queue.front() != current.move;
    if (isOver) return {};
    std::optional<TimeNs> next;
    const auto consider = [&](std::optional<TimeNs> time) {
        if (time && (!next || *time < *next)) next = std::max(*time, now);
    };
    if (!isAbandoned) {
        for (const Trigger& trigger : current.move->triggers)
            consider(triggerTime(trigger));
        consider(releaseTime());
    }
    const bool isStanding = isBraking && isStopAnnounced && !isAbandoned && now >= current.end;
    if (!isStanding) consider(current.end);
    return next;
}

void MotionSystem::Impl::finishStretch() {
    const std::shared_ptr<Move> move = queue.front();
    if (move->isReturn && !isBraking) {
        queue.pop_front();
    } else if (isBraking) {
        if (isAbandoned) queue.pop_front();
        isBraking = !isAbandoned; // an unfinished move stays first in line
        isAbandoned = false;
    } else {
        if (!std::exchange(move->isReleased, true)) report(MotionEventKind::Released, move.get(), now);
        // What was to fire later than the point is reached (negative lag) fires with it.
        for (Trigger& trigger : move->triggers) {
            if (!std::exchange(trigger.fired, true)) {
                report(MotionEventKind::Trigger, move.get(), now, trigger.wanted.id);
            }
        }
        report(MotionEventKind::Reached, move.get(), now);
        queue.pop_front();
        lastDone = move->id;
        reached.emplace_back(move->id, now);
        if (reached.size() > 64) reached.pop_front();
    }
    if (isHeld() && !std::exchange(isStopAnnounced, true)) report(MotionEventKind::Stopped, move.get(), now);
    goOn();
}

void MotionSystem::Impl::handleEventsNow() {
    if (isCoasting) {
        isCoasting = false;
        if (!std::exchange(isStopAnnounced, true))
            report(MotionEventKind::Stopped, queue.empty() ? nullptr : queue.front().get(), now);
        if (!isHeld()) resume();
        return;
    }
    const std::shared_ptr<Move> move = queue.front();
    if (!isAbandoned) {
        for (Trigger& trigger : move->triggers) {
            if (!happensNow(triggerTime(trigger))) continue;
            trigger.fired = true;
            report(MotionEventKind::Trigger, move.get(), now, trigger.wanted.id);
        }
        if (happensNow(releaseTime())) {
            move->isReleased = true;
            report(MotionEventKind::Released, move.get(), now);
        }
    }
    if (now >= stretch().end) finishStretch();
}

MotionState MotionSystem::Impl::stateAt(TimeNs time) const {
    const auto after = std::upper_bound(stretches.begin(), stretches.end(), time,
                                        [](TimeNs value, const Stretch& s) { return value < s.start; });
    const Stretch& at = after == stretches.begin() ? stretches.front() : *(after - 1);
    if (at.coast != nullptr) return at.coast->at(toSeconds(time - at.start), kinematics);
    if (at.move == nullptr) return at.still;
    MotionState state = at.move->plan.sampleAt(at.profile.at(toSeconds(time - at.start)));
    state.move = at.move->id;
    state.tag = at.move->tag;
    state.moving = time >= at.start && time < at.end;
    return state;
}

JointTarget MotionSystem::Impl::standing() const {
    const MotionState state = stateAt(now);
    return {state.joints, state.extax};
}

JointTarget MotionSystem::Impl::plannedEnd() const {
    if (!queue.empty() && !(isAbandoned && queue.size() == 1)) return queue.back()->plan.path().end();
    const MotionState state = stateAt(std::max(now, stretch().end));
    return {state.joints, state.extax};
}

void MotionSystem::Impl::forgetBefore(TimeNs time) {
    while (stretches.size() > 1 && stretches[1].start <= time)
        stretches.pop_front();
}

MotionSystem::MotionSystem(robot::RobotModel model, MotionOptions options) : impl_(std::make_unique<Impl>()) {
    impl_->model = std::move(model);
    impl_->options = options;
    impl_->kinematics = robot::Kinematics(impl_->model);
    ExternalAxes external = kNoExternalAxes;
    for (std::size_t i = 0; i < external.size(); ++i) {
        const ExternalAxisModel& axis = options.external[i];
        if (axis.present) external[i] = std::clamp(0.0, axis.lower, axis.upper);
    }
    impl_->stretches.emplace_back();
    placeAt({startPosture(), external});
}

MotionSystem::~MotionSystem() = default;
MotionSystem::MotionSystem(MotionSystem&&) noexcept = default;
MotionSystem& MotionSystem::operator=(MotionSystem&&) noexcept = default;

const robot::RobotModel& MotionSystem::model() const {
    return impl_->model;
}
const robot::Kinematics& MotionSystem::kinematics() const {
    return impl_->kinematics;
}

Expected<MoveId, MotionError> MotionSystem::enqueue(const MoveCommand& command) {
    MotionError error;
    if (impl_->model.kinematics != robot::KinematicsKind::SphericalWrist) {
        error.kind = MotionErrorKind::UnsupportedRobot;
        return Unexpected{error};
    }
    if (impl_->queue.size() >= impl_->options.maxQueued) {
        error.kind = MotionErrorKind::QueueFull;
        error.value = static_cast<double>(impl_->queue.size());
        return Unexpected{error};
    }
    MoveCommand based = command;
    based.frames.baseFrame = impl_->model.baseFrame;
    auto path = MotionPath::make(impl_->kinematics, impl_->plannedEnd(), based);
    if (!path) return Unexpected{path.error()};
    for (std::size_t i = 0; i < static_cast<std::size_t>(kExternalCount); ++i) {
        const ExternalAxisModel& axis = impl_->options.external[i];
        const double value = path->end().extax[i];
        if (!isConnected(value) || (value >= axis.lower - 1e-9 && value <= axis.upper + 1e-9)) continue;
        error.kind = MotionErrorKind::JointOutOfRange;
        error.joint = robot::kJointCount + 1 + static_cast<int>(i);
        error.value = value;
        error.pathFraction = 1;
        error.position = path->tcpAt(1).pos;
        return Unexpected{error};
    }
    auto move = std::make_shared<Move>();
    move->id = impl_->nextId++;
    move->tag = command.tag;
    move->isConcurrent = command.concurrent;
    move->isFlyBy = !command.zone.finep;
    move->zone = std::max({command.zone.pzoneTcp, command.zone.pzoneOri, command.zone.pzoneEax});
    for (const PathTrigger& trigger : command.triggers)
        move->triggers.push_back({trigger, false});
    move->plan = PlannedMotion::plan(std::move(*path), impl_->model, impl_->options.external, based);
    impl_->queue.push_back(move);
    impl_->startNext();
    return move->id;
}

void MotionSystem::clear() {
    Impl& s = *impl_;
    if (s.queue.empty()) return;
    if (s.isHalted) { // what remains is not the arm's any more
        s.noteCleared(s.queue.front()->id);
        s.queue.clear();
        s.isHalted = false;
        return;
    }
    const bool isUnderWay = s.queue.front()->isStarted;
    const bool isFinishing = isUnderWay && s.isMoving() && !s.isBraking && !s.replaceProfile(true);
    const MoveId first = s.queue.front()->id + (isFinishing ? 1 : 0);
    if (first < s.nextId) s.noteCleared(first);
    if (isUnderWay && s.isMoving()) {
        s.queue.resize(1); // it comes to rest first
        s.isAbandoned = !isFinishing;
    } else {
        s.queue.clear();
        s.isBraking = false;
        s.isAbandoned = false;
    }
}

bool MotionSystem::storePath() {
    Impl& s = *impl_;
    if (s.isMoving()) return false;
    if (!std::exchange(s.isHalted, false) && !s.queue.empty() && s.queue.front()->isStarted) {
        s.queue.front()->pausedAt = s.profileState(s.now).s;
    }
    s.levels.push_back({std::exchange(s.queue, {}), s.isStopRequested, s.isBraking});
    s.isStopRequested = false;
    s.isBraking = false;
    s.isStopAnnounced = true;
    return true;
}

bool MotionSystem::restorePath() {
    Impl& s = *impl_;
    if (s.isMoving() || !s.queue.empty() || s.levels.empty()) return false;
    Level level = std::move(s.levels.back());
    s.levels.pop_back();
    s.queue = std::move(level.queue);
    s.isStopRequested = level.isStopRequested;
    s.isBraking = level.isBraking;
    if (!s.queue.empty()) s.orderReturnToPath();
    s.goOn();
    return true;
}

bool MotionSystem::placeAt(const JointTarget& joints) {
    Impl& s = *impl_;
    if (!s.queue.empty() || s.isMoving()) return false;
    Stretch still;
    still.start = s.now;
    still.end = s.now;
    still.still = s.stateAt(s.now);
    still.still.joints = joints.robax;
    still.still.extax = joints.extax;
    still.still.jointSpeed = {};
    still.still.tcpSpeed = 0;
    still.still.moving = false;
    FrameSetup frames;
    if (s.stretch().move != nullptr) frames = s.stretch().move->plan.path().frames();
    frames.baseFrame = s.model.baseFrame;
    still.still.tcp = frames.tcpInWorld(s.kinematics.forward(joints.robax));
    s.stretches.push_back(std::move(still));
    return true;
}

void MotionSystem::stop() {
    Impl& s = *impl_;
    if (std::exchange(s.isStopRequested, true)) return;
    s.isStopAnnounced = false;
    s.hold();
    if (s.isMoving()) return;
    s.isStopAnnounced = true;
    s.report(MotionEventKind::Stopped, s.queue.empty() ? nullptr : s.queue.front().get(), s.now);
}

void MotionSystem::halt() {
    Impl& s = *impl_;
    stop();
    const bool onPath = s.isOnPath() && s.stretch().move->plan.limits().speed > 0; // not in a pause
    if (!onPath) return;
    s.isStopAnnounced = false;
    s.coastNow();
}

void MotionSystem::start() {
    impl_->isStopRequested = false;
    impl_->isStopAnnounced = true;
    impl_->resume();
}

bool MotionSystem::isStopRequested() const {
    return impl_->isStopRequested;
}

void MotionSystem::setOverride(double percent) {
    Impl& s = *impl_;
    const double wanted = std::isfinite(percent) ? std::clamp(percent, 0.0, 100.0) : 100.0;
    if (wanted == std::exchange(s.override, wanted)) return;
    if (s.isHeld()) return s.hold();
    if (s.isAbandoned) return;
    if (s.isOnPath() && !s.isBraking)
        s.replaceProfile(false);
    else
        s.goOn();
}

double MotionSystem::speedOverride() const {
    return impl_->override;
}

void MotionSystem::advanceTo(TimeNs time) {
    Impl& s = *impl_;
    if (time < s.now) return;
    s.forgetBefore(s.now);
    for (;;) {
        const auto next = s.nextEvent();
        if (!next || *next > time) break;
        s.now = std::max(s.now, *next);
        s.handleEventsNow();
    }
    s.now = time;
}

TimeNs MotionSystem::now() const {
    return impl_->now;
}
std::optional<TimeNs> MotionSystem::nextEventTime() const {
    return impl_->nextEvent();
}
std::vector<MotionEvent> MotionSystem::takeEvents() {
    return std::exchange(impl_->events, {});
}

bool MotionSystem::isIdle() const {
    return impl_->queue.empty();
}
bool MotionSystem::isMoving() const {
    return impl_->isMoving();
}
std::size_t MotionSystem::unfinishedMoves() const {
    return impl_->queue.size();
}

MoveStatus MotionSystem::status(MoveId move) const {
    const Impl& s = *impl_;
    if (move <= 0 || move >= s.nextId) return MoveStatus::Unknown;
    for (const auto& [first, last] : s.cleared) {
        if (move >= first && move <= last) return MoveStatus::Cleared;
    }
    const Move* unfinished = s.findUnfinished(move);
    if (unfinished == nullptr) return MoveStatus::Done;
    return unfinished->isStarted ? MoveStatus::Moving : MoveStatus::Queued;
}

bool MotionSystem::isStarted(MoveId move) const {
    const MoveStatus state = status(move);
    return state == MoveStatus::Moving || state == MoveStatus::Done;
}

bool MotionSystem::isReleased(MoveId move) const {
    if (isDone(move)) return true;
    const Move* unfinished = impl_->findUnfinished(move);
    return unfinished != nullptr && unfinished->isReleased;
}

bool MotionSystem::isDone(MoveId move) const {
    const MoveStatus state = status(move);
    return state == MoveStatus::Done || state == MoveStatus::Cleared;
}

MoveId MotionSystem::lastOrdered() const {
    return impl_->nextId - 1;
}

MoveId MotionSystem::currentMove() const {
    const Impl& s = *impl_;
    return !s.queue.empty() && s.queue.front()->isStarted ? s.queue.front()->id : s.lastDone;
}

std::optional<TimeNs> MotionSystem::reachTime(MoveId move) const {
    const Impl& s = *impl_;
    for (const auto& [id, time] : s.reached) {
        if (id == move) return time;
    }
    const bool isCurrent = !s.queue.empty() && s.queue.front()->id == move && s.queue.front()->isStarted;
    if (!isCurrent || s.isBraking || s.isHalted || s.queue.front()->isReturn) return {};
    return s.stretch().end;
}

MotionState MotionSystem::sample(TimeNs time) const {
    return impl_->stateAt(time);
}
JointTarget MotionSystem::currentJoints() const {
    return impl_->standing();
}
JointTarget MotionSystem::plannedEnd() const {
    return impl_->plannedEnd();
}

RobTarget MotionSystem::currentTarget(const FrameSetup& frames) const {
    FrameSetup based = frames;
    based.baseFrame = impl_->model.baseFrame;
    return calcRobTarget(impl_->kinematics, impl_->standing(), based);
}

RobTarget MotionSystem::toRobTarget(const JointTarget& joints, const FrameSetup& frames) const {
    FrameSetup based = frames;
    based.baseFrame = impl_->model.baseFrame;
    return calcRobTarget(impl_->kinematics, joints, based);
}

Expected<JointTarget, MotionError> MotionSystem::toJointTarget(const RobTarget& target,
                                                               const FrameSetup& frames) const {
    FrameSetup based = frames;
    based.baseFrame = impl_->model.baseFrame;
    return calcJointTarget(impl_->kinematics, target, based, impl_->standing().robax);
}

} // namespace motion

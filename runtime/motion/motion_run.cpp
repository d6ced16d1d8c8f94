// MotionSystem: the move in progress - started, braked on the path or off it, gone on with - and where the arm is.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

namespace {

constexpr double kReturnSpeed = 250; // mm/s, back to an interrupted path

} // namespace

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
    const std::vector<Trigger> passedOn = std::exchange(carried, {});
    move->triggers.insert(move->triggers.end(), passedOn.begin(), passedOn.end());
    begin(move, move->plan.profileAt(override));
    if (!move->isReturn) report(MotionEventKind::Started, move.get(), now);
}

/// Goes on along the path of the current move from the present state: to a stop, or to the end at the present
/// override. False if the motion is already braking for its end and cannot do better than that.
bool MotionSystem::Impl::replaceProfile(bool toStop) {
    const std::shared_ptr<Move> move = queue.front();
    if (!(move->plan.limits().speed > 0)) return false; // a pause has no path
    const bool isRunning = isOnFront();                 // else it has been put aside meanwhile
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
    if (isOnPath() && !isBraking && !isExcursion && stretch().profile.end() > 0) replaceProfile(true);
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
    if (isHeld() || isCoasting || isExcursion) return;
    const bool isUnfinished = !queue.empty() && queue.front()->isStarted;
    if (!isUnfinished) return startNext();
    const bool isInterrupted = isBraking || !isOnFront();
    if (isInterrupted && !isAbandoned) replaceProfile(false);
}

void MotionSystem::Impl::stepBackOnFront(double from, double mm, double mmPerSecond) {
    const std::shared_ptr<Move>& move = queue.front();
    const PlannedMotion& plan = move->plan;
    const double to = plan.parameterAtDistance(plan.distanceAt(from) - mm);
    ProfileLimits limits = plan.limits();
    double mmPerUnit = 0; // of the parameter, at its highest
    constexpr int kSamples = 32;
    for (int i = 0; i <= kSamples; ++i)
        mmPerUnit = std::max(mmPerUnit, plan.sampleAt({to + (from - to) * i / kSamples, 1, 0, 0}).tcpSpeed);
    if (mmPerUnit > 0) limits.speed = std::min(limits.speed, mmPerSecond / mmPerUnit);
    begin(move, Profile::restToRest(0, from - to, limits));
    stretches.back().backFrom = from;
    isExcursion = true;
}

void MotionSystem::Impl::finishExcursion() {
    isExcursion = false;
    const bool isBack = stretch().backFrom >= 0;
    if (!queue.empty() && isBack) {
        queue.front()->pausedAt = stretch().backFrom - stretch().profile.end();
        isBraking = true; // it has not come to its end
    }
    if (!queue.empty() && !isBack) queue.pop_front(); // it has returned to the path
    isStopAnnounced = true;
    report(MotionEventKind::Stopped, queue.empty() ? nullptr : queue.front().get(), now);
    if (!isHeld()) goOn();
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

MotionState MotionSystem::Impl::stateAt(TimeNs time) const {
    const auto after = std::upper_bound(stretches.begin(), stretches.end(), time,
                                        [](TimeNs value, const Stretch& s) { return value < s.start; });
    const Stretch& at = after == stretches.begin() ? stretches.front() : *(after - 1);
    if (at.coast != nullptr) return at.coast->at(toSeconds(time - at.start), kinematics);
    if (at.move == nullptr) return at.still;
    ProfileState along = at.profile.at(toSeconds(time - at.start));
    if (at.backFrom >= 0) along.s = at.backFrom - along.s;
    MotionState state = at.move->plan.sampleAt(along);
    if (at.backFrom >= 0)
        for (double& speed : state.jointSpeed)
            speed = -speed;
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

} // namespace motion

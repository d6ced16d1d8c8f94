// MotionSystem: what the arm does: it follows its path, is held on it, brakes off it, returns to it.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

namespace {

constexpr double kReturnSpeed = 250; // mm/s, back to an interrupted path

} // namespace

std::deque<Span>::const_iterator MotionSystem::Impl::spanAt(TimeNs time) const {
    const auto after = std::upper_bound(spans.begin(), spans.end(), time,
                                        [](TimeNs value, const Span& s) { return value < s.start; });
    return after == spans.begin() ? after : after - 1;
}

bool MotionSystem::Impl::isMoving() const {
    const Span& at = span();
    const double time = seconds();
    if (at.coast != nullptr) return now < at.start + toNs(at.coast->duration());
    if (now < at.ledUntil || (isModified(at) && modifiers.moveAtRest())) return true;
    return at.path != nullptr && at.path->isMoving(time);
}

/// When the arm comes to rest if nothing more is ordered; not before now.
TimeNs MotionSystem::Impl::restTime() const {
    TimeNs rest = now;
    for (auto at = spanAt(now); at != spans.end(); ++at) {
        if (at->coast != nullptr) rest = std::max(rest, at->start + toNs(at->coast->duration()));
        if (at->path != nullptr && !at->path->isEmpty()) rest = std::max(rest, toNs(at->path->restTime()));
        rest = std::max(rest, at->ledUntil);
    }
    if (isModified(span()) && modifiers.moveAtRest()) rest = std::max(rest, now + kModifierPeriod);
    return rest;
}

std::shared_ptr<Trajectory> MotionSystem::Impl::newPath(const JointTarget& start, double earliest) const {
    TrajectoryOptions wanted;
    wanted.planner = options.planner;
    auto path = std::make_shared<Trajectory>(model, options.external, wanted, start, earliest);
    path->setSpeedShare(seconds(), speedShare());
    path->setSpeedLimits(seconds(), speedLimits);
    return path;
}

/// `what` becomes what the arm follows from a time on; until it has moves the arm rests there.
void MotionSystem::Impl::follow(std::shared_ptr<const Trajectory> what, TimeNs from) {
    Span next;
    next.start = from;
    next.still = stillAt(what->endTarget());
    next.path = std::move(what);
    while (!spans.empty() && spans.back().start >= from)
        spans.pop_back();
    spans.push_back(std::move(next));
}

/// The arm is at rest: what is ordered from now on belongs to this path.
void MotionSystem::Impl::beginPath(std::shared_ptr<Trajectory> path) {
    level.finished.clear();
    lastFrames = framesNow();
    level.path = std::move(path);
    modifiers.pathReplaced();
    follow(level.path, now);
}

/// The arm brakes, if it moves, and what is ordered from now on begins where it comes to rest.
void MotionSystem::Impl::abandonPath(StopKind kind) {
    if (!isCoasting && detour == nullptr && !isStepping) path().hold(seconds(), kind);
    if (detour != nullptr) detour->hold(seconds(), kind);
    const TimeNs rest = restTime();
    if (const Pose shift = shiftNow(); !(shift == Pose{})) spans.back().shift = shift;
    const MotionState state = stateAt(rest);
    lastFrames = framesNow();
    modifiers.pathReplaced();
    level.path = newPath({state.joints, state.extax}, toSeconds(rest));
    detour = nullptr;
    isStepping = isHalted = false;
    level.finished.clear();
    level.carried.clear();
    if (isHeld()) path().hold(seconds());
    if (!isCoasting) follow(level.path, rest);
}

/// All moves from this one on. A move that was cleared long ago counts as done.
void MotionSystem::Impl::noteCleared(MoveId first) {
    if (first >= nextId) return;
    cleared.emplace_back(first, nextId - 1);
    if (cleared.size() > 64) cleared.pop_front();
}

/// After the stop flag or the override has changed.
void MotionSystem::Impl::holdOrRelease(StopKind kind) {
    if (isHalted || isStepping) return;
    Trajectory& followed = detour != nullptr ? *detour : path();
    if (isHeld())
        followed.hold(seconds(), kind);
    else
        followed.release(seconds());
}

/// One of the overrides has changed. A path that is put aside runs with the present ones when it continues.
void MotionSystem::Impl::obeyOverride() {
    if (overrideShare() > 0) {
        path().setSpeedShare(seconds(), speedShare());
        if (detour != nullptr) detour->setSpeedShare(seconds(), speedShare());
        for (Level& aside : stored)
            aside.path->setSpeedShare(seconds(), speedShare());
    }
    if (!isCoasting) holdOrRelease();
    noteMotion();
}

/// Brakes off the path, and notes where on the path the arm would have stopped.
void MotionSystem::Impl::coastNow() {
    const MotionState from = stateAt(now);
    if (detour == nullptr) {
        path().hold(seconds());
        path().standAt(seconds(), path().at(path().restTime()).place);
    }
    detour = nullptr;
    Span next;
    next.start = now;
    next.still = from;
    const FrameSetup frames = path().isEmpty() ? based({}) : path().framesAt(path().at(seconds()).place);
    next.coast = std::make_shared<const Coast>(from, model, frames);
    while (!spans.empty() && spans.back().start >= now)
        spans.pop_back();
    spans.push_back(std::move(next));
    isHalted = isCoasting = true;
}

/// After a halt by way of the path, else straight on.
void MotionSystem::Impl::resume() {
    if (isCoasting || isStepping) return; // when it has come to rest
    if (isHalted && startDetour()) return;
    holdOrRelease();
}

/// Back to where the path continues, axis by axis; false when the arm is there already.
bool MotionSystem::Impl::startDetour() {
    isHalted = false;
    if (!level.queue.empty() && !path().isEmpty()) {
        const MotionState goal = pathStateNow();
        MoveCommand back;
        back.joints = {goal.joints, goal.extax};
        back.frames = path().framesAt(path().at(seconds()).place);
        back.speed.vTcp = kReturnSpeed;
        const MotionState here = stateAt(now);
        auto way = MotionPath::make(kinematics, {here.joints, here.extax}, back);
        if (way && !way->isEmpty()) {
            detour = newPath({here.joints, here.extax}, seconds());
            detour->append(std::make_shared<const MotionPath>(std::move(*way)), back, seconds());
            follow(detour, now);
            return true;
        }
    }
    if (span().path != level.path) follow(level.path, now);
    return false;
}

void MotionSystem::Impl::finishDetour() {
    detour = nullptr;
    follow(level.path, now);
    if (isHeld()) {
        isStopAnnounced = isRestAnnounced = true;
        report(MotionEventKind::Stopped, front());
    }
    holdOrRelease();
    noteMotion();
}

/// The place on the path after `mm` back: on the interrupted move, or from its start on the one before.
std::optional<PathPlace> MotionSystem::Impl::placeBack(double mm) const {
    constexpr double kSamePlace = 1e-6;
    if (path().isEmpty()) return {};
    const PathPlace here = path().at(seconds()).place;
    const auto within = [&](const Move& move) -> std::optional<PathPlace> {
        const PathPlace start = startOf(move);
        const PathPlace from = here.run == start.run ? here : endOf(move);
        if (here < start || from.s <= start.s + kSamePlace) return {};
        return PathPlace{start.run, std::max(start.s, from.s - mm)};
    };
    if (front() != nullptr && front()->isStarted)
        if (const auto place = within(*front())) return place;
    return level.finished.empty() ? std::nullopt : within(*level.finished.back());
}

void MotionSystem::Impl::finishStepping() {
    isStepping = false;
    path().finishBack(seconds());
    isStopAnnounced = isRestAnnounced = true;
    report(MotionEventKind::Stopped, front());
    if (!isHeld()) holdOrRelease();
    noteMotion();
}

// ---- States ----

MotionState MotionSystem::Impl::stillAt(const JointTarget& joints) const {
    MotionState state;
    state.joints = joints.robax;
    state.extax = joints.extax;
    for (std::size_t i = 0; i < state.joints.size(); ++i)
        state.axisNumbers[i] = static_cast<uint8_t>(model.axisNumbers[i]);
    const FrameSetup frames = framesNow();
    state.tcp = frames.tcpInWorld(kinematics.forward(joints.robax), joints.extax);
    state.toolHeld = frames.tool.robotHeld;
    state.move = lastDone;
    if (!level.finished.empty()) state.tag = level.finished.back()->tag;
    return state;
}

/// As planned, without speeds.
MotionState MotionSystem::Impl::plannedAt(const Trajectory& trajectory, const Span& span,
                                          const Trajectory::Moment& at, TimeNs time) const {
    const RoutePoint point = trajectory.pointAt(at.place);
    MotionState state = span.still;
    state.joints = point.joints;
    state.extax = point.extax;
    const FrameSetup& frames = trajectory.framesAt(at.place);
    state.tcp = frames.tcpInWorld(kinematics.forward(point.joints), point.extax);
    state.toolHeld = frames.tool.robotHeld;
    state.moving = trajectory.isMoving(toSeconds(time));
    if (const Move* move = &trajectory == level.path.get() ? moveAt(at.place) : nullptr) {
        state.move = move->id;
        state.tag = move->tag;
    }
    return state;
}

MotionState MotionSystem::Impl::stateOn(const Trajectory& trajectory, const Span& span, TimeNs time) const {
    if (trajectory.isEmpty()) return span.still;
    const Trajectory::Moment moment = trajectory.at(toSeconds(time));
    MotionState state = plannedAt(trajectory, span, moment, time);
    if (state.moving && moment.speed != 0) {
        double rate = 0;
        state.jointSpeed = Joints::zeros(state.joints.size());
        trajectory.ratesAt(moment.place, {state.joints, state.extax}, state.jointSpeed, rate);
        for (double& speed : state.jointSpeed)
            speed *= moment.speed;
        state.tcpSpeed = rate * std::abs(moment.speed);
    }
    if (span.shift)
        (void)shiftArm(state, trajectory.framesAt(moment.place), *span.shift * state.tcp);
    else if (isModified(span))
        displace(state, moment, time);
    return state;
}

MotionState MotionSystem::Impl::stateAt(TimeNs time) const {
    const Span& at = *spanAt(time);
    if (at.coast != nullptr) return at.coast->at(toSeconds(time - at.start), kinematics);
    if (at.path != nullptr && !at.path->isEmpty()) return stateOn(*at.path, at, time);
    MotionState still = at.still;
    if (still.moving && time >= at.ledUntil) {
        still.moving = false;
        std::fill(still.jointSpeed.begin(), still.jointSpeed.end(), 0.0);
        still.tcpSpeed = 0;
    }
    return still;
}

/// With the axes that move for themselves; their share in the speed of the TCP is left out.
MotionState MotionSystem::Impl::shown(MotionState state, TimeNs time) const {
    if (independents.empty()) return state;
    const Pose before = based({}).base(state.extax) * kinematics.forward(state.joints);
    for (const auto& [axis, course] : independents) {
        const AxisMoment moment = course.at(toSeconds(time));
        if (axis.isExternal) {
            state.extax[axis.index] = moment.position;
        } else {
            state.joints[axis.index] = moment.position;
            state.jointSpeed[axis.index] = moment.speed;
        }
    }
    if (state.toolHeld)
        state.tcp = based({}).base(state.extax) * kinematics.forward(state.joints) * robot::inverse(before) *
                    state.tcp;
    return state;
}

/// At this moment.
JointTarget MotionSystem::Impl::shown(JointTarget joints) const {
    for (const auto& [axis, course] : independents)
        (axis.isExternal ? joints.extax[axis.index] : joints.robax[axis.index]) =
            course.at(seconds()).position;
    return joints;
}

/// A stop off the path leaves nothing to decide: the arm brakes already.
MotionState MotionSystem::Impl::stateIfStopped(TimeNs time) const {
    const Span& at = *spanAt(time);
    if (at.coast != nullptr) return at.coast->at(at.coast->duration(), kinematics);
    if (time < at.ledUntil) { // each axis brakes for itself
        const Coast braking(at.still, model, framesNow());
        return braking.at(braking.duration(), kinematics);
    }
    if (at.path == nullptr || at.path->isEmpty()) return at.still;
    return stateAtPlace(*at.path, at, at.path->restPlaceIfHeld(toSeconds(time)));
}

/// At rest at a place of the path.
MotionState MotionSystem::Impl::stateAtPlace(const Trajectory& trajectory, const Span& span,
                                             const PathPlace& place) const {
    MotionState state = plannedAt(trajectory, span, {place, 0}, now);
    state.moving = false;
    state.move = span.still.move;
    state.tag = span.still.tag;
    if (span.shift)
        (void)shiftArm(state, trajectory.framesAt(place), *span.shift * state.tcp);
    else if (isModified(span))
        displace(state, {place, 0}, now);
    return state;
}

/// Where the arm is; at a stop point without a further move, the point itself although the last tenths of a mm are still
/// being covered.
JointTarget MotionSystem::Impl::standing() const {
    const bool isArriving = level.queue.empty() && span().path == level.path && path().leadsToEnd();
    if (isArriving && !isModified(span())) return path().endTarget();
    const MotionState state = isArriving ? stateAtPlace(path(), span(), path().end()) : stateAt(now);
    return {state.joints, state.extax};
}

void MotionSystem::Impl::forgetBefore(TimeNs time) {
    while (spans.size() > 1 && spans[1].start <= time)
        spans.pop_front();
    if (modifiers.areActive()) modifiers.forgetBefore(time);
    if (path().isEmpty() || spans.front().path != level.path) return;
    const Move* oldest = level.finished.empty() ? front() : level.finished.front().get();
    if (oldest == nullptr) return;
    if (path().forgetBefore(toSeconds(time), oldest->leg)) forgetNextEvent();
}

} // namespace motion

// MotionSystem: the arm displaced from its planned path by path modifiers, and led from outside.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

namespace {

constexpr int kHalvings = 12; // of a displacement that is out of reach

/// A share of the way from one pose to another.
Pose between(const Pose& from, const Pose& to, double share) {
    return {from.pos + (to.pos - from.pos) * share, robot::slerp(from.rot, to.rot, share)};
}

/// How much of its movement has been executed, 0 to 1.
double shareOfMove(const PlannedMoment& at) {
    if (at.path->isPause(at.run)) return 1;
    const Route& route = at.path->route(at.run);
    const double length = route.leg(route.legAt(at.s)).length();
    return length > 0 ? std::clamp(1 - at.toEnd / length, 0.0, 1.0) : 1;
}

} // namespace

// ---- States ----

PlannedMoment MotionSystem::Impl::momentOf(const MotionState& planned, const Trajectory::Moment& at,
                                           TimeNs time) const {
    PlannedMoment moment;
    moment.time = time;
    moment.path = level.path.get();
    moment.run = at.place.run;
    moment.s = at.place.s;
    moment.speed = planned.moving ? at.speed : 0;
    moment.isMoving = planned.moving;
    moment.isHeld = isHeld();
    moment.tag = planned.tag;
    moment.frames = &path().framesAt(at.place);
    moment.joints = {planned.joints, planned.extax};
    moment.tcp = planned.tcp;
    const RoutePoint point{planned.joints, planned.extax, true};
    const Pose inObject = path().isPause(at.place.run)
                              ? moment.frames->fromFlange(kinematics.forward(planned.joints), planned.extax)
                              : path().route(at.place.run).tcpOf(*moment.frames, point, at.place.s);
    moment.object = planned.tcp * inverse(inObject);
    if (const Move* move = moveAt(at.place)) {
        moment.modifications = &move->modifications;
        const PathPlace end = endOf(*move);
        moment.toEnd = end.run == at.place.run ? std::max(0.0, end.s - at.place.s) : 0;
    }
    return moment;
}

/// Brings the TCP of a planned state to a pose in world, or, when the robot holds the work object, the object so that the
/// stationary tool is there relative to it. As near as the arm comes; the error when that is not there.
std::optional<MotionError> MotionSystem::Impl::shiftArm(MotionState& state, const FrameSetup& frames,
                                                        const Pose& wanted) const {
    const Pose base = frames.base(state.extax);
    const Pose flange = base * kinematics.forward(state.joints);
    const Pose planned = state.tcp;
    const Joints seed = state.joints;
    robot::IkError problem;
    const auto bring = [&](double share) {
        const Pose shift = between(planned, wanted, share) * inverse(planned);
        const Pose goal = inverse(base) * ((state.toolHeld ? shift : inverse(shift)) * flange);
        Joints joints = seed;
        problem = {};
        if (!kinematics.inverseContinue(goal, seed, joints)) return false;
        if (const int joint = kinematics.jointOutsideLimits(joints); joint != 0) {
            problem = kinematics.limitError(joints, joint);
            return false;
        }
        state.joints = joints;
        return true;
    };
    std::optional<MotionError> error;
    if (!bring(1)) {
        error = targetError(problem, wanted.pos);
        double low = 0;
        double high = 1;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (bring(middle) ? low : high) = middle;
        }
    }
    state.tcp = frames.tcpInWorld(kinematics.forward(state.joints), state.extax);
    return error;
}

void MotionSystem::Impl::displace(MotionState& state, const Trajectory::Moment& at, TimeNs time) const {
    const PlannedMoment planned = momentOf(state, at, time);
    const Pose wanted = modifiers.displaced(planned);
    if (wanted == planned.tcp && !modifiers.moveAtRest()) return;
    (void)shiftArm(state, *planned.frames, wanted);
    state.moving = state.moving || modifiers.moveAtRest();
    if (state.moving) measureSpeeds(state, planned, time);
}

/// From the latest place that has been noted before.
void MotionSystem::Impl::measureSpeeds(MotionState& state, const PlannedMoment& planned, TimeNs time) const {
    const ShownArm* before = modifiers.shownBefore(time);
    if (before == nullptr || before->joints.size() != state.joints.size()) return;
    const double seconds = toSeconds(time - before->time);
    for (std::size_t i = 0; i < state.joints.size(); ++i)
        state.jointSpeed[i] = (state.joints[i] - before->joints[i]) / seconds;
    // Another movement may have another object frame.
    if (before->tag != state.tag) return;
    state.tcpSpeed = norm(modifiers.placeInObject(planned, state.tcp) - before->tcpInObject) / seconds;
}

/// The place of the arm on its path now, or the one it would have if it were there.
MotionState MotionSystem::Impl::pathStateNow() const {
    Span span;
    span.start = now;
    span.path = level.path;
    return stateOn(path(), span, now);
}

/// From the planned pose of the TCP to where it is shown, in world.
Pose MotionSystem::Impl::shiftNow() const {
    if (!isModified(span())) return {};
    const Trajectory::Moment at = path().at(seconds());
    const MotionState planned = plannedAt(path(), span(), at, now);
    return modifiers.displaced(momentOf(planned, at, now)) * inverse(planned.tcp);
}

// ---- Time ----

/// When modifiers advance next; nothing when there is nothing to do for them.
std::optional<TimeNs> MotionSystem::Impl::nextAdvance() const {
    if (!isModified(span()) || !(path().isMoving(seconds()) || modifiers.moveAtRest())) return {};
    return (now / kModifierPeriod + 1) * kModifierPeriod;
}

void MotionSystem::Impl::advanceModifiers(TimeNs time) {
    const TimeNs last = time / kModifierPeriod * kModifierPeriod;
    TimeNs next = modifiers.advancedTo() + kModifierPeriod;
    if (next > last) return;
    if (!modifiers.areActive()) return modifiers.setAdvancedTo(last);
    for (next = std::max(next, (now + kModifierPeriod - 1) / kModifierPeriod * kModifierPeriod); next <= last;
         next += kModifierPeriod) {
        const Span& at = *spanAt(next);
        if (!isModified(at)) continue;
        const Trajectory::Moment place = path().at(toSeconds(next));
        MotionState state = plannedAt(path(), at, place, next);
        const PlannedMoment planned = momentOf(state, place, next);
        if (!state.moving && !modifiers.moveAtRest()) continue;
        modifiers.advance(planned);
        const Pose wanted = modifiers.displaced(planned);
        auto error = wanted == planned.tcp ? std::nullopt : shiftArm(state, *planned.frames, wanted);
        if (error && !modifiers.isOutOfReach) {
            error->pathFraction = shareOfMove(planned);
            modifiers.unreported = modifiers.latestError = error;
        }
        modifiers.isOutOfReach = error.has_value();
        modifiers.note({next, state.joints, modifiers.placeInObject(planned, state.tcp), state.tag});
    }
    modifiers.setAdvancedTo(last);
}

void MotionSystem::Impl::reportOutOfReach() {
    if (!std::exchange(modifiers.unreported, std::nullopt)) return;
    report(MotionEventKind::OutOfReach, front());
    if (std::exchange(isStopRequested, true)) return;
    isStopAnnounced = false;
    holdOrRelease();
}

// ---- Orders ----

void MotionSystem::addModifier(std::shared_ptr<PathModifier> modifier) {
    impl_->modifiers.add(std::move(modifier));
}

void MotionSystem::advanceModifiers(TimeNs time) {
    impl_.keepingNextEvent().advanceModifiers(time);
}

const std::optional<MotionError>& MotionSystem::outOfReachError() const {
    return impl_->modifiers.latestError;
}

bool MotionSystem::leadTo(const JointTarget& joints, const JointTarget& speed, TimeNs period) {
    Impl& s = *impl_;
    if (!s.level.queue.empty() || (s.isMoving() && !isLed()) || s.isHalted || s.detour != nullptr)
        return false;
    s.spans.back().ledUntil = 0;
    if (!placeAt(joints)) return false;
    const double step = toSeconds(period);
    JointTarget next = joints;
    bool isMoved = false;
    for (std::size_t i = 0; i < next.robax.size(); ++i) {
        next.robax[i] += speed.robax[i] * step;
        isMoved = isMoved || speed.robax[i] != 0;
    }
    for (std::size_t i = 0; i < next.extax.size(); ++i) {
        if (!isConnected(next.extax[i]) || !isConnected(speed.extax[i])) continue;
        next.extax[i] += speed.extax[i] * step;
        isMoved = isMoved || speed.extax[i] != 0;
    }
    if (!isMoved) return true;
    Span& span = s.spans.back();
    span.ledUntil = s.now + period;
    span.still.moving = true;
    span.still.jointSpeed = speed.robax;
    const Pose there = flangeInWorld(next) * inverse(flangeInWorld(joints)) * span.still.tcp;
    if (span.still.toolHeld) span.still.tcpSpeed = norm(there.pos - span.still.tcp.pos) / step;
    s.isRestAnnounced = false;
    return true;
}

bool MotionSystem::isLed() const {
    return impl_->now < impl_->span().ledUntil;
}

} // namespace motion

// MotionSystem: what happens when: triggers, release of the program, the end of a stretch.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

namespace {

/// Profile parameter at the trigger's place.
double placeOf(const PathTrigger& wanted, const PlannedMotion& plan) {
    const double length = plan.path().length();
    if (wanted.amount <= 0) return wanted.fromStart ? 0 : 1;
    if (wanted.amount >= length) return wanted.fromStart ? 1 : 0;
    return plan.parameterAtDistance(wanted.fromStart ? wanted.amount : length - wanted.amount);
}

} // namespace

/// On the move in progress, or ahead of the one that follows it.
std::optional<TimeNs> MotionSystem::Impl::triggerTime(const Move& move, const Trigger& trigger) const {
    if (trigger.fired || trigger.wanted.nextMove || stretch().move == nullptr) return {};
    return stretch().move.get() == &move ? timeOnPath(trigger.wanted) : timeAheadOf(move, trigger.wanted);
}

std::optional<TimeNs> MotionSystem::Impl::timeOnPath(const PathTrigger& wanted) const {
    const Stretch& current = stretch();
    double seconds = 0;
    if (wanted.inTime && wanted.fromStart) {
        seconds = wanted.amount - current.move->doneSeconds;
    } else if (wanted.inTime) {
        if (isBraking) return {}; // the end of the path is not in sight
        seconds = current.profile.duration() - wanted.amount;
    } else {
        const double place = placeOf(wanted, current.move->plan);
        if (place > current.profile.end() + 1e-12) return {};
        seconds = current.profile.timeAt(place);
    }
    const TimeNs time = current.start + toNs(std::max(0.0, seconds - wanted.lag));
    return isBraking && time > current.end ? std::nullopt : std::optional(time);
}

/// What the lag brings forward into the move in progress; none while that one does not run to its end.
std::optional<TimeNs> MotionSystem::Impl::timeAheadOf(const Move& move, const PathTrigger& wanted) const {
    if (!(wanted.lag > 0) || wanted.inTime || isBraking || isHeld()) return {};
    const double seconds = move.plan.profileAt(override).timeAt(placeOf(wanted, move.plan)) - wanted.lag;
    if (seconds >= 0) return {};
    return std::max(stretch().start, stretch().end - toNs(-seconds));
}

/// The moves whose triggers may fire now: the one in progress and the one that follows it.
std::vector<Move*> MotionSystem::Impl::movesWithTriggers() const {
    std::vector<Move*> moves;
    if (isAbandoned || queue.empty() || queue.front()->isReturn) return moves;
    moves.push_back(queue.front().get());
    if (queue.size() > 1) moves.push_back(queue[1].get());
    return moves;
}

/// Triggers of the move that is over which lie on the one that follows.
void MotionSystem::Impl::passTriggersOn(const Move& move) {
    for (const Trigger& trigger : move.triggers) {
        if (!trigger.wanted.nextMove) continue;
        carried.push_back({trigger.wanted});
        carried.back().wanted.nextMove = false;
        carried.back().wanted.fromStart = true;
    }
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
    if (isCoasting || isExcursion) return std::max(current.end, now);
    if (current.move == nullptr) return {};
    const bool isOver = queue.empty() || queue.front() != current.move;
    if (isOver) return {};
    std::optional<TimeNs> next;
    const auto consider = [&](std::optional<TimeNs> time) {
        if (time && (!next || *time < *next)) next = std::max(*time, now);
    };
    for (const Move* move : movesWithTriggers())
        for (const Trigger& trigger : move->triggers)
            consider(triggerTime(*move, trigger));
    if (!isAbandoned) consider(releaseTime());
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
            if (!trigger.wanted.nextMove && !std::exchange(trigger.fired, true))
                report(MotionEventKind::Trigger, move.get(), now, trigger.wanted.id);
        }
        passTriggersOn(*move);
        report(MotionEventKind::Reached, move.get(), now);
        queue.pop_front();
        lastDone = move->id;
        if (move->plan.limits().speed > 0) finished = move;
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
    if (isExcursion) return finishExcursion();
    const std::shared_ptr<Move> move = queue.front();
    for (Move* with : movesWithTriggers()) {
        for (Trigger& trigger : with->triggers) {
            if (!happensNow(triggerTime(*with, trigger))) continue;
            trigger.fired = true;
            report(MotionEventKind::Trigger, with, now, trigger.wanted.id);
        }
    }
    if (!isAbandoned && happensNow(releaseTime())) {
        move->isReleased = true;
        report(MotionEventKind::Released, move.get(), now);
    }
    if (now >= stretch().end) finishStretch();
}

} // namespace motion

// MotionSystem: what happens when: triggers, release of the program, the end of a stretch.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

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

} // namespace motion

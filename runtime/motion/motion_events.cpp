// MotionSystem: what happens when: starts and ends of moves, triggers, release of the program.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

const Move* MotionSystem::Impl::findUnfinished(MoveId id) const {
    const auto in = [&](const Level& of) -> const Move* {
        const auto found =
            std::find_if(of.queue.begin(), of.queue.end(), [&](const auto& m) { return m->id == id; });
        return found == of.queue.end() ? nullptr : found->get();
    };
    if (const Move* move = in(level)) return move;
    for (const Level& other : stored) {
        if (const Move* move = in(other)) return move;
    }
    return nullptr;
}

/// The move a place of the path belongs to; null when it is long finished or there is none.
const Move* MotionSystem::Impl::moveAt(const PathPlace& place) const {
    const Route& route = path().route(place.run);
    const std::size_t leg = route.legCount() == 0 ? 0 : route.legAt(place.s);
    for (const auto* moves : {&level.finished, &level.queue})
        for (const auto& move : *moves)
            if (move->leg.run == place.run && move->leg.leg == leg && !move->isPoint) return move.get();
    return nullptr;
}

PathPlace MotionSystem::Impl::startOf(const Move& move) const {
    return move.isPoint ? path().legEnd(move.leg) : path().legStart(move.leg);
}

PathPlace MotionSystem::Impl::endOf(const Move& move) const {
    return path().legEnd(move.leg);
}

PathPlace MotionSystem::Impl::placeOf(const Move& move, const PathTrigger& wanted) const {
    if (wanted.amount <= 0) return wanted.fromStart ? startOf(move) : endOf(move);
    const Route& route = path().route(move.leg.run);
    if (move.isPoint || route.legCount() == 0) return endOf(move);
    return {move.leg.run, wanted.fromStart ? route.placeAfterStart(move.leg.leg, wanted.amount)
                                           : route.placeBeforeEnd(move.leg.leg, wanted.amount)};
}

void MotionSystem::Impl::report(MotionEventKind kind, const Move* move, uint32_t trigger) {
    events.push_back({now, kind, move == nullptr ? 0 : move->id, move == nullptr ? 0 : move->tag, trigger});
}

std::optional<double> MotionSystem::Impl::startTime(const Move& move) const {
    if (move.isPoint) return reachTime(move);
    return path().timeAt(startOf(move));
}

bool MotionSystem::Impl::isPassed(const Move& move) const {
    const Route& route = path().route(move.leg.run);
    return route.legCount() > 0 && route.isRounded(move.leg.leg);
}

std::optional<double> MotionSystem::Impl::arrivalTime(const Move& move) const {
    return isPassed(move) ? path().timeAt(endOf(move)) : path().inPositionTime(move.leg.run);
}

std::optional<double> MotionSystem::Impl::reachTime(const Move& move) const {
    return isPassed(move) ? path().timeAt(endOf(move)) : path().stopTime(move.leg.run);
}

std::optional<double> MotionSystem::Impl::releaseTime(const Move& move) const {
    // After a fly-by point the order itself came the lead before its zone (manual 2.3).
    if (move.isConcurrent) return move.leg.leg > 0 ? std::optional(seconds()) : startTime(move);
    if (!move.isFlyBy && move.isAwaited) return reachTime(move);
    if (level.queue.back().get() != &move) return seconds(); // a move that follows is known already
    const auto decision = move.isFlyBy ? path().decisionTime() : path().brakingTime(move.leg.run);
    return decision ? std::optional(*decision - toSeconds(options.programLead)) : reachTime(move);
}

std::optional<double> MotionSystem::Impl::triggerTime(const Move& move, const PathTrigger& wanted) const {
    if (wanted.nextMove) return {};
    std::optional<double> time;
    if (wanted.inTime) {
        time = wanted.fromStart ? startTime(move) : arrivalTime(move);
        if (time) *time += wanted.fromStart ? wanted.amount : -wanted.amount;
        // A trigger timed from the end cannot fire before the move begins.
        if (const auto start = startTime(move); time && start) time = std::max(*time, *start);
    } else {
        time = path().timeAt(placeOf(move, wanted));
    }
    if (time) *time -= wanted.lag;
    return time;
}

/// Whether the next event remains the same until it happens or something is ordered: one that the arm's own path alone decides.
bool MotionSystem::Impl::keepsNextEvent() const {
    return spans.size() == 1 && !isCoasting && !isStepping && detour == nullptr && !modifiers.areActive() &&
           !modifiers.unreported && path().companionCount() == 0;
}

std::optional<TimeNs> MotionSystem::Impl::nextEvent() const {
    if (!keepsNextEvent()) return findNextEvent();
    if (!known.isKnown) known = {true, findNextEvent()};
    return known.time;
}

std::optional<TimeNs> MotionSystem::Impl::findNextEvent() const {
    std::optional<TimeNs> next;
    const auto considerAt = [&](TimeNs time) {
        if (!next || time < *next) next = std::max(time, now);
    };
    const auto consider = [&](std::optional<double> time) {
        if (time) considerAt(toNs(*time));
    };
    if (isCoasting) {
        const Span& at = span();
        return std::max(now, at.start + toNs(at.coast->duration()));
    }
    if (isStepping) return std::max(now, toNs(path().backEnd()));
    if (detour != nullptr) {
        if (!detour->isHeld()) return std::max(now, toNs(detour->restTime()));
        if ((isStopRequested && !isStopAnnounced) || !isRestAnnounced) return restTime();
        return {};
    }
    if ((isStopRequested && !isStopAnnounced) || !isRestAnnounced) considerAt(restTime());
    if (const auto advance = nextAdvance()) considerAt(*advance);
    if (modifiers.unreported) considerAt(now);
    if (level.queue.empty() || isHalted) return next;
    const Move& front = *level.queue.front();
    consider(front.isStarted ? reachTime(front) : startTime(front));
    for (const auto& move : level.queue) {
        if (!move->isReleased) consider(releaseTime(*move));
        for (const Trigger& trigger : move->triggers)
            if (!trigger.fired) consider(triggerTime(*move, trigger.wanted));
    }
    return next;
}

/// Triggers whose time has come; true if there was one.
bool MotionSystem::Impl::fireTriggers() {
    bool fired = false;
    for (const auto& move : level.queue) {
        for (Trigger& trigger : move->triggers) {
            if (trigger.fired || !isDue(triggerTime(*move, trigger.wanted))) continue;
            trigger.fired = fired = true;
            report(MotionEventKind::Trigger, move.get(), trigger.wanted.id);
        }
    }
    return fired;
}

/// The first move has come to its point.
void MotionSystem::Impl::finishFront() {
    const std::shared_ptr<Move> move = level.queue.front();
    if (!std::exchange(move->isReleased, true)) report(MotionEventKind::Released, move.get());
    for (Trigger& trigger : move->triggers) {
        if (trigger.wanted.nextMove) {
            level.carried.push_back({trigger.wanted});
            level.carried.back().wanted.nextMove = false;
            level.carried.back().wanted.fromStart = true;
        } else if (!std::exchange(trigger.fired, true)) {
            // A trigger due later than the point is reached fires with it.
            report(MotionEventKind::Trigger, move.get(), trigger.wanted.id);
        }
    }
    report(MotionEventKind::Reached, move.get());
    level.queue.pop_front();
    lastDone = move->id;
    constexpr std::size_t kKept = 4;
    level.finished.push_back(move);
    if (level.finished.size() > kKept) level.finished.pop_front();
    reached.emplace_back(move->id, now);
    if (reached.size() > 64) reached.pop_front();
}

/// Starts, releases and ends of moves that are due; true if there was one.
bool MotionSystem::Impl::handleMoves() {
    if (level.queue.empty()) return false;
    bool happened = false;
    const std::shared_ptr<Move> front = level.queue.front();
    if (!front->isStarted && isDue(startTime(*front))) {
        front->isStarted = happened = true;
        isRestAnnounced = false;
        const std::vector<Trigger> passedOn = std::exchange(level.carried, {});
        front->triggers.insert(front->triggers.end(), passedOn.begin(), passedOn.end());
        report(MotionEventKind::Started, front.get());
    }
    for (const auto& move : level.queue) {
        if (move->isReleased || !isDue(releaseTime(*move))) continue;
        move->isReleased = happened = true;
        report(MotionEventKind::Released, move.get());
    }
    if (fireTriggers()) happened = true;
    if (front->isStarted && isDue(reachTime(*front))) {
        finishFront();
        happened = true;
    }
    return happened;
}

void MotionSystem::Impl::handleEventsNow() {
    forgetNextEvent();
    reportOutOfReach();
    if (isCoasting) {
        isCoasting = false;
        if (!isHalted) follow(level.path, now); // its moves have been cleared meanwhile
        isRestAnnounced = true;
        report(std::exchange(isStopAnnounced, true) ? MotionEventKind::AtRest : MotionEventKind::Stopped,
               front());
        if (!isHeld()) resume();
        noteMotion();
        return;
    }
    if (isStepping) return finishStepping();
    if (detour != nullptr && !detour->isHeld()) return finishDetour();
    if (detour == nullptr && !isHalted) {
        while (handleMoves()) {
        }
    }
    if (now < restTime()) return;
    const bool isAtRest = !std::exchange(isRestAnnounced, true);
    if (isStopRequested && !std::exchange(isStopAnnounced, true))
        report(MotionEventKind::Stopped, front());
    else if (isAtRest)
        report(MotionEventKind::AtRest, front());
}

} // namespace motion

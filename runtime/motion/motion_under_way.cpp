// MotionSystem: a path under way, from one process to the next (--state).

#include "runtime/motion/follower.h"
#include "runtime/motion/motion_system_impl.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

/// Axes of the arm and outside it agree, so that continuing from there moves nothing first.
bool isSamePosture(const RoutePoint& point, const JointTarget& there) {
    constexpr double kSame = 1e-3; // deg, mm
    if (point.joints.size() != there.robax.size()) return false;
    for (std::size_t i = 0; i < point.joints.size(); ++i)
        if (!(std::fabs(point.joints[i] - there.robax[i]) < kSame)) return false;
    for (std::size_t i = 0; i < there.extax.size(); ++i)
        if (isConnected(there.extax[i]) && !(std::fabs(point.extax[i] - there.extax[i]) < kSame))
            return false;
    return true;
}

/// On a route, between the beginning and the end of the zone after a leg.
bool isInZone(const Route& route, std::size_t leg, double place) {
    return route.isRounded(leg) && place > route.zoneEntry(leg) && place < route.zoneExit(leg);
}

/// The same for any of the robots that move together with the leader.
bool isAnyInZone(const Trajectory& leader, const PathPlace& place, std::size_t leg) {
    const Route& route = leader.route(place.run);
    if (isInZone(route, leg, place.s)) return true;
    for (std::size_t i = 0; i < leader.companionCount(); ++i) {
        const Companions& others = leader.companionsOf(place.run);
        if (isInZone(others.route(i), leg, others.placeOf(i, route, place.s).place)) return true;
    }
    return false;
}

} // namespace

std::optional<MotionSystem::PlaceUnderWay> MotionSystem::placeUnderWay() const {
    const Impl& s = *impl_;
    if (s.isCoasting || s.isStepping || s.level.queue.empty() || s.path().isEmpty()) return {};
    const bool isOnPath =
        s.isHalted || s.detour != nullptr // it may have been brought back already
            ? isSamePosture(s.path().pointAt(s.path().at(s.seconds()).place), currentJoints())
            : s.span().path == s.level.path;
    if (!isOnPath) return {};
    const auto* follower = dynamic_cast<const Follower*>(&s.path());
    const Trajectory& leader = follower != nullptr ? *follower->leader() : s.path();
    const PathPlace place = leader.at(s.seconds()).place;
    if (s.path().isPause(place.run)) return {};
    const Route& route = leader.route(place.run);
    const Route& own = s.path().route(place.run);
    const auto isLegOf = [&](const Move& move, std::size_t leg) {
        return move.leg.run == place.run && !move.isPoint && move.leg.leg == leg && leg >= route.firstLeg();
    };
    for (const auto* moves : {&s.level.finished, &s.level.queue}) {
        for (const auto& move : *moves) {
            const std::size_t leg = move->leg.leg;
            if (!isLegOf(*move, leg) || !isAnyInZone(leader, place, leg)) continue;
            return PlaceUnderWay{move->id, true, own.leg(leg).path->start(), place.s - route.zoneEntry(leg)};
        }
    }
    const std::size_t leg = route.legAt(place.s);
    const Move& front = *s.level.queue.front();
    if (!isLegOf(front, leg)) return {};
    const double covered = place.s - route.leg(leg).pathBegin();
    if (!(covered > 0)) return {};
    return PlaceUnderWay{front.id, false, own.leg(leg).path->start(), covered};
}

std::optional<MotionSystem::OrderedUnderWay> MotionSystem::enqueueUnderWay(const JointTarget& from,
                                                                           double covered,
                                                                           const MoveCommand* before,
                                                                           const MoveCommand& command) {
    Impl& s = *impl_;
    const JointTarget here = currentJoints();
    if (!s.isResting() || from.robax.size() != here.robax.size()) return {};
    const std::shared_ptr<Trajectory> replaced = std::exchange(s.level.path, s.newPath(from, s.seconds()));
    Trajectory& path = s.path();
    std::vector<std::pair<MoveCommand, Trajectory::Appended>> appended;
    OrderedUnderWay result;
    for (const MoveCommand* one : {before, &command}) {
        if (one == nullptr) continue;
        result.start = path.endTarget();
        const auto ordered = s.prepared(*one);
        if (!ordered) break;
        appended.emplace_back(ordered->command, path.append(ordered->path, ordered->command, s.seconds()));
    }
    const std::size_t wanted = before != nullptr ? 2 : 1;
    const auto place = appended.size() == wanted ? s.placeAfter(covered, wanted) : std::nullopt;
    if (!place || !isSamePosture(path.pointAt(*place), here)) {
        s.level.path = replaced;
        return {};
    }
    path.hold(s.seconds());
    path.standAt(s.seconds(), *place);
    s.beginUnderWay(appended, result);
    // As after every order to an arm at rest: movements that the program orders until then are known in time.
    if (!s.isHeld()) path.release(s.seconds() + TrajectoryOptions().startDelay);
    s.noteMotion();
    return result;
}

/// The moves have been ordered, and the arm is at its place on them.
void MotionSystem::Impl::beginUnderWay(
    const std::vector<std::pair<MoveCommand, Trajectory::Appended>>& appended, OrderedUnderWay& ordered) {
    level.finished.clear();
    for (const auto& [made, at] : appended) {
        ordered.before = ordered.move;
        ordered.move = registerMove(made, at);
    }
    const std::shared_ptr<Move> first = level.queue.front();
    first->isStarted = true;
    if (appended.size() > 1) {
        first->isReleased = true;
        if (path().at(seconds()).place >= endOf(*first)) finishFront();
    }
    modifiers.pathReplaced();
    follow(level.path, now);
}

std::optional<std::vector<MotionSystem::OrderedUnderWay>>
MotionSystem::enqueueTogetherUnderWay(const std::vector<MotionSystem*>& systems,
                                      const std::vector<UnderWay>& orders, double covered) {
    const auto isReady = [](const MotionSystem* system) { return system->impl_->isResting(); };
    if (!std::all_of(systems.begin(), systems.end(), isReady)) return {};
    Impl& first = *systems.front()->impl_;
    const double now = first.seconds();
    std::vector<Impl::PathStart> starts;
    std::vector<JointTarget> here;
    for (std::size_t i = 0; i < systems.size(); ++i) {
        starts.push_back({orders[i].from, systems[i]->impl_->based(orders[i].command.frames)});
        here.push_back(systems[i]->currentJoints());
    }
    auto replaced = Impl::pathsTogether(systems, starts);
    for (std::size_t i = 0; i < systems.size(); ++i)
        std::swap(systems[i]->impl_->level.path, replaced[i]);
    Trajectory& leader = first.path();
    std::vector<OrderedUnderWay> results(systems.size());
    std::vector<std::vector<std::pair<MoveCommand, Trajectory::Appended>>> appended(systems.size());
    const std::size_t wanted = orders.front().before ? 2 : 1;
    for (std::size_t k = 0; k < wanted; ++k) {
        std::vector<MoveCommand> commands;
        for (std::size_t i = 0; i < systems.size(); ++i) {
            commands.push_back(k + 1 < wanted ? *orders[i].before : orders[i].command);
            results[i].start = systems[i]->impl_->path().endTarget();
        }
        const auto moves = Impl::preparedTogether(systems, commands);
        if (!moves) break;
        const Trajectory::Appended at = leader.appendTogether(*moves, now);
        for (std::size_t i = 0; i < systems.size(); ++i)
            appended[i].emplace_back((*moves)[i].command, at);
    }
    if (!Impl::standTogether(systems, here, appended.front().size() == wanted ? wanted : 0, covered)) {
        for (std::size_t i = 0; i < systems.size(); ++i)
            systems[i]->impl_->level.path = replaced[i];
        return {};
    }
    bool isHeld = false;
    for (std::size_t i = 0; i < systems.size(); ++i) {
        Impl& s = *systems[i]->impl_;
        s.beginUnderWay(appended[i], results[i]);
        isHeld = isHeld || s.isHeld();
    }
    if (!isHeld) leader.release(now + TrajectoryOptions().startDelay);
    for (MotionSystem* system : systems)
        system->impl_->noteMotion();
    return results;
}

/// Puts robots that have ordered this many movements at their place on the path of the leader; false when it is not on it, or
/// some arm is elsewhere.
bool MotionSystem::Impl::standTogether(const std::vector<MotionSystem*>& systems,
                                       const std::vector<JointTarget>& here, std::size_t moves,
                                       double covered) {
    Impl& first = *systems.front()->impl_;
    Trajectory& leader = first.path();
    if (moves == 0 || leader.lastRun() != leader.firstRun()) return false;
    const std::size_t run = leader.firstRun();
    if (leader.isPause(run) || leader.route(run).legCount() != moves) return false;
    const double place = moves == 1 ? covered : leader.route(run).zoneEntry(0) + covered;
    if (!(place > 0 && place < leader.route(run).length())) return false;
    leader.hold(first.seconds());
    leader.standAt(first.seconds(), {run, place});
    for (std::size_t i = 0; i < systems.size(); ++i) {
        const Trajectory& path = systems[i]->impl_->path();
        if (!isSamePosture(path.pointAt(path.at(first.seconds()).place), here[i])) return false;
    }
    return true;
}

/// The place on a path of one move, or in the corner of two; empty when it would lie outside the move or the corner.
std::optional<PathPlace> MotionSystem::Impl::placeAfter(double covered, std::size_t moves) const {
    const std::size_t run = path().firstRun();
    if (path().lastRun() != run || path().isPause(run) || !(covered > 0)) return {};
    const Route& route = path().route(run);
    if (route.legCount() != moves) return {};
    if (moves == 1) return covered < route.length() ? std::optional(PathPlace{run, covered}) : std::nullopt;
    const double place = route.zoneEntry(0) + covered;
    if (!route.isRounded(0) || !(place < route.zoneExit(0))) return {};
    return PathPlace{run, place};
}

} // namespace motion

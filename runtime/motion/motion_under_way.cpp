// MotionSystem: a path under way, from one process to the next (--state).

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

} // namespace

std::optional<MotionSystem::PlaceUnderWay> MotionSystem::placeUnderWay() const {
    const Impl& s = *impl_;
    const bool isOnPath = !s.isHalted && !s.isCoasting && !s.isStepping && s.detour == nullptr;
    if (!isOnPath || s.level.queue.empty() || s.path().isEmpty() || s.span().path != s.level.path) return {};
    const PathPlace place = s.path().at(s.seconds()).place;
    if (s.path().isPause(place.run)) return {};
    const Route& route = s.path().route(place.run);
    const auto isLegOf = [&](const Move& move, std::size_t leg) {
        return move.leg.run == place.run && !move.isPoint && move.leg.leg == leg && leg >= route.firstLeg();
    };
    for (const auto* moves : {&s.level.finished, &s.level.queue}) {
        for (const auto& move : *moves) {
            const std::size_t leg = move->leg.leg;
            if (!isLegOf(*move, leg) || !route.isRounded(leg)) continue;
            const double covered = place.s - route.zoneEntry(leg);
            if (covered > 0 && place.s < route.zoneExit(leg))
                return PlaceUnderWay{move->id, true, route.leg(leg).path->start(), covered};
        }
    }
    const std::size_t leg = route.legAt(place.s);
    const Move& front = *s.level.queue.front();
    if (!isLegOf(front, leg)) return {};
    const double covered = place.s - route.leg(leg).pathBegin();
    if (!(covered > 0)) return {};
    return PlaceUnderWay{front.id, false, route.leg(leg).path->start(), covered};
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
    s.level.finished.clear();
    path.hold(s.seconds());
    path.standAt(s.seconds(), *place);
    for (const auto& [made, at] : appended) {
        result.before = result.move;
        result.move = s.registerMove(made, at);
    }
    const std::shared_ptr<Move> first = s.level.queue.front();
    first->isStarted = true;
    if (before != nullptr) first->isReleased = true;
    if (before != nullptr && *place >= s.endOf(*first)) s.finishFront();
    s.modifiers.pathReplaced();
    s.follow(s.level.path, s.now);
    // As after every order to an arm at rest: movements that the program orders until then are known in time.
    if (!s.isHeld()) path.release(s.seconds() + TrajectoryOptions().startDelay);
    s.noteMotion();
    return result;
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

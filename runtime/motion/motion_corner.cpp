// MotionSystem: a corner that the arm is inside of, from one process to the next (--state).

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

std::optional<MotionSystem::CornerPlace> MotionSystem::cornerPlace() const {
    const Impl& s = *impl_;
    const bool isOnPath = !s.isHalted && !s.isCoasting && !s.isStepping && s.detour == nullptr;
    if (!isOnPath || s.level.queue.empty() || s.path().isEmpty() || s.span().path != s.level.path) return {};
    const PathPlace place = s.path().at(s.seconds()).place;
    if (s.path().isPause(place.run)) return {};
    const Route& route = s.path().route(place.run);
    for (const auto* moves : {&s.level.finished, &s.level.queue}) {
        for (const auto& move : *moves) {
            const std::size_t leg = move->leg.leg;
            if (move->leg.run != place.run || move->isPoint || leg < route.firstLeg() ||
                !route.isRounded(leg))
                continue;
            const double covered = place.s - route.zoneEntry(leg);
            if (covered > 0 && place.s < route.zoneExit(leg))
                return CornerPlace{move->id, route.leg(leg).path->start(), covered};
        }
    }
    return {};
}

std::optional<MotionSystem::OrderedInCorner> MotionSystem::enqueueInCorner(const JointTarget& from,
                                                                           double covered,
                                                                           const MoveCommand& before,
                                                                           const MoveCommand& after) {
    Impl& s = *impl_;
    const JointTarget here = currentJoints();
    if (!s.isResting() || from.robax.size() != here.robax.size()) return {};
    const std::shared_ptr<Trajectory> replaced = std::exchange(s.level.path, s.newPath(from, s.seconds()));
    Trajectory& path = s.path();
    std::vector<std::pair<MoveCommand, Trajectory::Appended>> appended;
    JointTarget point;
    for (const MoveCommand* command : {&before, &after}) {
        point = path.endTarget();
        const auto ordered = s.prepared(*command);
        if (!ordered) break;
        appended.emplace_back(ordered->command, path.append(ordered->path, ordered->command, s.seconds()));
    }
    const auto place = s.placeInCorner(covered, appended.size());
    if (!place || !isSamePosture(path.pointAt(*place), here)) {
        s.level.path = replaced;
        return {};
    }
    s.level.finished.clear();
    path.hold(s.seconds());
    path.standAt(s.seconds(), *place);
    OrderedInCorner result{s.registerMove(appended[0].first, appended[0].second), 0, point};
    const std::shared_ptr<Move> first = s.level.queue.front();
    result.after = s.registerMove(appended[1].first, appended[1].second);
    first->isStarted = first->isReleased = true;
    if (*place >= s.endOf(*first)) s.finishFront();
    s.modifiers.pathReplaced();
    s.follow(s.level.path, s.now);
    s.holdOrRelease();
    s.noteMotion();
    return result;
}

/// On the path of two moves that form a corner; nothing when they do not, or the place lies outside.
std::optional<PathPlace> MotionSystem::Impl::placeInCorner(double covered, std::size_t moves) const {
    if (moves < 2 || path().lastRun() != path().firstRun() || path().isPause(path().firstRun())) return {};
    const Route& route = path().route(path().firstRun());
    if (route.legCount() != 2 || !route.isRounded(0)) return {};
    const double place = route.zoneEntry(0) + covered;
    if (!(covered > 0) || !(place < route.zoneExit(0))) return {};
    return PathPlace{path().firstRun(), place};
}

} // namespace motion

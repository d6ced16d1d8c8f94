#include "runtime/motion/path_modifiers.h"

#include "runtime/motion/path_frame.h"
#include "runtime/motion/tolerances.h"
#include "runtime/motion/trajectory.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

/// The mean direction of the path relative to the work object around a place, up to `reach` before and after it, in the object
/// frame; zero where the TCP hardly moves.
Vec3 tangentAt(const PlannedMoment& at, double reach) {
    const Trajectory& path = *at.path;
    if (path.isPause(at.run)) return {};
    constexpr double kStep = 0.01; // mm
    const Route& way = path.route(at.run);
    const double place = std::min(at.s, way.length());
    // As far to both sides, so that on arcs the direction is that of the tangent.
    const double step = std::max(kStep, std::min({reach, place, way.length() - place}));
    const double low = std::max(0.0, place - step);
    const double high = std::min(way.length(), low + 2 * step);
    if (!(high - low > kNothing)) return {};
    const Vec3 from = way.tcpOf(*at.frames, way.at(low), low).pos;
    const Vec3 to = way.tcpOf(*at.frames, way.at(high), high).pos;
    const Vec3 tangent = (to - from) * (1 / (high - low));
    constexpr double kHardly = 0.01; // mm of TCP path a mm of route
    const double length = norm(tangent);
    return length < kHardly ? Vec3{} : tangent * (1 / length);
}

/// The rotation whose columns are x, y, z.
Quat fromAxes(const Vec3& x, const Vec3& y, const Vec3& z) {
    const double trace = x.x + y.y + z.z;
    if (trace > 0) return normalized(Quat{1 + trace, y.z - z.y, z.x - x.z, x.y - y.x});
    if (x.x >= y.y && x.x >= z.z)
        return normalized(Quat{y.z - z.y, 1 + x.x - y.y - z.z, y.x + x.y, z.x + x.z});
    if (y.y >= z.z) return normalized(Quat{z.x - x.z, y.x + x.y, 1 + y.y - x.x - z.z, z.y + y.z});
    return normalized(Quat{x.y - y.x, z.x + x.z, z.y + y.z, 1 + z.z - x.x - y.y});
}

} // namespace

Quat meanPathFrame(const PlannedMoment& at, double reach) {
    const Pose& tcp = at.tcp;
    const Vec3 toolX = rotate(tcp.rot, {1, 0, 0});
    Vec3 x = rotate(at.object.rot, tangentAt(at, reach));
    if (norm(x) < kNothing) x = toolX;
    Vec3 y = cross(rotate(tcp.rot, {0, 0, 1}), x);
    constexpr double kParallel = 1e-3; // the tool points along the path: its y axis takes the place
    if (norm(y) < kParallel) y = cross(cross(x, rotate(tcp.rot, {0, 1, 0})), x);
    y = y * (1 / norm(y));
    return fromAxes(x, y, cross(x, y));
}

Quat PlannedMoment::pathFrame() const {
    return meanPathFrame(*this, 0);
}

double PlannedMoment::distanceFrom(std::size_t otherRun, double otherS) const {
    const auto lengthOf = [this](std::size_t number) {
        return path->isPause(number) ? 0.0 : path->route(number).length();
    };
    double distance = s - otherS;
    for (std::size_t i = otherRun; i < run; ++i)
        distance += i < path->firstRun() ? otherS : lengthOf(i);
    for (std::size_t i = run; i < otherRun; ++i)
        distance -= lengthOf(i);
    return distance;
}

bool PathModifiers::areActive() const {
    return std::any_of(modifiers_.begin(), modifiers_.end(), [](const auto& m) { return m->isActive(); });
}

bool PathModifiers::moveAtRest() const {
    return std::any_of(modifiers_.begin(), modifiers_.end(),
                       [](const auto& m) { return m->isActive() && m->movesAtRest(); });
}

void PathModifiers::advance(const PlannedMoment& planned) {
    for (const auto& modifier : modifiers_)
        if (modifier->isActive()) modifier->advance(planned);
}

Vec3 PathModifiers::placeInObject(const PlannedMoment& planned, const Pose& tcp) const {
    Pose object = planned.object;
    for (const auto& modifier : modifiers_)
        if (modifier->isActive()) object = modifier->objectShift(planned) * object;
    return (robot::inverse(object) * tcp).pos;
}

Pose PathModifiers::displaced(const PlannedMoment& planned) const {
    Pose tcp = planned.tcp;
    for (const auto& modifier : modifiers_)
        if (modifier->isActive()) tcp = modifier->displaced(planned, tcp);
    return tcp;
}

void PathModifiers::pathReplaced() {
    for (const auto& modifier : modifiers_)
        modifier->pathReplaced();
    isOutOfReach = false;
}

void PathModifiers::pathStored() {
    for (const auto& modifier : modifiers_)
        modifier->pathStored();
}

void PathModifiers::pathRestored() {
    for (const auto& modifier : modifiers_)
        modifier->pathRestored();
}

void PathModifiers::storedPathsCleared() {
    for (const auto& modifier : modifiers_)
        modifier->storedPathsCleared();
}

void PathModifiers::forgetBefore(TimeNs time) {
    for (const auto& modifier : modifiers_)
        modifier->forgetBefore(time);
    while (shown_.size() > 1 && shown_[1].time < time)
        shown_.pop_front();
}

const ShownArm* PathModifiers::shownBefore(TimeNs time) const {
    for (auto at = shown_.rbegin(); at != shown_.rend(); ++at)
        if (at->time < time) return time - at->time <= 2 * kModifierPeriod ? &*at : nullptr;
    return nullptr;
}

} // namespace motion

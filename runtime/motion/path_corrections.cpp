#include "runtime/motion/path_corrections.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace motion {

namespace {

constexpr double kMostSpeed = 100;         // mm/s across the path
constexpr double kMostAcceleration = 2000; // mm/s^2
constexpr double kFullPace = 10; // mm/s along the path; slower ones slow down what happens across it

/// How long a change by this vector may take, s; one that has a speed of its own needs time to lose it.
double blendTime(const Vec3& change, const Vec3& rate) {
    const double mm = norm(change);
    // Peaks of a fifth-degree polynomial from rest to rest: 1.875 of the mean speed, 5.78 of way by time squared.
    return std::max({1.875 * mm / kMostSpeed, std::sqrt(5.78 * mm / kMostAcceleration),
                     2 * norm(rate) / kMostAcceleration});
}

} // namespace

PathCorrections::PathCorrections() : modification_(std::make_shared<const Corrected>(this)) {}

void PathCorrections::setOffset(const Vec3& offset) {
    if (offset == offset_) return;
    offset_ = offset;
    hasJumped_ = true;
}

void PathCorrections::setOffsetAhead(const Vec3& offset, double mm) {
    if (!isActive()) forgetPlace();
    constexpr std::size_t kMost = 4096; // newer ones take the place of the last
    if (ahead_.size() >= kMost) ahead_.pop_back();
    ahead_.push_back({way_ + mm, offset});
}

/// Corrections whose place the TCP has reached are in force.
void PathCorrections::takeAhead() {
    for (; !ahead_.empty() && ahead_.front().at <= way_; ahead_.pop_front())
        setOffset(ahead_.front().offset);
}

bool PathCorrections::isActive() const {
    return !ahead_.empty() || !(offset_ == Vec3{}) || !shown_.isNone();
}

bool PathCorrections::concerns(const PlannedMoment& planned) const {
    if (planned.modifications == nullptr) return false;
    return std::find(planned.modifications->begin(), planned.modifications->end(), modification_) !=
           planned.modifications->end();
}

void PathCorrections::advance(const PlannedMoment& planned) {
    const Step step = stepTo(planned);
    way_ += step.way;
    takeAhead();
    const bool isCorrected = concerns(planned);
    if (std::exchange(wasCorrected_, isCorrected) != isCorrected) hasJumped_ = true;
    if (step.isOtherRun) hasJumped_ = true;
    const Vec3 target = isCorrected ? rotate(planned.pathFrame(), offset_) : Vec3{};
    // A corner without room, or a way along the tool: such a path has no sides, and those that it is given may turn at once.
    constexpr double kSharpTurn = 0.5; // of the displacement, in one period
    if (norm(target - std::exchange(target_, target)) > kSharpTurn * norm(target)) hasJumped_ = true;
    if (std::exchange(hasJumped_, false))
        return shown_.jumpTo(planned.time, target, blendTime(shown_.now() - target, shown_.rate()));
    const double pace = planned.isMoving ? std::min(1.0, std::fabs(planned.speed) / kFullPace) : 0;
    shown_.advance(planned.time, target, kModifierSeconds * pace);
}

void PathCorrections::otherPath(bool isNew) {
    if (isNew) ahead_.clear();
    hasJumped_ = true;
}

} // namespace motion

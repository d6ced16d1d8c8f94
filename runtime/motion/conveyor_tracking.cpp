#include "runtime/motion/conveyor_tracking.h"

#include "runtime/robot/frames.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kCaught = 0.005;     // mm or deg: from here on the arm keeps to the object exactly
constexpr double kBrakingShare = 0.8; // of the acceleration, to have some left for the discrete steps
constexpr double kStill = 1e-9;

double seconds(TimeNs span) {
    return 1e-9 * static_cast<double>(span);
}

} // namespace

void ConveyorTracking::setOrdered(std::shared_ptr<const OnConveyor> ordered) {
    ordered_ = std::move(ordered);
    isBeginning_ = false;
}

const ConveyorTracking::Sample* ConveyorTracking::sampleAt(TimeNs time) const {
    const auto after = std::upper_bound(samples_.begin(), samples_.end(), time,
                                        [](TimeNs value, const Sample& s) { return value < s.time; });
    return after == samples_.begin() ? nullptr : &*(after - 1);
}

double ConveyorTracking::displacementAt(const Sample& sample, TimeNs time) {
    if (sample.isCaught) return sample.on->object->position(time) - sample.on->planned;
    const double t = std::clamp(seconds(time - sample.time), 0.0, kModifierSeconds);
    return sample.d + t * (sample.v + t * sample.a / 2);
}

double ConveyorTracking::speedAt(const Sample& sample, TimeNs time) {
    if (sample.isCaught) return sample.on->object->speed(time);
    return sample.v + sample.a * std::clamp(seconds(time - sample.time), 0.0, kModifierSeconds);
}

bool ConveyorTracking::isDisplaced() const {
    if (samples_.empty()) return false;
    const Sample& last = samples_.back();
    return last.isCaught || std::fabs(last.d) > kStill || std::fabs(last.v) > kStill || last.a != 0;
}

void ConveyorTracking::beginFromHere() {
    isBeginning_ = true;
    if (samples_.empty()) return;
    Sample next = samples_.back();
    next.time = now_();
    next.v = speedAt(samples_.back(), next.time);
    next.d = next.a = 0;
    next.isCaught = next.follows = false;
    ordered_ = nullptr;
    samples_.push_back(std::move(next));
}

void ConveyorTracking::advance(const PlannedMoment& planned) {
    isPathMoving_ = planned.isMoving;
    const auto* on = planned.find<OnConveyor>();
    if (on == nullptr && !isDisplaced()) return;
    Sample next;
    if (!samples_.empty()) {
        const Sample& last = samples_.back();
        next.on = last.on;
        next.isCaught = last.isCaught;
        next.d = displacementAt(last, planned.time);
        next.v = speedAt(last, planned.time);
    }
    next.time = planned.time;
    next.follows = on != nullptr;
    if (on != nullptr &&
        (next.on == nullptr || next.on->object != on->object || next.on->planned != on->planned))
        next.on = std::make_shared<const OnConveyor>(*on);
    if (on == nullptr)
        returnToPath(next);
    else if (on->object->isConnected() && !planned.isHeld)
        follow(next, *on);
    else
        stopMoving(next);
    while (!samples_.empty() && samples_.back().time >= next.time)
        samples_.pop_back();
    samples_.push_back(std::move(next));
}

/// One period towards a place that is `error` away and moves with `reference`.
void ConveyorTracking::approach(Sample& next, double error, double reference, double mostSpeed) {
    const double acceleration = next.on->object->adjustmentAcceleration();
    const double fastest = std::min(std::sqrt(2 * kBrakingShare * acceleration * std::fabs(error)),
                                    0.5 * std::fabs(error) / kModifierSeconds);
    const double wanted = std::clamp(reference + std::copysign(fastest, error), -mostSpeed, mostSpeed);
    next.a = std::clamp((wanted - next.v) / kModifierSeconds, -acceleration, acceleration);
}

void ConveyorTracking::follow(Sample& next, const OnConveyor& on) const {
    if (next.isCaught) return;
    const double reference = on.object->speed(next.time);
    const double error = on.object->position(next.time) - on.planned - next.d;
    const double step = on.object->adjustmentAcceleration() * kModifierSeconds;
    if (std::fabs(error) <= kCaught && std::fabs(next.v - reference) <= step) {
        next.isCaught = true;
        next.a = 0;
        return;
    }
    approach(next, error, reference, on.object->adjustmentSpeed());
}

/// The movement does not belong to an object: the speed along the conveyor ends, and the arm is on its planned path again.
void ConveyorTracking::returnToPath(Sample& next) const {
    next.isCaught = false;
    const double step = next.on->object->adjustmentAcceleration() * kModifierSeconds;
    if (std::fabs(next.d) <= kCaught && std::fabs(next.v) <= step) {
        next.d = next.v = next.a = 0;
        return;
    }
    approach(next, -next.d, 0, next.on->object->adjustmentSpeed());
}

/// The object was dropped, or the robot is stopped: it stays where it is.
void ConveyorTracking::stopMoving(Sample& next) {
    next.isCaught = false;
    const double acceleration = next.on->object->adjustmentAcceleration();
    next.a = std::clamp(-next.v / kModifierSeconds, -acceleration, acceleration);
}

Pose ConveyorTracking::displaced(const PlannedMoment& planned, const Pose& tcp) const {
    const Sample* sample = sampleAt(planned.time);
    if (sample == nullptr || sample->on == nullptr) return tcp;
    const double d = displacementAt(*sample, planned.time);
    if (d == 0) return tcp;
    const TrackedObject& object = *sample->on->object;
    const double from = sample->on->planned;
    return object.frame(from + d) * robot::inverse(object.frame(from)) * tcp;
}

Pose ConveyorTracking::objectShift(const PlannedMoment& planned) const {
    const auto* on = planned.find<OnConveyor>();
    if (on == nullptr || !on->object->isConnected()) return {};
    const TrackedObject& object = *on->object;
    return object.frame(object.position(planned.time)) * robot::inverse(object.frame(on->planned));
}

bool ConveyorTracking::movesAtRest() const {
    if (samples_.empty() || isBeginning_) return false;
    const Sample& last = samples_.back();
    if (std::fabs(speedAt(last, now_())) > kStill || last.a != 0) return true;
    const bool mayFollow = last.on->object->isConnected() && !isHeld_();
    if (last.isCaught) return !mayFollow; // the next sample is no longer caught
    return last.follows ? mayFollow : std::fabs(last.d) > kStill;
}

void ConveyorTracking::pathReplaced() {
    if (isBeginning_) return; // by the path that begins where the arm is
    samples_.clear();
    ordered_ = nullptr;
}

void ConveyorTracking::pathStored() {
    stored_.push_back({samples_.empty() ? Sample{} : samples_.back(), ordered_});
    pathReplaced();
}

void ConveyorTracking::pathRestored() {
    samples_.clear();
    if (stored_.empty()) return;
    Stored kept = std::move(stored_.back());
    stored_.pop_back();
    ordered_ = std::move(kept.ordered);
    if (kept.sample.on == nullptr) return;
    kept.sample.d = displacementAt(kept.sample, kept.sample.time);
    kept.sample.v = kept.sample.a = 0;
    kept.sample.isCaught = false;
    kept.sample.follows = true;
    kept.sample.time = now_();
    samples_.push_back(std::move(kept.sample));
}

void ConveyorTracking::forgetBefore(TimeNs time) {
    while (samples_.size() > 1 && samples_[1].time <= time)
        samples_.pop_front();
}

} // namespace motion

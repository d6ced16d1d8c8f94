#include "runtime/motion/soft_servo.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace motion {

namespace {

constexpr double kDeflection = 0.1; // deg or mm a percent, under the greatest torque
constexpr std::size_t kWindow =
    25; // periods: torques act averaged over this time, as a mass on a spring gives way

} // namespace

double SoftServo::Ramp::at(TimeNs time) const {
    const double x =
        seconds > 0 ? std::clamp(1e-9 * static_cast<double>(time - begin) / seconds, 0.0, 1.0) : 1;
    return from + (to - from) * x * x * (3 - 2 * x);
}

bool SoftServo::Ramp::isOver(TimeNs time) const {
    return 1e-9 * static_cast<double>(time - begin) >= seconds;
}

SoftServo::SoftServo(const robot::Kinematics& kinematics, const robot::AccelerationMap& accelerations)
    : kinematics_(kinematics), accelerations_(accelerations) {}

void SoftServo::setCompliance(TimeNs now, std::size_t axis, double percent, double seconds) {
    Ramp& ramp = ramps_[axis];
    if (ramp.to == percent) return;
    ramp = {ramp.at(now), percent, now, seconds};
    unsettled_ = static_cast<int>(kWindow);
}

bool SoftServo::isCompliant() const {
    return std::any_of(ramps_.begin(), ramps_.end(), [](const Ramp& r) { return r.to > 0; });
}

bool SoftServo::isActive() const {
    return isCompliant() || unsettled_ > 0 || !shown_.empty();
}

void SoftServo::setOutsideTorque(std::size_t axis, double share) {
    const double kept = std::clamp(share, -1.0, 1.0);
    if (std::exchange(outside_[axis], kept) != kept && isCompliant()) unsettled_ = static_cast<int>(kWindow);
}

bool SoftServo::movesAtRest() const {
    return unsettled_ > 0;
}

/// By the mean torque over the window.
Joints SoftServo::deflectionOf(const Sample& now) const {
    const std::size_t axes = now.planned.size();
    Joints most = now.planned;
    accelerations_.limitsAt(now.planned, most);
    Joints deflection = Joints::zeros(axes);
    const auto speed = [&](std::size_t from, std::size_t axis) {
        return (window_[from + 1].planned[axis] - window_[from].planned[axis]) / kModifierSeconds;
    };
    for (std::size_t i = 0; i < axes; ++i) {
        const double compliance = kDeflection * ramps_[i].at(now.time);
        if (compliance == 0) continue;
        double outside = 0;
        for (std::size_t k = 1; k < window_.size(); ++k)
            outside += window_[k].outside[i];
        outside /= static_cast<double>(window_.size() - 1);
        const double gained = speed(window_.size() - 2, i) - speed(0, i);
        const double needed = gained / (kModifierSeconds * static_cast<double>(window_.size() - 2)) / most[i];
        deflection[i] = compliance * std::clamp(outside - needed, -1.0, 1.0);
    }
    return deflection;
}

void SoftServo::advance(const PlannedMoment& planned) {
    const std::size_t axes = planned.joints.robax.size();
    Sample now{planned.time, planned.joints.robax, outside_, Joints::zeros(axes)};
    const bool continues = !window_.empty() && window_.back().planned.size() == axes &&
                           planned.time - window_.back().time == kModifierPeriod;
    if (!continues) { // it rested until now, with the same torque as at the end
        Sample before = now;
        if (!window_.empty()) before.outside = window_.back().outside;
        window_.assign(kWindow + 1, before);
    }
    bool isMoved = false;
    bool isRamping = false;
    for (std::size_t i = 0; i < axes; ++i) {
        isMoved = isMoved || std::abs(now.planned[i] - window_.back().planned[i]) > kNothing ||
                  std::abs(now.outside[i] - window_.back().outside[i]) > kNothing;
        isRamping = isRamping || !ramps_[i].isOver(planned.time);
    }
    window_.push_back(now);
    while (window_.size() > kWindow + 2)
        window_.pop_front();
    unsettled_ = isMoved || isRamping ? static_cast<int>(kWindow) + 1 : std::max(0, unsettled_ - 1);
    now.deflection = deflectionOf(now);
    shown_.push_back(std::move(now));
}

Joints SoftServo::deflectionAt(TimeNs time, std::size_t axes) const {
    if (shown_.empty()) return Joints::zeros(axes);
    const auto after =
        std::find_if(shown_.begin(), shown_.end(), [time](const Sample& s) { return s.time >= time; });
    if (after == shown_.end()) return shown_.back().deflection;
    if (after == shown_.begin()) return after->deflection;
    const Sample& before = *(after - 1);
    const double share =
        static_cast<double>(time - before.time) / static_cast<double>(after->time - before.time);
    Joints deflection = before.deflection;
    for (std::size_t i = 0; i < deflection.size(); ++i)
        deflection[i] += share * (after->deflection[i] - before.deflection[i]);
    return deflection;
}

Pose SoftServo::displaced(const PlannedMoment& planned, const Pose& tcp) const {
    const Joints& joints = planned.joints.robax;
    const Joints deflection = deflectionAt(planned.time, joints.size());
    Joints bent = joints;
    bool isBent = false;
    for (std::size_t i = 0; i < std::min(bent.size(), deflection.size()); ++i) {
        bent[i] += deflection[i];
        isBent = isBent || std::abs(deflection[i]) > kNothing;
    }
    if (!isBent) return tcp;
    const Pose base = planned.frames->base(planned.joints.extax);
    const Pose flange = base * kinematics_.forward(joints);
    const Pose there = base * kinematics_.forward(bent);
    // A stationary tool stays, and the object that the robot holds moves.
    return planned.frames->tool.robotHeld ? there * robot::inverse(flange) * tcp
                                          : flange * robot::inverse(there) * tcp;
}

void SoftServo::forgetBefore(TimeNs time) {
    while (shown_.size() > 1 && shown_[1].time < time)
        shown_.pop_front();
    if (!isCompliant() && unsettled_ == 0) shown_.clear();
}

} // namespace motion

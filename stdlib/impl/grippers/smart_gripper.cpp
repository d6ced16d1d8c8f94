#include "stdlib/impl/grippers/smart_gripper.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/surroundings.h"
#include "stdlib/impl/motion/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rt::lib {

SmartGripper& SmartGripper::of(TaskCore* task) {
    auto& gripper = motionOf(task).service<SmartGripper>();
    if (gripper.controller_ == nullptr) gripper.open(task);
    return gripper;
}

void SmartGripper::open(TaskCore* task) {
    controller_ = &taskOf(task).controller();
    unit_ = motionOf(task).unitName();
    if (const std::size_t end = unit_.find('_'); end != std::string::npos)
        suffix_ = unit_.substr(end); // "_L"
    controller_->service<Surroundings>().addListener([this](const Surroundings::Name& name, double) {
        if (sameName(name.unit, unit_) && sameName(name.quantity, Surroundings::kPart) && isMoving())
            move(goal_);
    });
    show();
}

void SmartGripper::calibrate() {
    zero_ = whereNow();
    isCalibrated_ = true;
    show();
}

double SmartGripper::position() const {
    return whereNow() - zero_;
}

void SmartGripper::moveTo(double position) {
    move(std::clamp(position + zero_, 0.0, kMostTravel));
}

void SmartGripper::moveInward() {
    move(0);
}

void SmartGripper::moveOutward() {
    move(std::min(limit_ + (isCalibrated_ ? zero_ : 0), kMostTravel));
}

void SmartGripper::stop() {
    const double here = whereNow();
    controller_->scheduler().cancel(std::exchange(arrival_, 0));
    start_ = goal_ = end_ = here;
    show();
    changed_.notifyAll();
}

Status SmartGripper::waitStill(Task& task) {
    if (!isMoving()) return kOk;
    WaitSpec spec;
    spec.queues = {&changed_};
    spec.condition = [this] { return !isMoving(); };
    WaitResult result{};
    return task.waitFor(spec, result);
}

void SmartGripper::setVacuum(std::size_t cup, bool on) {
    if (on) setBlow(cup, false);
    output(fmt::format("hand_CmdVacuum{}", cup + 1), on ? 1 : 0);
}

bool SmartGripper::failsVacuum(std::size_t cup) const {
    const auto& around = controller_->service<Surroundings>();
    return around.value(unit_, Surroundings::kVacuumFailure, static_cast<int>(cup) + 1, 0) != 0;
}

void SmartGripper::setBlow(std::size_t cup, bool on) {
    if (on) setVacuum(cup, false);
    output(fmt::format("hand_CmdBlowoff{}", cup + 1), on ? 1 : 0);
}

void SmartGripper::move(double goal) {
    const double here = whereNow();
    Scheduler& clock = controller_->scheduler();
    clock.cancel(std::exchange(arrival_, 0));
    start_ = here;
    goal_ = goal;
    end_ = met(here, goal);
    began_ = clock.now();
    arrival_ = clock.after(fromSeconds(std::abs(end_ - here) / speed_), [this] { arrived(); });
}

void SmartGripper::arrived() {
    arrival_ = 0;
    start_ = goal_ = end_;
    show();
    changed_.notifyAll();
}

/// A part stops fingers that come to it from either side; those that hold it from outside leave it outwards.
double SmartGripper::met(double from, double goal) const {
    const double part = controller_->service<Surroundings>().value(unit_, Surroundings::kPart, -1) + zero_;
    if (part < zero_) return goal;
    if (from >= part && goal < part) return part;
    if (from < part && goal > part) return part;
    return goal;
}

double SmartGripper::whereNow() const {
    if (!isMoving()) return end_;
    const double way = speed_ * toSeconds(controller_->scheduler().now() - began_);
    const double all = std::abs(end_ - start_);
    return way >= all ? end_ : start_ + std::copysign(way, end_ - start_);
}

/// The signals of the gripper, where the configuration has them.
void SmartGripper::show() const {
    output("hand_StatusCalibrated", isCalibrated_ ? 1 : 0);
    output("hand_ActualPosition", std::round(position() * 10)); // tenths of a mm
}

void SmartGripper::output(const std::string& signal, double value) const {
    IoSystem& io = controller_->io();
    for (const std::string& name : {signal + suffix_, signal})
        if (const SignalId id = io.find(name); id >= 0) (void)io.force(id, value); // out of range: stays
}

} // namespace rt::lib

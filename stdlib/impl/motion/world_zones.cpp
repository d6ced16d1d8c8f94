#include "stdlib/impl/motion/world_zones.h"

#include <algorithm>
#include <string>
#include <utility>

namespace rt::lib {
namespace {

using Action = WorldZone::Action;

constexpr Time kStep = kMillisecond; // between two looks at a moving arm
constexpr Time kExactness = 1000;    // ns, of the moment of a change

/// Whether the zone acts on an arm that is where it will be at that time. The moment from which on an arm can no longer be
/// stopped outside counts for what has to happen before.
bool concerns(const WorldZone& zone, const motion::MotionSystem& arm, Time time) {
    if (zone.shape.contains(arm.sample(time))) return true;
    return zone.action != Action::OutputInside && zone.shape.contains(arm.sampleStopped(time));
}

/// The zone concerns the arm at one of the two times only: the last moment, up to kExactness, at which it is as at `from`.
Time lastMoment(const WorldZone& zone, const motion::MotionSystem& arm, Time from, Time to, bool atFrom) {
    while (to - from > kExactness) {
        const Time middle = from + (to - from) / 2;
        (concerns(zone, arm, middle) == atFrom ? from : to) = middle;
    }
    return from;
}

/// Some axis moves, or is about to.
bool isUnderWay(const motion::MotionSystem& arm) {
    if (arm.isMoving()) return true;
    const double now = static_cast<double>(arm.now()) * 1e-9;
    for (const motion::GroupAxis& axis : arm.independentAxes()) {
        const motion::AxisCourse* course = arm.independent(axis);
        if (course->settledAt() > now || course->at(now).speed != 0) return true;
    }
    return false;
}

/// The tasks that move the robot stop with an error, and with them all NORMAL tasks.
void stopProgram(Controller& controller, MotionDriver& motion, const WorldZone& zone) {
    const bool isIn = zone.shape.contains(motion.system().current());
    Task* mover = nullptr;
    for (const auto& task : controller.tasks())
        if (task->motionGroup() == static_cast<int>(motion.group()) && task->isExecuting())
            mover = task.get();
    controller.log().write(
        EventId::WorldZoneStop, mover,
        {motion.unitName(), isIn ? "it is inside" : "it would enter", std::to_string(zone.number)});
    if (mover != nullptr) {
        mover->stop(StopCause::Error);
        controller.taskFailed(*mover);
    } else {
        motion.programStop();
    }
}

} // namespace

int WorldZones::add(const WorldZone& zone) {
    if (zones_.size() >= kMost) return 0;
    zones_.push_back(zone);
    zones_.back().number = ++lastNumber_;
    enable(zones_.back());
    return lastNumber_;
}

WorldZone* WorldZones::find(int number) {
    const auto found = std::find_if(zones_.begin(), zones_.end(),
                                    [number](const WorldZone& zone) { return zone.number == number; });
    return found == zones_.end() ? nullptr : &*found;
}

void WorldZones::enable(WorldZone& zone) {
    listen();
    zone.enabled = true;
    zone.inside.reset();
    if (motorsOff_) return;
    const motion::MotionSystem& arm = motion_->system();
    if (zone.action != Action::Stop) act(zone, concerns(zone, arm, arm.now()));
    lookAt(controller_->scheduler().now());
}

void WorldZones::erase(int number) {
    std::erase_if(zones_, [number](const WorldZone& zone) { return zone.number == number; });
}

void WorldZones::eraseTemporary() {
    std::erase_if(zones_, [](const WorldZone& zone) { return !zone.stationary; });
}

void WorldZones::restore(std::vector<WorldZone> zones, int lastNumber) {
    listen();
    zones_ = std::move(zones);
    lastNumber_ = lastNumber;
    lookAt(controller_->scheduler().now());
}

void WorldZones::listen() {
    if (std::exchange(listening_, true)) return;
    motorsOff_ = !controller_->motorsOn();
    motion_->addListener([this](ArmChange news) { take(news); });
}

/// While the motors are off nothing is looked at; what they find when they are on again is acted upon again.
void WorldZones::take(ArmChange news) {
    if (news == ArmChange::MotorsOff) motorsOff_ = true;
    if (news == ArmChange::PowerFailed)
        std::erase_if(zones_, [](const WorldZone& zone) { return zone.stationary; });
    if (news == ArmChange::Start && std::exchange(motorsOff_, false))
        for (WorldZone& zone : zones_)
            zone.inside.reset();
    noteMotion();
}

void WorldZones::noteMotion() {
    if (!zones_.empty() && !motorsOff_) lookAt(controller_->scheduler().now());
}

void WorldZones::lookAt(Time time) {
    controller_->scheduler().cancel(tick_);
    tick_ = controller_->scheduler().at(time, [this] {
        tick_ = 0;
        look();
    });
}

/// Acts on where the arm is now, and arranges the next look.
void WorldZones::look() {
    if (motorsOff_ || zones_.empty()) return;
    const motion::MotionSystem& arm = motion_->system();
    const Time now = controller_->scheduler().now();
    const bool isMoving = isUnderWay(arm);
    Time next = now + kStep;
    for (WorldZone& zone : zones_) {
        if (!zone.enabled || (zone.action == Action::Stop && (!isMoving || arm.isStopRequested()))) continue;
        const bool inside = concerns(zone, arm, now);
        if (zone.action != Action::Stop) {
            act(zone, inside);
        } else if (inside || (zone.stopAt == now && concerns(zone, arm, now + kExactness))) {
            stopProgram(*controller_, *motion_, zone);
            continue;
        }
        if (!isMoving || concerns(zone, arm, next) == inside) continue;
        const Time last = lastMoment(zone, arm, now, next, inside);
        const bool isLate =
            std::exchange(zone.stopAt, last) == now; // it was to be stopped now, and need not be
        next = zone.action != Action::Stop ? last + kExactness : std::max(last, now + (isLate ? 1 : 0));
    }
    if (isMoving) lookAt(next); // at once again when it has to be stopped now
}

/// Zones with the same output: it has the value of those the arm is in.
void WorldZones::act(WorldZone& zone, bool inside) {
    if (zone.inside == inside) return;
    zone.inside = inside;
    const auto keeps = [&](const WorldZone& other) {
        return other.enabled && other.action != Action::Stop && other.output == zone.output &&
               other.inside == true;
    };
    if (!inside && std::any_of(zones_.begin(), zones_.end(), keeps)) return;
    IoSystem& io = controller_->io();
    (void)io.force(io.idOf(zone.output), zone.value == inside ? 1 : 0); // checked by WZDOSet
}

WorldZones& zonesOf(Controller& controller, MotionDriver& motion) {
    auto& zones = motion.service<WorldZones>();
    zones.connect(controller, motion);
    return zones;
}

void endTemporaryZones(Task& task) {
    zonesOf(task.controller(), task.controller().motion(task)).eraseTemporary();
}

} // namespace rt::lib

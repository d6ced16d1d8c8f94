#include "runtime/motion/follower.h"

namespace motion {

Follower::Follower(std::shared_ptr<Trajectory> leader, std::size_t member, const robot::RobotModel& model,
                   const ExternalAxisModels& external, const JointTarget& start, const FrameSetup& frames)
    : Trajectory(model, external, {}, start, 0), leader_(std::move(leader)), member_(member), start_(start),
      frames_(frames) {}

Trajectory::Appended Follower::append(const std::shared_ptr<const MotionPath>& /*path*/,
                                      const MoveCommand& /*command*/, double /*now*/) {
    return {{leader_->isEmpty() ? 0 : leader_->lastRun(), 0}, true, false};
}

PathPlace Follower::own(const PathPlace& leading) const {
    if (leader_->isEmpty() || leader_->isPause(leading.run)) return leading;
    return {
        leading.run,
        leader_->companionsOf(leading.run).placeOf(member_, leader_->route(leading.run), leading.s).place};
}

PathPlace Follower::leading(const PathPlace& own) const {
    if (leader_->isEmpty() || leader_->isPause(own.run)) return own;
    return {own.run, leader_->companionsOf(own.run).leaderPlace(member_, leader_->route(own.run), own.s)};
}

PathPlace Follower::restPlaceIfHeld(double time) const {
    return own(leader_->restPlaceIfHeld(time));
}

Trajectory::Moment Follower::at(double time) const {
    Moment moment = leader_->at(time);
    if (leader_->isEmpty()) return moment;
    if (!leader_->isPause(moment.place.run)) {
        const Companions::Mapped mapped =
            leader_->companionsOf(moment.place.run)
                .placeOf(member_, leader_->route(moment.place.run), moment.place.s);
        moment.place.s = mapped.place;
        moment.speed *= mapped.slope;
    }
    return moment;
}

std::optional<double> Follower::timeAt(const PathPlace& place) const {
    return leader_->timeAt(leading(place));
}

const Route& Follower::route(std::size_t run) const {
    static const Route kNone;
    return leader_->isPause(run) ? kNone : leader_->companionsOf(run).route(member_);
}

PathPlace Follower::legStart(const LegRef& leg) const {
    if (leader_->isPause(leg.run)) return {leg.run, 0};
    return {leg.run, route(leg.run).legStart(leg.leg)};
}

PathPlace Follower::legEnd(const LegRef& leg) const {
    if (leader_->isPause(leg.run)) return {leg.run, 1};
    return {leg.run, route(leg.run).legEnd(leg.leg)};
}

/// The latest run before a pause that has a way; null when there is none.
const Route* Follower::routeBefore(std::size_t run) const {
    while (run > leader_->firstRun())
        if (!leader_->isPause(--run)) return &route(run);
    return nullptr;
}

/// During a pause the robot is where it was before.
RoutePoint Follower::pointAt(const PathPlace& place) const {
    if (!leader_->isPause(place.run)) return route(place.run).at(place.s);
    const Route* before = routeBefore(place.run);
    return before != nullptr ? before->at(before->length()) : RoutePoint{start_.robax, start_.extax, true};
}

const FrameSetup& Follower::framesAt(const PathPlace& place) const {
    if (leader_->isPause(place.run)) {
        const Route* before = routeBefore(place.run);
        return before != nullptr ? before->leg(before->legCount() - 1).path->frames() : frames_;
    }
    const Route& way = route(place.run);
    return way.leg(way.legAt(place.s)).path->frames();
}

PathPlace Follower::end() const {
    return leader_->isEmpty() ? PathPlace{}
                              : PathPlace{leader_->lastRun(), route(leader_->lastRun()).length()};
}

void Follower::goBack(double now, const PathPlace& to, double mmPerSecond) {
    leader_->goBack(now, leading(to), mmPerSecond);
}

} // namespace motion

#pragma once
// Follower: the path of a robot that moves together with another one (MultiMove). Times and stops are those of the leader's
// trajectory; the places are on its own routes, which the leader's runs keep.

#include "runtime/motion/trajectory.h"

namespace motion {

class Follower final : public Trajectory {
  public:
    /// `member`: its number among the companions of the leader. The robot is at `start`; `frames` hold until it moves.
    Follower(std::shared_ptr<Trajectory> leader, std::size_t member, const robot::RobotModel& model,
             const ExternalAxisModels& external, const JointTarget& start, const FrameSetup& frames);

    /// Not possible alone: the move has no way, and the arm stays where it is.
    Appended append(const std::shared_ptr<const MotionPath>& path, const MoveCommand& command,
                    double now) override;
    void closeLast() override { leader_->closeLast(); }
    bool isEmpty() const override { return leader_->isEmpty(); }
    void setSpeedShare(double now, double share) override { leader_->setSpeedShare(now, share); }
    void hold(double now, StopKind kind) override { leader_->hold(now, kind); }
    void release(double now) override { leader_->release(now); }
    bool isHeld() const override { return leader_->isHeld(); }
    bool isMoving(double time) const override { return leader_->isMoving(time); }
    double restTime() const override { return leader_->restTime(); }
    PathPlace restPlaceIfHeld(double time) const override;
    Moment at(double time) const override;
    std::optional<double> timeAt(const PathPlace& place) const override;
    std::optional<double> inPositionTime(std::size_t run) const override {
        return leader_->inPositionTime(run);
    }
    std::optional<double> stopTime(std::size_t run) const override { return leader_->stopTime(run); }
    std::optional<double> brakingTime(std::size_t run) const override { return leader_->brakingTime(run); }
    std::optional<double> decisionTime() const override { return leader_->decisionTime(); }
    const Route& route(std::size_t run) const override;
    PathPlace legStart(const LegRef& leg) const override;
    PathPlace legEnd(const LegRef& leg) const override;
    RoutePoint pointAt(const PathPlace& place) const override;
    const FrameSetup& framesAt(const PathPlace& place) const override;
    PathPlace end() const override;
    bool leadsToEnd() const override { return leader_->leadsToEnd(); }
    bool isPause(std::size_t run) const override { return leader_->isPause(run); }
    void goBack(double now, const PathPlace& to, double mmPerSecond) override;
    double backEnd() const override { return leader_->backEnd(); }
    void finishBack(double now) override { leader_->finishBack(now); }
    void standAt(double now, const PathPlace& place) override { leader_->standAt(now, leading(place)); }
    std::size_t companionCount() const override { return leader_->companionCount(); }
    bool forgetBefore(double time, const LegRef& leg) override {
        oldestTime_ = time;
        oldest_ = leg;
        return false;
    }
    const Trajectory* leader() const { return leader_.get(); }

  private:
    PathPlace own(const PathPlace& leading) const;
    PathPlace leading(const PathPlace& own) const;
    const Route* routeBefore(std::size_t run) const;

    std::shared_ptr<Trajectory> leader_;
    std::size_t member_ = 0;
    JointTarget start_;
    FrameSetup frames_;
};

} // namespace motion

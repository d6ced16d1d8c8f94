#pragma once
// Trajectory: the runs of one path level in time: place on the path at a moment, moment at a place, stop, continue, go back,
// replace what is planned from a moment on. Times in seconds. Runs follow each other closely: the next one begins when
// the last mm of the one before is left (docs/motion.md).

#include "runtime/motion/run.h"

#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <optional>

namespace motion {

/// A place on the path of a trajectory.
struct PathPlace {
    std::size_t run = 0;
    double s = 0; ///< mm on the route of that run
    friend auto operator<=>(const PathPlace&, const PathPlace&) = default;
};

/// A leg of a run.
struct LegRef {
    std::size_t run = 0;
    std::size_t leg = 0;
    friend auto operator<=>(const LegRef&, const LegRef&) = default;
};

struct TrajectoryOptions {
    double startDelay = 0.020; ///< s, from the order of a move to its start when the arm is at rest
    double overlap = 1.0;      ///< mm left of a run when the next one begins
    double inPosition = 0.5;   ///< mm left when the program continues after a stop point
    double emptyMove = 0.073;  ///< s, a move to where the arm is
    Planner planner = Planner::Measured;
};

class Trajectory {
  public:
    /// Without moves yet; the arm is at `start`, and moves from the time `earliest` on.
    Trajectory(const robot::RobotModel& model, const ExternalAxisModels& external, TrajectoryOptions options,
               const JointTarget& start, double earliest);
    virtual ~Trajectory() = default;
    Trajectory(const Trajectory&) = delete;
    Trajectory& operator=(const Trajectory&) = delete;

    // ---- what is to be run ----
    struct Appended {
        LegRef at;
        bool isPoint = false;      ///< no way of its own: the end of that leg
        bool isCornerLost = false; ///< the fly-by point before has become a stop point
    };
    /// Appends a move while the arm moves or rests.
    virtual Appended append(const std::shared_ptr<const MotionPath>& path, const MoveCommand& command,
                            double now);
    /// One move of each robot of a synchronised movement, this one's first; the companions' in the order in which they were
    /// added, all of which still exist. They begin and end together, and every fly-by point is one for all of them.
    struct Ordered {
        std::shared_ptr<const MotionPath> path;
        MoveCommand command;
        std::optional<std::size_t>
            carrier; ///< number of the robot that carries the work object, 0 for this one
        std::function<Pose(const RoutePoint&)> carrierFrame; ///< the user frame where that robot is
    };
    Appended appendTogether(const std::vector<Ordered>& moves, double now);
    /// From now on moves are appended together with those of `follower`; the path is empty.
    void addCompanion(const std::shared_ptr<Trajectory>& follower) { followers_.push_back(follower); }
    /// How many robots move together with the first one; 0: this one moves alone.
    virtual std::size_t companionCount() const { return followers_.size(); }
    const Companions& companionsOf(std::size_t run) const { return runAt(run).companions(); }
    /// The run is a pause; nothing moves.
    virtual bool isPause(std::size_t run) const { return entry(run).pause > 0; }
    std::size_t firstRun() const { return first_; }
    std::size_t lastRun() const { return count() - 1; }
    /// The last point of the path is a stop point.
    virtual void closeLast();
    virtual bool isEmpty() const { return entries_.empty(); }

    // ---- time ----
    virtual void setSpeedShare(double now, double share);
    /// From `now` on no faster than this. Robots that follow this one obey from the next movement on.
    virtual void setSpeedLimits(double now, const SpeedLimits& most);
    /// Brakes on the path and stays there until release(). A quick stop also brakes an arm faster that brakes already.
    virtual void hold(double now, StopKind kind = StopKind::Normal);
    virtual void release(double now);
    virtual bool isHeld() const { return isHeld_; }
    virtual bool isMoving(double time) const;
    /// When everything comes to rest, as planned; minus infinity when nothing is planned, as at a path that is held from its beginning.
    virtual double restTime() const;
    /// The place where the arm would come to rest if hold() were called at that time, which has been planned already.
    virtual PathPlace restPlaceIfHeld(double time) const;

    /// The pose of the arm, and its speed (mm/s) along the path.
    struct Moment {
        PathPlace place;
        double speed = 0;
    };
    virtual Moment at(double time) const;
    /// When the arm comes to this place; nothing if the plan does not lead there.
    virtual std::optional<double> timeAt(const PathPlace& place) const;
    /// When the run is in position at its end; nothing if the plan does not lead there.
    virtual std::optional<double> inPositionTime(std::size_t run) const;
    /// When the stop point at its end has been reached as its StopPoint asks, after inPositionTime() in most cases.
    virtual std::optional<double> stopTime(std::size_t run) const;
    /// When the arm begins to brake for the end of the run for the last time, or the pause begins.
    virtual std::optional<double> brakingTime(std::size_t run) const;
    /// When the planner needs to know what follows an open end of the last run; nothing when it is not open.
    virtual std::optional<double> decisionTime() const;

    // ---- places ----
    virtual const Route& route(std::size_t run) const { return runAt(run).route(); }
    virtual PathPlace legStart(const LegRef& leg) const;
    virtual PathPlace legEnd(const LegRef& leg) const;
    virtual RoutePoint pointAt(const PathPlace& place) const;
    /// Derivatives of the axes by the place, deg/mm, and mm of TCP path per mm. `first` has a component for each axis; `here` is
    /// pointAt(place).
    void ratesAt(const PathPlace& place, const RoutePoint& here, Joints& first, double& tcpRate) const;
    /// Frames of the move the place belongs to.
    virtual const FrameSetup& framesAt(const PathPlace& place) const;
    virtual PathPlace end() const;
    /// The plan leads to the end of the last move.
    virtual bool leadsToEnd() const {
        return !entries_.empty() && entries_.back().isScheduled && !entries_.back().run->isBraking();
    }
    /// The end of the last move, or the pose of the arm when there is none.
    const JointTarget& endTarget() const { return endTarget_; }

    // ---- back along the path ----
    /// Moves back from the place where the arm is held to an earlier one on the same or the previous run.
    virtual void goBack(double now, const PathPlace& to, double mmPerSecond);
    virtual double backEnd() const { return back_->course.end(); }
    /// The arm has come to rest there.
    virtual void finishBack(double now);
    /// The arm is at a place, without having moved there (after braking off the path).
    virtual void standAt(double now, const PathPlace& place);

    /// Drops the part before this time and leg, except for what a follower still asks for: its time may be an earlier one. True if
    /// times may be rounded differently from now on.
    virtual bool forgetBefore(double time, const LegRef& leg);

  protected:
    /// Of a follower: the first time and leg of its leader's path that it still asks for.
    double oldestTime_ = -std::numeric_limits<double>::infinity();
    LegRef oldest_;
    JointTarget endTarget_;

  private:
    struct Back {
        Course course;
        PathPlace from;
    };
    struct Entry {
        std::unique_ptr<Run> run;
        double ordered = 0;
        double pause = 0;         // s, of a run without a way; 0 = it has one
        bool isScheduled = false; // its start is known
        StopPoint stop;           // at its end
        CourseState late;         // of the course when it was ordered after its start; 0 otherwise
        std::shared_ptr<const MotionPath> path; // of its first move
    };
    const Entry& entry(std::size_t run) const { return entries_[run - first_]; }
    Entry& entry(std::size_t run) { return entries_[run - first_]; }
    const Run& runAt(std::size_t run) const { return *entry(run).run; }
    static CourseState stateOf(const Entry& entry, double time);
    std::size_t count() const { return first_ + entries_.size(); }
    static bool hasBegun(const Entry& entry, double time);
    std::size_t activeAt(double time) const;
    std::optional<double> startAfter(std::size_t run) const;
    double courseTime(std::size_t run, double place) const;
    void schedule(std::size_t from, double now, double earliest);
    struct Tail {
        double left = 0, speed = 0; // mm, mm/s
    };
    Tail tailBefore(std::size_t run, double time) const;
    RunSettings settings() const;
    Leg legOf(const std::shared_ptr<const MotionPath>& path, const MoveCommand& command) const;
    static bool keepsPlace(const Ordered& move);
    std::vector<Leg> legsTogether(const std::vector<Ordered>& moves) const;
    RunSettings settingsOf(double rampShare) const;
    Appended appendPause(const std::shared_ptr<const MotionPath>& path, double seconds, const StopPoint& stop,
                         double now);
    Appended appendRun(std::unique_ptr<Run> run, const std::shared_ptr<const MotionPath>& path, double pause,
                       const StopPoint& stop, double now);

    robot::RobotModel model_;
    ExternalAxisModels external_;
    robot::AccelerationMap accelerations_;
    TrajectoryOptions options_;
    std::size_t first_ = 0; // number of the oldest run that is kept
    std::deque<Entry> entries_;
    /// Times of places found since the plan changed last: each event asks for the same few again.
    struct Found {
        std::size_t run = 0;
        double place = -1, time = 0;
    };
    mutable std::array<Found, 8> found_{};
    mutable std::size_t nextFound_ = 0;
    void planChanged() { found_.fill({}); }

    double earliest_ = 0;
    std::vector<std::weak_ptr<Trajectory>> followers_;
    SpeedLimits speedLimits_;
    double share_ = 1;
    bool isHeld_ = false;
    std::optional<Back> back_;
};

} // namespace motion

#pragma once
// Run: a route with its timing, from one standstill to the next. The measured plan takes the highest speed along the route
// that keeps all limits, with full acceleration before and after; the course averages it in time. The optimal plan is exact.

#include "runtime/motion/companions.h"
#include "runtime/motion/course.h"
#include "runtime/motion/optimal_plan.h"
#include "runtime/motion/planner.h"
#include "runtime/motion/route.h"
#include "runtime/motion/stop_kind.h"
#include "runtime/motion/stretch_limits.h"
#include "runtime/robot/dynamics.h"

#include <vector>

namespace motion {

struct RunSettings {
    const robot::AccelerationMap* accelerations = nullptr;
    double longWindow = 0.108, shortWindow = 0.048; ///< s
    double rampShare = 1;                           ///< AccSet \Ramp, which the windows contain
    double speedShare = 1;                          ///< of the programmed speed, above 0 to 1
    std::shared_ptr<Companions> companions; ///< robots that move together with this one; null for none
    Planner planner = Planner::Measured;
    Joints jerk{}; ///< deg/s^3; of the optimal planner
};

class Run {
  public:
    /// At rest at the start of an empty route. Nothing moves before `start` (s).
    Run(const RunSettings& settings, double start);

    /// Appends a leg; nothing planned before `now` changes. False when the end of the route has to stay a stop point
    /// (too late, or no corner possible). `isOpen`: its end is a fly-by point.
    bool append(Leg leg, bool isOpen, double now);
    /// The same, with a leg for each companion.
    bool appendTogether(Leg leg, std::vector<Leg> others, bool isOpen, double now);
    const Companions& companions() const { return *settings_.companions; }
    /// The robot `carried` moves along with the user frame that `carrier` moves: 0 is this robot, 1 the first companion.
    /// `frameOf`: the frame for a place of the carrier.
    void setCarrier(std::size_t carried, std::size_t carrier, std::function<Pose(const RoutePoint&)> frameOf);
    /// The end of the route is passed by on a curve as soon as a leg follows; until then the plan stops there.
    bool isOpen() const { return isOpen_; }
    void close() { isOpen_ = false; }

    /// Replans from `now` on: to the end of the route at this share of the programmed speed (above 0, to 1).
    void plan(double now, double speedShare);
    /// From `now` on no faster than this.
    void limitSpeeds(double now, const SpeedLimits& most);
    /// Replans from `now` on: brakes as fast as the limits allow and rests there.
    void brake(double now, StopKind kind);
    /// The place where a normal brake() would let the arm come to rest.
    double restPlace(double now) const;
    /// At rest at a place since `time`.
    void standAt(double time, double place);
    /// Course back along the route, from a place to an earlier one, as mm from the first; at most at this speed.
    Course courseBack(double time, double from, double to, double mmPerSecond) const;

    /// When a leg that is to follow the open end has to be known for its corner to be possible,
    /// s; of the optimal plan.
    double decisionTime() const;
    /// When the last braking of the plan begins, s; of a measured plan.
    double lastBraking() const;

    const Route& route() const { return route_; }
    const Course& course() const { return course_; }
    /// mm of route that count as a mm that is left at the stop point at its end: of the robot that keeps it most closely.
    double perMmLeft() const;
    double start() const { return start_; }
    /// Shifts the start; the run has not begun.
    void startAt(double time);
    bool isBraking() const { return isBraking_; } ///< the plan ends before the route does
    /// True if times of the course may be rounded differently from now on.
    bool forgetBefore(double time, double place);

  private:
    Course newCourse(double time, double place) const;
    double fixedPlace(double now) const;
    bool appendOptimal(double changed, double now);
    bool canAppend(double now) const;
    std::size_t limitStretches(std::size_t from);
    std::size_t widenDips(std::size_t from);
    template <class Step> void brakeFrom(const CourseState& state, Step step) const;
    double speedSquare(std::size_t stretch) const;
    void planBackward(std::size_t from);
    void planForward(double now);
    void taperEnd();
    double taperSquare(double place) const;
    double taperWay() const { return taperJerk_ * taper_ * taper_ * taper_ / 6; } // mm, covered meanwhile
    void passStretch(std::size_t stretch, double from, double square);
    void passTapered(std::size_t stretch, double from, double square, double last);
    void meetDuration();
    double optimalSpeedFor(double wanted);
    double averagedSpeedFor(double wanted);
    double nodePlace(std::size_t node) const;

    RunSettings settings_;
    std::optional<OptimalPlan> optimal_;
    Route route_;
    Course course_;
    double start_ = 0;
    double share_ = 1;
    bool isOpen_ = false;
    bool isBraking_ = false;
    mutable std::optional<double>
        decision_;                // decisionTime() or lastBraking(), found since the plan changed last
    Queue<StretchLimits> limits_; // of each stretch
    Queue<double> reachable_;     // largest squares of speed at the beginnings of stretches, then at the end
    Queue<double> planned_;       // squares of the plan there
    std::size_t changed_ = 0;     // nodes from this one on have a new reachable speed
    double taper_ = 0;            // s, in which the braking for a stop point decreases besides the windows
    double taperJerk_ = 0;        // mm/s^3, at which it does
};

} // namespace motion

#pragma once
// OptimalPlan: plans an exact course on a route: the shortest time that keeps all limits, and braking on the path.

#include "runtime/motion/course.h"
#include "runtime/motion/profile_grid.h"
#include "runtime/motion/queue.h"
#include "runtime/motion/route_profile.h"
#include "runtime/motion/velocity_ramp.h"

#include <optional>

namespace motion {

class OptimalPlan {
  public:
    explicit OptimalPlan(const ArmLimits& limits) : limits_(limits) {}

    /// Measures the stretches of the route from this one on; the ones before are known.
    void measure(const Route& route, std::size_t from);
    /// AccSet \FinePointRamp as a share of \Ramp, when the route ends with a stop point; else 1.
    void setEndRamp(double share) { endRampShare_ = share; }
    /// The first stretches of the route have been forgotten.
    void forget(std::size_t stretches);
    /// Replaces what the course does after `now`: to the end of the route at this share of the programmed speed. The route has
    /// changed from the place `changed` on. False when the limits cannot be kept from there: the course is unchanged then.
    bool plan(Course& course, const Route& route, double now, double changed, double share);
    /// Brakes after `now` as fast as the limits allow, and rests.
    void brake(Course& course, double now) const;
    /// The place where brake() would let it rest.
    double restPlace(const Course& course, double now) const;
    /// ... if it brakes evenly, which may be further on; found faster.
    double evenRestPlace(const Course& course, double now) const;
    /// From a place back to an earlier one, as mm from the first; at most at this speed of the TCP.
    Course courseBack(double time, double from, double to, double mmPerSecond) const;

  private:
    /// A change of speed that begins some time after `now`, until then the plan remains.
    struct Slowing {
        double begin = 0; ///< s
        AxisState from;
        VelocityRamp ramp;
    };
    double length() const { return begins_.empty() ? 0 : begins_.back() + cells_.back().width; }
    std::size_t cellAt(double place) const;
    std::vector<ProfileCell> pathBetween(double from, double to, double share) const;
    double mostSquareAhead(double place, double way, double share) const;
    /// `course`: the plan before it.
    bool keepsLimits(const Slowing& slowing, const Course& course) const;
    /// The change to this speed that ends first; nothing when none keeps the limits.
    std::optional<Slowing> slowing(const Course& course, double now, double speed) const;
    bool planFrom(Course& course, const Route& route, double time, double share);
    bool solveFrom(Course& course, const Route& route, double time, const CourseState& state, double share);
    void softenEnd(std::vector<ProfileCell>& path) const;
    /// Samples the course and lowers the limits where the arm would exceed them; false when it was not necessary.
    bool tightenWhereExceeded(const Course& course, const Route& route, double time, double share, int round);
    /// Shares of limits.
    struct Use {
        double acceleration = 0, jerk = 0;
    };
    Use useAt(const Route& route, const std::array<const Joints*, 4>& axes, double place) const;
    static void tighten(ProfileCell& cell, const Use& use, double speed, int round);
    Course stopped(const Course& course, double now) const;
    static void follow(Course& course, const Slowing& slowing);

    ArmLimits limits_;
    Queue<ProfileCell> cells_; // of each stretch, at full override
    Queue<double> begins_;
    double share_ = 1;
    double endRampShare_ = 1;
    bool keepsTicks_ = false; // the plan that was found last keeps all limits at each tick
    ProfileSolver solver_;
};

} // namespace motion

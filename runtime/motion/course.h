#pragma once
// Course: the place along a path over time. It is planned in pieces of constant acceleration and executed as the average of
// that plan over two windows in time, which is how controllers limit jerk (docs/motion.md). What has been executed up to
// a moment depends only on the plan up to that moment, so the rest of the plan can be replaced at any time.
// An exact course has no windows: it is executed as planned, in pieces that limit jerk themselves.

#include "runtime/motion/queue.h"

#include <cstddef>
#include <memory>

namespace motion {

/// Place (mm), speed (mm/s) and acceleration (mm/s^2) along a path.
struct CourseState {
    double s = 0, v = 0, a = 0;
};

class Course {
  public:
    Course() { knots_.push_back({}); }
    /// At rest at `place` from `time` (s) on and before. The windows (s) are positive.
    Course(double time, double place, double longWindow, double shortWindow);

    /// Continues the plan from its end to `place` (not before the end) with constant acceleration; `speed` there.
    /// At least one of the speeds at both ends is positive.
    void moveTo(double place, double speed);
    /// At rest at `place` from `time` (s) on and before; executed as planned.
    static Course exact(double time, double place) { return {time, place, 0, 0}; }
    bool isExact() const { return shortWindow_ == 0; }
    /// At rest at the end of this course after it has been executed, from `time` on or, if that is later, from its end on.
    Course continued(double time, double longWindow, double shortWindow) const;
    /// How acceleration changes on a piece of an exact course: by the time, or by the place, which makes the square of the
    /// speed a quadratic function of the place.
    struct Change {
        double perSecond = 0; ///< mm/s^3
        double perMm = 0;     ///< 1/s^2; one of the two is 0
    };
    /// Continues an exact plan from its end, where it has speed v and acceleration a, for that many seconds to a place.
    void follow(double v, double a, Change change, double seconds, double place);
    /// Seconds for `way` mm on which the acceleration changes by the place, with these speeds at both ends.
    static double secondsFor(double way, double v, double endV, double perMm);

    /// Continues the plan with rest for that many seconds. The plan ends at rest.
    void rest(double seconds);
    /// Drops what is planned after `time`. The plan then ends there, perhaps moving.
    void cutAfter(double time);
    /// From `time` on, which is not before the execution of the plan begins, only the short window averages: the plan is cut
    /// there, and continues from the average over the long window with the speed that this has.
    void dropLongWindow(double time);
    bool isQuick() const { return longWindow_ == 0 && !isExact(); } ///< it has been dropped
    /// Shifts the whole course in time by that many seconds.
    void shift(double seconds);
    /// Makes the whole exact plan take that many times as long.
    void slowBy(double factor);
    /// Forgets what no question about `time` or later needs. True if answers may be rounded differently from now on.
    bool forgetBefore(double time);

    /// The plan, before it is averaged.
    CourseState plannedAt(double time) const;
    /// s, of what is remembered
    double begin() const { return before_ != nullptr ? before_->begin() : knots_.front().t; }
    double plannedEnd() const { return knots_.back().t; } ///< s
    double endPlace() const { return knots_.back().s + origin_; }
    /// When the last braking of the plan begins; its end if it does not end with braking.
    double lastBraking() const;
    /// When the plan comes to this place for the first time; its end if it does not.
    double plannedTimeAt(double place) const;

    /// The motion executed.
    CourseState at(double time) const;
    /// When the motion comes to rest at the end of the plan.
    double end() const { return plannedEnd() + (knots_.size() > 1 ? longWindow_ + shortWindow_ : 0); }
    /// When the motion comes to this place for the first time. The end if the plan does not lead there.
    double timeAt(double place) const;

  private:
    struct Knot {
        double t = 0, s = 0, v = 0, a = 0; // the acceleration holds until the next knot
        double once = 0, twice = 0;        // integrals of s over time since the first knot
        Change change{};                   // until the next knot; of an exact course
    };
    struct Integrals {
        double s, once, twice, v;
    };
    const Knot& knotAt(double time) const;
    static CourseState stateOn(const Knot& knot, double seconds);
    static double timeOn(const Knot& knot, double way, double most);
    Integrals integralsAt(double time) const;
    static Integrals integralsOn(const Knot& from, double time);
    void push(const Knot& knot);

    Queue<Knot> knots_; // the last one: the end, at rest afterwards when its speed is 0
    double origin_ = 0; // subtracted from places, so that integrals stay small
    double longWindow_ = 1, shortWindow_ = 1;
    std::shared_ptr<const Course> before_; // executed until `from_`; null for none
    double from_ = 0;
};

} // namespace motion

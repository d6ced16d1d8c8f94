#pragma once
// AxisCourse: one axis that moves for itself (manual 2.2.4), in pieces of constant acceleration, or of constant jerk when
// that is limited. Degrees and seconds; a course never changes.

#include "runtime/motion/velocity_ramp.h"

#include <cstddef>
#include <vector>

namespace motion {

/// An axis of a motion group: of the robot (0 is axis 1), or an external one (0 is eax_a).
struct GroupAxis {
    bool isExternal = false;
    std::size_t index = 0;
    bool operator==(const GroupAxis&) const = default;
};

/// Position (deg, or mm of a linear external axis) and speed of an axis.
struct AxisMoment {
    double position = 0;
    double speed = 0;
};

class AxisCourse {
  public:
    /// As it is at that time, with its speed from then on.
    AxisCourse(double time, AxisMoment from);

    /// The course up to `time` remains. Then to a position, at most at this speed (above 0) ...
    /// `jerk`: deg/s^3; 0 = not limited.
    AxisCourse movedTo(double time, double position, double speed, double acceleration,
                       double jerk = 0) const;
    /// ... or at a speed for ever; 0: it comes to rest.
    AxisCourse turning(double time, double speed, double acceleration, double jerk = 0) const;

    /// Even for times shortly before the last change; before the beginning it is as it begins.
    AxisMoment at(double time) const;
    /// From this time on the speed remains as it is then.
    double settledAt() const { return pieces_.back().start; }

  private:
    struct Piece {
        double start, position, speed, acceleration, jerk = 0;
    };
    static AxisMoment momentOn(const Piece& piece, double time);
    AxisCourse upTo(double time) const;
    void changeSpeed(double speed, double acceleration);
    void keepSpeed(double seconds);
    AxisState lastState() const;
    void keepJerk(double seconds, double jerk);
    void settle(double position, double speed);

    std::vector<Piece> pieces_; ///< the last one without acceleration and jerk
};

} // namespace motion

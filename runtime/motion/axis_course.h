#pragma once
// AxisCourse: one axis that moves for itself (manual 2.2.4), in pieces of constant acceleration. Degrees and seconds; a
// course never changes.

#include <vector>

namespace motion {

/// Position (deg) and speed (deg/s) of an axis.
struct AxisMoment {
    double position = 0;
    double speed = 0;
};

class AxisCourse {
  public:
    /// As it is at that time, with its speed from then on.
    AxisCourse(double time, AxisMoment from);

    /// What is executed up to `time` remains. Then to a position, at most at this speed (above 0) ...
    AxisCourse movedTo(double time, double position, double speed, double acceleration) const;
    /// ... or at a speed for ever; 0: it comes to rest.
    AxisCourse turning(double time, double speed, double acceleration) const;

    /// Also for times shortly before the last change; before the beginning it is as it begins.
    AxisMoment at(double time) const;
    /// From this time on the speed remains as it is then.
    double settledAt() const { return pieces_.back().start; }

  private:
    struct Piece {
        double start, position, speed, acceleration;
    };
    static AxisMoment momentOn(const Piece& piece, double time);
    AxisCourse upTo(double time) const;
    void changeSpeed(double speed, double acceleration);
    void keepSpeed(double seconds);

    std::vector<Piece> pieces_; ///< the last one without acceleration
};

} // namespace motion

#pragma once
// Belt: the course of a simulated conveyor: its speed changes with constant acceleration whenever another one is ordered.

#include "runtime/base/time.h"

#include <cstddef>
#include <deque>

namespace rt {

/// Positions in mm (or degrees) since the start of the controller.
class Belt {
  public:
    /// Runs at `speed` from time 0 on. `acceleration`: of later changes, per s^2.
    Belt(double speed, double acceleration);

    /// From `time` on towards this speed; not before the call before.
    void setSpeed(Time time, double speed);
    /// It was there at this time, with this speed on its way to `target`; what was before is forgotten.
    void restore(Time time, double position, double speed, double target);
    double target() const { return target_; }
    /// At any of the latest 256 changes of speed, and later.
    double position(Time time) const;
    double speed(Time time) const;
    /// When it comes to this position after `from` if its speed is not changed again; kNever when it does not.
    Time whenAt(double position, Time from) const;

  private:
    static constexpr std::size_t kMostPieces = 512;
    struct Piece {
        Time start = 0;
        double position = 0, speed = 0, acceleration = 0;
    };
    const Piece& pieceAt(Time time) const;

    std::deque<Piece> pieces_;
    double acceleration_;
    double target_;
};

} // namespace rt

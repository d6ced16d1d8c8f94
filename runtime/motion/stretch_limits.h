#pragma once
// StretchLimits: how fast a route may be passed on one of its stretches, and how the speed may change there.

#include "runtime/motion/route.h"
#include "runtime/motion/tolerances.h"
#include "runtime/robot/dynamics.h"

#include <array>
#include <vector>

namespace motion {

/// Squares of the speed at one end of a stretch that go with a square at the other end.
struct SquareRange {
    double low = -kUnlimited, high = kUnlimited; ///< (mm/s)^2; the low one may be below 0: a stop on the way
};

/// The axes and other quantities that may not accelerate arbitrarily on a stretch. Two are calculated at a time.
class AccelerationRows {
  public:
    /// One more, if there is room. `first`, `second`: derivatives by the place; `most`: in the unit of the quantity per s^2.
    void add(double first, double second, double most) {
        if (count_ == kMost) return;
        first_[count_] = first;
        second_[count_] = second;
        most_[count_++] = most;
        first_[count_] = second_[count_] = most_[count_] = 0; // beside it, where the last one is alone
    }
    /// Narrows `range` to the squares at the other end of a stretch of this width (mm) that keep all of them, from this square at
    /// one end on. `towardsEnd`: from the beginning of the stretch to its end.
    void narrow(SquareRange& range, double square, double width, bool towardsEnd) const;

  private:
    static constexpr std::size_t kMost = 14;
    std::array<double, kMost + 1> first_, second_, most_; // the first ones are set
    std::size_t count_ = 0;
};

/// Limits of the speed on one stretch.
struct StretchLimits {
    double width = 0;          ///< mm
    double speed = 0;          ///< mm/s of route at full override
    double ownSpeed = 0;       ///< the same, before dips nearby lower it
    double axisSpeed = 0;      ///< the same, as the axes alone allow on this stretch
    double bendSquare = 0;     ///< (mm/s)^2, as the axes must turn with the path
    double gain = 0, drop = 0; ///< mm/s^2 along the route
    AccelerationRows rows;
    std::vector<AccelerationRows> more; ///< of robots that move together with this one

    /// Squares at the other end of a part of the stretch, of this width (mm), from this square at one end on.
    SquareRange reachFrom(double square, double partWidth, bool towardsEnd) const;
};

/// Sets new limits to those of the axes of one robot and of a move.
void limitsOn(const RouteStretch& stretch, const MoveLimits& most,
              const robot::AccelerationMap& accelerations, StretchLimits& limits);

} // namespace motion

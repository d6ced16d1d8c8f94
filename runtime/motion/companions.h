#pragma once
// Companions: robots that move together with the one of a run (synchronised movements of MultiMove). Each has a route of
// its own with as many legs as the leader's; one common place, that on the leader's route, gives the places of all of them.

#include "runtime/motion/route.h"
#include "runtime/motion/stretch_limits.h"

#include <memory>
#include <vector>

namespace motion {

class Companions {
  public:
    /// `averaging`: s, half of what the course averages over.
    explicit Companions(double averaging) : averaging_(averaging) {}
    /// The next leg of every companion, in their order. `fixed`: the part of the leader's route up to there can no longer
    /// change. False when a corner is not possible; nothing has changed then.
    bool append(std::vector<Leg> legs, const Route& leader, double fixed);
    /// A stretch where a companion brakes or cannot move limits the leader as well.
    void tighten(const Route& leader, const RouteStretch& stretch, StretchLimits& limits) const;

    void add(const robot::AccelerationMap& accelerations) { members_.push_back({{}, accelerations}); }
    std::size_t size() const { return members_.size(); }
    const Route& route(std::size_t member) const { return members_[member].route; }
    Route& route(std::size_t member) { return members_[member].route; }
    /// Place of a companion, and how much it moves a mm of the leader's route.
    struct Mapped {
        double place = 0, slope = 0;
    };
    Mapped placeOf(std::size_t member, const Route& leader, double place) const;
    double leaderPlace(std::size_t member, const Route& leader, double place) const;

  private:
    double largestSlope(std::size_t member, const Route& leader, double from, double to) const;
    struct Member {
        Route route;
        robot::AccelerationMap accelerations; // of its robot
    };
    std::vector<Member> members_;
    double averaging_ = 0;
};

} // namespace motion

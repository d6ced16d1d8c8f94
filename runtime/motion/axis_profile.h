#pragma once
// AxisProfile: one axis from one state to another in the shortest or in a given time under limits of speed, acceleration and
// jerk; and several axes that arrive together. Seven pieces of constant jerk, without iteration from rest to rest.

#include "runtime/motion/velocity_ramp.h"

#include <array>
#include <optional>
#include <span>

namespace motion {

/// All above 0.
struct AxisLimits {
    double speed = 0, acceleration = 0, jerk = 0;
};

class AxisProfile {
  public:
    static constexpr std::size_t kPieces = 7;

    AxisProfile() = default;
    /// From rest at one position to rest at another.
    static AxisProfile restToRest(double from, double to, const AxisLimits& limits);
    /// Between any two states in a short time: the shortest of its shape, which changes to one speed, keeps it, and changes to
    /// the last one. A speed beyond its limit at the beginning is taken back first.
    static AxisProfile between(const AxisState& from, const AxisState& to, const AxisLimits& limits);
    /// ... in exactly that many seconds; nothing when no profile of this shape lasts so long.
    static std::optional<AxisProfile> lasting(double seconds, const AxisState& from, const AxisState& to,
                                              const AxisLimits& limits);
    /// From rest to rest over a longer time: slower everywhere.
    AxisProfile slowedTo(double seconds) const;

    double duration() const { return duration_; }
    /// Before its beginning and after its end: the states there, moving on at their speeds.
    AxisState at(double seconds) const;
    const AxisState& begin() const { return from_; }
    const AxisState& end() const { return to_; }
    const std::array<double, kPieces>& times() const { return time_; } ///< s, of the pieces
    const std::array<double, kPieces>& jerks() const { return jerk_; }

  private:
    friend class ProfileChoice;
    AxisState from_, to_;
    std::array<double, kPieces> time_{}, jerk_{};
    double duration_ = 0;
};

/// Several axes from rest to rest that begin and arrive together; `profiles` has their number.
void restToRestTogether(std::span<const double> from, std::span<const double> to,
                        std::span<const AxisLimits> limits, std::span<AxisProfile> profiles);
/// Several axes between any states that begin and arrive together.
void betweenTogether(std::span<const AxisState> from, std::span<const AxisState> to,
                     std::span<const AxisLimits> limits, std::span<AxisProfile> profiles);

} // namespace motion

#pragma once
// Stage 3 of motion, one dimension: jerk-limited profiles of a path parameter over time. Units are the
// caller's (parameter u, so u/s, u/s^2, u/s^3).

#include <array>

namespace motion {

/// Bounds of the path parameter's derivatives; all positive. deceleration: 0 means as acceleration.
struct ProfileLimits {
    double speed = 0, acceleration = 0, jerk = 0;
    double deceleration = 0;
};

struct ProfileState {
    double s = 0, v = 0, a = 0, j = 0;
};

/// A motion made of phases of constant jerk. Immutable; no allocation.
class Profile {
  public:
    Profile() = default; ///< stands still at 0 for no time

    /// Fastest motion from rest at `from` to rest at `to` >= from: seven phases (fewer where a limit is not
    /// reached).
    static Profile restToRest(double from, double to, const ProfileLimits& limits);
    /// As restToRest, but lasting `duration` s if the limits allow it, else as fast as they allow.
    static Profile withDuration(double from, double to, const ProfileLimits& limits, double duration);
    /// From a state in motion (0 <= v) to rest at `to`, cruising at limits.speed. If the state is too fast to
    /// stop in time under the limits, `feasible` is false and nothing else is meaningful.
    static Profile continueTo(const ProfileState& start, double to, const ProfileLimits& limits,
                              bool& feasible);
    /// From a state in motion to rest as soon as the limits allow; the place follows.
    static Profile brake(const ProfileState& start, const ProfileLimits& limits);

    /// Stands still at 0 for `duration` s.
    static Profile pause(double duration);

    double duration() const { return duration_; } ///< s
    ProfileState at(double time) const;           ///< clamped to [0, duration]
    double end() const { return end_; }           ///< final s
    double peakSpeed() const;                     ///< highest v
    /// Earliest time at which s is reached; s is clamped. Monotone in s.
    double timeAt(double s) const;

  private:
    struct Phase {
        double start = 0; // s, since the beginning of the profile
        ProfileState state;
    };
    void append(double length, double jerk);
    void finish(double to);

    static constexpr int kMaxPhases = 12;
    std::array<Phase, kMaxPhases> phases_{};
    int count_ = 0;
    ProfileState tip_;
    double duration_ = 0;
    double end_ = 0;
};

} // namespace motion

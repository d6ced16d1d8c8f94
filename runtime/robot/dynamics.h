#pragma once
// Dynamics of an arm as motion planning needs them: how fast each axis may accelerate in a posture, and how the
// controller smooths speed in time. Figures belong to the model (data file) or are derived from its size and speeds.

#include "runtime/robot/angles.h"
#include "runtime/robot/expected.h"
#include "runtime/robot/frames.h"

#include <algorithm>
#include <array>

namespace robot {

struct OpwParameters;
struct RobotModel;

/// Greatest acceleration of one axis, rad/s^2: a constant torque over an inertia that depends on the posture,
/// scale * min(cap, 1 / (base + elbow * xe^2 + wrist * xw^2 + reach * d^2)), lengths in m: xe and xw are the
/// horizontal distances of elbow and wrist centre from axis 1, d the distance of the wrist centre from axis 2.
struct AccelerationLimit {
    double scale = 1;
    double cap = 0;
    double base = 0, elbow = 0, wrist = 0, reach = 0; ///< all 0: the cap alone
};

struct Dynamics {
    static constexpr std::size_t kAxes = 7;
    std::array<AccelerationLimit, kAxes> axes{};
    double longWindow = 0;  ///< s, first moving average of the speed along the path
    double shortWindow = 0; ///< s, second one
    double load =
        0; ///< kg the arm carried when the accelerations were identified: no less is available with them
    /// mrad between motor and arm when the axis takes its greatest acceleration; 0 where no recording gave it.
    std::array<double, kAxes> motorDeflection{};
    bool isGiven() const { return axes[0].cap > 0; }
};

/// Estimates for a model whose data file gives no dynamics: between those identified for an IRB 1200-5/0.9 and an IRB
/// 6640-180/2.55, by reach.
Dynamics estimatedDynamics(const RobotModel& model);

/// The limits in force in one posture, deg/s^2, for the axes of the model. `degrees`: its axis angles.
class AccelerationMap {
  public:
    AccelerationMap() = default;
    explicit AccelerationMap(const RobotModel& model);
    /// `Angles`: any sequence of axis angles in degrees; `out` has the same length.
    template <class Angles> void limitsAt(const Angles& degrees, Angles& out) const {
        const Arm arm = armAt(degrees[1], degrees.size() > 2 ? degrees[2] : 0);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = limit(dynamics_.axes[i], arm);
    }

    const Dynamics& dynamics() const { return dynamics_; }

  private:
    struct Arm {
        double elbow2 = 0, wrist2 = 0, reach2 = 0; // squares, m^2
    };
    Arm armAt(double axis2, double axis3) const;
    static double limit(const AccelerationLimit& axis, const Arm& arm) {
        const double inertia =
            axis.base + axis.elbow * arm.elbow2 + axis.wrist * arm.wrist2 + axis.reach * arm.reach2;
        const double most = inertia > 0 ? 1 / inertia : axis.cap;
        return axis.scale * (axis.cap > 0 ? std::min(axis.cap, most) : most) / kDeg;
    }

    Dynamics dynamics_;
    double a1_ = 0, a2_ = 0, c2_ = 0, c3_ = 0; // m
};

} // namespace robot

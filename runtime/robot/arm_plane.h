#pragma once
// Axes 1 to 3 of an ortho-parallel arm in closed form: which angles carry a given point of the forearm to a given place.
// Shared by the mechanisms whose wrist differs. Internal to runtime/robot.
//
// Model angles: all zero with the upper arm vertical and the forearm horizontal. In the plane of the arm (r outward,
// z up) the upper arm points to angle q2 from z towards r, the forearm is turned by q2 + q3.

#include "runtime/robot/fast_trig.h"
#include "runtime/robot/frames.h"
#include "runtime/robot/robot_model.h"

#include <algorithm>
#include <cmath>

namespace robot {

inline constexpr double kFreeArm = 1e-6;          ///< mm; wrist centre on axis 1
inline constexpr double kOutstretched = 1 + 1e-9; ///< rounding of a target exactly at full reach

/// The point to be reached, usually the wrist centre, taken apart once for all branches.
struct ArmTarget {
    double x = 0, y = 0, z = 0;
    double square = 0, radius = 0;       ///< distance from axis 1, squared, and along the arm plane
    double freeSine = 0, freeCosine = 1; ///< axis 1 where the point lies on it
    bool isArmFree = false;
};

/// Sines and cosines of one branch of axes 1 to 3.
struct ArmBranch {
    double sine1 = 0, cosine1 = 1;
    double sine2 = 0, cosine2 = 1;
    double sineEta = 0, cosineEta = 1; ///< from upper arm to the point
    double sine23 = 0, cosine23 = 1;

    Vec3 forearmX() const { return {cosine1 * cosine23, sine1 * cosine23, -sine23}; }
    Vec3 forearmY() const { return {-sine1, cosine1, 0}; }
    Vec3 forearmZ() const { return {cosine1 * sine23, sine1 * sine23, cosine23}; }
};

/// Lengths in mm. The point is carried at (along, up) from axis 3 in the axes x, z of the forearm.
struct ArmPlane {
    double a1 = 0, b = 0, c1 = 0, c2 = 0;
    double along = 0, up = 0;
    double forearm = 0;          ///< distance of the point from axis 3
    double sine = 0, cosine = 1; ///< of the angle from the upper arm to that line with axis 3 at 0
    double angleDeg = 0;

    ArmPlane() = default;
    ArmPlane(const OpwParameters& g, double sideways, double pointAlong, double pointUp)
        : a1(g.a1), b(sideways), c1(g.c1), c2(g.c2), along(pointAlong), up(pointUp) {
        forearm = std::hypot(along, up);
        if (!(forearm > 0)) return;
        sine = along / forearm;
        cosine = up / forearm;
        angleDeg = std::atan2(sine, cosine) / kDeg;
    }

    /// Distance of the point from axis 1 along the arm plane; negative: behind axis 1.
    double radius(double sine2, double sine23, double cosine23) const {
        return a1 + c2 * sine2 + along * cosine23 + up * sine23;
    }

    /// If the point lies on axis 1, that axis is at `axis1Deg`. False when the point is too near to axis 1 for
    /// the sideways offset, even for figures that are not numbers.
    bool aim(const Vec3& point, double axis1Deg, ArmTarget& target) const {
        target.x = point.x;
        target.y = point.y;
        target.z = point.z;
        target.square = point.x * point.x + point.y * point.y;
        const double inPlane = target.square - b * b;
        if (!(inPlane >= 0)) return false;
        target.radius = std::sqrt(inPlane);
        target.isArmFree = target.square < kFreeArm * kFreeArm;
        if (target.isArmFree) {
            target.freeSine = std::sin(axis1Deg * kDeg);
            target.freeCosine = std::cos(axis1Deg * kDeg);
        }
        return true;
    }

    /// Cosine of the angle from the upper arm to the point; beyond 1 or -1 the point is out of reach.
    double reachCosine(const ArmTarget& target, int shoulder) const {
        const double outward = (shoulder == 0 ? target.radius : -target.radius) - a1;
        const double upward = target.z - c1;
        return (outward * outward + upward * upward - c2 * c2 - forearm * forearm) / (2 * c2 * forearm);
    }

    /// Branch with the point before (shoulder 0) or behind (1) axis 1, elbow up (0) or down (1).
    bool solve(const ArmTarget& target, int shoulder, int elbow, ArmBranch& arm) const {
        const double side = shoulder == 0 ? 1.0 : -1.0;
        const double r = side * target.radius;
        if (target.isArmFree) {
            arm.sine1 = side * target.freeSine;
            arm.cosine1 = side * target.freeCosine;
        } else {
            const double scale = 1.0 / target.square;
            arm.sine1 = (target.y * r - target.x * b) * scale;
            arm.cosine1 = (target.x * r + target.y * b) * scale;
        }
        const double outward = r - a1;
        const double upward = target.z - c1;
        const double square = outward * outward + upward * upward;
        const double cosineEta = (square - c2 * c2 - forearm * forearm) / (2 * c2 * forearm);
        if (!(std::fabs(cosineEta) <= kOutstretched) || square < 1e-12) return false;
        arm.cosineEta = std::clamp(cosineEta, -1.0, 1.0);
        arm.sineEta = std::sqrt(1 - arm.cosineEta * arm.cosineEta) * (elbow == 0 ? 1.0 : -1.0);
        const double reach = c2 + forearm * arm.cosineEta;
        const double across = forearm * arm.sineEta;
        const double scale = 1.0 / square;
        arm.sine2 = (reach * outward - across * upward) * scale;
        arm.cosine2 = (reach * upward + across * outward) * scale;
        const double sineArm = (outward - c2 * arm.sine2) / forearm;
        const double cosineArm = (upward - c2 * arm.cosine2) / forearm;
        arm.sine23 = sineArm * cosine - cosineArm * sine;
        arm.cosine23 = cosineArm * cosine + sineArm * sine;
        return true;
    }
};

} // namespace robot

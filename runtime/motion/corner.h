#pragma once
// Corner: the curve that replaces two legs inside the zone of a fly-by point, and the blends of orientation and external
// axes over zones of their own (manual 2.2.3; shape: docs/motion.md).

#include "runtime/motion/length_map.h"
#include "runtime/motion/targets.h"

#include <array>
#include <cstdint>

namespace motion {

/// Bezier curve in any space with + and * by a number: of the third degree with the first four points or, smooth, of the
/// fifth degree with all of them.
template <class Point> struct Bezier {
    std::array<Point, 6> p{};
    bool isSmooth = false;
    Point at(double x) const {
        const double y = 1 - x;
        if (isSmooth) {
            const double xx = x * x, yy = y * y;
            return p[0] * (yy * yy * y) + p[1] * (5 * yy * yy * x) + p[2] * (10 * yy * y * xx) +
                   p[3] * (10 * yy * xx * x) + p[4] * (5 * y * xx * xx) + p[5] * (xx * xx * x);
        }
        return p[0] * (y * y * y) + p[1] * (3 * y * y * x) + p[2] * (3 * y * x * x) + p[3] * (x * x * x);
    }
    Point slopeAt(double x) const {
        const double y = 1 - x;
        if (isSmooth) {
            const double xx = x * x, yy = y * y;
            return (p[1] - p[0]) * (5 * yy * yy) + (p[2] - p[1]) * (20 * yy * y * x) +
                   (p[3] - p[2]) * (30 * yy * xx) + (p[4] - p[3]) * (20 * y * xx * x) +
                   (p[5] - p[4]) * (5 * xx * xx);
        }
        return (p[1] - p[0]) * (3 * y * y) + (p[2] - p[1]) * (6 * y * x) + (p[3] - p[2]) * (3 * x * x);
    }
};

/// How far the inner control points lie from the ends, as a share of the zone radius; identified on recordings.
inline constexpr double kCornerTension = 0.757;
/// The same between the control points of a smooth curve, which then passes the programmed point at the same distance. At
/// its ends it bends as the legs do, so that the axes need no sudden change of acceleration.
inline constexpr double kSmoothTension = 0.48 * kCornerTension;

/// The place of the arm angle of a seven-axis arm in the vector below: that of external axis a, which it leaves free.
inline constexpr std::size_t kArmAnglePlace = robot::kMostJoints;
/// Angles of all axes in one vector, for curves in joint space.
struct AxisVector {
    std::array<double, 7 + kExternalCount> v{};
    friend AxisVector operator+(AxisVector a, const AxisVector& b) {
        for (std::size_t i = 0; i < a.v.size(); ++i)
            a.v[i] += b.v[i];
        return a;
    }
    friend AxisVector operator*(AxisVector a, double k) {
        for (double& x : a.v)
            x *= k;
        return a;
    }
    friend AxisVector operator-(const AxisVector& a, const AxisVector& b) { return a + b * -1.0; }
    /// Axes that are not connected have no angle.
    friend double dot(const AxisVector& a, const AxisVector& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.v.size(); ++i)
            if (std::isfinite(a.v[i] * b.v[i])) sum += a.v[i] * b.v[i];
        return sum;
    }
};

/// A quantity that leaves the course of the first leg some way before the corner and joins that of the second some way
/// after it.
template <class Point> struct Blend {
    double before = 0, after = 0; ///< mm of path, measured on the legs as programmed
    double begin = 0, end = 0;    ///< places on the route
    double tension = kCornerTension;
    Bezier<Point> curve;
    bool covers(double s) const { return before > 0 && s > begin && s < end; }
    Point at(double s) const { return curve.at(parameter(s)); }

  private:
    /// The curve's parameter, so that the quantity leaves and joins the legs at the rate it has there.
    double parameter(double s) const {
        const double length = end - begin;
        const double wanted = (s - begin) / length;
        Bezier<double> way;
        const double first = tension * before / length;
        const double last = tension * after / length;
        way.isSmooth = curve.isSmooth;
        if (way.isSmooth)
            way.p = {0.0, first, 2 * first, 1 - 2 * last, 1 - last, 1.0};
        else
            way.p = {0.0, std::min(first, 1.0), std::max(1 - last, 0.0), 1.0};
        double low = 0;
        double high = 1;
        double x = wanted;
        for (int i = 0; i < 60 && high - low > 1e-15; ++i) {
            const double miss = way.at(x) - wanted;
            if (std::abs(miss) < 1e-15) break;
            (miss < 0 ? low : high) = x;
            const double slope = way.slopeAt(x);
            const double newton = slope > 0 ? x - miss / slope : low;
            x = newton > low && newton < high ? newton : 0.5 * (low + high);
        }
        return x;
    }
};

/// On stretches where the TCP hardly moves a degree of turning, or a unit of an external axis, counts as this many mm.
inline constexpr double kMmPerDegree = 0.2;
/// When a stop point is reached, a degree of turning or a unit of an external axis counts as this many mm that are left.
inline constexpr double kMmLeftPerDegree = 2;
/// mm of route per unit of a parameter by which the TCP moves `mm` and the rest turns `degrees`: those of the TCP, unless
/// it moves less than that much turning counts.
double pathRate(double mm, double degrees);
/// mm of route at the end of such a movement that count as a mm that is left.
double perMmLeft(double mm, double degrees);
/// Sets the external axes that are connected.
void takeExternal(const AxisVector& axes, ExternalAxes& external);
/// Speeds of the external axes, added.
double externalRate(const AxisVector& slope);
inline constexpr int kCornerPieces = 24; ///< in which the length of a corner's curve is measured
inline constexpr int kAxesPieces = 96;   ///< ... of a curve of the axes, on which the TCP's rate varies more

enum class CornerKind : uint8_t {
    None,  ///< the legs meet in the point itself
    Space, ///< curve of the TCP, in the object frame of the second leg
    Joint, ///< curve of all axes: between joint moves, at a change of tool, or where axes would jump
};

struct Corner {
    CornerKind kind = CornerKind::None;
    bool isSmooth = false;        ///< its curves bend at their ends as the legs do
    double before = 0, after = 0; ///< mm of path cut off the two legs
    double begin = 0;             ///< place on the route
    LengthMap lengths;            ///< of the curve
    /// Least mm of route per unit of the parameter half way along the curve; 0 unless the path turns back on itself. The TCP comes to rest
    /// there: with mm of TCP path alone its velocity would change from one moment to the next.
    double reversalRate = 0;
    Bezier<Vec3> space;
    Bezier<AxisVector> axes;
    Quat centre;         ///< orientation at the programmed point
    Blend<Vec3> turn;    ///< rotation vectors relative to `centre`, rad
    double armAngle = 0; ///< seven axes: arm angle at the programmed point, deg
    Blend<AxisVector>
        external; ///< external axes and, in the place of the first one, the arm angle of seven axes
    /// mm of route per unit of the parameter where the TCP covers `mm`.
    double routeRate(double parameter, double mm) const;
    double length() const { return kind == CornerKind::None ? 0 : lengths.length(); }
    double end() const { return begin + length(); }
    double halfLength = 0; ///< mm of the curve up to the middle of its parameter
    double middle() const {
        return begin + halfLength;
    } ///< place of the programmed point: half way along the curve's parameter
};

} // namespace motion

// Seven axes whose neighbours all cross at right angles with offsets (IRB 14000, IRB 14050). The arm angle fixes the
// half plane through shoulder and wrist in which axis 3 points. Everything follows from five angles: axes 1 and 2 give
// the line of the upper arm, axes 5 and 6 (seen from the flange) the line of the forearm, the fifth the direction of axis
// 3 in its half plane. Axis 3 is perpendicular to both lines, and the arm must close: five equations.
//
// Chain from the base: axes 1, 2, 7, 3, 4, 5, 6. Directions at zero: z, y, z, y, x, y, x. See SevenAxisGeometry.

#include "runtime/robot/fast_trig.h"
#include "runtime/robot/mechanism.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace robot {

namespace {

constexpr std::size_t kOrder[7] = {0, 1, 6, 2, 3, 4, 5}; // place in the chain -> index into Joints
constexpr double kMm = 0.01;                             // weight of a millimetre against a direction cosine
constexpr double kSolved = 1e-14;                        // residual of rounding
constexpr double kAccepted = 1e-10;                      // residual of a solution beside a singularity
constexpr double kSamePlace = 0.5; // rad; a start as near as this to a solution would lead to it
constexpr double kLeastBend = 0.2; // rad; a start with the arm stretched would not know which way to bend

constexpr double kBesideSingular = 0.3; // sine of axis 2 or 5 from which on its neighbour is guessed well
constexpr double kNearSingular = 0.2;   // ... and up to which solutions crowd
constexpr double kBetween =
    0.1; // rad; as near as this to a solution nothing is looked for between two of them
constexpr int kPlacesAround = 8; // at which that neighbour is tried

constexpr std::size_t kUnknowns = 5;
constexpr int kJudged = 4;        // iterations after which a start that leads nowhere is given up ...
constexpr double kHopeless = 0.1; // ... when this residual is left
constexpr double kArriving =
    0.05; // rad; nearer than this to a solution, with less than this residual: it leads there

/// The five angles, rad: axis 1, axis 2, axis 5, axis 6, axis 3 from the line shoulder-wrist into its half plane.
struct Ends {
    double t[kUnknowns] = {};
};

/// Solutions that are known, as their five angles.
struct Found {
    std::array<Ends, kMostBranches> ends;
    std::size_t count = 0;
    bool hasNear(const Ends& wanted, double distance) const {
        for (std::size_t n = 0; n < count; ++n) {
            double largest = 0;
            for (std::size_t k = 0; k < kUnknowns; ++k) {
                const double turns = (wanted.t[k] - ends[n].t[k]) * (0.5 / std::numbers::pi);
                largest = std::max(largest, std::fabs(turns - std::nearbyint(turns)));
            }
            if (2 * std::numbers::pi * largest < distance) return true;
        }
        return false;
    }
};

/// The same lines but for the offsets, with the shoulder (axes 1, 2) or the wrist (axes 5, 6) turned over.
Ends flipped(Ends ends, bool shoulder, bool wrist) {
    if (shoulder) {
        ends.t[0] += std::numbers::pi;
        ends.t[1] = -ends.t[1];
    }
    if (wrist) {
        ends.t[2] = -ends.t[2];
        ends.t[3] += std::numbers::pi;
    }
    return ends;
}

/// A share of the short way from one to the other, both beside the singularity of shoulder (angle 1) or wrist (angle 2): the
/// link goes straight there, past the axis about which its neighbour (angle 0 or 3) turns it.
Ends between(const Ends& from, const Ends& to, double share, std::size_t singular) {
    Ends ends = from;
    for (std::size_t k = 0; k < kUnknowns; ++k)
        ends.t[k] += share * std::remainder(to.t[k] - from.t[k], 2 * std::numbers::pi);
    const std::size_t neighbour = singular == 1 ? 0 : 3;
    const auto mixed = [&](double a, double b) { return a + share * (b - a); };
    const double x = mixed(std::sin(from.t[singular]) * std::cos(from.t[neighbour]),
                           std::sin(to.t[singular]) * std::cos(to.t[neighbour]));
    const double y = mixed(std::sin(from.t[singular]) * std::sin(from.t[neighbour]),
                           std::sin(to.t[singular]) * std::sin(to.t[neighbour]));
    const double side = std::sin(from.t[singular]) < 0 ? -1 : 1;
    ends.t[neighbour] = std::atan2(side * y, side * x);
    const double turn = side * std::asin(std::min(1.0, std::hypot(x, y)));
    ends.t[singular] = std::cos(from.t[singular]) < 0 ? std::numbers::pi - turn : turn;
    return ends;
}

/// Pose and arm angle taken apart once.
struct SevenAxesTarget {
    Vec3 shoulder, wrist;
    Vec3 x, y, z; // of the flange, turned so that x is the direction of axis 6 and y, z are level at zero
    Vec3 line;    // from shoulder to wrist, unit
    Vec3 half;    // perpendicular to it, into the half plane of axis 3
    double distance = 0;
};

/// The two lines at given ends, and what they leave open.
struct Lines {
    Vec3 x1, y1, x2, s; // axis 1 turned; upper arm direction s
    Vec3 y6, z5, z6, f; // wrist; forearm direction f
    Vec3 axis3;         // its direction
    Vec3 axis3Turned;   // derivative of that by the fifth angle
    double sine2 = 0, cosine2 = 1, sine5 = 0, cosine5 = 1;
    bool onHalf = true; // axis 3 is in its half plane, not in the opposite one
    double residual[kUnknowns] = {};
    double size() const {
        double largest = 0;
        for (double r : residual)
            largest = std::max(largest, std::fabs(r));
        return largest;
    }
};

class SevenAxes final : public Mechanism {
  public:
    explicit SevenAxes(const RobotModel& model) : Mechanism(model), g_(model.sevenAxes) {
        quarterShift_ = 45; // as programs of these robots show
    }
    Pose forward(const Joints& joints) const override;
    void inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                    IkBranches& out) const override;
    bool inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                         Joints& out) const override;
    ConfData configuration(const Joints& joints) const override;
    bool namesBranch(int cfx) const override { return cfx >= 0 && cfx <= 7; }
    Singularity singularity(const Joints& joints) const override;
    JacobianMatrix jacobian(const Joints& joints) const override;
    double armAngle(const Joints& joints) const override;

  protected:
    double side(const Joints& joints) const override;

  private:
    struct Chain {
        Vec3 axes[7], pivots[7];
        Vec3 x, y, z, flange; // axes of the last frame, x out of the flange
    };
    Chain chainOf(const Joints& joints) const;
    bool referenceAxes(const Vec3& line, Vec3& x, Vec3& y) const;
    bool takeApart(const Pose& flange, double armAngleDeg, SevenAxesTarget& target) const;
    void linesAt(const SevenAxesTarget& target, const Ends& ends, Lines& lines) const;
    void equations(const Lines& l, double (&matrix)[kMostJoints][kMostJoints]) const;
    Ends weakDirection(const SevenAxesTarget& target, const Ends& ends) const;
    bool polish(const SevenAxesTarget& target, Ends& ends, Lines& lines, int iterations,
                const Found* known = nullptr) const;
    void toJoints(const Ends& ends, const Lines& lines, Joints& out) const;
    double stretchedDeg() const {
        return (std::atan2(g_.elbowOut, g_.upperArm) + std::atan2(g_.elbowUp, g_.forearm)) / kDeg - 90.0;
    }
    void start(const SevenAxesTarget& target, double tilt, int branch, Ends& ends) const;
    Ends endsOf(const SevenAxesTarget& target, const Joints& joints) const;
    void add(const Ends& ends, const Lines& lines, Found& found, IkBranches& out) const;

    SevenAxisGeometry g_;
};

/// Turns two axes of a frame by an angle: from a towards b.
void turn(Vec3& a, Vec3& b, double sine, double cosine) {
    const Vec3 turned = a * cosine + b * sine;
    b = b * cosine - a * sine;
    a = turned;
}

SevenAxes::Chain SevenAxes::chainOf(const Joints& joints) const {
    double angles[7];
    for (std::size_t k = 0; k < 7; ++k)
        angles[k] = modelAngle(joints, kOrder[k]);
    double s[7];
    double c[7];
    trig::sinCosDeg(angles, s, c);
    Chain chain;
    Vec3 x{1, 0, 0};
    Vec3 y{0, 1, 0};
    Vec3 z{0, 0, 1};
    Vec3 at{0, 0, g_.base};
    const auto joint = [&](std::size_t k, const Vec3& axis) {
        chain.axes[k] = axis;
        chain.pivots[k] = at;
    };
    joint(0, z);
    turn(x, y, s[0], c[0]);
    at = at + x * g_.shoulder;
    joint(1, y);
    turn(z, x, s[1], c[1]);
    at = at - x * g_.shoulder + z * g_.upperArm;
    joint(2, z);
    turn(x, y, s[2], c[2]);
    at = at + x * g_.elbowOut;
    joint(3, y);
    turn(z, x, s[3], c[3]);
    at = at + x * g_.forearm + z * g_.elbowUp;
    joint(4, x);
    turn(y, z, s[4], c[4]);
    at = at + z * g_.wrist;
    joint(5, y);
    turn(z, x, s[5], c[5]);
    at = at - z * g_.wrist;
    joint(6, x);
    turn(y, z, s[6], c[6]);
    chain.flange = at + x * g_.flange;
    chain.x = x;
    chain.y = y;
    chain.z = z;
    return chain;
}

Pose SevenAxes::forward(const Joints& joints) const {
    const Chain chain = chainOf(joints);
    return {chain.flange, fromColumns(chain.z * -1.0, chain.y, chain.x)};
}

/// Axes against which the arm angle is measured: both perpendicular to the line from shoulder to wrist. RobotStudio
/// counts from -(line x reference) towards the reference. False where the line is along the reference.
bool SevenAxes::referenceAxes(const Vec3& line, Vec3& x, Vec3& y) const {
    y = g_.armAngleReference - line * dot(g_.armAngleReference, line);
    const double length = norm(y);
    if (!(length > 1e-9)) return false;
    y = y * (1 / length);
    x = cross(y, line);
    return true;
}

double SevenAxes::armAngle(const Joints& joints) const {
    const Chain chain = chainOf(joints);
    const Vec3 offset = chain.pivots[6] - chain.pivots[0];
    const double distance = norm(offset);
    Vec3 x;
    Vec3 y;
    if (!(distance > 0) || !referenceAxes(offset * (1 / distance), x, y)) return 0;
    return std::atan2(dot(y, chain.axes[3]), dot(x, chain.axes[3])) / kDeg;
}

bool SevenAxes::takeApart(const Pose& flange, double armAngleDeg, SevenAxesTarget& target) const {
    target.x = column(flange.rot, 2);
    target.y = column(flange.rot, 1);
    target.z = column(flange.rot, 0) * -1.0;
    target.shoulder = {0, 0, g_.base};
    target.wrist = flange.pos - target.x * g_.flange;
    const Vec3 offset = target.wrist - target.shoulder;
    target.distance = norm(offset);
    const double reach = std::hypot(g_.upperArm, g_.elbowOut) + std::hypot(g_.forearm, g_.elbowUp) +
                         2 * std::fabs(g_.shoulder) + 2 * std::fabs(g_.wrist);
    if (!(target.distance > 1e-9) || !(target.distance < reach) || !std::isfinite(armAngleDeg)) return false;
    target.line = offset * (1 / target.distance);
    Vec3 x;
    Vec3 y;
    if (!referenceAxes(target.line, x, y)) return false;
    const double angle = armAngleDeg * kDeg;
    target.half = x * std::cos(angle) + y * std::sin(angle);
    return std::isfinite(dot(target.half, target.x));
}

void SevenAxes::linesAt(const SevenAxesTarget& target, const Ends& ends, Lines& l) const {
    double degrees[kUnknowns];
    for (std::size_t k = 0; k < kUnknowns; ++k)
        degrees[k] = ends.t[k] / kDeg;
    double s[kUnknowns];
    double c[kUnknowns];
    trig::sinCosDeg(degrees, s, c);
    const Vec3 up{0, 0, 1};
    l.x1 = {c[0], s[0], 0};
    l.y1 = {-s[0], c[0], 0};
    l.sine2 = s[1];
    l.cosine2 = c[1];
    l.s = l.x1 * s[1] + up * c[1];
    l.x2 = l.x1 * c[1] - up * s[1];
    l.sine5 = s[2];
    l.cosine5 = c[2];
    l.y6 = target.y * c[3] - target.z * s[3];
    l.z6 = target.y * s[3] + target.z * c[3];
    l.f = target.x * c[2] + l.z6 * s[2];
    l.z5 = l.z6 * c[2] - target.x * s[2];
    l.axis3 = target.line * c[4] + target.half * s[4];
    l.onHalf = s[4] > 0;
    l.axis3Turned = target.half * c[4] - target.line * s[4];
    const Vec3 gap = target.wrist - target.shoulder + (l.z6 - l.z5) * g_.wrist - (l.x1 - l.x2) * g_.shoulder -
                     l.s * g_.upperArm - cross(l.axis3, l.s) * g_.elbowOut - l.f * g_.forearm -
                     cross(l.f, l.axis3) * g_.elbowUp;
    l.residual[0] = gap.x * kMm;
    l.residual[1] = gap.y * kMm;
    l.residual[2] = gap.z * kMm;
    l.residual[3] = dot(l.s, l.axis3);
    l.residual[4] = dot(l.f, l.axis3);
}

/// Derivatives of the residuals by the angles.
void SevenAxes::equations(const Lines& l, double (&matrix)[kMostJoints][kMostJoints]) const {
    // By each angle: the change of s, of f, and of the gap as far as it does not come from these.
    const Vec3 ds[kUnknowns] = {l.y1 * l.sine2, l.x2, {}, {}, {}};
    const Vec3 df[kUnknowns] = {{}, {}, l.z5, l.y6 * l.sine5, {}};
    const Vec3 rest[kUnknowns] = {l.y1 * ((l.cosine2 - 1) * g_.shoulder), l.s * -g_.shoulder, l.f * g_.wrist,
                                  l.y6 * ((1 - l.cosine5) * g_.wrist),
                                  cross(l.axis3Turned, l.s) * -g_.elbowOut -
                                      cross(l.f, l.axis3Turned) * g_.elbowUp};
    for (std::size_t k = 0; k < kUnknowns; ++k) {
        const Vec3 gap = rest[k] - ds[k] * g_.upperArm - cross(l.axis3, ds[k]) * g_.elbowOut -
                         df[k] * g_.forearm - cross(df[k], l.axis3) * g_.elbowUp;
        matrix[0][k] = gap.x * kMm;
        matrix[1][k] = gap.y * kMm;
        matrix[2][k] = gap.z * kMm;
        matrix[3][k] = dot(ds[k], l.axis3);
        matrix[4][k] = dot(df[k], l.axis3);
    }
    matrix[3][4] = dot(l.s, l.axis3Turned);
    matrix[4][4] = dot(l.f, l.axis3Turned);
}

/// With `known` only what leads to another solution than these is followed to its end.
bool SevenAxes::polish(const SevenAxesTarget& target, Ends& ends, Lines& lines, int iterations,
                       const Found* known) const {
    linesAt(target, ends, lines);
    double size = lines.size();
    for (int n = 0; n < iterations && size > kSolved; ++n) {
        double matrix[kMostJoints][kMostJoints];
        double step[kMostJoints];
        equations(lines, matrix);
        for (std::size_t k = 0; k < kUnknowns; ++k)
            step[k] = -lines.residual[k];
        if (!solveLinear(kUnknowns, matrix, step)) break;
        double largest = 0;
        for (std::size_t k = 0; k < kUnknowns; ++k)
            largest = std::max(largest, std::fabs(step[k]));
        if (!(largest < 1e6)) break;
        const double scale = largest > 0.7 ? 0.7 / largest : 1.0;
        for (std::size_t k = 0; k < kUnknowns; ++k)
            ends.t[k] += step[k] * scale;
        linesAt(target, ends, lines);
        const double before = size;
        size = lines.size();
        if (known != nullptr && n == kJudged && size > kHopeless) return false;
        if (known != nullptr && before > kArriving && size < kArriving && known->hasNear(ends, kArriving))
            return false;
        if (size < kAccepted && size >= 0.5 * before) break; // rounding
    }
    return size < kAccepted && lines.onHalf;
}

void SevenAxes::toJoints(const Ends& ends, const Lines& l, Joints& out) const {
    const Vec3 x3 = cross(l.axis3, l.s);
    const Vec3 z4 = cross(l.f, l.axis3);
    const double y[3] = {dot(x3, l.y1), -dot(l.f, l.s), dot(l.y6, z4)};
    const double x[3] = {dot(x3, l.x2), dot(l.f, x3), dot(l.y6, l.axis3)};
    double a[3];
    trig::atan2Deg(y, x, a);
    const double model[7] = {ends.t[0] / kDeg, ends.t[1] / kDeg, a[0], a[1], a[2],
                             ends.t[2] / kDeg, ends.t[3] / kDeg};
    out = Joints::zeros(7);
    for (std::size_t k = 0; k < 7; ++k) {
        const std::size_t i = kOrder[k];
        out[i] = withinLimits(axisAngle(std::remainder(model[k], 360.0), i), i);
    }
}

/// A point near a solution: the arm as if all offsets at shoulder and wrist were taken from a first guess. Bits of
/// `branch`: 0 wrist, 1 elbow, 2 shoulder. `tilt` leans axis 3 out of the plane across the line from shoulder to wrist.
void SevenAxes::start(const SevenAxesTarget& target, double tilt, int branch, Ends& ends) const {
    const Vec3 axis3 = target.half * std::cos(tilt) + target.line * std::sin(tilt);
    const double upper = std::hypot(g_.upperArm, g_.elbowOut);
    const double fore = std::hypot(g_.forearm, g_.elbowUp);
    const double upperSkew = std::atan2(g_.elbowOut, g_.upperArm);
    const double foreSkew = std::atan2(g_.elbowUp, g_.forearm);
    Vec3 from = target.shoulder;
    Vec3 to = target.wrist;
    for (int n = 0; n < 2; ++n) {
        Vec3 along = to - from;
        along = along - axis3 * dot(axis3, along);
        const double distance = std::max(norm(along), 1e-6);
        along = along * (1 / distance);
        const Vec3 across = cross(axis3, along); // a quarter turn about axis 3
        const double cosine = std::clamp(
            (distance * distance + upper * upper - fore * fore) / (2 * upper * distance), -1.0, 1.0);
        const double angle = std::max(std::acos(cosine), kLeastBend);
        const double bend = (branch & 2) != 0 ? angle : -angle;
        const Vec3 elbow = (along * std::cos(bend) + across * std::sin(bend)) * upper;
        Vec3 rest = along * distance - elbow;
        rest = rest * (1 / std::max(norm(rest), 1e-6));
        // Links are skewed against their lines.
        const double upperAngle = bend - upperSkew;
        const Vec3 s = along * std::cos(upperAngle) + across * std::sin(upperAngle);
        const Vec3 f = rest * std::cos(foreSkew) + cross(axis3, rest) * std::sin(foreSkew);
        const double level = std::hypot(s.x, s.y);
        const double shoulder = (branch & 4) != 0 ? -1.0 : 1.0;
        ends.t[0] = std::atan2(shoulder * s.y, shoulder * s.x);
        ends.t[1] = std::atan2(shoulder * level, s.z);
        const double fx = dot(f, target.x);
        const double fy = dot(f, target.y);
        const double fz = dot(f, target.z);
        const double side = (branch & 1) != 0 ? -1.0 : 1.0;
        ends.t[2] = std::atan2(side * std::hypot(fy, fz), fx);
        ends.t[3] = std::atan2(side * fy, side * fz);
        ends.t[4] = std::numbers::pi / 2 - tilt;
        Lines lines;
        linesAt(target, ends, lines);
        from = target.shoulder + (lines.x1 - lines.x2) * g_.shoulder;
        to = target.wrist + (lines.z6 - lines.z5) * g_.wrist;
    }
}

void SevenAxes::add(const Ends& ends, const Lines& lines, Found& found, IkBranches& out) const {
    constexpr double kSame = 2e-7; // rad
    if (found.count >= kMostBranches || found.hasNear(ends, kSame)) return;
    Joints joints;
    toJoints(ends, lines, joints);
    out.add(joints);
    found.ends[found.count++] = ends;
}

Ends SevenAxes::endsOf(const SevenAxesTarget& target, const Joints& joints) const {
    constexpr std::size_t kPlaces[4] = {0, 1, 4, 5};
    Ends ends;
    for (std::size_t k = 0; k < 4; ++k)
        ends.t[k] = modelAngle(joints, kPlaces[k]) * kDeg;
    const double degrees[3] = {modelAngle(joints, 0), modelAngle(joints, 1), modelAngle(joints, 6)};
    double s[3];
    double c[3];
    trig::sinCosDeg(degrees, s, c);
    const Vec3 x2{c[0] * c[1], s[0] * c[1], -s[1]};
    const Vec3 axis3 = Vec3{-s[0], c[0], 0} * c[2] - x2 * s[2];
    ends.t[4] = std::atan2(dot(axis3, target.half), dot(axis3, target.line));
    return ends;
}

void SevenAxes::inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                           IkBranches& out) const {
    out.valid = 0;
    SevenAxesTarget target;
    if (!takeApart(flange, std::isnan(armAngleDeg) ? armAngle(seed) : armAngleDeg, target)) return;
    Found found;
    bool isThorough = false;
    const auto tryFrom = [&](Ends ends) {
        Lines lines;
        if (polish(target, ends, lines, 15, isThorough ? nullptr : &found)) add(ends, lines, found, out);
    };
    // With axis 2 near 0 axis 1 hardly turns the upper arm, and a first guess knows nothing of it; the same with axes 5 and 6.
    const auto tryAround = [&](Ends ends, std::size_t unknown) {
        for (int n = 1; n < kPlacesAround; ++n) {
            ends.t[unknown] += 2 * std::numbers::pi / kPlacesAround;
            if (!found.hasNear(ends, kSamePlace)) tryFrom(ends);
        }
    };
    const auto search = [&](double tilt) {
        for (int branch = 0; branch < 8; ++branch) {
            Ends ends;
            start(target, tilt, branch, ends);
            tryFrom(ends);
            if (std::fabs(std::sin(ends.t[1])) < kBesideSingular) tryAround(ends, 0);
            if (std::fabs(std::sin(ends.t[2])) < kBesideSingular) tryAround(ends, 3);
        }
    };
    // But for the offsets, every solution has three more with shoulder and wrist turned over.
    const auto turnOver = [&] {
        for (std::size_t k = 0; k < found.count; ++k) {
            for (int flip = 1; flip < 4; ++flip) {
                const Ends ends = flipped(found.ends[k], (flip & 1) != 0, (flip & 2) != 0);
                if (!found.hasNear(ends, kSamePlace)) tryFrom(ends);
            }
        }
    };
    // Two solutions beside the same singularity of shoulder or wrist may have two more between them.
    const auto tryBetween = [&](std::size_t singular) {
        const auto isBeside = [&](const Ends& ends) {
            return std::fabs(std::sin(ends.t[singular])) < kNearSingular;
        };
        const std::size_t count = found.count;
        for (std::size_t a = 0; a < count; ++a) {
            for (std::size_t b = a + 1; b < count; ++b) {
                if (!isBeside(found.ends[a]) || !isBeside(found.ends[b])) continue;
                for (const double share : {0.5, 0.25, 0.75}) {
                    const Ends ends = between(found.ends[a], found.ends[b], share, singular);
                    if (!found.hasNear(ends, kBetween)) tryFrom(ends);
                }
            }
        }
    };
    search(0);
    tryFrom(endsOf(target, seed));
    turnOver();
    tryBetween(1);
    tryBetween(2);
    // Solutions come in pairs: an odd number means that one is missing.
    isThorough = true;
    for (double tilt : {0.0, 0.4, -0.4}) {
        if (out.count() % 2 == 0) return;
        search(tilt);
        turnOver();
    }
    for (std::size_t k = 0; out.count() % 2 != 0 && k < found.count; ++k) {
        const Ends ends = found.ends[k];
        const Ends weak = weakDirection(target, ends);
        for (double step : {0.05, -0.05, 0.15, -0.15, 0.4, -0.4}) {
            Ends beside = ends;
            for (std::size_t n = 0; n < kUnknowns; ++n)
                beside.t[n] += step * weak.t[n];
            tryFrom(beside);
        }
    }
}

/// Two solutions that are close to each other lie along the direction that the equations hold least: the answer of
/// their inverse to nearly anything, made a unit.
Ends SevenAxes::weakDirection(const SevenAxesTarget& target, const Ends& ends) const {
    Lines lines;
    linesAt(target, ends, lines);
    double matrix[kMostJoints][kMostJoints];
    equations(lines, matrix);
    double answer[kMostJoints] = {1, 0.7, -0.6, 0.8, 0.5};
    Ends direction;
    if (!solveLinear(kUnknowns, matrix, answer)) return direction;
    double square = 0;
    for (std::size_t n = 0; n < kUnknowns; ++n)
        square += answer[n] * answer[n];
    for (std::size_t n = 0; n < kUnknowns; ++n)
        direction.t[n] = answer[n] / std::sqrt(square);
    return direction;
}

bool SevenAxes::inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                                Joints& out) const {
    const double angle = std::isnan(armAngleDeg) ? armAngle(seed) : armAngleDeg;
    SevenAxesTarget target;
    if (!takeApart(flange, angle, target)) return false;
    Ends ends = endsOf(target, seed);
    Lines lines;
    if (polish(target, ends, lines, 8)) {
        toJoints(ends, lines, out);
        if (turnTowards(seed, out) < kTrustedDeg && side(seed) * side(out) >= 0) return true;
    }
    IkBranches branches;
    inverseAll(flange, seed, angle, branches);
    return nearestOf(branches, seed, out);
}

/// Determinant of the equations at a posture, relative to the lengths of its columns: 0 where pose and arm angle do
/// not hold the axes.
double SevenAxes::side(const Joints& joints) const {
    SevenAxesTarget target;
    if (!takeApart(forward(joints), armAngle(joints), target)) return 0;
    Lines lines;
    linesAt(target, endsOf(target, joints), lines);
    double matrix[kMostJoints][kMostJoints];
    equations(lines, matrix);
    double lengths = 1;
    for (std::size_t k = 0; k < kUnknowns; ++k) {
        double square = 0;
        for (std::size_t row = 0; row < kUnknowns; ++row)
            square += matrix[row][k] * matrix[row][k];
        lengths *= std::sqrt(square);
    }
    return lengths > 0 ? determinant(kUnknowns, matrix) / lengths : 0;
}

ConfData SevenAxes::configuration(const Joints& joints) const {
    int cfx = 0;
    if (joints[1] < -kNoise) cfx |= 4;
    if (std::remainder(modelAngle(joints, 2) - stretchedDeg(), 360.0) < -kNoise) cfx |= 2;
    if (joints[4] < -kNoise) cfx |= 1;
    return quarters(joints, cfx);
}

Singularity SevenAxes::singularity(const Joints& joints) const {
    const Chain chain = chainOf(joints);
    const double bend = std::fabs(std::remainder(modelAngle(joints, 2) - stretchedDeg(), 360.0));
    const Vec3 line = chain.pivots[6] - chain.pivots[0];
    const Vec3& reference = g_.armAngleReference;
    Singularity result;
    result.wristDeg = std::fabs(std::remainder(joints[4], 360.0));
    result.elbowDeg = std::min(bend, 180.0 - bend);
    result.shoulderDeg = std::fabs(std::remainder(joints[1], 360.0));
    result.armAngleDeg = std::atan2(norm(cross(line, reference)), std::fabs(dot(line, reference))) / kDeg;
    result.foldDeg = std::asin(std::min(std::fabs(side(joints)), 1.0)) / kDeg;
    return result;
}

JacobianMatrix SevenAxes::jacobian(const Joints& joints) const {
    const Chain chain = chainOf(joints);
    JacobianMatrix result;
    result.columns = 7;
    for (std::size_t k = 0; k < 7; ++k) {
        const std::size_t i = kOrder[k];
        const Vec3 axis = chain.axes[k] * signs_[i];
        const Vec3 shift = cross(axis, chain.flange - chain.pivots[k]);
        const double entries[6] = {shift.x, shift.y, shift.z, axis.x, axis.y, axis.z};
        for (std::size_t row = 0; row < 6; ++row)
            result(row, i) = entries[row];
    }
    return result;
}

} // namespace

std::shared_ptr<const Mechanism> makeSevenAxes(const RobotModel& model) {
    return std::make_shared<SevenAxes>(model);
}

} // namespace robot

// Inverse of an ortho-parallel arm whose axis 6 passes axis 5 at a distance. With the angle of axis 6 given, the foot of
// axis 5 and with it axes 1 to 3 are known in closed form (four branches), and one condition is left: axis 5 is
// perpendicular to the forearm. Its roots over one turn of axis 6 are all solutions.

#include "runtime/robot/six_axes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace robot {

namespace {

constexpr int kGrid = 96; // intervals of axis 6 that are looked at first
constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kMostDepth = 12;         // halvings of an interval in which the forearm turns fast
constexpr double kFastTurn = 0.15;     // change of the forearm direction that asks for a halving
constexpr double kTrustedSlope = 0.02; // slope of the condition below which two solutions are close

struct OffsetTarget {
    Vec3 x, y, z; // columns of the flange orientation
    Vec3 foot;    // of axis 6 on the common perpendicular with axis 5
    double axis1Deg = 0;
};

/// The condition of one branch at one angle of axis 6.
struct Sample {
    double angle = 0; // rad
    bool isValid = false;
    double value = 0; // cosine of the angle between axis 5 and the forearm: 0 is wanted
    Vec3 forearm;     // its direction
};

struct GridAngles {
    double sine[kGrid], cosine[kGrid];
    GridAngles() {
        for (int i = 0; i < kGrid; ++i) {
            sine[i] = std::sin(kTurn * i / kGrid);
            cosine[i] = std::cos(kTurn * i / kGrid);
        }
    }
};

class OffsetWrist final : public SixAxes {
  public:
    using SixAxes::SixAxes;
    void inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                    IkBranches& out) const override;
    bool inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                         Joints& out) const override;

  protected:
    bool namesBranch(int) const override { return false; }
    double side(const Joints& joints) const override { return jacobianDeterminant(joints); }

  private:
    friend class RootSearch;
    OffsetTarget takeApart(const Pose& flange, const Joints& seed) const;
    /// The wrist at sine and cosine of axis 6: directions of the offset and of axis 5, and the arm's target.
    bool wristAt(const OffsetTarget& target, double sine, double cosine, Vec3& axis5, ArmTarget& arm) const;
    Sample sampleAt(const OffsetTarget& target, int branch, double angle) const;
    bool solution(const OffsetTarget& target, int branch, double angle, Joints& out) const;
};

/// All roots of one branch.
class RootSearch {
  public:
    RootSearch(const OffsetWrist& wrist, const OffsetTarget& target, int branch, IkBranches& out)
        : wrist_(wrist), target_(target), branch_(branch), out_(out) {}

    /// Between two neighbouring samples, one of them valid at least.
    void between(const Sample& a, const Sample& b, int depth = kMostDepth);
    /// Around three invalid samples whose middle one is nearest to being in reach.
    void island(double from, double to);

  private:
    Sample at(double angle) const { return wrist_.sampleAt(target_, branch_, angle); }
    /// Last valid sample towards an invalid angle.
    Sample edge(Sample valid, double invalid) const;
    void fromEdge(const Sample& edge, const Sample& inside, int depth);
    void refine(Sample a, Sample b, int depth);
    void minimum(const Sample& a, const Sample& b, int depth);
    double slope(const Sample& a, double towards) const;
    double lack(double angle) const;
    void found(double angle);

    const OffsetWrist& wrist_;
    const OffsetTarget& target_;
    int branch_;
    IkBranches& out_;
};

OffsetTarget OffsetWrist::takeApart(const Pose& flange, const Joints& seed) const {
    OffsetTarget target{
        column(flange.rot, 0), column(flange.rot, 1), column(flange.rot, 2), {}, modelAngle(seed, 0)};
    target.foot = flange.pos - target.z * geometry_.c4;
    return target;
}

bool OffsetWrist::wristAt(const OffsetTarget& target, double sine, double cosine, Vec3& axis5,
                          ArmTarget& arm) const {
    axis5 = target.y * cosine + target.x * sine;
    const Vec3 offset = target.y * sine - target.x * cosine;
    return plane_.aim(target.foot - offset * wristOffset_, target.axis1Deg, arm);
}

Sample OffsetWrist::sampleAt(const OffsetTarget& target, int branch, double angle) const {
    Sample sample;
    sample.angle = angle;
    Vec3 axis5;
    ArmTarget aim;
    ArmBranch arm;
    sample.isValid = wristAt(target, std::sin(angle), std::cos(angle), axis5, aim) &&
                     plane_.solve(aim, branch >> 1, branch & 1, arm);
    if (!sample.isValid) return sample;
    sample.forearm = arm.forearmX();
    sample.value = dot(axis5, sample.forearm);
    return sample;
}

bool OffsetWrist::solution(const OffsetTarget& target, int branch, double angle, Joints& out) const {
    const double sine = std::sin(angle);
    const double cosine = std::cos(angle);
    Vec3 axis5;
    ArmTarget aim;
    ArmBranch arm;
    if (!wristAt(target, sine, cosine, axis5, aim) || !plane_.solve(aim, branch >> 1, branch & 1, arm))
        return false;
    const Vec3 offset = target.y * sine - target.x * cosine;
    const double y[6] = {
        arm.sine1, arm.sine2, arm.sineEta, dot(axis5, arm.forearmZ()), dot(offset, arm.forearmX()), sine};
    const double x[6] = {
        arm.cosine1, arm.cosine2, arm.cosineEta, dot(axis5, arm.forearmY()), dot(target.z, arm.forearmX()),
        cosine};
    double a[6];
    trig::atan2Deg(y, x, a);
    toAxes({a[0], a[1], a[2] - plane_.angleDeg, a[3], a[4], a[5]}, out);
    return true;
}

void RootSearch::found(double angle) {
    Joints joints;
    if (!wrist_.solution(target_, branch_, angle, joints)) return;
    for (int k = 0; k < static_cast<int>(kMostBranches); ++k) {
        if (!out_.has(k)) continue;
        const Joints& other = out_.joints[static_cast<std::size_t>(k)];
        double largest = 0;
        for (std::size_t i = 0; i < 6; ++i)
            largest = std::max(largest, std::fabs(std::remainder(other[i] - joints[i], 360.0)));
        if (largest < 1e-6) return; // where two branches meet
    }
    out_.add(joints);
}

Sample RootSearch::edge(Sample valid, double invalid) const {
    for (int n = 0; n < 45; ++n) {
        const Sample middle = at(0.5 * (valid.angle + invalid));
        if (middle.isValid)
            valid = middle;
        else
            invalid = middle.angle;
    }
    return valid;
}

double RootSearch::slope(const Sample& a, double towards) const {
    const Sample b = at(a.angle + 1e-3 * (towards - a.angle));
    return b.isValid ? (b.value - a.value) / (b.angle - a.angle) : 0;
}

/// At the edge of the reach the forearm turns like a root of the distance: steps that grow like a square see it evenly.
void RootSearch::fromEdge(const Sample& edge, const Sample& inside, int depth) {
    Sample last = edge;
    for (const double share : {0.0625, 0.25, 0.5625}) {
        const Sample next = at(edge.angle + share * (inside.angle - edge.angle));
        if (!next.isValid) continue;
        between(last, next, depth);
        last = next;
    }
    between(last, inside, depth);
}

void RootSearch::between(const Sample& a, const Sample& b, int depth) {
    if (!a.isValid && !b.isValid) return;
    if (a.angle > b.angle) return between(b, a, depth);
    if (!a.isValid) return fromEdge(edge(b, a.angle), b, depth);
    if (!b.isValid) return fromEdge(edge(a, b.angle), a, depth);
    const Vec3 turn = b.forearm - a.forearm;
    const double width = b.angle - a.angle;
    const double change = std::sqrt(dot(turn, turn));
    if (change > kFastTurn && depth > 0) {
        const Sample middle = at(0.5 * (a.angle + b.angle));
        between(a, middle, depth - 1);
        return between(middle, b, depth - 1);
    }
    if ((a.value < 0) != (b.value < 0)) return refine(a, b, depth);
    // Two roots between samples of one sign: only where the value could have come down to zero, and it falls
    // towards the inside from both ends.
    if (std::min(std::fabs(a.value), std::fabs(b.value)) > 0.75 * (width + change)) return;
    if (a.value * slope(a, b.angle) >= 0 || b.value * slope(b, a.angle) <= 0) return;
    minimum(a, b, depth);
}

void RootSearch::minimum(const Sample& a, const Sample& b, int depth) {
    constexpr double kGolden = 0.3819660112501051;
    const double sign = a.value < 0 ? -1 : 1;
    double low = a.angle;
    double high = b.angle;
    Sample left = at(low + kGolden * (high - low));
    Sample right = at(high - kGolden * (high - low));
    for (int n = 0; n < 40 && high - low > 1e-9; ++n) {
        if (!left.isValid || !right.isValid) return;
        for (const Sample& middle : {left, right}) {
            if (sign * middle.value <= 0) {
                refine(a, middle, depth);
                return refine(middle, b, depth);
            }
        }
        if (sign * left.value < sign * right.value) {
            high = right.angle;
            right = left;
            left = at(low + kGolden * (high - low));
        } else {
            low = left.angle;
            left = right;
            right = at(high - kGolden * (high - low));
        }
    }
    // A minimum that touches zero to rounding: the double root of a singular posture.
    if (left.isValid && std::fabs(left.value) < 1e-13) found(left.angle);
}

/// False position with the Illinois correction: the bracket stays, the end is as fast as a Newton step.
void RootSearch::refine(Sample a, Sample b, int depth) {
    double valueA = a.value;
    double valueB = b.value;
    for (int n = 0; n < 60; ++n) {
        const double width = b.angle - a.angle;
        if (valueA == 0) return found(a.angle);
        if (valueB == 0) return found(b.angle);
        if (std::fabs(width) < 1e-15) break;
        double angle = a.angle - valueA * width / (valueB - valueA);
        if (n % 8 == 7 || !(angle > std::min(a.angle, b.angle) && angle < std::max(a.angle, b.angle)))
            angle = 0.5 * (a.angle + b.angle);
        if (angle == a.angle || angle == b.angle) break;
        const Sample middle = at(angle);
        if (!middle.isValid) { // a gap in the reach
            if (depth <= 0) return;
            between(a, middle, depth - 1);
            return between(middle, b, depth - 1);
        }
        if ((middle.value < 0) == (b.value < 0)) {
            valueA *= 0.5; // the same end again: the other one counts less
        } else {
            a = b;
            valueA = b.value;
        }
        b = middle;
        valueB = middle.value;
        if (std::fabs(middle.value) < 1e-16) return found(middle.angle);
    }
    found(std::fabs(a.value) < std::fabs(b.value) ? a.angle : b.angle);
}

/// By how much the target is out of reach at an angle; below 1 it is in reach.
double RootSearch::lack(double angle) const {
    Vec3 axis5;
    ArmTarget aim;
    if (!wrist_.wristAt(target_, std::sin(angle), std::cos(angle), axis5, aim)) return HUGE_VAL;
    return std::fabs(wrist_.plane_.reachCosine(aim, branch_ >> 1));
}

void RootSearch::island(double from, double to) {
    constexpr double kGolden = 0.3819660112501051;
    const double low = from;
    const double high = to;
    double left = from + kGolden * (to - from);
    double right = to - kGolden * (to - from);
    double lackLeft = lack(left);
    double lackRight = lack(right);
    for (int n = 0; n < 30 && lackLeft > 1 && lackRight > 1; ++n) {
        if (lackLeft < lackRight) {
            to = right;
            right = left;
            lackRight = lackLeft;
            left = from + kGolden * (to - from);
            lackLeft = lack(left);
        } else {
            from = left;
            left = right;
            lackLeft = lackRight;
            right = to - kGolden * (to - from);
            lackRight = lack(right);
        }
    }
    const Sample inside = at(lackLeft < lackRight ? left : right);
    if (!inside.isValid) return;
    fromEdge(edge(inside, low), inside, kMostDepth);
    fromEdge(edge(inside, high), inside, kMostDepth);
}

void OffsetWrist::inverseAll(const Pose& flange, const Joints& seed, double /*armAngleDeg*/,
                             IkBranches& out) const {
    static const GridAngles grid;
    out.valid = 0;
    const OffsetTarget target = takeApart(flange, seed);
    if (!(dot(target.foot, target.foot) < 1e12) || !std::isfinite(target.axis1Deg)) return;
    Sample samples[4][kGrid];
    double lacks[2][kGrid];
    for (int i = 0; i < kGrid; ++i) {
        Vec3 axis5;
        ArmTarget aim;
        const bool isAimed = wristAt(target, grid.sine[i], grid.cosine[i], axis5, aim);
        for (int shoulder = 0; shoulder < 2; ++shoulder)
            lacks[shoulder][i] = isAimed ? std::fabs(plane_.reachCosine(aim, shoulder)) : HUGE_VAL;
        for (int branch = 0; branch < 4; ++branch) {
            Sample& sample = samples[branch][i];
            sample.angle = kTurn * i / kGrid;
            ArmBranch arm;
            sample.isValid =
                lacks[branch >> 1][i] <= kOutstretched && plane_.solve(aim, branch >> 1, branch & 1, arm);
            if (!sample.isValid) continue;
            sample.forearm = arm.forearmX();
            sample.value = dot(axis5, sample.forearm);
        }
    }
    for (int branch = 0; branch < 4; ++branch) {
        RootSearch search(*this, target, branch, out);
        for (int i = 0; i < kGrid; ++i) {
            const Sample& here = samples[branch][i];
            Sample next = samples[branch][(i + 1) % kGrid];
            next.angle = kTurn * (i + 1) / kGrid;
            search.between(here, next);
            const double* lack = lacks[branch >> 1];
            const double before = lack[(i + kGrid - 1) % kGrid];
            const double after = lack[(i + 1) % kGrid];
            const bool isNearest = lack[i] < 1.5 && lack[i] <= before && lack[i] < after;
            if (!here.isValid && !next.isValid && before > kOutstretched && isNearest)
                search.island(here.angle - kTurn / kGrid, here.angle + kTurn / kGrid);
        }
    }
}

bool OffsetWrist::inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                                  Joints& out) const {
    const OffsetTarget target = takeApart(flange, seed);
    if (!(dot(target.foot, target.foot) < 1e12) || !std::isfinite(target.axis1Deg)) return false;
    const int branch = configuration(seed).cfx >> 1;
    Sample a = sampleAt(target, branch, modelAngle(seed, 5) * kDeg);
    Sample b = sampleAt(target, branch, a.angle + 1e-4);
    double slope = 0;
    for (int n = 0; n < 12 && a.isValid && b.isValid; ++n) {
        if (b.angle != a.angle && b.value != a.value) slope = (b.value - a.value) / (b.angle - a.angle);
        if (std::fabs(b.value) < 1e-15 || !(std::fabs(slope) > kTrustedSlope)) break;
        const double step = std::clamp(-b.value / slope, -0.2, 0.2);
        a = b;
        b = sampleAt(target, branch, b.angle + step);
        if (std::fabs(step) < 1e-12) break;
    }
    if (b.isValid && std::fabs(b.value) < 1e-14 && std::fabs(slope) > kTrustedSlope &&
        solution(target, branch, b.angle, out) && turnTowards(seed, out) < kTrustedDeg &&
        side(seed) * side(out) > 0)
        return true;
    IkBranches branches;
    inverseAll(flange, seed, armAngleDeg, branches);
    return nearestOf(branches, seed, out);
}

} // namespace

std::shared_ptr<const Mechanism> makeOffsetWrist(const RobotModel& model) {
    return std::make_shared<OffsetWrist>(model);
}

} // namespace robot

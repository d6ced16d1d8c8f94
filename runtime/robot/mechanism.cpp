// Choosing among the branches of an inverse: the same for every mechanism.

#include "runtime/robot/mechanism.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace robot {

double nearestTurnWithin(double angle, double goal, double lower, double upper) {
    double best = nearestTurn(angle, goal);
    if (best > upper + kNoise) best -= 360.0 * std::ceil((best - upper - kNoise) / 360.0);
    if (best < lower - kNoise) {
        const double raised = best + 360.0 * std::ceil((lower - kNoise - best) / 360.0);
        if (raised <= upper + kNoise) best = raised;
    }
    return best;
}

Vec3 column(const Quat& q, int axis) {
    switch (axis) {
    case 0:
        return {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)};
    case 1:
        return {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)};
    default:
        return {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
    }
}

Quat fromColumns(const Vec3& x, const Vec3& y, const Vec3& z) {
    // Four times the squares of the components; the root of the largest loses no digits.
    const double w = 1 + x.x + y.y + z.z;
    const double i = 1 + x.x - y.y - z.z;
    const double j = 1 - x.x + y.y - z.z;
    const double k = 1 - x.x - y.y + z.z;
    if (w >= i && w >= j && w >= k) return normalized({w, y.z - z.y, z.x - x.z, x.y - y.x});
    if (i >= j && i >= k) return normalized({y.z - z.y, i, x.y + y.x, z.x + x.z});
    if (j >= k) return normalized({z.x - x.z, x.y + y.x, j, y.z + z.y});
    return normalized({x.y - y.x, z.x + x.z, y.z + z.y, k});
}

bool levelTurn(const Quat& flange, const Quat& zero, double& turnDeg) {
    const Quat rest = flange * conjugate(zero);
    const double tilt = 2 * std::hypot(rest.x, rest.y); // of the z axis, rad
    if (!(tilt < 0.05 * std::numbers::pi / 180)) return false;
    turnDeg = 2 * std::atan2(rest.z, rest.w) * 180 / std::numbers::pi;
    return std::isfinite(turnDeg);
}

bool solveLinear(std::size_t n, double (&a)[kMostJoints][kMostJoints], double (&b)[kMostJoints]) {
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i + 1; k < n; ++k)
            if (std::fabs(a[k][i]) > std::fabs(a[pivot][i])) pivot = k;
        if (!(std::fabs(a[pivot][i]) > 1e-14)) return false; // also for figures that are not numbers
        if (pivot != i) {
            std::swap_ranges(a[i], a[i] + n, a[pivot]);
            std::swap(b[i], b[pivot]);
        }
        const double scale = 1 / a[i][i];
        for (std::size_t k = i + 1; k < n; ++k) {
            const double factor = a[k][i] * scale;
            for (std::size_t j = i + 1; j < n; ++j)
                a[k][j] -= factor * a[i][j];
            b[k] -= factor * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j)
            b[i] -= a[i][j] * b[j];
        b[i] /= a[i][i];
    }
    return true;
}

double determinant(std::size_t n, double (&a)[kMostJoints][kMostJoints]) {
    double result = 1;
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i + 1; k < n; ++k)
            if (std::fabs(a[k][i]) > std::fabs(a[pivot][i])) pivot = k;
        if (pivot != i) {
            std::swap_ranges(a[i], a[i] + n, a[pivot]);
            result = -result;
        }
        result *= a[i][i];
        if (a[i][i] == 0) return 0;
        for (std::size_t k = i + 1; k < n; ++k) {
            const double factor = a[k][i] / a[i][i];
            for (std::size_t j = i + 1; j < n; ++j)
                a[k][j] -= factor * a[i][j];
        }
    }
    return result;
}

Mechanism::Mechanism(const RobotModel& model)
    : signs_(model.geometry.signs), shifts_(Joints::zeros(model.lowerDeg.size())), lower_(model.lowerDeg),
      upper_(model.upperDeg), axisNumbers_(model.axisNumbers) {
    for (std::size_t i = 0; i < shifts_.size(); ++i)
        shifts_[i] = -model.geometry.offsetsDeg[i];
}

double Mechanism::armAngle(const Joints&) const {
    return 0;
}

double Mechanism::elbowAngle(const Joints&) const {
    return 0;
}

bool Mechanism::isElbowOutside(const Joints& joints, double tolerance) const {
    const double angle = elbowAngle(joints);
    return !(angle >= leastElbow_ - tolerance && angle <= mostElbow_ + tolerance);
}

IkError Mechanism::limitError(const Joints& joints, int joint) const {
    const auto i = static_cast<std::size_t>(joint) - 1;
    const bool isItself = !(joints[i] >= lower_[i] - 1e-6 && joints[i] <= upper_[i] + 1e-6);
    if (isItself || !isElbowLimited_) return {IkErrorKind::OutOfJointLimits, joint, joints[i]};
    return {IkErrorKind::OutOfElbowLimits, joint, elbowAngle(joints)};
}

bool Mechanism::inverseWithWrist(const Vec3&, const Pose&, const Joints&, const Joints&, Joints&) const {
    return false;
}

bool Mechanism::inverseLockedAxis4(const Pose&, const Pose&, double, const Joints&, Joints&) const {
    return false;
}

std::array<int, 3> Mechanism::quarterAxes() const {
    std::array<int, 3> axes{-1, -1, -1};
    for (std::size_t i = 0; i < jointCount(); ++i) {
        if (isLinear(i)) continue;
        if (axisNumbers_[i] == 1) axes[0] = static_cast<int>(i);
        if (axisNumbers_[i] == 4) axes[1] = static_cast<int>(i);
        if (axisNumbers_[i] == 6) axes[2] = static_cast<int>(i);
    }
    return axes;
}

ConfData Mechanism::quarters(const Joints& joints, int cfx) const {
    const std::array<int, 3> axes = quarterAxes();
    const auto quarter = [&](int axis) {
        return axis < 0 ? 0 : quarterOf(joints[static_cast<std::size_t>(axis)]);
    };
    return {quarter(axes[0]), quarter(axes[1]), quarter(axes[2]), cfx};
}

double Mechanism::turnTowards(const Joints& seed, Joints& candidate) const {
    const auto linear = static_cast<std::size_t>(std::max(linear_, 0));
    const double place = candidate[linear];
    for (std::size_t i = 0; i < kMostJoints; ++i) // those that the arm does not have remain 0
        candidate[i] = nearestTurn(candidate[i], seed[i]);
    if (linear_ >= 0) candidate[linear] = place;
    double largest = 0;
    for (std::size_t i = 0; i < kMostJoints; ++i)
        largest = std::max(largest, std::fabs(candidate[i] - seed[i]));
    return largest;
}

double Mechanism::side(const Joints&) const {
    return 0;
}

bool Mechanism::nearestOf(const IkBranches& branches, const Joints& seed, Joints& out) const {
    const double seedSide = side(seed);
    double best = HUGE_VAL;
    double bestOfSide = HUGE_VAL;
    Joints ofSide;
    for (int k = 0; k < static_cast<int>(kMostBranches); ++k) {
        if (!branches.has(k)) continue;
        Joints candidate = branches.joints[static_cast<std::size_t>(k)];
        const double largest = turnTowards(seed, candidate);
        if (largest < best) {
            best = largest;
            out = candidate;
        }
        if (seedSide != 0 && largest < bestOfSide && largest < kTrustedDeg &&
            side(candidate) * seedSide > 0) {
            bestOfSide = largest;
            ofSide = candidate;
        }
    }
    if (bestOfSide < HUGE_VAL) out = ofSide;
    return best < HUGE_VAL;
}

bool Mechanism::inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                                Joints& out) const {
    IkBranches branches;
    inverseAll(flange, seed, armAngleDeg, branches);
    return nearestOf(branches, seed, out);
}

void Mechanism::inverseContinueEach(std::span<InverseTask> tasks) const {
    for (InverseTask& task : tasks)
        continueAlone(task);
}

Expected<Joints, IkError> Mechanism::inverse(const Pose& flange, const ConfData& conf, const Joints& seed,
                                             double armAngleDeg) const {
    IkBranches branches;
    inverseAll(flange, seed, armAngleDeg, branches);
    if (branches.valid == 0) return Unexpected{IkError{}};
    const Expected<Joints, IkError> named = inverseAmong(branches, conf, seed, false);
    return named || namesBranch(conf.cfx) ? named : inverseAmong(branches, conf, seed, true);
}

/// The branch with the quarters of `conf`, and with its cfx unless `any` may be taken.
Expected<Joints, IkError> Mechanism::inverseAmong(const IkBranches& branches, const ConfData& conf,
                                                  const Joints& seed, bool any) const {
    const std::array<int, 3> axes = quarterAxes();
    const int wanted[3] = {conf.cf1, conf.cf4, conf.cf6};
    IkError error{IkErrorKind::NoSuchConfiguration, 0, 0};
    double best = HUGE_VAL;
    Joints joints;
    for (int k = 0; k < static_cast<int>(kMostBranches); ++k) {
        if (!branches.has(k)) continue;
        Joints candidate = branches.joints[static_cast<std::size_t>(k)];
        if (!any && configuration(candidate).cfx != conf.cfx) continue;
        for (std::size_t i = 0; i < jointCount(); ++i)
            if (!isLinear(i)) candidate[i] = nearestTurnWithin(candidate[i], seed[i], lower_[i], upper_[i]);
        int off = 0; // quarters by which the solution misses the configuration, in all
        int offAxis = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            if (axes[c] < 0) continue;
            const auto i = static_cast<std::size_t>(axes[c]);
            candidate[i] = nearestTurn(candidate[i], middleOf(wanted[c]));
            const int distance = std::abs(quarterOf(candidate[i]) - wanted[c]);
            off += distance;
            if (distance > 1 && offAxis == 0) offAxis = axes[c] + 1;
        }
        const int outside = jointOutsideLimits(candidate, 1e-6);
        if (offAxis != 0) {
            error = {IkErrorKind::NoSuchConfiguration, offAxis,
                     candidate[static_cast<std::size_t>(offAxis) - 1]};
            continue;
        }
        if (outside != 0) {
            error = limitError(candidate, outside);
            continue;
        }
        Joints turned = candidate;
        const double distance = 1000.0 * off + turnTowards(seed, turned); // the quarters count first
        if (distance < best) {
            best = distance;
            joints = candidate;
        }
    }
    if (best == HUGE_VAL) return Unexpected{error};
    return joints;
}

Expected<Joints, IkError> Mechanism::inverseNear(const Pose& flange, const Joints& seed,
                                                 double armAngleDeg) const {
    IkBranches branches;
    inverseAll(flange, seed, armAngleDeg, branches);
    if (branches.valid == 0) return Unexpected{IkError{}};
    double best = HUGE_VAL;
    double bestSum = HUGE_VAL;
    double bestOutside = HUGE_VAL;
    Joints joints;
    IkError error;
    for (int k = 0; k < static_cast<int>(kMostBranches); ++k) {
        if (!branches.has(k)) continue;
        Joints candidate = branches.joints[static_cast<std::size_t>(k)];
        double largest = 0;
        double sum = 0;
        for (std::size_t i = 0; i < jointCount(); ++i) {
            if (!isLinear(i)) candidate[i] = nearestTurnWithin(candidate[i], seed[i], lower_[i], upper_[i]);
            largest = std::max(largest, std::fabs(candidate[i] - seed[i]));
            sum += std::fabs(candidate[i] - seed[i]);
        }
        const int joint = jointOutsideLimits(candidate, 1e-6);
        if (joint == 0 && (largest < best - kNoise || (largest < best + kNoise && sum < bestSum))) {
            best = largest;
            bestSum = sum;
            joints = candidate;
        } else if (joint != 0 && largest < bestOutside) {
            bestOutside = largest;
            error = limitError(candidate, joint);
        }
    }
    if (best == HUGE_VAL) return Unexpected{error};
    return joints;
}

} // namespace robot

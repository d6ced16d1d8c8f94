// Closed-form inverse of an ortho-parallel arm whose axes 4, 5 and 6 meet in one point.

#include "runtime/robot/six_axes.h"

#include <algorithm>
#include <cmath>

namespace robot {

namespace {

constexpr double kFreeWrist = 1e-10; // sine of axis 5 below which axes 4 and 6 are one axis
// Another branch turns axis 1 or 4 by about half a revolution: a near solution is the nearest.
constexpr double kNear = 20; // deg

/// The flange pose taken apart once for all branches.
struct SphericalTarget {
    Vec3 flangeX, flangeY, flangeZ;
    ArmTarget arm;
};

class SphericalWrist final : public SixAxes {
  public:
    using SixAxes::SixAxes;
    void inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                    IkBranches& out) const override;
    Expected<Joints, IkError> inverse(const Pose& flange, const ConfData& conf, const Joints& seed,
                                      double armAngleDeg) const override;
    bool inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                         Joints& out) const override;
    void inverseContinueEach(std::span<InverseTask> tasks) const override;

  private:
    template <std::size_t N> void continueTogether(std::span<InverseTask, N> tasks) const;
    int branchForward(const Joints& seed) const;
    bool takeApart(const Pose& flange, const Joints& seed, SphericalTarget& target) const;
    /// Sines and cosines of the angles, six of each; the sine of axis 5.
    double findTerms(const SphericalTarget& target, const ArmBranch& arm, int cfx, double* y,
                     double* x) const;
    bool solveBranch(const SphericalTarget& target, int cfx, double axis4, double axis6, Joints& out) const;
    /// Axes 4 and 6 in line: axis 4 at `axis4` degrees, axis 6 in the turn nearest to `axis6`.
    void solveFreeWrist(const SphericalTarget& target, const ArmBranch& arm, double axis4, double axis6,
                        double (&model)[6]) const;
};

bool SphericalWrist::takeApart(const Pose& flange, const Joints& seed, SphericalTarget& target) const {
    target.flangeX = column(flange.rot, 0);
    target.flangeY = column(flange.rot, 1);
    target.flangeZ = column(flange.rot, 2);
    return plane_.aim(flange.pos - target.flangeZ * geometry_.c4, modelAngle(seed, 0), target.arm);
}

void SphericalWrist::solveFreeWrist(const SphericalTarget& target, const ArmBranch& arm, double axis4,
                                    double axis6, double (&model)[6]) const {
    model[3] = signs_[3] * axis4 + shifts_[3];
    const double turn =
        std::atan2(dot(arm.forearmZ(), target.flangeY), dot(arm.forearmY(), target.flangeY)) / kDeg;
    const bool isFolded = dot(arm.forearmX(), target.flangeZ) < 0; // axis 5 at 180 degrees
    model[5] = isFolded ? model[3] - turn : turn - model[3];
    model[5] = nearestTurn(model[5], signs_[5] * axis6 + shifts_[5]);
}

double SphericalWrist::findTerms(const SphericalTarget& target, const ArmBranch& arm, int cfx, double* y,
                                 double* x) const {
    const double flip = ((cfx & 1) == 0) == (signs_[4] > 0) ? 1.0 : -1.0;
    const double m10 = dot(arm.forearmY(), target.flangeZ);
    const double m20 = dot(arm.forearmZ(), target.flangeZ);
    const double sine5 = std::sqrt(m10 * m10 + m20 * m20);
    const double ys[6] = {arm.sine1,  arm.sine2,    arm.sineEta,
                          flip * m10, flip * sine5, flip * dot(arm.forearmX(), target.flangeY)};
    const double xs[6] = {arm.cosine1,
                          arm.cosine2,
                          arm.cosineEta,
                          -flip * m20,
                          dot(arm.forearmX(), target.flangeZ),
                          -flip * dot(arm.forearmX(), target.flangeX)};
    std::copy(ys, ys + 6, y);
    std::copy(xs, xs + 6, x);
    return sine5;
}

bool SphericalWrist::solveBranch(const SphericalTarget& target, int cfx, double axis4, double axis6,
                                 Joints& out) const {
    ArmBranch arm;
    if (!plane_.solve(target.arm, cfx >> 2 & 1, cfx >> 1 & 1, arm)) return false;
    double y[6];
    double x[6];
    const double sine5 = findTerms(target, arm, cfx, y, x);
    double angle[6];
    trig::atan2Deg(y, x, angle);
    double model[6] = {angle[0], angle[1], angle[2] - plane_.angleDeg, angle[3], angle[4], angle[5]};
    if (sine5 < kFreeWrist) solveFreeWrist(target, arm, axis4, axis6, model);
    toAxes(model, out);
    return true;
}

void SphericalWrist::inverseAll(const Pose& flange, const Joints& seed, double /*armAngleDeg*/,
                                IkBranches& out) const {
    out.valid = 0;
    SphericalTarget target;
    if (!takeApart(flange, seed, target)) return;
    ArmBranch arms[4];
    double y[24] = {};
    double x[24] = {};
    double angle[24];
    bool isArm[4];
    bool isFree[4];
    for (std::size_t i = 0; i < 4; ++i) {
        ArmBranch& arm = arms[i];
        isArm[i] = plane_.solve(target.arm, static_cast<int>(i >> 1), static_cast<int>(i & 1), arm);
        const double m10 = dot(arm.forearmY(), target.flangeZ);
        const double m20 = dot(arm.forearmZ(), target.flangeZ);
        const double sine5 = std::sqrt(m10 * m10 + m20 * m20);
        isFree[i] = sine5 < kFreeWrist;
        const double ys[6] = {arm.sine1, arm.sine2, arm.sineEta,
                              m10,       sine5,     dot(arm.forearmX(), target.flangeY)};
        const double xs[6] = {arm.cosine1,
                              arm.cosine2,
                              arm.cosineEta,
                              -m20,
                              dot(arm.forearmX(), target.flangeZ),
                              -dot(arm.forearmX(), target.flangeX)};
        std::copy(ys, ys + 6, y + 6 * i);
        std::copy(xs, xs + 6, x + 6 * i);
    }
    trig::atan2Deg(y, x, angle);
    const unsigned positive = signs_[4] > 0 ? 0 : 1;
    for (std::size_t i = 0; i < 4; ++i) {
        if (!isArm[i]) continue;
        const double* a = angle + 6 * i;
        double model[6] = {a[0], a[1], a[2] - plane_.angleDeg, a[3], a[4], a[5]};
        if (isFree[i]) solveFreeWrist(target, arms[i], seed[3], seed[5], model);
        toAxes(model, out.joints[2 * i + positive]);
        model[3] += model[3] > 0 ? -180 : 180;
        model[4] = -model[4];
        model[5] += model[5] > 0 ? -180 : 180;
        if (isFree[i]) solveFreeWrist(target, arms[i], seed[3], seed[5], model);
        toAxes(model, out.joints[2 * i + 1 - positive]);
        out.valid = static_cast<uint16_t>(out.valid | (3U << (2 * i)));
    }
}

Expected<Joints, IkError> SphericalWrist::inverse(const Pose& flange, const ConfData& conf,
                                                  const Joints& seed, double /*armAngleDeg*/) const {
    SphericalTarget target;
    if (!takeApart(flange, seed, target)) return Unexpected{IkError{}};
    Joints joints;
    if (conf.cfx < 0 || conf.cfx > 7) return Unexpected{IkError{IkErrorKind::NoSuchConfiguration, 0, 0}};
    // If axis 4 is free it goes into its quarter, as near to the seed as that lets.
    const double axis4 = std::clamp(seed[3], 90.0 * conf.cf4, 90.0 * conf.cf4 + 90.0);
    if (!solveBranch(target, conf.cfx, axis4, seed[5], joints)) {
        ArmBranch arm;
        const bool isReachable = plane_.solve(target.arm, 0, 0, arm) || plane_.solve(target.arm, 1, 0, arm);
        return Unexpected{
            IkError{isReachable ? IkErrorKind::NoSuchConfiguration : IkErrorKind::Unreachable, 0, 0}};
    }
    const int quarters[3] = {conf.cf1, conf.cf4, conf.cf6};
    const std::size_t axes[3] = {0, 3, 5};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = axes[k];
        const double centre = 90.0 * quarters[k] + 45.0;
        joints[i] = nearestTurn(joints[i], centre);
        const double off = joints[i] + kNoise - centre;
        if (!(off >= -135.0 && off < 135.0)) { // more than one quarter
            return Unexpected{IkError{IkErrorKind::NoSuchConfiguration, static_cast<int>(i) + 1, joints[i]}};
        }
    }
    if (const int joint = jointOutsideLimits(joints, 1e-6); joint != 0) {
        return Unexpected{
            IkError{IkErrorKind::OutOfJointLimits, joint, joints[static_cast<std::size_t>(joint) - 1]}};
    }
    return joints;
}

/// The branch of the seed if the arm reaches forward.
int SphericalWrist::branchForward(const Joints& seed) const {
    const double elbowDeg = modelAngle(seed, 2) + plane_.angleDeg;
    const double within = std::abs(elbowDeg) < 180 ? elbowDeg : elbowDeg - 360 * std::round(elbowDeg / 360);
    return (within < 0 ? 2 : 0) | (seed[4] < 0 ? 1 : 0);
}

bool SphericalWrist::inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                                     Joints& out) const {
    // Most arms reach forward, and that they do is quicker to try than to compute.
    SphericalTarget target;
    Joints same = seed;
    const bool isWhole = takeApart(flange, seed, target);
    const auto isNear = [&](int cfx) {
        if (!isWhole || !solveBranch(target, cfx, seed[3], seed[5], same) || turnTowards(seed, same) >= kNear)
            return false;
        out = same;
        return true;
    };
    const int forward = branchForward(seed);
    if (isNear(forward)) return true;
    const int own = configuration(seed).cfx;
    if (own != forward && isNear(own)) return true;
    IkBranches branches;
    inverseAll(flange, seed, armAngleDeg, branches);
    // The elbow cannot change along a path, for that takes the stretched arm; shoulder and wrist can be
    // passed through.
    const int elbow = own & 2;
    double best = HUGE_VAL;
    for (int cfx : {elbow, elbow | 1, elbow | 4, elbow | 5}) {
        if (!branches.has(cfx)) continue;
        Joints candidate = branches.joints[static_cast<std::size_t>(cfx)];
        const double largest = turnTowards(seed, candidate);
        if (largest < best) {
            best = largest;
            out = candidate;
        }
    }
    return best < HUGE_VAL;
}

/// Step by step for all poses: what one has to wait for in a step, the others fill. A task whose seed is still sought gets the branch of the
/// task that seeks it, and is solved alone when that was wrong.
template <std::size_t N> void SphericalWrist::continueTogether(std::span<InverseTask, N> tasks) const {
    int branch[N];
    for (std::size_t i = 0; i < N; ++i) {
        std::size_t before = 0;
        while (before < i && tasks[i].seed != &tasks[before].joints)
            ++before;
        branch[i] = before < i ? branch[before] : branchForward(*tasks[i].seed);
    }
    SphericalTarget target[N];
    ArmBranch arm[N];
    bool isUsual[N];
    for (std::size_t i = 0; i < N; ++i)
        isUsual[i] = takeApart(tasks[i].flange, *tasks[0].seed, target[i]) && !target[i].arm.isArmFree;
    for (std::size_t i = 0; i < N; ++i)
        isUsual[i] = isUsual[i] && plane_.solve(target[i].arm, 0, branch[i] >> 1 & 1, arm[i]);
    double y[6 * N];
    double x[6 * N];
    double angle[6 * N];
    for (std::size_t i = 0; i < N; ++i) {
        const double sine5 = findTerms(target[i], arm[i], branch[i], y + 6 * i, x + 6 * i);
        isUsual[i] = isUsual[i] && sine5 >= kFreeWrist;
    }
    trig::atan2Deg(y, x, angle);
    for (std::size_t i = 0; i < N; ++i) {
        InverseTask& task = tasks[i];
        const double* const a = angle + 6 * i;
        Joints found = *task.seed;
        if (isUsual[i]) toAxes({a[0], a[1], a[2] - plane_.angleDeg, a[3], a[4], a[5]}, found);
        if (isUsual[i] && branchForward(*task.seed) == branch[i] && turnTowards(*task.seed, found) < kNear) {
            task.joints = found;
            task.isSolved = true;
        } else {
            continueAlone(task);
        }
    }
}

void SphericalWrist::inverseContinueEach(std::span<InverseTask> tasks) const {
    for (; tasks.size() >= 3; tasks = tasks.subspan(3))
        continueTogether<3>(tasks.first<3>());
    if (tasks.size() == 2)
        continueTogether<2>(tasks.first<2>());
    else if (!tasks.empty())
        continueAlone(tasks.front());
}

} // namespace

std::shared_ptr<const Mechanism> makeSphericalWrist(const RobotModel& model) {
    return std::make_shared<SphericalWrist>(model);
}

} // namespace robot

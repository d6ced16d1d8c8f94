// Closed-form kinematics of an ortho-parallel arm with spherical wrist.
// Model angles: all zero with the upper arm vertical and the forearm horizontal. In the plane of the arm (r
// outward, z up) the upper arm points to angle q2 from z towards r, the forearm is turned by q2 + q3.

#include "runtime/robot/kinematics.h"

#include "runtime/robot/fast_trig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace robot {

namespace {

constexpr double kNoise = 1e-7;            // deg; less is rounding, not posture
constexpr double kFreeWrist = 1e-10;       // sine of axis 5 below which axes 4 and 6 are one axis
constexpr double kFreeArm = 1e-6;          // mm; wrist centre on axis 1
constexpr double kOutstretched = 1 + 1e-9; // rounding of a target exactly at full reach
constexpr double kHalfRoot2 = 0.70710678118654752440;

double nearestTurn(double angle, double goal) {
    return angle + 360.0 * std::nearbyint((goal - angle) / 360.0);
}

/// The angle plus the whole turns that bring it as near to `goal` as the range [lower, upper] lets.
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

} // namespace

struct Kinematics::Target {
    Vec3 flangeX, flangeY, flangeZ;      // columns of the flange orientation
    double x = 0, y = 0, z = 0;          // wrist centre
    double square = 0, radius = 0;       // its distance from axis 1, squared, and along the arm plane
    double freeSine = 0, freeCosine = 1; // axis 1 where the wrist centre lies on it
    bool isArmFree = false;
};

struct Kinematics::ArmBranch {
    double sine1 = 0, cosine1 = 1;
    double sine2 = 0, cosine2 = 1;
    double sineEta = 0, cosineEta = 1; // from upper arm to wrist centre
    double sine23 = 0, cosine23 = 1;

    Vec3 forearmX() const { return {cosine1 * cosine23, sine1 * cosine23, -sine23}; }
    Vec3 forearmY() const { return {-sine1, cosine1, 0}; }
    Vec3 forearmZ() const { return {cosine1 * sine23, sine1 * sine23, cosine23}; }
};

int quarterRevolution(double angleDeg) {
    constexpr double kMost = 1e9; // an angle beyond any arm's
    return static_cast<int>(std::clamp(std::floor((angleDeg + kNoise) / 90.0), -kMost, kMost));
}

std::string IkError::message() const {
    switch (kind) {
    case IkErrorKind::Unreachable: return "the position is outside the reach of the arm";
    case IkErrorKind::OutOfJointLimits:
        return fmt::format("axis {} would have to be at {:.2f} degrees, outside its range", joint, angleDeg);
    case IkErrorKind::NoSuchConfiguration:
        return joint == 0
                   ? std::string("the position does not have the configuration asked for")
                   : fmt::format(
                         "axis {} would be at {:.2f} degrees, in another quarter than confdata asks for",
                         joint, angleDeg);
    }
    return {};
}

Kinematics::Kinematics(const RobotModel& model)
    : geometry_(model.geometry), signs_(model.geometry.signs), lower_(model.lowerDeg),
      upper_(model.upperDeg) {
    for (std::size_t i = 0; i < 6; ++i)
        shifts_[i] = -geometry_.offsetsDeg[i];
    shifts_[2] -= 90.0; // OPW's zero has the forearm upright
    forearm_ = std::hypot(geometry_.c3, geometry_.a2);
    forearmSine_ = geometry_.c3 / forearm_;
    forearmCosine_ = -geometry_.a2 / forearm_;
    forearmAngleDeg_ = std::atan2(forearmSine_, forearmCosine_) / trig::kDeg;
}

double Kinematics::radius(double sine2, double sine23, double cosine23) const {
    return geometry_.a1 + geometry_.c2 * sine2 + geometry_.c3 * cosine23 - geometry_.a2 * sine23;
}

Pose Kinematics::forward(const Joints& joints) const {
    Joints m;
    for (std::size_t i = 0; i < 6; ++i)
        m[i] = signs_[i] * joints[i] + shifts_[i];
    const double angles[6] = {0.5 * m[0], m[1], 0.5 * (m[1] + m[2]), 0.5 * m[3], 0.5 * m[4], 0.5 * m[5]};
    double s[6];
    double c[6];
    trig::sinCosDeg(angles, s, c);

    // Orientation: about z, y, x, y, x, then the quarter turn about y that puts z out of the flange.
    const Quat arm{c[0] * c[2], -s[0] * s[2], c[0] * s[2], s[0] * c[2]};
    const Quat wrist = Quat{c[3] * c[4], s[3] * c[4], c[3] * s[4], s[3] * s[4]} *
                       Quat{kHalfRoot2 * c[5], kHalfRoot2 * s[5], kHalfRoot2 * c[5], kHalfRoot2 * s[5]};
    Pose flange;
    flange.rot = arm * wrist;

    const double sine23 = 2 * s[2] * c[2];
    const double cosine23 = 1 - 2 * s[2] * s[2];
    const double r = radius(s[1], sine23, cosine23);
    const double sine1 = 2 * s[0] * c[0];
    const double cosine1 = 1 - 2 * s[0] * s[0];
    const Vec3 centre{cosine1 * r - sine1 * geometry_.b, sine1 * r + cosine1 * geometry_.b,
                      geometry_.c1 + geometry_.c2 * c[1] - geometry_.c3 * sine23 - geometry_.a2 * cosine23};
    flange.pos = centre + column(flange.rot, 2) * geometry_.c4;
    return flange;
}

bool Kinematics::takeApart(const Pose& flange, const Joints& seed, Target& target) const {
    target.flangeX = column(flange.rot, 0);
    target.flangeY = column(flange.rot, 1);
    target.flangeZ = column(flange.rot, 2);
    target.x = flange.pos.x - geometry_.c4 * target.flangeZ.x;
    target.y = flange.pos.y - geometry_.c4 * target.flangeZ.y;
    target.z = flange.pos.z - geometry_.c4 * target.flangeZ.z;
    target.square = target.x * target.x + target.y * target.y;
    const double inPlane = target.square - geometry_.b * geometry_.b;
    if (!(inPlane >= 0)) return false; // also for figures that are not numbers
    target.radius = std::sqrt(inPlane);
    target.isArmFree = target.square < kFreeArm * kFreeArm;
    if (target.isArmFree) {
        const double angle = (signs_[0] * seed[0] + shifts_[0]) * trig::kDeg;
        target.freeSine = std::sin(angle);
        target.freeCosine = std::cos(angle);
    }
    return true;
}

bool Kinematics::solveArm(const Target& target, int shoulder, int elbow, ArmBranch& arm) const {
    const double side = shoulder == 0 ? 1.0 : -1.0;
    const double r = side * target.radius;
    if (target.isArmFree) {
        arm.sine1 = side * target.freeSine;
        arm.cosine1 = side * target.freeCosine;
    } else {
        const double scale = 1.0 / target.square;
        arm.sine1 = (target.y * r - target.x * geometry_.b) * scale;
        arm.cosine1 = (target.x * r + target.y * geometry_.b) * scale;
    }
    const double outward = r - geometry_.a1;
    const double upward = target.z - geometry_.c1;
    const double square = outward * outward + upward * upward;
    const double upper = geometry_.c2;
    const double cosine = (square - upper * upper - forearm_ * forearm_) / (2 * upper * forearm_);
    if (!(std::fabs(cosine) <= kOutstretched) || square < 1e-12) return false;
    arm.cosineEta = std::clamp(cosine, -1.0, 1.0);
    arm.sineEta = std::sqrt(1 - arm.cosineEta * arm.cosineEta) * (elbow == 0 ? 1.0 : -1.0);
    const double along = upper + forearm_ * arm.cosineEta;
    const double across = forearm_ * arm.sineEta;
    const double scale = 1.0 / square;
    arm.sine2 = (along * outward - across * upward) * scale;
    arm.cosine2 = (along * upward + across * outward) * scale;
    const double sineArm = (outward - upper * arm.sine2) / forearm_;
    const double cosineArm = (upward - upper * arm.cosine2) / forearm_;
    arm.sine23 = sineArm * forearmCosine_ - cosineArm * forearmSine_;
    arm.cosine23 = cosineArm * forearmCosine_ + sineArm * forearmSine_;
    return true;
}

void Kinematics::toAxes(const Joints& model, Joints& out) const {
    for (std::size_t i = 0; i < 6; ++i)
        out[i] = signs_[i] * (model[i] - shifts_[i]);
    // Axes 2, 3 and 5 have one turn only; it need not be the one around zero (axis 3 goes down to -245
    // degrees).
    for (std::size_t i : {1U, 2U, 4U}) {
        if (out[i] > upper_[i] + kNoise && out[i] - 360 >= lower_[i] - kNoise) out[i] -= 360;
        if (out[i] < lower_[i] - kNoise && out[i] + 360 <= upper_[i] + kNoise) out[i] += 360;
    }
}

void Kinematics::solveFreeWrist(const Target& target, const ArmBranch& arm, const Joints& seed,
                                Joints& model) const {
    model[3] = signs_[3] * seed[3] + shifts_[3];
    const double turn =
        std::atan2(dot(arm.forearmZ(), target.flangeY), dot(arm.forearmY(), target.flangeY)) / trig::kDeg;
    const bool isFolded = dot(arm.forearmX(), target.flangeZ) < 0; // axis 5 at 180 degrees
    model[5] = isFolded ? model[3] - turn : turn - model[3];
    model[5] = nearestTurn(model[5], signs_[5] * seed[5] + shifts_[5]);
}

bool Kinematics::solveBranch(const Target& target, int cfx, const Joints& seed, Joints& out) const {
    ArmBranch arm;
    if (!solveArm(target, cfx >> 2 & 1, cfx >> 1 & 1, arm)) return false;
    const double flip = ((cfx & 1) == 0) == (signs_[4] > 0) ? 1.0 : -1.0;
    const double m10 = dot(arm.forearmY(), target.flangeZ);
    const double m20 = dot(arm.forearmZ(), target.flangeZ);
    const double sine5 = std::sqrt(m10 * m10 + m20 * m20);
    const double y[6] = {arm.sine1,  arm.sine2,    arm.sineEta,
                         flip * m10, flip * sine5, flip * dot(arm.forearmX(), target.flangeY)};
    const double x[6] = {arm.cosine1,
                         arm.cosine2,
                         arm.cosineEta,
                         -flip * m20,
                         dot(arm.forearmX(), target.flangeZ),
                         -flip * dot(arm.forearmX(), target.flangeX)};
    double angle[6];
    trig::atan2Deg(y, x, angle);
    Joints model{angle[0], angle[1], angle[2] - forearmAngleDeg_, angle[3], angle[4], angle[5]};
    if (sine5 < kFreeWrist) solveFreeWrist(target, arm, seed, model);
    toAxes(model, out);
    return true;
}

void Kinematics::inverseAll(const Pose& flange, const Joints& seed, IkBranches& out) const {
    out.valid = 0;
    Target target;
    if (!takeApart(flange, seed, target)) return;
    ArmBranch arms[4];
    double y[24] = {};
    double x[24] = {};
    double angle[24];
    bool isArm[4];
    bool isFree[4];
    for (std::size_t i = 0; i < 4; ++i) {
        ArmBranch& arm = arms[i];
        isArm[i] = solveArm(target, static_cast<int>(i >> 1), static_cast<int>(i & 1), arm);
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
        Joints model{a[0], a[1], a[2] - forearmAngleDeg_, a[3], a[4], a[5]};
        if (isFree[i]) solveFreeWrist(target, arms[i], seed, model);
        toAxes(model, out.joints[2 * i + positive]);
        model[3] += model[3] > 0 ? -180 : 180;
        model[4] = -model[4];
        model[5] += model[5] > 0 ? -180 : 180;
        if (isFree[i]) solveFreeWrist(target, arms[i], seed, model);
        toAxes(model, out.joints[2 * i + 1 - positive]);
        out.valid = static_cast<uint8_t>(out.valid | (3U << (2 * i)));
    }
}

Expected<Joints, IkError> Kinematics::inverse(const Pose& flange, const ConfData& conf,
                                              const Joints& seed) const {
    Target target;
    if (!takeApart(flange, seed, target)) return Unexpected{IkError{}};
    Joints joints;
    if (conf.cfx < 0 || conf.cfx > 7) return Unexpected{IkError{IkErrorKind::NoSuchConfiguration, 0, 0}};
    Joints hint = seed; // where axis 4 is free it goes into its quarter, as near to the seed as that lets
    hint[3] = std::clamp(seed[3], 90.0 * conf.cf4, 90.0 * conf.cf4 + 90.0);
    if (!solveBranch(target, conf.cfx, hint, joints)) {
        ArmBranch arm;
        const bool isReachable = solveArm(target, 0, 0, arm) || solveArm(target, 1, 0, arm);
        return Unexpected{
            IkError{isReachable ? IkErrorKind::NoSuchConfiguration : IkErrorKind::Unreachable, 0, 0}};
    }
    const int quarters[3] = {conf.cf1, conf.cf4, conf.cf6};
    const std::size_t axes[3] = {0, 3, 5};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = axes[k];
        const double centre = 90.0 * quarters[k] + 45.0;
        joints[i] = nearestTurn(joints[i], centre);
        if (std::abs(quarterRevolution(joints[i]) - quarters[k]) > 1) {
            return Unexpected{IkError{IkErrorKind::NoSuchConfiguration, static_cast<int>(i) + 1, joints[i]}};
        }
    }
    if (const int joint = jointOutsideLimits(joints); joint != 0) {
        return Unexpected{
            IkError{IkErrorKind::OutOfJointLimits, joint, joints[static_cast<std::size_t>(joint) - 1]}};
    }
    return joints;
}

Expected<Joints, IkError> Kinematics::inverseNear(const Pose& flange, const Joints& seed) const {
    IkBranches branches;
    inverseAll(flange, seed, branches);
    if (branches.valid == 0) return Unexpected{IkError{}};
    double best = HUGE_VAL;
    double bestSum = HUGE_VAL;
    double bestOutside = HUGE_VAL;
    Joints joints{};
    IkError error;
    for (int cfx = 0; cfx < 8; ++cfx) {
        if (!branches.has(cfx)) continue;
        Joints candidate = branches.joints[static_cast<std::size_t>(cfx)];
        double largest = 0;
        double sum = 0;
        for (std::size_t i = 0; i < 6; ++i) {
            candidate[i] = nearestTurnWithin(candidate[i], seed[i], lower_[i], upper_[i]);
            largest = std::max(largest, std::fabs(candidate[i] - seed[i]));
            sum += std::fabs(candidate[i] - seed[i]);
        }
        const int joint = jointOutsideLimits(candidate);
        if (joint == 0 && (largest < best - kNoise || (largest < best + kNoise && sum < bestSum))) {
            best = largest;
            bestSum = sum;
            joints = candidate;
        } else if (joint != 0 && largest < bestOutside) {
            bestOutside = largest;
            error = {IkErrorKind::OutOfJointLimits, joint, candidate[static_cast<std::size_t>(joint) - 1]};
        }
    }
    if (best == HUGE_VAL) return Unexpected{error};
    return joints;
}

bool Kinematics::inverseContinue(const Pose& flange, const Joints& seed, Joints& out) const {
    IkBranches branches;
    inverseAll(flange, seed, branches);
    // The elbow cannot change along a path, for that takes the stretched arm; shoulder and wrist can be
    // passed through.
    const int elbow = configuration(seed).cfx & 2;
    double best = HUGE_VAL;
    for (int cfx : {elbow, elbow | 1, elbow | 4, elbow | 5}) {
        if (!branches.has(cfx)) continue;
        Joints candidate = branches.joints[static_cast<std::size_t>(cfx)];
        double largest = 0;
        for (std::size_t i = 0; i < 6; ++i) {
            candidate[i] = nearestTurn(candidate[i], seed[i]);
            largest = std::max(largest, std::fabs(candidate[i] - seed[i]));
        }
        if (largest < best) {
            best = largest;
            out = candidate;
        }
    }
    return best < HUGE_VAL;
}

ConfData Kinematics::configuration(const Joints& joints) const {
    const double m2 = signs_[1] * joints[1] + shifts_[1];
    const double m3 = signs_[2] * joints[2] + shifts_[2];
    const double angles[3] = {m2, m2 + m3, m3 + forearmAngleDeg_};
    double s[3];
    double c[3];
    trig::sinCosDeg(angles, s, c);
    ConfData conf{quarterRevolution(joints[0]), quarterRevolution(joints[3]), quarterRevolution(joints[5]),
                  0};
    if (radius(s[0], s[1], c[1]) < -kFreeArm) conf.cfx |= 4;
    if (s[2] < -kNoise * trig::kDeg) conf.cfx |= 2;
    if (joints[4] < -kNoise) conf.cfx |= 1;
    return conf;
}

int Kinematics::jointOutsideLimits(const Joints& joints, double toleranceDeg) const {
    for (std::size_t i = 0; i < 6; ++i) {
        const bool isInside = joints[i] >= lower_[i] - toleranceDeg && joints[i] <= upper_[i] + toleranceDeg;
        if (!isInside) return static_cast<int>(i) + 1;
    }
    return 0;
}

Singularity Kinematics::singularity(const Joints& joints) const {
    const double m2 = signs_[1] * joints[1] + shifts_[1];
    const double m3 = signs_[2] * joints[2] + shifts_[2];
    const double angles[2] = {m2, m2 + m3};
    double s[2];
    double c[2];
    trig::sinCosDeg(angles, s, c);
    const double eta = std::fabs(std::remainder(m3 + forearmAngleDeg_, 360.0));
    return {std::fabs(std::remainder(joints[4], 360.0)), std::fabs(radius(s[0], s[1], c[1])),
            std::min(eta, 180.0 - eta)};
}

JacobianMatrix Kinematics::jacobian(const Joints& joints) const {
    double angles[6];
    for (std::size_t i = 0; i < 6; ++i)
        angles[i] = signs_[i] * joints[i] + shifts_[i];
    angles[2] += angles[1];
    double s[6];
    double c[6];
    trig::sinCosDeg(angles, s, c);
    const Vec3 outward{c[0], s[0], 0};
    const Vec3 sideways{-s[0], c[0], 0};
    const Vec3 up{0, 0, 1};
    const Vec3 shoulder = outward * geometry_.a1 + sideways * geometry_.b + up * geometry_.c1;
    const Vec3 elbow = shoulder + outward * (geometry_.c2 * s[1]) + up * (geometry_.c2 * c[1]);
    const Vec3 forearmX = outward * c[2] - up * s[2];
    const Vec3 forearmZ = outward * s[2] + up * c[2];
    const Vec3 centre = elbow + forearmX * geometry_.c3 - forearmZ * geometry_.a2;
    const Vec3 axis5 = sideways * c[3] + forearmZ * s[3];
    const Vec3 flangeZ = forearmX * c[4] - (forearmZ * c[3] - sideways * s[3]) * s[4];
    const Vec3 flange = centre + flangeZ * geometry_.c4;

    const Vec3 axes[6] = {up, sideways, sideways, forearmX, axis5, flangeZ};
    const Vec3 pivots[6] = {{}, shoulder, elbow, centre, centre, centre};
    JacobianMatrix result;
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3 turn = axes[i] * signs_[i];
        const Vec3 shift = cross(turn, flange - pivots[i]);
        const double entries[6] = {shift.x, shift.y, shift.z, turn.x, turn.y, turn.z};
        for (std::size_t row = 0; row < 6; ++row)
            result[6 * row + i] = entries[row];
    }
    return result;
}

} // namespace robot

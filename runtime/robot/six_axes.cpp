// Six axes on an ortho-parallel base: forward kinematics, configuration, singularities, Jacobian, and the inverses that
// SingArea needs. See arm_plane.h for the model angles.

#include "runtime/robot/six_axes.h"

#include <array>
#include <cmath>

namespace robot {

namespace {

constexpr double kHalfRoot2 = 0.70710678118654752440;

/// Forearm axes (x along, y sideways, z up) for sines and cosines of axis 1 and of axes 2 + 3.
struct Forearm {
    Vec3 x, y, z;
    Forearm(double sine1, double cosine1, double sine23, double cosine23)
        : x{cosine1 * cosine23, sine1 * cosine23, -sine23}, y{-sine1, cosine1, 0},
          z{cosine1 * sine23, sine1 * sine23, cosine23} {}
};

} // namespace

SixAxes::SixAxes(const RobotModel& model)
    : Mechanism(model), geometry_(model.geometry),
      plane_(model.geometry, model.geometry.b, model.geometry.c3, -model.geometry.a2),
      wristOffset_(model.wristOffset) {
    shifts_[2] -= 90.0; // OPW's zero has the forearm upright
}

Pose SixAxes::forward(const Joints& joints) const {
    double m[6];
    for (std::size_t i = 0; i < 6; ++i)
        m[i] = modelAngle(joints, i);
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
    const double r = plane_.radius(s[1], sine23, cosine23);
    const double sine1 = 2 * s[0] * c[0];
    const double cosine1 = 1 - 2 * s[0] * s[0];
    const Vec3 centre{cosine1 * r - sine1 * geometry_.b, sine1 * r + cosine1 * geometry_.b,
                      geometry_.c1 + geometry_.c2 * c[1] - geometry_.c3 * sine23 - geometry_.a2 * cosine23};
    flange.pos = centre + column(flange.rot, 2) * geometry_.c4;
    if (wristOffset_ != 0) {
        const double sine6 = 2 * s[5] * c[5];
        const double cosine6 = 1 - 2 * s[5] * s[5];
        flange.pos =
            flange.pos + (column(flange.rot, 1) * sine6 - column(flange.rot, 0) * cosine6) * wristOffset_;
    }
    return flange;
}

void SixAxes::toAxes(const double (&model)[6], Joints& out) const {
    for (std::size_t i = 0; i < 6; ++i)
        out[i] = axisAngle(model[i], i);
    // Axes 2, 3 and 5 have one turn only; it need not be the one around zero (axis 3 goes down to -245
    // degrees).
    for (std::size_t i : {1U, 2U, 4U})
        out[i] = withinLimits(out[i], i);
}

ConfData SixAxes::configuration(const Joints& joints) const {
    const double m2 = modelAngle(joints, 1);
    const double m3 = modelAngle(joints, 2);
    const double angles[3] = {m2, m2 + m3, m3 + plane_.angleDeg};
    double s[3];
    double c[3];
    trig::sinCosDeg(angles, s, c);
    ConfData conf{quarterRevolution(joints[0]), quarterRevolution(joints[3]), quarterRevolution(joints[5]),
                  0};
    if (plane_.radius(s[0], s[1], c[1]) < -kFreeArm) conf.cfx |= 4;
    if (s[2] < -kNoise * kDeg) conf.cfx |= 2;
    if (joints[4] < -kNoise) conf.cfx |= 1;
    return conf;
}

Singularity SixAxes::singularity(const Joints& joints) const {
    const double m2 = modelAngle(joints, 1);
    const double m3 = modelAngle(joints, 2);
    const double angles[2] = {m2, m2 + m3};
    double s[2];
    double c[2];
    trig::sinCosDeg(angles, s, c);
    const double eta = std::fabs(std::remainder(m3 + plane_.angleDeg, 360.0));
    Singularity result;
    result.wristDeg = std::fabs(std::remainder(joints[4], 360.0));
    result.armMm = std::fabs(plane_.radius(s[0], s[1], c[1]));
    result.elbowDeg = std::min(eta, 180.0 - eta);
    if (wristOffset_ == 0) return result;
    // With the offset the wrist is not singular at axis 5 = 0 but where the determinant vanishes; divided by what arm
    // and elbow contribute it is the sine of axis 5 of an arm without the offset.
    const double contribution = plane_.c2 * plane_.forearm * std::sin(result.elbowDeg * kDeg) *
                                std::max(result.armMm, std::fabs(wristOffset_));
    const double sine = std::fabs(jacobianDeterminant(joints)) / std::max(contribution, 1e-9);
    result.wristDeg = std::asin(std::min(sine, 1.0)) / kDeg;
    return result;
}

JacobianMatrix SixAxes::jacobian(const Joints& joints) const {
    double angles[6];
    for (std::size_t i = 0; i < 6; ++i)
        angles[i] = modelAngle(joints, i);
    angles[2] += angles[1];
    double s[6];
    double c[6];
    trig::sinCosDeg(angles, s, c);
    const Vec3 outward{c[0], s[0], 0};
    const Vec3 sideways{-s[0], c[0], 0};
    const Vec3 up{0, 0, 1};
    const Vec3 shoulder = outward * geometry_.a1 + sideways * geometry_.b + up * geometry_.c1;
    const Vec3 elbow = shoulder + outward * (geometry_.c2 * s[1]) + up * (geometry_.c2 * c[1]);
    const Forearm forearm(s[0], c[0], s[2], c[2]);
    const Vec3 centre = elbow + forearm.x * geometry_.c3 - forearm.z * geometry_.a2;
    const Vec3 axis5 = sideways * c[3] + forearm.z * s[3];
    const Vec3 raised = forearm.z * c[3] - sideways * s[3];
    const Vec3 flangeZ = forearm.x * c[4] - raised * s[4];
    const Vec3 foot = centre + (raised * c[4] + forearm.x * s[4]) * wristOffset_;
    const Vec3 flange = foot + flangeZ * geometry_.c4;

    const Vec3 axes[6] = {up, sideways, sideways, forearm.x, axis5, flangeZ};
    const Vec3 pivots[6] = {{}, shoulder, elbow, centre, centre, foot};
    JacobianMatrix result;
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3 turn = axes[i] * signs_[i];
        const Vec3 shift = cross(turn, flange - pivots[i]);
        const double entries[6] = {shift.x, shift.y, shift.z, turn.x, turn.y, turn.z};
        for (std::size_t row = 0; row < 6; ++row)
            result(row, i) = entries[row];
    }
    return result;
}

double SixAxes::jacobianDeterminant(const Joints& joints) const {
    const JacobianMatrix matrix = jacobian(joints);
    double a[kMostJoints][kMostJoints];
    for (std::size_t row = 0; row < 6; ++row)
        for (std::size_t i = 0; i < 6; ++i)
            a[row][i] = matrix(row, i);
    return determinant(6, a);
}

namespace {

/// Angles of axes 1 and 2, and of the forearm against the upper arm, degrees.
std::array<double, 3> anglesOf(const ArmBranch& arm) {
    const double y[3] = {arm.sine1, arm.sine2, arm.sineEta};
    const double x[3] = {arm.cosine1, arm.cosine2, arm.cosineEta};
    double angle[3];
    trig::atan2Deg(y, x, angle);
    return {angle[0], angle[1], angle[2]};
}

} // namespace

bool SixAxes::nearestArm(const ArmPlane& plane, const Vec3& point, const Joints& model, const Joints& seed,
                         Joints& out) const {
    ArmTarget target;
    if (!(plane.forearm > 0) || !plane.aim(point, modelAngle(seed, 0), target)) return false;
    double best = HUGE_VAL;
    for (int branch = 0; branch < 4; ++branch) {
        ArmBranch arm;
        if (!plane.solve(target, branch >> 1, branch & 1, arm)) continue;
        const std::array<double, 3> angle = anglesOf(arm);
        Joints candidate;
        toAxes({angle[0], angle[1], angle[2] - plane.angleDeg, model[3], model[4], model[5]}, candidate);
        const double largest = turnTowards(seed, candidate);
        if (largest < best) {
            best = largest;
            out = candidate;
        }
    }
    return best < HUGE_VAL;
}

bool SixAxes::inverseWithWrist(const Vec3& tcp, const Pose& flange_tcp, const Joints& wrist,
                               const Joints& seed, Joints& out) const {
    double angles[3];
    for (std::size_t i = 0; i < 3; ++i)
        angles[i] = modelAngle(wrist, i + 3);
    double s[3];
    double c[3];
    trig::sinCosDeg(angles, s, c);
    // The tool centre point in the axes of the forearm (x, y, z as in Forearm) does not depend on axes 1 to 3: it
    // takes the place of the wrist centre.
    const Vec3 axis5{0, c[0], s[0]};
    const Vec3 raised{0, -s[0], c[0]};
    const Vec3 along{1, 0, 0};
    const Vec3 flangeZ = along * c[1] - raised * s[1];
    const Vec3 offset = raised * c[1] + along * s[1];
    const Vec3 flangeX = axis5 * s[2] - offset * c[2];
    const Vec3 flangeY = axis5 * c[2] + offset * s[2];
    const Vec3& tool = flange_tcp.pos;
    const Vec3 point = along * geometry_.c3 - Vec3{0, 0, geometry_.a2} + offset * wristOffset_ +
                       flangeZ * (geometry_.c4 + tool.z) + flangeX * tool.x + flangeY * tool.y;
    const ArmPlane plane(geometry_, geometry_.b + point.y, point.x, point.z);
    Joints model;
    for (std::size_t i = 3; i < 6; ++i)
        model[i] = modelAngle(wrist, i);
    if (!nearestArm(plane, tcp, model, seed, out)) return false;
    for (std::size_t i = 3; i < 6; ++i)
        out[i] = wrist[i]; // in the very turn asked for
    return true;
}

/// The flange with axis 4 locked: turned by axis 1 about z, then by `sum` (of axes 2, 3 and 5, flange z up at 0) about
/// y, then by `spin` about its own z. Degrees.
struct SixAxes::Locked {
    double axis1 = 0, sum = 0, spin = 0;
    Vec3 centre;         // of the wrist
    double sideways = 0; // mm by which the wrist misses the plane of the arm
};

/// The orientation nearest to the wanted one for a given axis 1 is closed: the scalar product of the quaternions is
/// p cos(a - b) + t sin(a - b) + q cos(a + b) + r sin(a + b) in the half angles a of the sum and b of the spin.
SixAxes::Locked SixAxes::lockedAt(double axis1, const Pose& base_tcp, const Pose& flange_tcp,
                                  bool isTurned) const {
    const Quat arm = fromAxisAngle({0, 0, 1}, axis1);
    const Quat rest = conjugate(arm) * base_tcp.rot * conjugate(flange_tcp.rot);
    const double total = std::atan2(rest.y + rest.z, rest.w - rest.x);
    const double difference = std::atan2(rest.y - rest.z, rest.w + rest.x);
    Locked result;
    result.axis1 = axis1;
    result.sum = (total + difference) / kDeg;
    result.spin = (total - difference) / kDeg;
    const Quat level = arm * fromAxisAngle({0, 1, 0}, result.sum);
    const Quat turn = level * fromAxisAngle({0, 0, 1}, result.spin);
    const Vec3 offset = column(level, 0) * (isTurned ? wristOffset_ : -wristOffset_);
    result.centre = base_tcp.pos - rotate(turn, flange_tcp.pos) - column(turn, 2) * geometry_.c4 - offset;
    const double angle = axis1 * kDeg;
    result.sideways = result.centre.y * std::cos(angle) - result.centre.x * std::sin(angle) - geometry_.b;
    return result;
}

bool SixAxes::inverseLockedAxis4(const Pose& base_tcp, const Pose& flange_tcp, double axis4Deg,
                                 const Joints& seed, Joints& out) const {
    const double halfTurns = (signs_[3] * axis4Deg + shifts_[3]) / 180.0;
    if (!(std::fabs(halfTurns - std::nearbyint(halfTurns)) < kNoise)) return false;
    const bool isTurned = std::fabs(std::remainder(halfTurns, 2.0)) > 0.5;
    Locked before = lockedAt(modelAngle(seed, 0), base_tcp, flange_tcp, isTurned);
    Locked locked = lockedAt(before.axis1 + 0.01, base_tcp, flange_tcp, isTurned);
    for (int n = 0; n < 50 && std::fabs(locked.sideways) > 1e-12; ++n) {
        if (locked.sideways == before.sideways) break;
        const double slope = (locked.sideways - before.sideways) / (locked.axis1 - before.axis1);
        const double step = std::clamp(-locked.sideways / slope, -30.0, 30.0);
        if (std::fabs(step) < 1e-14) break;
        before = locked;
        locked = lockedAt(locked.axis1 + step, base_tcp, flange_tcp, isTurned);
    }
    if (!(std::fabs(locked.sideways) < 1e-8)) return false;
    return nearestLocked(locked, isTurned, axis4Deg, seed, out);
}

bool SixAxes::nearestLocked(const Locked& locked, bool isTurned, double axis4Deg, const Joints& seed,
                            Joints& out) const {
    ArmTarget target;
    if (!plane_.aim(locked.centre, locked.axis1, target)) return false;
    double best = HUGE_VAL;
    for (int branch = 0; branch < 4; ++branch) {
        ArmBranch arm;
        if (!plane_.solve(target, branch >> 1, branch & 1, arm)) continue;
        const std::array<double, 3> angle = anglesOf(arm);
        // The other shoulder needs axis 1 half a turn further, for which the orientation was not made.
        if (std::fabs(std::remainder(angle[0] - locked.axis1, 360.0)) > 1e-3) continue;
        const double axis3 = angle[2] - plane_.angleDeg;
        const double pitch = locked.sum - 90.0 - angle[1] - axis3;
        Joints candidate;
        toAxes({locked.axis1, angle[1], axis3, 0, std::remainder(isTurned ? -pitch : pitch, 360.0),
                isTurned ? locked.spin + 180.0 : locked.spin},
               candidate);
        candidate[3] = seed[3]; // not a choice of the solution
        const double largest = turnTowards(seed, candidate);
        if (largest < best) {
            best = largest;
            out = candidate;
        }
    }
    out[3] = best < HUGE_VAL ? axis4Deg : out[3];
    return best < HUGE_VAL;
}

} // namespace robot

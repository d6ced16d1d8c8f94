#pragma once
// Stage 1 of motion: forward and inverse kinematics of an arm, whatever its mechanism. Angles in degrees, lengths in
// mm. "flange" poses are the flange frame (RAPID's tool0, z out of the flange) in the robot's base frame; base
// frame, tool and work object are the caller's (see motion/targets.h).

#include "runtime/robot/expected.h"
#include "runtime/robot/frames.h"
#include "runtime/robot/robot_model.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>

namespace robot {

/// RAPID's confdata. cf1, cf4, cf6 are quarter revolutions of the axes of these numbers (0 = [0,90), 1 = [90,180),
/// -1 = [-90,0) ...; seven axes: the nearest quarter, 0 = [-45,45)), 0 for an axis the arm does not have. cfx names the
/// branch, by mechanism:
/// spherical wrist and offset wrist: bit 2 wrist centre behind axis 1, bit 1 wrist centre behind the lower arm, bit 0
///   axis 5 negative; with an offset wrist the wrist centre is the foot of axis 5 and more than eight solutions exist:
///   of those that share all four figures the one nearest to the seed is taken;
/// seven axes: bit 2 axis 2 negative, bit 1 elbow bent the other way (axis 3 beyond the stretched arm), bit 0 axis 5
///   negative; shared figures as with the offset wrist;
/// parallel rods: bit 2 wrist behind axis 1, bit 1 wrist behind the lower arm;
/// SCARA: bit 0 axis 2 negative;
/// delta: always 0 (the elbows point outward).
struct ConfData {
    int cf1 = 0, cf4 = 0, cf6 = 0, cfx = 0;
    friend bool operator==(const ConfData&, const ConfData&) = default;
};

enum class IkErrorKind : uint8_t {
    Unreachable,      ///< out of reach of the arm, or an orientation that the arm cannot give
    OutOfJointLimits, ///< reachable in space, but an axis would leave its range; `joint` says which
    OutOfElbowLimits, ///< reachable in space, but `angleDeg` between lower and upper arm is outside the range of the rods
    NoSuchConfiguration, ///< reachable, but not with the configuration asked for
};
struct IkError {
    IkErrorKind kind = IkErrorKind::Unreachable;
    int joint = 0;       ///< index into Joints plus 1, 0 = none
    double angleDeg = 0; ///< the angle (mm of a linear axis) that axis would have needed
    std::string message() const;
};

/// Most solutions an inverse may have.
inline constexpr std::size_t kMostBranches = 16;

/// Solutions of the inverse. With a spherical wrist the index is cfx (0..7); with other mechanisms the solutions
/// come in no particular order. Whether axes are within limits (perhaps a revolution further) is not looked at.
struct IkBranches {
    std::array<Joints, kMostBranches> joints;
    uint16_t valid = 0; ///< bit i: joints[i] holds a solution
    bool has(int index) const { return (valid >> index & 1) != 0; }
    int count() const { return std::popcount(valid); }
    /// Takes one more solution unless all places are taken.
    void add(const Joints& solution) {
        const int place = std::countr_one(valid);
        if (place >= static_cast<int>(kMostBranches)) return;
        joints[static_cast<std::size_t>(place)] = solution;
        valid = static_cast<uint16_t>(valid | 1U << place);
    }
};

/// How far from a singularity a posture is (manual chapter 2.7). All in natural units: small means near; infinite
/// when the arm has no such singularity.
struct Singularity {
    double wristDeg = HUGE_VAL;    ///< |axis 5|; offset wrist: the figure of that meaning, see six_axes.cpp
    double armMm = HUGE_VAL;       ///< distance of the wrist centre from axis 1
    double elbowDeg = HUGE_VAL;    ///< angle by which the elbow is away from the stretched or folded arm
    double shoulderDeg = HUGE_VAL; ///< seven axes: |axis 2|
    /// Seven axes: angle between the direction from shoulder to wrist and the reference direction.
    double armAngleDeg = HUGE_VAL;
    /// Seven axes: arc sine of the determinant of the equations that pose and arm angle give, each column made a unit.
    /// Two solutions meet at 0.
    double foldDeg = HUGE_VAL;
};

/// Row-major, 6 rows: d(x, y, z of the flange in mm; rotation vector in rad) / d(axis angle in rad, or mm of a linear
/// axis), base frame; one column per axis.
struct JacobianMatrix {
    std::array<double, 6 * kMostJoints> entries{};
    std::size_t columns = 6;
    double operator[](std::size_t i) const { return entries[i]; }
    double operator()(std::size_t row, std::size_t column) const { return entries[row * columns + column]; }
    double& operator()(std::size_t row, std::size_t column) { return entries[row * columns + column]; }
};

/// Means "the arm angle of the seed" in the functions below.
inline constexpr double kSeedArmAngle = std::numeric_limits<double>::quiet_NaN();

class Mechanism;

/// One of several poses near each other whose joints are sought.
struct InverseTask {
    Pose flange;
    const Joints* seed = nullptr; ///< may be `joints` of an earlier task
    double armAngleDeg = 0;
    Joints joints;         ///< the solution; the seed when there is none
    bool isSolved = false; ///< the pose can be reached
};

/// Kinematics of one model. A value, cheap to copy; thread-safe; no allocation in any call, no exception. Figures that
/// are not numbers and joints of a different number of axes give "unreachable" or a pose of no meaning, never a crash.
/// `armAngleDeg` counts only for seven axes: eax_a of the robtarget.
class Kinematics {
  public:
    /// An arm of length zero: nothing can be reached.
    Kinematics();
    /// Of any model that parseRobotModel accepts.
    explicit Kinematics(const RobotModel& model);

    /// Number of axes, 4 to 7: the size of all Joints here.
    std::size_t jointCount() const;
    /// RAPID's number of joint `i` (from 0): rax_<number> of a jointtarget, and 7 is eax_a. An arm of four axes with
    /// parallel rods has the axes 1, 2, 3 and 6.
    int axisNumber(std::size_t i) const;
    /// Whether joint `i` (from 0) is linear, in mm.
    bool isLinear(std::size_t i) const;
    /// Whether robtargets of this arm have an arm angle in eax_a.
    bool hasArmAngle() const;

    /// Flange in base.
    Pose forward(const Joints& joints) const;

    /// Arm angle in degrees, -180 to 180; 0 for an arm without one and where the reference direction is along the line
    /// from shoulder to wrist. It is the angle of axis 3 about that line as RobotStudio counts it: 0 along (reference
    /// direction x line), 90 towards the reference direction.
    double armAngle(const Joints& joints) const;

    /// All branches. If the pose is singular, the angle that is free is taken from `seed`. Poses out of reach leave
    /// valid = 0.
    void inverseAll(const Pose& flange, const Joints& seed, IkBranches& out,
                    double armAngleDeg = kSeedArmAngle) const;

    /// The branch named by cfx with axes 1, 4, 6 in the quarter revolutions asked for, within the joint
    /// limits. If the branch exists but not in exactly these quarters, the nearest revolution is taken when
    /// every axis is at most one quarter off (manual 2.4: "the same or a close configuration"); otherwise
    /// NoSuchConfiguration.
    Expected<Joints, IkError> inverse(const Pose& flange, const ConfData& conf, const Joints& seed,
                                      double armAngleDeg = kSeedArmAngle) const;

    /// The solution within the joint limits whose axes are nearest to `seed` (largest axis difference
    /// smallest). Continuous through the wrist singularity.
    Expected<Joints, IkError> inverseNear(const Pose& flange, const Joints& seed,
                                          double armAngleDeg = kSeedArmAngle) const;

    /// Continuation along a path: the solution nearest to `seed` that a movement without stretching the elbow leads
    /// to, no limit check. Returns false when out of reach.
    bool inverseContinue(const Pose& flange, const Joints& seed, Joints& out,
                         double armAngleDeg = kSeedArmAngle) const;

    /// As inverseContinue() for one task after the other, in less time.
    void inverseContinueEach(std::span<InverseTask> tasks) const;

    /// SingArea \Wrist: axes 4 to 6 are given in `wrist` (its axes 1 to 3 do not count), axes 1 to 3 bring the
    /// tool centre point to `tcp` (base frame, mm); `flange_tcp` is the tool. The solution nearest to `seed`, no
    /// limit check. False when out of reach or when the arm is not one of six axes.
    bool inverseWithWrist(const Vec3& tcp, const Pose& flange_tcp, const Joints& wrist, const Joints& seed,
                          Joints& out) const;

    /// SingArea \LockAxis4: axis 4 stays at `axis4Deg` (a multiple of 180, as the manual demands), the tool centre
    /// point is at base_tcp.pos exactly and the orientation is the nearest to base_tcp.rot that five axes can give. The
    /// solution nearest to `seed`, no limit check. False when out of reach, for other angles of axis 4, or when the
    /// arm is not one of six axes.
    bool inverseLockedAxis4(const Pose& base_tcp, const Pose& flange_tcp, double axis4Deg, const Joints& seed,
                            Joints& out) const;

    /// Configuration of a posture.
    ConfData configuration(const Joints& joints) const;

    /// First axis (index plus 1) outside its range by more than `tolerance` (deg, mm), 0 if none. 3 also where the rods of a
    /// palletizer do not let axes 2 and 3 be there together.
    int jointOutsideLimits(const Joints& joints, double tolerance = 1e-6) const;
    /// Angle between lower and upper arm, deg, 180 when stretched; 0 unless rods limit it.
    double elbowAngle(const Joints& joints) const;
    /// Why joint `joint` of jointOutsideLimits is not allowed.
    IkError limitError(const Joints& joints, int joint) const;

    Singularity singularity(const Joints& joints) const;
    JacobianMatrix jacobian(const Joints& joints) const;

    /// Joint limits, degrees (mm for a linear axis).
    const Joints& lowerDeg() const;
    const Joints& upperDeg() const;

  private:
    std::shared_ptr<const Mechanism> mechanism_; // never null
};

/// Quarter revolution of an angle in degrees: 0 = [0,90), -1 = [-90,0). An angle less than 1e-7 below a
/// multiple of 90 counts as having reached it, so that rounding does not change a configuration.
int quarterRevolution(double angleDeg);

} // namespace robot

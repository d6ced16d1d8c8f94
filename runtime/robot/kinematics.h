#pragma once
// Stage 1 of motion: forward and inverse kinematics of six-axis arms with a spherical wrist, in closed form.
// Angles in degrees, lengths in mm. "flange" poses are the flange frame (RAPID's tool0, z out of the flange)
// in the robot's base frame; base frame, tool and work object are the caller's (see motion/targets.h).

#include "runtime/robot/expected.h"
#include "runtime/robot/frames.h"
#include "runtime/robot/robot_model.h"

#include <array>
#include <cstdint>
#include <string>

namespace robot {

/// RAPID's confdata: quarter revolutions of axes 1, 4 and 6 (0 = [0,90), 1 = [90,180), -1 = [-90,0) ...), and
/// cfx: bit 2 wrist centre behind axis 1, bit 1 wrist centre behind the lower arm, bit 0 axis 5 negative.
struct ConfData {
    int cf1 = 0, cf4 = 0, cf6 = 0, cfx = 0;
    friend bool operator==(const ConfData&, const ConfData&) = default;
};

enum class IkErrorKind : uint8_t {
    Unreachable,         ///< out of reach of the arm
    OutOfJointLimits,    ///< reachable in space, but an axis would leave its range; `joint` says which
    NoSuchConfiguration, ///< reachable, but not with the configuration asked for
};
struct IkError {
    IkErrorKind kind = IkErrorKind::Unreachable;
    int joint = 0;       ///< 1..6, 0 = none
    double angleDeg = 0; ///< the angle that axis would have needed
    std::string message() const;
};

/// All branches of the inverse, indexed by cfx (0..7). Angles of axes 1, 4, 6 lie in [-180, 180]; whether
/// they are within limits (perhaps a revolution further) is not looked at.
struct IkBranches {
    std::array<Joints, 8> joints;
    uint8_t valid = 0; ///< bit i: joints[i] holds a solution
    bool has(int cfx) const { return (valid >> cfx & 1) != 0; }
};

/// How far from a singularity a posture is (manual chapter 2.7). All in natural units: small means near.
struct Singularity {
    double wristDeg = 0; ///< |axis 5|
    double armMm = 0;    ///< distance of the wrist centre from axis 1
    double elbowDeg = 0; ///< angle by which axis 3 is away from the stretched arm
};

/// 6x6 row-major: d(x, y, z of the flange in mm; rotation vector in rad) / d(axis angle in rad), base frame.
using JacobianMatrix = std::array<double, 36>;

/// Kinematics of one model. A value, cheap to copy; thread-safe; no allocation in any call.
class Kinematics {
  public:
    Kinematics() = default;
    /// The model must be of kind SphericalWrist.
    explicit Kinematics(const RobotModel& model);

    /// Flange in base for axis angles in degrees.
    Pose forward(const Joints& joints) const;

    /// All eight branches. Where the pose is singular (wrist: axis 5 at 0; arm: wrist centre on axis 1) the
    /// angle that is free is taken from `seed`. Poses out of reach leave valid = 0.
    void inverseAll(const Pose& flange, const Joints& seed, IkBranches& out) const;

    /// The branch named by cfx with axes 1, 4, 6 in the quarter revolutions asked for, within the joint
    /// limits. If the branch exists but not in exactly these quarters, the nearest revolution is taken when
    /// every axis is at most one quarter off (manual 2.4: "the same or a close configuration"); otherwise
    /// NoSuchConfiguration.
    Expected<Joints, IkError> inverse(const Pose& flange, const ConfData& conf, const Joints& seed) const;

    /// The solution within the joint limits whose axes are nearest to `seed` (largest weighted axis
    /// difference smallest). Continuous through the wrist singularity.
    Expected<Joints, IkError> inverseNear(const Pose& flange, const Joints& seed) const;

    /// Continuation along a path: the same cfx branch as `seed` (axis 5 may change sign at 0), no limit
    /// check. Returns false when out of reach.
    bool inverseContinue(const Pose& flange, const Joints& seed, Joints& out) const;

    /// Configuration of a posture.
    ConfData configuration(const Joints& joints) const;

    /// First axis (1..6) outside its range by more than `toleranceDeg`, 0 if none.
    int jointOutsideLimits(const Joints& joints, double toleranceDeg = 1e-6) const;

    Singularity singularity(const Joints& joints) const;
    JacobianMatrix jacobian(const Joints& joints) const;

    const Joints& lowerDeg() const { return lower_; }
    const Joints& upperDeg() const { return upper_; }

  private:
    struct Target;    // a flange pose taken apart
    struct ArmBranch; // axes 1 to 3 of one branch
    bool takeApart(const Pose& flange, const Joints& seed, Target& target) const;
    bool solveArm(const Target& target, int shoulder, int elbow, ArmBranch& arm) const;
    bool solveBranch(const Target& target, int cfx, const Joints& seed, Joints& out) const;
    void solveFreeWrist(const Target& target, const ArmBranch& arm, const Joints& seed, Joints& model) const;
    void toAxes(const Joints& model, Joints& out) const;
    double radius(double sine2, double sine23, double cosine23) const;

    OpwParameters geometry_;
    Joints signs_{}; // model angle = sign * axis angle + shift, degrees, all zero in the ABB zero posture
    Joints shifts_{};
    Joints lower_{}, upper_{};
    double forearm_ = 0;                         // mm, axis 3 to wrist centre
    double forearmSine_ = 0, forearmCosine_ = 0; // of the angle from the upper arm to that line at axis 3 = 0
    double forearmAngleDeg_ = 0;
};

/// Quarter revolution of an angle in degrees: 0 = [0,90), -1 = [-90,0). An angle less than 1e-7 below a
/// multiple of 90 counts as having reached it, so that rounding does not change a configuration.
int quarterRevolution(double angleDeg);

} // namespace robot

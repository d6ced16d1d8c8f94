#pragma once
// The interface that every mechanism implements, and what all of them share: choosing among branches. Internal to
// runtime/robot; callers use Kinematics, which says what the functions mean.

#include "runtime/robot/fast_trig.h"
#include "runtime/robot/kinematics.h"

namespace robot {

/// Movement of an axis since the seed up to which a solution is taken for its continuation without a search.
inline constexpr double kTrustedDeg = 15.0;
inline constexpr double kNoise = 1e-7; ///< deg; less is rounding, not posture

/// The angle plus the whole turns that bring it nearest to `goal`.
inline double nearestTurn(double angle, double goal) {
    return angle + 360.0 * (((goal - angle) * (1.0 / 360.0) + trig::kRounder) - trig::kRounder);
}
/// The angle plus the whole turns that bring it as near to `goal` as the range [lower, upper] lets.
double nearestTurnWithin(double angle, double goal, double lower, double upper);
/// Column 0, 1 or 2 of the rotation matrix of a unit quaternion.
Vec3 column(const Quat& q, int axis);
/// Unit quaternion whose rotation matrix has these columns (orthonormal, right-handed).
Quat fromColumns(const Vec3& x, const Vec3& y, const Vec3& z);
/// Turn about z, degrees, of a flange that points down and is `zero` at 0; false when it is tilted by more than 0.05
/// degrees (a target of a program has six digits) or holds figures that are not numbers.
bool levelTurn(const Quat& flange, const Quat& zero, double& turnDeg);
/// Solves A x = b by elimination with pivoting, both overwritten (x in b). False for a singular matrix.
bool solveLinear(std::size_t n, double (&a)[kMostJoints][kMostJoints], double (&b)[kMostJoints]);

/// Determinant of the first n rows and columns, which are overwritten; not a number for such figures.
double determinant(std::size_t n, double (&a)[kMostJoints][kMostJoints]);

class Mechanism {
  public:
    /// Takes limits, axis numbers, signs and shifts of the model.
    explicit Mechanism(const RobotModel& model);
    virtual ~Mechanism() = default;
    Mechanism(const Mechanism&) = delete;
    Mechanism& operator=(const Mechanism&) = delete;

    virtual Pose forward(const Joints& joints) const = 0;
    virtual void inverseAll(const Pose& flange, const Joints& seed, double armAngleDeg,
                            IkBranches& out) const = 0;
    virtual ConfData configuration(const Joints& joints) const = 0;
    virtual Singularity singularity(const Joints& joints) const = 0;
    virtual JacobianMatrix jacobian(const Joints& joints) const = 0;

    /// cfx of a target names one of the branches. Otherwise every branch may be meant: what the manufacturer calls it is
    /// not public.
    virtual bool namesBranch(int) const { return true; }
    virtual double armAngle(const Joints& joints) const;
    virtual Expected<Joints, IkError> inverse(const Pose& flange, const ConfData& conf, const Joints& seed,
                                              double armAngleDeg) const;
    virtual bool inverseContinue(const Pose& flange, const Joints& seed, double armAngleDeg,
                                 Joints& out) const;
    virtual void inverseContinueEach(std::span<InverseTask> tasks) const;
    virtual bool inverseWithWrist(const Vec3& tcp, const Pose& flange_tcp, const Joints& wrist,
                                  const Joints& seed, Joints& out) const;
    virtual bool inverseLockedAxis4(const Pose& base_tcp, const Pose& flange_tcp, double axis4Deg,
                                    const Joints& seed, Joints& out) const;
    Expected<Joints, IkError> inverseNear(const Pose& flange, const Joints& seed, double armAngleDeg) const;
    int jointOutsideLimits(const Joints& joints, double tolerance) const {
        for (std::size_t i = 0; i < lower_.size(); ++i) {
            const bool isInside = joints[i] >= lower_[i] - tolerance && joints[i] <= upper_[i] + tolerance;
            if (!isInside) return static_cast<int>(i) + 1;
        }
        return isElbowLimited_ && isElbowOutside(joints, tolerance) ? kElbowAxis : 0;
    }
    /// Angle between lower and upper arm, deg; 0 for an arm on which nothing limits it.
    virtual double elbowAngle(const Joints& joints) const;
    bool isElbowOutside(const Joints& joints, double tolerance) const;
    /// Why joint `joint` (from 1) of these is not allowed: it leaves its own range, or the range of the elbow.
    IkError limitError(const Joints& joints, int joint) const;

    std::size_t jointCount() const { return lower_.size(); }
    int axisNumber(std::size_t i) const { return axisNumbers_[i]; }
    bool isLinear(std::size_t i) const { return linear_ == static_cast<int>(i); }
    const Joints& lower() const { return lower_; }
    const Joints& upper() const { return upper_; }

  protected:
    void continueAlone(InverseTask& task) const {
        task.joints = *task.seed;
        task.isSolved = inverseContinue(task.flange, *task.seed, task.armAngleDeg, task.joints);
    }
    /// Model angle of joint i, all zero in the posture that the mechanism calls zero.
    double modelAngle(const Joints& joints, std::size_t i) const {
        return signs_[i] * joints[i] + shifts_[i];
    }
    double axisAngle(double model, std::size_t i) const { return signs_[i] * (model - shifts_[i]); }
    /// An angle of an axis with one turn, moved by a turn when that brings it within limits.
    double withinLimits(double angle, std::size_t i) const {
        if (angle > upper_[i] + kNoise && angle - 360 >= lower_[i] - kNoise) return angle - 360;
        if (angle < lower_[i] - kNoise && angle + 360 <= upper_[i] + kNoise) return angle + 360;
        return angle;
    }
    /// Quarter revolution in which confdata counts this axis angle.
    int quarterOf(double angleDeg) const { return quarterRevolution(angleDeg + quarterShift_); }
    /// The angle in the middle of a quarter revolution.
    double middleOf(int quarter) const { return 90.0 * quarter + 45.0 - quarterShift_; }
    /// The three axes whose quarter revolutions are cf1, cf4 and cf6, as indices; -1 for none.
    Expected<Joints, IkError> inverseAmong(const IkBranches& branches, const ConfData& conf,
                                           const Joints& seed, bool any) const;
    std::array<int, 3> quarterAxes() const;
    ConfData quarters(const Joints& joints, int cfx) const;
    /// Largest difference of an axis after each rotary axis of `candidate` was turned to the one nearest to `seed`.
    double turnTowards(const Joints& seed, Joints& candidate) const;
    /// A number whose sign changes where two solutions meet; 0 for a mechanism that does not need it.
    virtual double side(const Joints& joints) const;
    /// The nearest to `seed` of several solutions, turned towards it; false without any. Where two solutions are close
    /// to each other, the one on the same side as the seed is its continuation even if the other one is nearer.
    bool nearestOf(const IkBranches& branches, const Joints& seed, Joints& out) const;

    Joints signs_, shifts_; // model angle = sign * axis angle + shift, degrees
    Joints lower_, upper_;
    std::array<int, kMostJoints> axisNumbers_{};
    int linear_ = -1;                                      // index of the linear axis, -1 for none
    double quarterShift_ = 0;                              // deg, by which quarter 0 begins before 0
    bool isElbowLimited_ = false;                          // axes 2 and 3 limit each other
    double leastElbow_ = -HUGE_VAL, mostElbow_ = HUGE_VAL; // deg
    static constexpr int kElbowAxis = 3;                   // the axis that is named then
};

std::shared_ptr<const Mechanism> makeSphericalWrist(const RobotModel& model);
std::shared_ptr<const Mechanism> makeOffsetWrist(const RobotModel& model);
std::shared_ptr<const Mechanism> makeSevenAxes(const RobotModel& model);
std::shared_ptr<const Mechanism> makeParallelRods(const RobotModel& model);
std::shared_ptr<const Mechanism> makeScara(const RobotModel& model);
std::shared_ptr<const Mechanism> makeDelta(const RobotModel& model);
std::shared_ptr<const Mechanism> makeNoArm(const RobotModel& model);

} // namespace robot

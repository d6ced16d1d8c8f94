#pragma once
// The common part of six-axis arms with an ortho-parallel base, whether axis 6 meets axis 5 (spherical wrist) or passes
// it at a distance (offset wrist). Internal to runtime/robot.

#include "runtime/robot/arm_plane.h"
#include "runtime/robot/mechanism.h"

namespace robot {

class SixAxes : public Mechanism {
  public:
    explicit SixAxes(const RobotModel& model);

    Pose forward(const Joints& joints) const final;
    ConfData configuration(const Joints& joints) const final;
    Singularity singularity(const Joints& joints) const final;
    JacobianMatrix jacobian(const Joints& joints) const final;
    bool inverseWithWrist(const Vec3& tcp, const Pose& flange_tcp, const Joints& wrist, const Joints& seed,
                          Joints& out) const final;
    bool inverseLockedAxis4(const Pose& base_tcp, const Pose& flange_tcp, double axis4Deg, const Joints& seed,
                            Joints& out) const final;

  protected:
    double jacobianDeterminant(const Joints& joints) const;
    /// Axis angles of model angles, axes 2, 3 and 5 in the turn that is within limits.
    void toAxes(const double (&model)[6], Joints& out) const;
    /// The nearest to `seed` of the four branches that carry the plane's point to `point`; axes 4 to 6 as in `model`.
    bool nearestArm(const ArmPlane& plane, const Vec3& point, const Joints& model, const Joints& seed,
                    Joints& out) const;

    struct Locked;
    Locked lockedAt(double axis1, const Pose& base_tcp, const Pose& flange_tcp, bool isTurned) const;
    bool nearestLocked(const Locked& locked, bool isTurned, double axis4Deg, const Joints& seed,
                       Joints& out) const;

    OpwParameters geometry_;
    ArmPlane plane_;         // to the wrist centre
    double wristOffset_ = 0; // mm from axis 5 to axis 6, along z of the forearm with axes 4 and 5 at zero
};

} // namespace robot

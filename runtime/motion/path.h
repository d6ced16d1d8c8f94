#pragma once
// Stage 2 of motion: the geometry of one move, without time. The path parameter s runs from 0 to 1; TCP path
// length and orientation grow evenly with it on lines and circles, axis angles on joint moves.

#include "runtime/motion/move_command.h"
#include "runtime/robot/kinematics.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace motion {

/// Line or arc of the TCP in the (displaced) object frame, with its orientation spline.
class CartesianCurve {
  public:
    /// Straight line; orientation slerp, the short way.
    static CartesianCurve line(const Pose& start, const Pose& end);
    /// Circle through three points. With PathFrame the circle point's orientation only selects the way of twisting
    /// (manual 2.2.2). Three points on one line, the circle point between the others, give that line. Errors: points
    /// too close, circle point on the line but outside, more than 240 degrees.
    static Expected<CartesianCurve, MotionError>
    arc(const Pose& start, const Pose& via, const Pose& end,
        CircleOrientation orientation = CircleOrientation::PathFrame);

    Pose at(double s) const;                            ///< s in [0, 1]
    double length() const { return length_; }           ///< mm
    double rotationDeg() const { return rotationDeg_; } ///< highest d(orientation)/ds, degrees per unit of s
    bool isArc() const { return isArc_; }
    Vec3 centre() const { return centre_; }       ///< arc only, object frame
    Vec3 axis() const { return axis_; }           ///< arc only: unit normal, right-handed about the motion
    double radius() const { return radius_; }     ///< arc only, mm
    double sweepDeg() const { return sweepDeg_; } ///< arc only

  private:
    Pose start_, end_;
    bool isArc_ = false;
    double length_ = 0, rotationDeg_ = 0;
    Vec3 centre_, axis_, spoke_; // spoke: from centre to start
    double radius_ = 0, sweepDeg_ = 0;
    void twistOnCircle(const Pose& via, double viaAngle);
    void twistInObject(const Pose& via, CircleOrientation orientation);

    Quat orientationAt(double s) const;

    double viaShare_ = 1;    // up to there the first twist holds
    bool isCarried_ = false; // the orientation turns with the circle
    Vec3
        twist_; // rotation vector (rad) of the orientation relative to the moving frame, over the whole curve
    Vec3 twistAfter_; // ... and from the circle point on, when that has an orientation of its own
    Quat viaRot_;
};

/// A node of the grid that planning lays over a path.
struct PathNode {
    double s = 0;
    Joints joints{};
    double distance = 0; ///< mm of TCP path from the start
};

/// One move with its start state, resolved to a path in joint space.
/// A circular move in two: start to circle point, circle point to target, on the same circle (stepwise execution stops
/// at the circle point, manual 1.21). `begin`: TCP in the object frame, arm angle and external axes there: these have come
/// as far at the circle point as the TCP. Empty when such a circle does not exist.
std::vector<MoveCommand> splitAtCirclePoint(const MoveCommand& command, const RobTarget& begin);
/// A circle that began at `start` and has come to `here`: the rest of it, as a command that begins there. Unchanged when
/// `here` does not lie on it.
MoveCommand restOfCircle(const MoveCommand& command, const Pose& start, const Pose& here);

/// The external axes at the end of a movement from `start`: those of the target, where they are connected.
ExternalAxes targetAxes(const ExternalAxes& start, const ExternalAxes& target);

class MotionPath {
  public:
    MotionPath() = default; ///< at rest with all axes at 0

    /// Resolves the command from where the arm is. All geometric errors are found here: reach, joint
    /// range along the whole path, configuration, circle data, singularities.
    static Expected<MotionPath, MotionError> make(const robot::Kinematics& kinematics,
                                                  const JointTarget& start, const MoveCommand& command);

    /// Axis angles at s in [0, 1]; exactly on the line or circle, not an interpolation between grid nodes.
    /// `tcp`: the TCP there in the object frame, when it is known without the angles.
    Joints jointsAt(double s, std::optional<Pose>* tcp = nullptr) const;
    /// Makes jointsAt(s) a task, with the TCP there: its joints are those of jointsAt(). False, and nothing is set, where they are known without.
    bool seeksJoints(double s, robot::InverseTask& task, std::optional<Pose>& tcp) const;
    ExternalAxes externalAt(double s) const;
    /// Ways of the external axes, added; deg and mm alike.
    double externalTravel() const;
    /// Arm angle of an arm with seven axes, deg: even along lines and circles. Not within a turn. Else 0.
    double armAngleAt(double s) const;
    /// deg by which it changes along a line or circle; 0 for joint moves.
    double armTravel() const { return armTravel_; }
    /// Flange in base for a TCP in the object frame, with these external axes and user frame.
    Pose flangeOf(const Pose& target, const ExternalAxes& axes, const Pose* user = nullptr) const;
    /// TCP in the object frame.
    Pose tcpAt(double s) const;
    /// Rates of the TCP in the object frame: mm and degrees per unit of s.
    void tcpRatesAt(double s, double& mm, double& deg) const;

    bool isCartesian() const { return isCartesian_; }
    /// Nothing moves.
    bool isEmpty() const { return isEmpty_; }
    /// TCP path length, mm (measured along the grid for joint moves).
    double length() const { return nodes_.empty() ? 0 : nodes_.back().distance; }
    const CartesianCurve& curve() const { return curve_; }
    const JointTarget& start() const { return start_; }
    const JointTarget& end() const { return end_; }
    const FrameSetup& frames() const { return frames_; }
    const std::vector<PathNode>& nodes() const { return nodes_; } ///< finer where axes turn fast

    const robot::Kinematics& kinematics() const { return kinematics_; }

  private:
    using Problem = std::optional<MotionError>;
    Problem resolveJointTarget(const MoveCommand& command);
    Problem resolveCurve(const MoveCommand& command);
    void resolveArmAngle(const MoveCommand& command);
    Problem march();
    Problem marchWithMode(const MoveCommand& command);
    bool canInterpolateWrist() const;
    Problem interpolateWrist(const MoveCommand& command);
    Joints wristAt(double s) const;
    Problem checkNode(const PathNode& node) const;
    Problem checkTarget(const MoveCommand& command) const;
    Problem checkArrival(const MoveCommand& command) const;
    bool solve(double s, const Joints& seed, Joints& out, std::optional<Pose>* tcp = nullptr) const;
    bool solveByWrist(double s, const Joints& seed, Joints& out) const;
    bool missByWrist(const Joints& joints, const ExternalAxes& axes, const Vec3& goal,
                     double (&miss)[2]) const;
    Problem takeWristAxes(CircleOrientation orientation);
    Problem checkWristArrival(const MoveCommand& command) const;
    bool isSmoothStep(const PathNode& from, const PathNode& to) const;
    bool isArmAngleLost(const Joints& joints) const;
    MotionError errorAt(MotionErrorKind kind, double s, int joint, double value) const;
    void layStraightGrid();
    ExternalAxes externalNear(double s) const;
    Pose flangeFor(const Pose& target, double s) const;
    Pose tcpOf(const Joints& joints, double s) const;
    const PathNode& nodeNear(double s) const;

    robot::Kinematics kinematics_;
    void setFrames(const FrameSetup& frames);
    FrameSetup frames_;
    /// The flange is before * target * after, unless something moves a frame; with a stationary tool before * target^-1 * after.
    Pose beforeTarget_, afterTarget_;
    bool isBeforeTarget_ = false, isAfterTarget_ = false; // not the identity
    JointTarget start_, end_;
    bool isCartesian_ = false;
    bool isEmpty_ = true;
    SingularityMode mode_ = SingularityMode::Off; // in force on this path
    double lockedAxis4_ = 0;                      // deg
    Joints wristVia_{};                      // posture in the circle point of a circle with SingArea Wrist
    double wristViaShare_ = 0;               // of the circle point on that circle; 0 = no circle
    double armStart_ = 0, armTravel_ = 0;    // deg
    bool isByWrist_ = false;                 // a circle that two axes of the wrist run
    std::array<std::size_t, 2> wristAxes_{}; // those, as indices
    CartesianCurve curve_;
    std::vector<PathNode> nodes_;
};

} // namespace motion

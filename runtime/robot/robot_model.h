#pragma once
// RobotModel: the constant facts about one robot arm, read from a data file in physical units. Models are
// data: a new one needs a JSON file in a searched folder and no compiler.

#include "runtime/robot/dynamics.h"
#include "runtime/robot/expected.h"
#include "runtime/robot/frames.h"
#include "runtime/robot/joints.h"

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace robot {

enum class KinematicsKind {
    SphericalWrist, ///< six axes, axes 4, 5 and 6 meet in one point: closed-form inverse
    OffsetWrist,    ///< six axes, axis 6 passes axis 5 at a distance (CRB 15000)
    SevenAxes,      ///< seven axes with an arm angle (IRB 14000, IRB 14050)
    ParallelRods,   ///< four axes, rods keep the flange level (IRB 260, 460, 660, 760)
    Scara,          ///< four axes, the third one linear (IRB 910SC, IRB 920T)
    Delta,          ///< three arms with parallel rods and a turning flange (IRB 360)
    NoArm           ///< no axes; not in data files
};

/// Geometry after Brandstoetter et al. (ortho-parallel base, spherical wrist); lengths in mm.
/// a1: axis 1 to axis 2 horizontally; a2: axis 3 to forearm axis (negative: forearm axis above axis 3); b:
/// sideways offset of the arm plane; c1: base to axis 2; c2: axis 2 to 3; c3: axis 3 to wrist centre; c4:
/// wrist centre to flange.
struct OpwParameters {
    double a1 = 0, a2 = 0, b = 0, c1 = 0, c2 = 0, c3 = 0, c4 = 0;
    Joints offsetsDeg{};            ///< model angle = sign * axis angle - offset; 0,0,-90,0,0,0 on ABB arms
    Joints signs{1, 1, 1, 1, 1, 1}; ///< +1 or -1
};

/// Lengths in mm of an arm with seven axes, at the zero posture (upper arm upright, forearm along x): axis 1 is z at
/// height `base`; axis 2 is parallel to y at x = `shoulder`; axis 7, the second of the upper arm, is z again; axis 3 is
/// parallel to y, `upperArm` above axis 2 at x = `elbowOut`; axis 4 is parallel to x, `elbowUp` above axis 3; axis 5 is
/// parallel to y, `forearm` from axis 3 and `wrist` above axis 4; axis 6 is in line with axis 4; the flange is `flange`
/// from axis 5.
struct SevenAxisGeometry {
    double base = 0, shoulder = 0, upperArm = 0, elbowOut = 0, elbowUp = 0, forearm = 0, wrist = 0,
           flange = 0;
    Vec3 armAngleReference{0, 0, 1}; ///< unit vector in base: system parameter Arm-Angle Reference Direction
};

/// Lengths in mm of an arm whose rods keep the flange level: a1 axis 1 to axis 2 horizontally, c1 height of axis 2, c2
/// lower arm, c3 upper arm, then `out` horizontally and `down` to the flange. Axis 2 counts from the vertical, axis 3
/// from the horizontal (positive: down) whatever axis 2 does.
struct ParallelRodGeometry {
    double a1 = 0, c1 = 0, c2 = 0, c3 = 0, out = 0, down = 0;
    /// Range of the angle between lower and upper arm, degrees (180: stretched). It limits axes 2 and 3 together.
    double leastElbowDeg = -HUGE_VAL, mostElbowDeg = HUGE_VAL;
};

/// Lengths in mm of a SCARA arm: height of the flange with axis 3 at 0, axis 1 to 2, axis 2 to 3.
struct ScaraGeometry {
    double height = 0, upperArm = 0, forearm = 0;
};

/// Lengths in mm of a delta robot: distance of the arm axes and of the rod joints of the platform from the centre
/// line, the two links, and the flange below the rod joints. Base frame in the plane of the arm axes, z up; arm 1
/// points along x, arms 2 and 3 are 120 and 240 degrees further about z; an arm at 0 degrees is level, positive: down.
struct DeltaGeometry {
    double baseRadius = 0, upperArm = 0, rod = 0, platformRadius = 0, flangeDown = 0;
};

/// Only the geometry that belongs to `kinematics` is filled in (the signs and offsets of `geometry` always are).
/// Figures per axis are in degrees, for a linear axis in mm.
struct RobotModel {
    std::string name; ///< as people write it: "IRB 120-3/0.58"
    double payloadKg = 0;
    double reachM = 0;
    KinematicsKind kinematics = KinematicsKind::SphericalWrist;
    OpwParameters geometry;
    SevenAxisGeometry sevenAxes;
    ParallelRodGeometry parallelRods;
    ScaraGeometry scara;
    DeltaGeometry delta;
    std::array<int, kMostJoints> axisNumbers{1, 2, 3, 4, 5, 6, 7}; ///< RAPID's number of each axis
    Quat flangeRot{0, 0, 1, 0}; ///< four axes: flange in base with all axes at 0; z must point down
    Joints lowerDeg{};          ///< joint limits, degrees
    Joints upperDeg{};
    Joints maxSpeed{};              ///< deg/s
    Joints maxAcceleration{};       ///< deg/s^2
    Joints maxJerk{};               ///< deg/s^3
    Dynamics dynamics;              ///< of the data file, else estimated
    double maxTcpSpeed = 5000;      ///< mm/s; what MaxRobSpeed gives and vmax means
    double wristOffset = 0;         ///< mm between axes 5 and 6; not 0 only for OffsetWrist
    Pose baseFrame;                 ///< base in world; identity unless configured
    Joints home = Joints::zeros(0); ///< where the arm is at the start; no axes: the usual posture
    int externalAxes = 0;           ///< external axes that come with the arm
    std::vector<std::string>
        provisional; ///< names of fields of the data file that are assumed, not published
};

struct ModelError {
    std::string message; ///< complete sentence part with file, field and remedy
};

/// Finds a model by name or reads the file it names. A text that ends in ".json" is a path. Otherwise the
/// name is looked up in the *.json files of `searchDirs` (first hit wins, so that a folder can override a
/// shipped model), then among the embedded models. Lenient: case, blanks and punctuation do not count
/// ("irb120"), trailing parts may be left out as long as one model remains ("IRB 120-3"), and use_robot_type
/// of MOC.cfg ("ROB1_1660ID_1.55_4") is understood. Errors: unknown (with near names), ambiguous (with all
/// candidates), unreadable or incomplete file.
Expected<RobotModel, ModelError> loadRobotModel(std::string_view nameOrPath,
                                                std::span<const std::string> searchDirs = {});

/// The embedded model that comes nearest to a robot of a name that no model has: of the same family or one beside it, and of a
/// similar reach and payload. "" when none is near.
std::string similarRobotModel(std::string_view name);

/// Reads one model from the text of a data file; `origin` names it in errors.
Expected<RobotModel, ModelError> parseRobotModel(std::string_view jsonText, std::string_view origin);

/// A model without an arm, for a motion task that moves external units alone.
RobotModel armlessModel();

/// Names of all embedded models, sorted.
std::vector<std::string> robotModelNames();

} // namespace robot

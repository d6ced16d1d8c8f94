#pragma once
// RobotModel: the constant facts about one robot arm, read from a data file in physical units. Models are
// data: a new one needs a JSON file in a searched folder and no compiler.

#include "runtime/robot/expected.h"
#include "runtime/robot/frames.h"
#include "runtime/robot/joints.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace robot {

enum class KinematicsKind {
    SphericalWrist, ///< six axes, axes 4, 5 and 6 meet in one point: closed-form inverse
    OffsetWrist     ///< wrist axes do not meet (CRB 15000): listed, but motion refuses it
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

struct RobotModel {
    std::string name; ///< as people write it: "IRB 120-3/0.58"
    double payloadKg = 0;
    double reachM = 0;
    KinematicsKind kinematics = KinematicsKind::SphericalWrist;
    OpwParameters geometry;
    Joints lowerDeg{}; ///< joint limits, degrees
    Joints upperDeg{};
    Joints maxSpeed{};         ///< deg/s
    Joints maxAcceleration{};  ///< deg/s^2
    Joints maxJerk{};          ///< deg/s^3
    double maxTcpSpeed = 5000; ///< mm/s; what MaxRobSpeed gives and vmax means
    double wristOffset = 0;    ///< mm between axes 5 and 6; not 0 only for OffsetWrist
    Pose baseFrame;            ///< base in world; identity unless configured
    int externalAxes = 0;      ///< external axes that come with the arm
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

/// Reads one model from the text of a data file; `origin` names it in errors.
Expected<RobotModel, ModelError> parseRobotModel(std::string_view jsonText, std::string_view origin);

/// Names of all embedded models, sorted.
std::vector<std::string> robotModelNames();

} // namespace robot

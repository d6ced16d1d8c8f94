#pragma once
// The results of a simulated camera: the JSON file of --camera (docs/vision.md).

#include "runtime/base/time.h"
#include "runtime/robot/frames.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rt::lib {

/// Of a camera parameter: a number, a truth value or a text.
using CameraValue = std::variant<double, bool, std::string>;
using CameraParameters = std::map<std::string, CameraValue, std::less<>>; ///< by lower-case name

/// A part that a vision job has found. Position in mm in the work object of the camera.
struct CameraPart {
    std::string name;
    robot::Pose frame;
    std::array<double, 5> values{};
    std::array<std::string, 2> texts;
    double type = 0;
};

struct CameraImage {
    std::vector<CameraPart> parts;
    CameraParameters parameters; ///< as they are after this image
    double seconds = -1;         ///< until the result is there; negative: as the camera says
};

struct CameraJob {
    std::string name; ///< as written
    CameraParameters parameters;
    std::vector<CameraImage> images;
    bool repeats = true; ///< after the last image the first follows; else images without parts
};

/// From when to when, in virtual time.
using CameraSpan = std::pair<Time, Time>;

struct CameraFile {
    bool runMode = false; ///< at the start
    std::string job;      ///< loaded at the start; "": none
    double exposureTime = 8, brightness = 0.5, contrast = 0.5;
    double loadSeconds = 1, imageSeconds = 0.2;
    CameraParameters parameters;
    std::map<std::string, CameraJob, std::less<>> jobs; ///< by lower-case name
    std::vector<CameraSpan> silent;                     ///< the camera does not answer
    std::vector<CameraSpan> busy;                       ///< the camera does something else
};

/// Returns what is wrong with the text, for people; "" when it is well.
std::string readCameraFile(const std::string& bytes, CameraFile& file);

} // namespace rt::lib

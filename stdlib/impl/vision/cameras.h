#pragma once
// Simulated cameras of Integrated Vision: mode, job, images in time, and the results that a program fetches.

#include "stdlib/impl/vision/camera_file.h"

#include "runtime/host/controller.h"

#include "stdlib_types.h"

#include <nlohmann/json_fwd.hpp>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// A result that CamGetResult can fetch.
struct CameraResult {
    CameraPart part;
    double scene = 0;
};

/// One camera. Times are virtual; what is under way is finished by bringUp().
class Camera {
  public:
    Camera(std::string name, CameraFile file);

    const std::string& name() const { return name_; }
    const CameraFile& file() const { return file_; }
    /// Finishes what is finished at this time.
    void bringUp(Time now);

    bool isRunMode() const { return runMode_; }
    void setRunMode(bool on) { runMode_ = on; }
    bool isSilent(Time now) const;
    bool isElsewhere(Time now) const;

    /// False: there is no such job. It is loaded at loadedAt(); the results go, unless they are kept.
    bool startLoad(std::string_view job, bool keepResults, Time now);
    /// kNever: no job is being loaded.
    Time loadedAt() const { return loadedAt_; }
    /// Name as in the file; "" when no job is loaded.
    std::string loadedJob() const;

    /// The image that is next; its results are there at imageAt().
    void takeImage(double scene, bool keepResults, Time now);
    /// kNever: no image is being processed.
    Time imageAt() const { return imageAt_; }

    /// Of a scene, or of all.
    std::size_t count(const std::optional<double>& scene) const;
    std::optional<CameraResult> fetch(const std::optional<double>& scene);
    void flush() { results_.clear(); }

    /// Null: the camera has no such parameter. Those of the last image come before those of the job and of the camera.
    CameraValue* parameter(std::string_view name);

    /// The part that another process needs to continue (--state); times from `now` on.
    nlohmann::json state(Time now) const;
    /// Takes that over; jobs that the file no longer has are not loaded. Throws what the JSON library throws.
    void restore(const nlohmann::json& state, Time now);

    double exposureTime, brightness, contrast;
    int unnamedScenes = 0; ///< images without \SceneId so far

  private:
    CameraJob* jobFrom(const nlohmann::json& name);

    std::string name_;
    CameraFile file_;
    bool runMode_ = false;
    CameraJob* job_ = nullptr;
    CameraJob* loading_ = nullptr;
    Time loadedAt_ = kNever, imageAt_ = kNever;
    std::size_t nextImage_ = 0;
    const CameraImage* image_ = nullptr; ///< being processed
    double scene_ = 0;
    CameraParameters seen_; ///< of the last image
    std::deque<CameraResult> results_;
};

/// Reads the files of --camera; what is wrong with them is left in CameraNames::problem.
void openCameras(Controller& controller);
/// Cameras and their results between two processes (--state).
void keepCameras(Controller& controller, StateKeepers& kept);
/// Null: the camera has no file.
Camera* findCamera(Controller& controller, int number);

} // namespace rt::lib

// Integrated Vision: the instructions and functions Cam..., of a simulated camera.

#include "stdlib/impl/vision/cameras.h"

#include "runtime/host/camera_names.h"
#include "stdlib/impl/math/convert.h"
#include "stdlib/impl/support/fail.h"

#include "natives/vision.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

using namespace rt;
using lib::Camera;

namespace {

/// \MaxTime of vision instructions when it is left out, s.
constexpr float kUsualTime = 120;

/// The name of the camera that a variable names; "" when it names none.
std::string nameOf(TaskCore* task, Handle handle) {
    const auto& names = taskOf(task).controller().service<CameraNames>();
    const int number = names.cameraOf(handle);
    return number < 0 ? "" : names.name(number);
}

/// The camera, brought up to now. Null, with ERR_CAM_COM_TIMEOUT raised, when it does not answer.
Camera* answering(TaskCore* task, Handle handle, Status& status) {
    Task& owner = taskOf(task);
    auto& names = owner.controller().service<CameraNames>();
    const int number = names.cameraOf(handle);
    if (number < 0) {
        status = lib::fail(task, err::ERR_CAM_COM_TIMEOUT,
                           "the camera variable names no camera; use AliasCamera first");
        return nullptr;
    }
    Camera* camera = lib::findCamera(owner.controller(), number);
    if (camera == nullptr || camera->isSilent(owner.now())) {
        status = lib::fail(
            task, err::ERR_CAM_COM_TIMEOUT,
            camera == nullptr
                ? fmt::format("camera {0} is not there; --camera={0}=FILE.json says what it sees",
                              names.name(number))
                : fmt::format("camera {} does not answer (\"silent\" in its file)", names.name(number)));
        return nullptr;
    }
    camera->bringUp(owner.now());
    return camera;
}

/// As answering(), of a camera that takes orders: it has no job to load and nothing else to do. An image in progress is waited
/// for: the camera does one thing after the other.
Camera* ready(TaskCore* task, Handle handle, Status& status) {
    Task& owner = taskOf(task);
    Camera* camera = answering(task, handle, status);
    if (camera == nullptr) return nullptr;
    if (camera->isElsewhere(owner.now()) || camera->loadedAt() != kNever) {
        status = lib::fail(task, err::ERR_CAM_BUSY,
                           fmt::format("camera {} {}", camera->name(),
                                       camera->loadedAt() != kNever
                                           ? "loads a job; use CamWaitLoadJob first"
                                           : "has something else to do (\"busy\" in its file)"));
        return nullptr;
    }
    while (camera->imageAt() != kNever) {
        if ((status = owner.sleepUntil(camera->imageAt())) != kOk) return nullptr;
        camera->bringUp(owner.now());
    }
    return camera;
}

Status inProgramMode(TaskCore* task, const Camera& camera) {
    if (!camera.isRunMode()) return kOk;
    return lib::fail(task, err::ERR_CAM_NO_PROGMODE,
                     fmt::format("camera {} is in run mode; use CamSetProgramMode first", camera.name()));
}

Status inRunMode(TaskCore* task, const Camera& camera) {
    if (camera.isRunMode()) return kOk;
    return lib::fail(task, err::ERR_CAM_NO_RUNMODE,
                     fmt::format("camera {} is in program mode; use CamSetRunMode first", camera.name()));
}

/// Absolute virtual time for \MaxTime; ERR_ARGVALERR when it is not a time.
Status deadlineOf(TaskCore* task, const float* seconds, Time& deadline) {
    const float span = seconds != nullptr ? *seconds : kUsualTime;
    if (!(span >= 0))
        return lib::fail(task, err::ERR_ARGVALERR, "\\MaxTime must be a time in s, not negative");
    deadline = span >= k::WAIT_MAX ? kNever : addTime(taskOf(task).now(), fromSeconds(span));
    return kOk;
}

Status startLoad(TaskCore* task, Camera& camera, const String& job, bool keepResults) {
    if (const Status status = inProgramMode(task, camera)) return status;
    if (camera.startLoad(job.view(), keepResults, taskOf(task).now())) return kOk;
    std::string known;
    for (const auto& [key, each] : camera.file().jobs)
        known += (known.empty() ? "" : ", ") + each.name;
    return lib::fail(task, err::ERR_CAM_COM_TIMEOUT,
                     fmt::format("camera {} has no job {}; it has {}", camera.name(), job.view(),
                                 known.empty() ? "none" : known));
}

data::Cameratarget targetOf(const Camera& camera, const lib::CameraResult& result) {
    data::Cameratarget target{};
    target.name.assign(result.part.name);
    target.cframe = lib::toPose(result.part.frame);
    float* const values[] = {&target.val1, &target.val2, &target.val3, &target.val4, &target.val5};
    for (std::size_t i = 0; i < result.part.values.size(); ++i)
        *values[i] = static_cast<float>(result.part.values[i]);
    target.string1.assign(result.part.texts[0]);
    target.string2.assign(result.part.texts[1]);
    target.type = static_cast<float>(result.part.type);
    target.cameraname.assign(camera.name());
    target.sceneid = static_cast<float>(result.scene);
    return target;
}

std::optional<double> sceneOf(const float* scene) {
    return scene != nullptr ? std::optional<double>(*scene) : std::nullopt;
}

template <class Value>
Status mismatch(TaskCore* task, Status number, const Camera& camera, const String& name, Value* found) {
    return lib::fail(task, number,
                     fmt::format("parameter {} of camera {} {}", name.view(), camera.name(),
                                 found == nullptr ? "does not exist" : "has a different type"));
}

Status setMode(TaskCore* task, Handle handle, bool run) {
    Status status = kOk;
    Camera* camera = ready(task, handle, status);
    if (camera != nullptr) camera->setRunMode(run);
    return status;
}

} // namespace

extern "C" {

Status rt_CamFlush(TaskCore* task, Handle* Camera) {
    Status status = kOk;
    if (lib::Camera* camera = answering(task, *Camera, status)) camera->flush();
    return status;
}

Status rt_CamSetProgramMode(TaskCore* task, Handle* Camera) {
    return setMode(task, *Camera, false);
}

Status rt_CamSetRunMode(TaskCore* task, Handle* Camera) {
    return setMode(task, *Camera, true);
}

/// The results are those of the jobs in the file; the next image of a job that is loaded is its first.
Status rt_CamLoadJob(TaskCore* task, Handle* Camera, const String* JobName, bool KeepTargets,
                     const float* MaxTime) {
    Status status = kOk;
    Time deadline = kNever;
    if ((status = deadlineOf(task, MaxTime, deadline)) != kOk) return status;
    lib::Camera* camera = ready(task, *Camera, status);
    if (camera == nullptr) return status;
    if ((status = startLoad(task, *camera, *JobName, KeepTargets)) != kOk) return status;
    Task& owner = taskOf(task);
    if (camera->loadedAt() > deadline) {
        if ((status = owner.sleepUntil(deadline)) != kOk) return status;
        return lib::fail(task, err::ERR_CAM_MAXTIME,
                         fmt::format("camera {} has not loaded the job within \\MaxTime", camera->name()));
    }
    if ((status = owner.sleepUntil(camera->loadedAt())) == kOk) camera->bringUp(owner.now());
    return status;
}

Status rt_CamStartLoadJob(TaskCore* task, Handle* Camera, const String* Name, bool KeepTargets) {
    Status status = kOk;
    lib::Camera* camera = ready(task, *Camera, status);
    return camera == nullptr ? status : startLoad(task, *camera, *Name, KeepTargets);
}

Status rt_CamWaitLoadJob(TaskCore* task, Handle* Camera) {
    Status status = kOk;
    lib::Camera* camera = answering(task, *Camera, status);
    while (camera != nullptr && camera->loadedAt() != kNever) {
        if ((status = taskOf(task).sleepUntil(camera->loadedAt())) != kOk) return status;
        camera = answering(task, *Camera, status);
    }
    return status;
}

Status rt_CamReqImage(TaskCore* task, Handle* Camera, const float* SceneId, bool KeepTargets,
                      bool AwaitComplete) {
    Status status = kOk;
    lib::Camera* camera = answering(task, *Camera, status);
    if (camera == nullptr) return status;
    if (camera->imageAt() != kNever)
        return lib::fail(task, err::ERR_CAM_BUSY,
                         fmt::format("camera {} has not finished the image before", camera->name()));
    if ((camera = ready(task, *Camera, status)) == nullptr) return status;
    if ((status = inRunMode(task, *camera)) != kOk) return status;
    if (camera->loadedJob().empty())
        return lib::fail(task, err::ERR_CAM_NO_RUNMODE,
                         fmt::format("camera {} has no job; use CamLoadJob first", camera->name()));
    Task& owner = taskOf(task);
    const double scene = SceneId != nullptr ? *SceneId : -(++camera->unnamedScenes);
    camera->takeImage(scene, KeepTargets, owner.now());
    if (AwaitComplete && (status = owner.sleepUntil(camera->imageAt())) == kOk) camera->bringUp(owner.now());
    return status;
}

Status rt_CamGetResult(TaskCore* task, Handle* Camera, data::Cameratarget* CamTarget, const float* SceneId,
                       const float* MaxTime) {
    Status status = kOk;
    Time deadline = kNever;
    if ((status = deadlineOf(task, MaxTime, deadline)) != kOk) return status;
    lib::Camera* camera = answering(task, *Camera, status);
    if (camera == nullptr) return status;
    if (camera->isElsewhere(taskOf(task).now()) || camera->loadedAt() != kNever) {
        (void)ready(task, *Camera, status); // says why
        return status;
    }
    if ((status = inRunMode(task, *camera)) != kOk) return status;
    Task& owner = taskOf(task);
    const auto scene = sceneOf(SceneId);
    auto result = camera->fetch(scene);
    while (!result && camera->imageAt() != kNever) {
        const bool isLate = camera->imageAt() > deadline;
        if ((status = owner.sleepUntil(isLate ? deadline : camera->imageAt())) != kOk) return status;
        if (isLate)
            return lib::fail(task, err::ERR_CAM_MAXTIME,
                             fmt::format("camera {} has no result within \\MaxTime", camera->name()));
        if ((camera = answering(task, *Camera, status)) == nullptr) return status;
        result = camera->fetch(scene);
    }
    if (!result)
        return lib::fail(task, err::ERR_CAM_NO_MORE_DATA,
                         fmt::format("camera {} has no further result{}", camera->name(),
                                     scene ? fmt::format(" of scene {:g}", *scene) : ""));
    *CamTarget = targetOf(*camera, *result);
    return kOk;
}

Status rt_CamGetParameter(TaskCore* task, Handle* Camera, const String* ParName, float* NumVar, bool* BoolVar,
                          String* StrVar) {
    Status status = kOk;
    lib::Camera* camera = ready(task, *Camera, status);
    if (camera == nullptr) return status;
    lib::CameraValue* found = camera->parameter(ParName->view());
    if (found != nullptr && NumVar != nullptr && std::holds_alternative<double>(*found))
        *NumVar = static_cast<float>(std::get<double>(*found));
    else if (found != nullptr && BoolVar != nullptr && std::holds_alternative<bool>(*found))
        *BoolVar = std::get<bool>(*found);
    else if (found != nullptr && StrVar != nullptr && std::holds_alternative<std::string>(*found))
        StrVar->assign(std::get<std::string>(*found));
    else
        return mismatch(task, err::ERR_CAM_GET_MISMATCH, *camera, *ParName, found);
    return kOk;
}

Status rt_CamSetParameter(TaskCore* task, Handle* Camera, const String* ParName, const float* NumVal,
                          const bool* BoolVal, const String* StrVal) {
    Status status = kOk;
    lib::Camera* camera = ready(task, *Camera, status);
    if (camera == nullptr) return status;
    lib::CameraValue* found = camera->parameter(ParName->view());
    if (found != nullptr && NumVal != nullptr && std::holds_alternative<double>(*found))
        *found = static_cast<double>(*NumVal);
    else if (found != nullptr && BoolVal != nullptr && std::holds_alternative<bool>(*found))
        *found = *BoolVal;
    else if (found != nullptr && StrVal != nullptr && std::holds_alternative<std::string>(*found))
        *found = std::string(StrVal->view());
    else
        return mismatch(task, err::ERR_CAM_SET_MISMATCH, *camera, *ParName, found);
    return kOk;
}

Status rt_CamSetExposure(TaskCore* task, Handle* Camera, const float* ExposureTime, const float* Brightness,
                         const float* Contrast) {
    const auto isShare = [](const float* value) { return value == nullptr || (*value >= 0 && *value <= 1); };
    if (ExposureTime != nullptr && !(*ExposureTime > 0 && std::isfinite(*ExposureTime)))
        return lib::fail(task, err::ERR_ARGVALERR, "\\ExposureTime must be a time in ms, above 0");
    if (!isShare(Brightness) || !isShare(Contrast))
        return lib::fail(task, err::ERR_ARGVALERR, "\\Brightness and \\Contrast must be from 0 to 1");
    Status status = kOk;
    lib::Camera* camera = ready(task, *Camera, status);
    if (camera == nullptr) return status;
    if (ExposureTime != nullptr) camera->exposureTime = *ExposureTime;
    if (Brightness != nullptr) camera->brightness = *Brightness;
    if (Contrast != nullptr) camera->contrast = *Contrast;
    return kOk;
}

Status rt_CamGetExposure(TaskCore* task, float* result, Handle* Camera, bool, bool Brightness,
                         bool Contrast) {
    *result = 0;
    Status status = kOk;
    const lib::Camera* camera = ready(task, *Camera, status);
    if (camera == nullptr) return status;
    *result = static_cast<float>(Brightness ? camera->brightness
                                 : Contrast ? camera->contrast
                                            : camera->exposureTime);
    return kOk;
}

Status rt_CamGetLoadedJob(TaskCore* task, String* result, Handle* Camera) {
    result->assign("");
    Status status = kOk;
    if (const lib::Camera* camera = ready(task, *Camera, status)) result->assign(camera->loadedJob());
    return status;
}

Status rt_CamGetName(TaskCore* task, String* result, Handle* Camera) {
    result->assign(nameOf(task, *Camera));
    return kOk;
}

/// Those that are there; an image in progress is not waited for.
Status rt_CamNumberOfResults(TaskCore* task, float* result, Handle* Camera, const float* SceneId) {
    *result = 0;
    Status status = kOk;
    const lib::Camera* camera = answering(task, *Camera, status);
    if (camera == nullptr) return status;
    if (camera->loadedAt() != kNever || camera->isElsewhere(taskOf(task).now())) {
        (void)ready(task, *Camera, status); // says why
        return status;
    }
    *result = static_cast<float>(camera->count(sceneOf(SceneId)));
    return kOk;
}

Status rt_AliasCamera(TaskCore* task, const String* CameraName, Handle* FromCamera, Handle* ToCamera) {
    auto& names = taskOf(task).controller().service<CameraNames>();
    const int number = CameraName != nullptr ? names.find(CameraName->view()) : names.cameraOf(*FromCamera);
    if (number < 0)
        return lib::fail(
            task, err::ERR_CAM_COM_TIMEOUT,
            CameraName != nullptr
                ? fmt::format("no camera is called {0}; --camera={0}=FILE.json adds one", CameraName->view())
                : "FromCamera names no camera");
    *ToCamera = CameraNames::handleOf(number);
    return kOk;
}
}

#include "stdlib/impl/vision/cameras.h"

#include "config/letter_case.h"
#include "config/read_file.h"
#include "runtime/host/camera_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <utility>

namespace rt::lib {
namespace {

struct Cameras {
    std::map<int, std::unique_ptr<Camera>> byNumber;
};

bool isWithin(const std::vector<CameraSpan>& spans, Time now) {
    return std::any_of(spans.begin(), spans.end(),
                       [now](const CameraSpan& span) { return now >= span.first && now < span.second; });
}

/// A name that a program can use: letters, digits and underscores.
bool isName(std::string_view text) {
    return !text.empty() && text.size() <= 32 && std::isalpha(static_cast<unsigned char>(text[0])) &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

std::string openCamera(Controller& controller, const std::string& option) {
    const std::size_t sign = option.find('=');
    const std::string name = option.substr(0, sign);
    if (sign == std::string::npos || sign + 1 == option.size())
        return fmt::format("'{}' is not NAME=FILE.json", option);
    if (!isName(name)) return fmt::format("'{}' is not a name that a program can use", name);
    const std::string path = option.substr(sign + 1);
    auto& names = controller.service<CameraNames>();
    if (names.find(name) >= 0) return fmt::format("there are two files for camera '{}'", name);
    std::string bytes;
    if (const std::string problem = rapid::config::readFile(path, bytes); !problem.empty())
        return fmt::format("cannot read '{}': {}", path, problem);
    CameraFile file;
    if (const std::string problem = readCameraFile(bytes, file); !problem.empty())
        return fmt::format("'{}' does not describe a camera: {}", path, problem);
    controller.service<Cameras>().byNumber[names.add(name)] = std::make_unique<Camera>(name, std::move(file));
    return {};
}

} // namespace

void openCameras(Controller& controller) {
    for (const std::string& option : controller.options().cameras) {
        const std::string problem = openCamera(controller, option);
        if (problem.empty()) continue;
        controller.service<CameraNames>().problem = problem;
        return;
    }
}

Camera* findCamera(Controller& controller, int number) {
    const auto& cameras = controller.service<Cameras>().byNumber;
    const auto found = cameras.find(number);
    return found == cameras.end() ? nullptr : found->second.get();
}

Camera::Camera(std::string name, CameraFile file)
    : exposureTime(file.exposureTime), brightness(file.brightness), contrast(file.contrast),
      name_(std::move(name)), file_(std::move(file)), runMode_(file_.runMode) {
    if (!file_.job.empty()) job_ = &file_.jobs[file_.job];
}

void Camera::bringUp(Time now) {
    if (loadedAt_ <= now) {
        loadedAt_ = kNever;
        job_ = std::exchange(loading_, nullptr);
        nextImage_ = 0;
        seen_.clear();
    }
    if (imageAt_ <= now) {
        imageAt_ = kNever;
        if (const CameraImage* image = std::exchange(image_, nullptr)) {
            for (const CameraPart& part : image->parts)
                results_.push_back({part, scene_});
            seen_ = image->parameters;
        }
    }
}

bool Camera::isSilent(Time now) const {
    return isWithin(file_.silent, now);
}

bool Camera::isElsewhere(Time now) const {
    return isWithin(file_.busy, now);
}

bool Camera::startLoad(std::string_view job, bool keepResults, Time now) {
    const std::string wanted = rapid::config::lowerCase(job);
    auto found = file_.jobs.find(wanted);
    if (found == file_.jobs.end() && !wanted.ends_with(".job")) found = file_.jobs.find(wanted + ".job");
    if (found == file_.jobs.end()) return false;
    if (!keepResults) flush();
    loading_ = &found->second;
    loadedAt_ = addTime(now, fromSeconds(file_.loadSeconds));
    return true;
}

std::string Camera::loadedJob() const {
    return job_ == nullptr ? "" : job_->name;
}

void Camera::takeImage(double scene, bool keepResults, Time now) {
    if (!keepResults) flush();
    image_ = nullptr;
    if (job_ != nullptr && !job_->images.empty()) {
        if (job_->repeats)
            image_ = &job_->images[nextImage_++ % job_->images.size()];
        else if (nextImage_ < job_->images.size())
            image_ = &job_->images[nextImage_++];
    }
    scene_ = scene;
    const bool hasTime = image_ != nullptr && image_->seconds >= 0;
    imageAt_ = addTime(now, fromSeconds(hasTime ? image_->seconds : file_.imageSeconds));
}

std::size_t Camera::count(const std::optional<double>& scene) const {
    if (!scene) return results_.size();
    return static_cast<std::size_t>(
        std::count_if(results_.begin(), results_.end(),
                      [&scene](const CameraResult& result) { return result.scene == *scene; }));
}

std::optional<CameraResult> Camera::fetch(const std::optional<double>& scene) {
    const auto found = std::find_if(results_.begin(), results_.end(), [&scene](const CameraResult& result) {
        return !scene || result.scene == *scene;
    });
    if (found == results_.end()) return std::nullopt;
    CameraResult result = std::move(*found);
    results_.erase(found);
    return result;
}

CameraValue* Camera::parameter(std::string_view name) {
    const std::string wanted = rapid::config::lowerCase(name);
    std::vector<CameraParameters*> places = {&seen_};
    if (job_ != nullptr) places.push_back(&job_->parameters);
    places.push_back(&file_.parameters);
    for (CameraParameters* place : places)
        if (const auto found = place->find(wanted); found != place->end()) return &found->second;
    return nullptr;
}

} // namespace rt::lib

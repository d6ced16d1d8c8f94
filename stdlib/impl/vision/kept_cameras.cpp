// Cameras between two processes (--state): mode, jobs, the image in progress, and the results that were not fetched.

#include "config/json_text.h"
#include "config/letter_case.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/camera_names.h"
#include "runtime/host/json_numbers.h"
#include "runtime/host/path_image.h"
#include "stdlib/impl/vision/cameras.h"

#include <algorithm>
#include <stdexcept>

namespace rt::lib {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostResults = 100'000;
constexpr double kLongestSpan = 1e9; // s

Json jsonOf(const CameraParameters& parameters) {
    Json all = Json::object();
    for (const auto& [name, value] : parameters)
        std::visit([&all, &name](const auto& known) { all[name] = known; }, value);
    return all;
}

/// The values of those that are there, when they are of the same kind.
void takeValues(const Json& json, CameraParameters& parameters) {
    for (auto& [name, value] : parameters) {
        const auto found = json.find(name);
        if (found == json.end()) continue;
        if (std::holds_alternative<double>(value) && found->is_number()) value = found->get<double>();
        if (std::holds_alternative<bool>(value) && found->is_boolean()) value = found->get<bool>();
        if (std::holds_alternative<std::string>(value) && found->is_string())
            value = found->get<std::string>();
    }
}

CameraParameters parametersFrom(const Json& json) {
    CameraParameters parameters;
    for (const auto& [name, value] : json.items()) {
        if (value.is_boolean())
            parameters[name] = value.get<bool>();
        else if (value.is_number())
            parameters[name] = value.get<double>();
        else
            parameters[name] = value.get<std::string>();
    }
    return parameters;
}

Json jsonOf(const CameraResult& result) {
    const CameraPart& part = result.part;
    return {{"name", part.name},     {"frame", rt::jsonOf(part.frame)},
            {"values", part.values}, {"texts", part.texts},
            {"type", part.type},     {"scene", result.scene}};
}

CameraResult resultFrom(const Json& json) {
    CameraResult result;
    CameraPart& part = result.part;
    json.at("name").get_to(part.name);
    part.frame = poseFrom(json.at("frame"));
    if (json.at("values").size() != part.values.size() || json.at("texts").size() != part.texts.size())
        throw std::invalid_argument("a different number of values");
    json.at("values").get_to(part.values);
    json.at("texts").get_to(part.texts);
    json.at("type").get_to(part.type);
    json.at("scene").get_to(result.scene);
    return result;
}

/// Seconds until then; null: never.
Json spanUntil(Time then, Time now) {
    return then == kNever ? Json() : Json(toSeconds(then - now));
}

Time timeFrom(const Json& span, Time now) {
    if (span.is_null()) return kNever;
    return addTime(now, fromSeconds(std::clamp(numberFrom<double>(span), 0.0, kLongestSpan)));
}

} // namespace

CameraJob* Camera::jobFrom(const Json& name) {
    const auto found = file_.jobs.find(rapid::config::lowerCase(name.get<std::string>()));
    return found == file_.jobs.end() ? nullptr : &found->second;
}

Json Camera::state(Time now) const {
    const auto nameOf = [](const CameraJob* job) { return job == nullptr ? std::string() : job->name; };
    Json results = Json::array(), jobs = Json::object();
    for (const CameraResult& result : results_)
        results.push_back(jsonOf(result));
    for (const auto& [name, job] : file_.jobs)
        jobs[name] = jsonOf(job.parameters);
    const bool hasImage = image_ != nullptr && job_ != nullptr;
    return {{"runMode", runMode_},
            {"job", nameOf(job_)},
            {"loading", nameOf(loading_)},
            {"loadedIn", spanUntil(loadedAt_, now)},
            {"imageIn", spanUntil(imageAt_, now)},
            {"image", hasImage ? image_ - job_->images.data() : -1},
            {"nextImage", nextImage_},
            {"scene", scene_},
            {"seen", jsonOf(seen_)},
            {"settings", {exposureTime, brightness, contrast}},
            {"unnamedScenes", unnamedScenes},
            {"parameters", jsonOf(file_.parameters)},
            {"jobs", std::move(jobs)},
            {"results", std::move(results)}};
}

void Camera::restore(const Json& state, Time now) {
    const Json& settings = state.at("settings");
    exposureTime = numberFrom<double>(settings.at(0));
    brightness = numberFrom<double>(settings.at(1));
    contrast = numberFrom<double>(settings.at(2));
    unnamedScenes = numberFrom<int>(state.at("unnamedScenes"));
    state.at("runMode").get_to(runMode_);
    takeValues(state.at("parameters"), file_.parameters);
    for (auto& [name, job] : file_.jobs)
        if (const auto found = state.at("jobs").find(name); found != state.at("jobs").end())
            takeValues(*found, job.parameters);
    job_ = jobFrom(state.at("job"));
    loading_ = jobFrom(state.at("loading"));
    loadedAt_ = loading_ == nullptr ? kNever : timeFrom(state.at("loadedIn"), now);
    imageAt_ = timeFrom(state.at("imageIn"), now);
    nextImage_ = numberFrom<std::size_t>(state.at("nextImage"));
    const auto image = numberFrom<int64_t>(state.at("image"));
    const bool isThere = job_ != nullptr && image >= 0 && image < static_cast<int64_t>(job_->images.size());
    image_ = isThere ? &job_->images[static_cast<std::size_t>(image)] : nullptr;
    scene_ = numberFrom<double>(state.at("scene"));
    seen_ = parametersFrom(state.at("seen"));
    results_.clear();
    if (state.at("results").size() > kMostResults) throw std::invalid_argument("too many results");
    for (const Json& result : state.at("results"))
        results_.push_back(resultFrom(result));
}

void keepCameras(Controller& controller, StateKeepers& kept) {
    const auto forEach = [&controller](auto action) {
        for (std::size_t i = 0; i < controller.service<CameraNames>().size(); ++i)
            if (Camera* camera = findCamera(controller, static_cast<int>(i))) action(*camera);
    };
    kept.keepers["cameras"] = {
        [&controller, forEach] {
            Json all = Json::object();
            forEach([&](Camera& camera) { all[camera.name()] = camera.state(controller.scheduler().now()); });
            return all;
        },
        [&controller, forEach](const Json& all) {
            forEach([&](Camera& camera) {
                if (const auto found = all.find(camera.name()); found != all.end())
                    camera.restore(*found, controller.scheduler().now());
            });
        }};
    kept.handles["cameradev"] = {[&controller](Handle handle) {
                                     const auto& names = controller.service<CameraNames>();
                                     const int camera = names.cameraOf(handle);
                                     return camera < 0 ? std::string() : names.name(camera);
                                 },
                                 [&controller](const std::string& name) {
                                     const int camera = controller.service<CameraNames>().find(name);
                                     return camera < 0 ? Handle{} : CameraNames::handleOf(camera);
                                 }};
}

} // namespace rt::lib

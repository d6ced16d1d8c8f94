#include "stdlib/impl/vision/camera_file.h"

#include "config/json_text.h"
#include "config/letter_case.h"
#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string_view>

namespace rt::lib {
namespace {

using nlohmann::json;

/// Says where in the file something is wrong; read() turns it into a sentence.
struct Mistake {
    std::string text;
};

/// An object with these keys and no others: a misspelt key would be skipped in silence.
void checkKeys(const json& object, const std::string& where, std::initializer_list<const char*> keys) {
    if (!object.is_object()) throw Mistake{where + " is not an object"};
    for (const auto& [key, value] : object.items()) {
        if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
        std::string known;
        for (const char* each : keys)
            known += fmt::format("{}{}", known.empty() ? "" : ", ", each);
        throw Mistake{fmt::format("{} has the unknown key \"{}\"; known are {}", where, key, known)};
    }
}

double numberOf(const json& value, const std::string& where) {
    if (!value.is_number()) throw Mistake{where + " is not a number"};
    return value.get<double>();
}

double secondsOf(const json& value, const std::string& where) {
    const double seconds = numberOf(value, where);
    if (!(seconds >= 0)) throw Mistake{where + " is a negative time"};
    return seconds;
}

void readNumber(const json& object, const std::string& where, const char* key, double& out) {
    if (object.contains(key)) out = numberOf(object[key], where + "." + key);
}

void readSeconds(const json& object, const std::string& where, const char* key, double& out) {
    if (object.contains(key)) out = secondsOf(object[key], where + "." + key);
}

std::string textOf(const json& value, const std::string& where) {
    if (!value.is_string()) throw Mistake{where + " is not a text"};
    const std::string text = value.get<std::string>();
    if (text.size() > 80) throw Mistake{where + " is longer than the 80 bytes of a string"};
    return text;
}

const json& listOf(const json& value, const std::string& where, std::size_t least, std::size_t most) {
    if (!value.is_array() || value.size() < least || value.size() > most)
        throw Mistake{least == most ? fmt::format("{} is not a list of {} members", where, least)
                                    : fmt::format("{} is not a list of at most {} members", where, most)};
    return value;
}

CameraParameters parametersOf(const json& object, const std::string& where) {
    if (!object.is_object()) throw Mistake{where + " is not an object"};
    CameraParameters out;
    for (const auto& [key, value] : object.items()) {
        if (value.is_boolean())
            out[rapid::config::lowerCase(key)] = value.get<bool>();
        else if (value.is_number())
            out[rapid::config::lowerCase(key)] = value.get<double>();
        else
            out[rapid::config::lowerCase(key)] = textOf(value, where + "." + key);
    }
    return out;
}

/// "position" and either "rotation" about z in deg or "orient".
robot::Pose frameOf(const json& part, const std::string& where) {
    robot::Pose frame;
    if (part.contains("position")) {
        const json& list = listOf(part["position"], where + ".position", 3, 3);
        frame.pos = {numberOf(list[0], where), numberOf(list[1], where), numberOf(list[2], where)};
    }
    if (part.contains("rotation") && part.contains("orient"))
        throw Mistake{where + " has both \"rotation\" and \"orient\""};
    if (part.contains("rotation")) {
        const double half = numberOf(part["rotation"], where + ".rotation") * std::numbers::pi / 360;
        frame.rot = {std::cos(half), 0, 0, std::sin(half)};
    } else if (part.contains("orient")) {
        const json& list = listOf(part["orient"], where + ".orient", 4, 4);
        frame.rot = {numberOf(list[0], where), numberOf(list[1], where), numberOf(list[2], where),
                     numberOf(list[3], where)};
        if (!(robot::norm(frame.rot) > 1e-6)) throw Mistake{where + ".orient has the length 0"};
        frame.rot = robot::normalized(frame.rot);
    }
    return frame;
}

CameraPart partOf(const json& object, const std::string& where) {
    checkKeys(object, where, {"name", "position", "rotation", "orient", "values", "strings", "type"});
    CameraPart part;
    if (object.contains("name")) part.name = textOf(object["name"], where + ".name");
    part.frame = frameOf(object, where);
    if (object.contains("values")) {
        const json& list = listOf(object["values"], where + ".values", 0, part.values.size());
        for (std::size_t i = 0; i < list.size(); ++i)
            part.values[i] = numberOf(list[i], where + ".values");
    }
    if (object.contains("strings")) {
        const json& list = listOf(object["strings"], where + ".strings", 0, part.texts.size());
        for (std::size_t i = 0; i < list.size(); ++i)
            part.texts[i] = textOf(list[i], where + ".strings");
    }
    readNumber(object, where, "type", part.type);
    return part;
}

CameraImage imageOf(const json& object, const std::string& where) {
    checkKeys(object, where, {"parts", "parameters", "seconds"});
    CameraImage image;
    if (object.contains("parts")) {
        const json& parts = listOf(object["parts"], where + ".parts", 0, 10000);
        for (std::size_t i = 0; i < parts.size(); ++i)
            image.parts.push_back(partOf(parts[i], fmt::format("{}.parts[{}]", where, i)));
    }
    if (object.contains("parameters"))
        image.parameters = parametersOf(object["parameters"], where + ".parameters");
    readSeconds(object, where, "seconds", image.seconds);
    return image;
}

CameraJob jobOf(const std::string& name, const json& object, const std::string& where) {
    checkKeys(object, where, {"parameters", "images", "repeat"});
    CameraJob job;
    job.name = name;
    if (object.contains("parameters"))
        job.parameters = parametersOf(object["parameters"], where + ".parameters");
    if (object.contains("repeat")) {
        if (!object["repeat"].is_boolean()) throw Mistake{where + ".repeat is neither true nor false"};
        job.repeats = object["repeat"].get<bool>();
    }
    if (object.contains("images")) {
        const json& images = listOf(object["images"], where + ".images", 0, 100000);
        for (std::size_t i = 0; i < images.size(); ++i)
            job.images.push_back(imageOf(images[i], fmt::format("{}.images[{}]", where, i)));
    }
    return job;
}

std::vector<CameraSpan> spansOf(const json& root, const char* key) {
    std::vector<CameraSpan> out;
    if (!root.contains(key)) return out;
    const json& list = listOf(root[key], key, 0, 10000);
    for (const json& each : list) {
        const json& span = listOf(each, key, 2, 2);
        const double from = secondsOf(span[0], key);
        const double to = secondsOf(span[1], key);
        if (to < from) throw Mistake{fmt::format("{} has a span that ends before it begins", key)};
        out.emplace_back(fromSeconds(from), fromSeconds(to));
    }
    return out;
}

void readRoot(const json& root, CameraFile& file) {
    const std::string where = "the file";
    checkKeys(root, where,
              {"mode", "job", "jobs", "parameters", "exposure_time", "brightness", "contrast", "load_seconds",
               "image_seconds", "silent", "busy"});
    if (root.contains("mode")) {
        const std::string mode = textOf(root["mode"], "mode");
        if (mode != "run" && mode != "program") throw Mistake{"mode is neither \"run\" nor \"program\""};
        file.runMode = mode == "run";
    }
    readNumber(root, where, "exposure_time", file.exposureTime);
    readNumber(root, where, "brightness", file.brightness);
    readNumber(root, where, "contrast", file.contrast);
    readSeconds(root, where, "load_seconds", file.loadSeconds);
    readSeconds(root, where, "image_seconds", file.imageSeconds);
    if (root.contains("parameters")) file.parameters = parametersOf(root["parameters"], "parameters");
    if (root.contains("jobs")) {
        if (!root["jobs"].is_object()) throw Mistake{"jobs is not an object"};
        for (const auto& [name, job] : root["jobs"].items())
            file.jobs[rapid::config::lowerCase(name)] =
                jobOf(textOf(json(name), "the name of a job"), job, "jobs." + name);
    }
    if (root.contains("job")) {
        file.job = rapid::config::lowerCase(textOf(root["job"], "job"));
        if (!file.jobs.contains(file.job)) throw Mistake{"job is not one of the jobs"};
    }
    file.silent = spansOf(root, "silent");
    file.busy = spansOf(root, "busy");
}

} // namespace

std::string readCameraFile(const std::string& bytes, CameraFile& file) {
    try {
        readRoot(rapid::config::parseJson(bytes, true), file);
    } catch (const Mistake& mistake) {
        return mistake.text;
    } catch (const json::exception& problem) {
        return fmt::format("it is not JSON: {}", problem.what());
    }
    return {};
}

} // namespace rt::lib

// Motion settings between two processes (--state): what AccSet, VelSet, ConfL, PDispOn ... have set, and the tool and work
// object in force.

#include "config/json_text.h"
#include "stdlib/impl/motion/kept_per_group.h"
#include "stdlib/impl/motion/state.h"

#include "runtime/debug/state_keepers.h"
#include "runtime/host/path_image.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace rt::lib {
namespace {

using Json = nlohmann::json;

/// A record of num components alone, in their order.
template <class Record> Json numbersOf(const Record& record) {
    static_assert(std::is_trivially_copyable_v<Record> && sizeof(Record) % sizeof(float) == 0);
    std::vector<float> numbers(sizeof(Record) / sizeof(float));
    std::memcpy(numbers.data(), &record, sizeof(Record));
    return numbers;
}

template <class Record> void readNumbers(const Json& json, Record& record) {
    const auto numbers = json.get<std::vector<float>>();
    if (numbers.size() * sizeof(float) != sizeof(Record))
        throw std::invalid_argument("a different number of values");
    std::memcpy(&record, numbers.data(), sizeof(Record));
}

Json save(const MotionState& s) {
    return {{"settings", jsonOf(s.settings)},
            {"confJ", s.confJ},
            {"confL", s.confL},
            {"circleOrientation", static_cast<int>(s.circleOrientation)},
            {"singWrist", s.singWrist},
            {"singLockAxis4", s.singLockAxis4},
            {"displacement", jsonOf(s.displacement)},
            {"axisOffsets", s.axisOffsets},
            {"toolHeld", s.tool.robhold},
            {"tool", numbersOf(s.tool.tframe)},
            {"load", numbersOf(s.tool.tload)},
            {"gripLoad", numbersOf(s.gripLoad)},
            {"speedLimits", {s.speedLimits.tcp, s.speedLimits.joints, s.speedLimits.external}},
            {"supervision", {s.motionSupervision, s.supervisionLevel}},
            {"pathResolution", s.pathResolution},
            {"objectHeld", s.workObject.robhold},
            {"userFixed", s.workObject.ufprog},
            {"unit", std::string(s.workObject.ufmec.view())},
            {"user", numbersOf(s.workObject.uframe)},
            {"object", numbersOf(s.workObject.oframe)}};
}

MotionState load(const Json& json) {
    MotionState s;
    s.settings = settingsFrom(json.at("settings"));
    json.at("confJ").get_to(s.confJ);
    json.at("confL").get_to(s.confL);
    s.circleOrientation = circleOrientationFrom(json.at("circleOrientation").get<int>());
    json.at("singWrist").get_to(s.singWrist);
    json.at("singLockAxis4").get_to(s.singLockAxis4);
    s.displacement = poseFrom(json.at("displacement"));
    const Json& offsets = json.at("axisOffsets");
    if (offsets.size() != s.axisOffsets.size()) throw std::invalid_argument("a different number of values");
    offsets.get_to(s.axisOffsets);
    json.at("toolHeld").get_to(s.tool.robhold);
    readNumbers(json.at("tool"), s.tool.tframe);
    readNumbers(json.at("load"), s.tool.tload);
    readNumbers(json.at("gripLoad"), s.gripLoad);
    const Json& limits = json.at("speedLimits");
    limits.at(0).get_to(s.speedLimits.tcp);
    limits.at(1).get_to(s.speedLimits.joints);
    limits.at(2).get_to(s.speedLimits.external);
    json.at("supervision").at(0).get_to(s.motionSupervision);
    json.at("supervision").at(1).get_to(s.supervisionLevel);
    s.pathResolution = json.value("pathResolution", s.pathResolution);
    json.at("objectHeld").get_to(s.workObject.robhold);
    json.at("userFixed").get_to(s.workObject.ufprog);
    s.workObject.ufmec.assign(json.at("unit").get<std::string>());
    readNumbers(json.at("user"), s.workObject.uframe);
    readNumbers(json.at("object"), s.workObject.oframe);
    return s;
}

} // namespace

StateKeepers::Keeper keptPerGroup(Controller& controller, std::function<Json(MotionDriver&)> saveOne,
                                  std::function<void(MotionDriver&, const Json&)> loadOne) {
    const auto saveAll = [&controller, saveOne = std::move(saveOne)] {
        Json list = Json::array();
        for (const auto& motion : controller.motions())
            list.push_back(saveOne(*motion));
        return list;
    };
    const auto loadAll = [&controller, loadOne = std::move(loadOne)](const Json& json) {
        if (json.size() != controller.motions().size())
            throw std::invalid_argument("there was a different number of motion groups");
        for (std::size_t i = 0; i < json.size(); ++i)
            loadOne(*controller.motions()[i], json[i]);
    };
    return {saveAll, loadAll};
}

void keepSettings(Controller& controller, StateKeepers& kept) {
    kept.keepers["motionSettings"] = keptPerGroup(
        controller, [](MotionDriver& motion) { return save(motion.service<MotionState>()); },
        [](MotionDriver& motion, const Json& json) {
            auto& state = motion.service<MotionState>();
            state = load(json);
            motion.setSpeedLimits(state.speedLimits);
        });
}

} // namespace rt::lib

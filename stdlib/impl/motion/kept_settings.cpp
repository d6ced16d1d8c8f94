// Motion settings between two processes (--state): what AccSet, VelSet, ConfL, PDispOn ... have set, and the tool and work
// object in force.

#include "stdlib/impl/motion/state.h"

#include "runtime/host/state_keepers.h"

#include <nlohmann/json.hpp>

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
        throw std::invalid_argument("another number of numbers");
    std::memcpy(&record, numbers.data(), sizeof(Record));
}

Json save(const MotionState& s) {
    const motion::MotionSettings& m = s.settings;
    const motion::Pose& d = s.displacement;
    return {{"settings",
             {m.velocityPercent, m.maxTcpSpeed, m.accelerationPercent, m.rampPercent, m.pathAcceleration,
              m.pathDeceleration, m.worldAcceleration}},
            {"confJ", s.confJ},
            {"confL", s.confL},
            {"singWrist", s.singWrist},
            {"singLockAxis4", s.singLockAxis4},
            {"displacement", {d.pos.x, d.pos.y, d.pos.z, d.rot.w, d.rot.x, d.rot.y, d.rot.z}},
            {"axisOffsets", s.axisOffsets},
            {"toolHeld", s.tool.robhold},
            {"tool", numbersOf(s.tool.tframe)},
            {"load", numbersOf(s.tool.tload)},
            {"objectHeld", s.workObject.robhold},
            {"userFixed", s.workObject.ufprog},
            {"unit", std::string(s.workObject.ufmec.view())},
            {"user", numbersOf(s.workObject.uframe)},
            {"object", numbersOf(s.workObject.oframe)}};
}

std::vector<double> numbers(const Json& json, std::size_t count) {
    auto values = json.get<std::vector<double>>();
    if (values.size() != count) throw std::invalid_argument("another number of numbers");
    return values;
}

MotionState load(const Json& json) {
    MotionState s;
    const auto m = numbers(json.at("settings"), 7);
    s.settings = {m[0], m[1], m[2], m[3], m[4], m[5], m[6]};
    json.at("confJ").get_to(s.confJ);
    json.at("confL").get_to(s.confL);
    json.at("singWrist").get_to(s.singWrist);
    json.at("singLockAxis4").get_to(s.singLockAxis4);
    const auto d = numbers(json.at("displacement"), 7);
    s.displacement = {{d[0], d[1], d[2]}, {d[3], d[4], d[5], d[6]}};
    const auto offsets = numbers(json.at("axisOffsets"), s.axisOffsets.size());
    std::copy(offsets.begin(), offsets.end(), s.axisOffsets.begin());
    json.at("toolHeld").get_to(s.tool.robhold);
    readNumbers(json.at("tool"), s.tool.tframe);
    readNumbers(json.at("load"), s.tool.tload);
    json.at("objectHeld").get_to(s.workObject.robhold);
    json.at("userFixed").get_to(s.workObject.ufprog);
    s.workObject.ufmec.assign(json.at("unit").get<std::string>());
    readNumbers(json.at("user"), s.workObject.uframe);
    readNumbers(json.at("object"), s.workObject.oframe);
    return s;
}

} // namespace

void keepSettings(Controller& controller, StateKeepers& kept) {
    kept.keepers["motionSettings"] = {
        [&controller] { return save(controller.service<MotionState>()); },
        [&controller](const Json& json) { controller.service<MotionState>() = load(json); }};
}

} // namespace rt::lib

// World zones between two processes (--state): temporary zones survive a power failure, stationary ones are defined again
// by the routine of the event POWER ON (manual 2.9). A shapedata keeps its contents.

#include "config/json_text.h"
#include "stdlib/impl/motion/kept_per_group.h"
#include "stdlib/impl/motion/world_zones.h"

#include "runtime/debug/state_keepers.h"
#include "runtime/host/json_numbers.h"
#include "stdlib/impl/io/signals.h"

#include <stdexcept>
#include <utility>

namespace rt::lib {
namespace {

using Json = nlohmann::json;

template <std::size_t N> void readNumbers(const Json& json, std::array<double, N>& numbers) {
    if (json.size() != N) throw std::invalid_argument("a different number of values");
    json.get_to(numbers);
}

Json jsonOf(const ZoneShape& s) {
    return {{"kind", static_cast<int>(s.kind)},
            {"outside", s.outside},
            {"low", s.low},
            {"high", s.high},
            {"radius", s.radius},
            {"height", s.height},
            {"lowAxes", s.lowAxes},
            {"highAxes", s.highAxes}};
}

ZoneShape shapeFrom(const Json& json) {
    ZoneShape s;
    const int kind = numberFrom<int>(json.at("kind"));
    if (kind < 0 || kind > static_cast<int>(ZoneShape::Kind::Joints))
        throw std::invalid_argument("no such kind");
    s.kind = static_cast<ZoneShape::Kind>(kind);
    json.at("outside").get_to(s.outside);
    readNumbers(json.at("low"), s.low);
    readNumbers(json.at("high"), s.high);
    json.at("radius").get_to(s.radius);
    json.at("height").get_to(s.height);
    readNumbers(json.at("lowAxes"), s.lowAxes);
    readNumbers(json.at("highAxes"), s.highAxes);
    return s;
}

Json save(Controller& controller, MotionDriver& motion) {
    const WorldZones& zones = zonesOf(controller, motion);
    Json list = Json::array();
    for (const WorldZone& zone : zones.all()) {
        if (zone.stationary) continue;
        list.push_back({{"number", zone.number},
                        {"enabled", zone.enabled},
                        {"action", static_cast<int>(zone.action)},
                        {"shape", jsonOf(zone.shape)},
                        {"output", signalName(controller.io(), zone.output)},
                        {"value", zone.value}});
    }
    return {{"last", zones.lastNumber()}, {"zones", std::move(list)}};
}

void load(Controller& controller, MotionDriver& motion, const Json& json) {
    std::vector<WorldZone> zones;
    for (const Json& entry : json.at("zones")) {
        WorldZone zone;
        zone.number = numberFrom<int>(entry.at("number"));
        entry.at("enabled").get_to(zone.enabled);
        const int action = numberFrom<int>(entry.at("action"));
        if (action < 0 || action > static_cast<int>(WorldZone::Action::OutputBefore))
            throw std::invalid_argument("no such action");
        zone.action = static_cast<WorldZone::Action>(action);
        zone.shape = shapeFrom(entry.at("shape"));
        entry.at("value").get_to(zone.value);
        if (zone.action != WorldZone::Action::Stop) {
            zone.output = signalNamed(controller.io(), entry.at("output").get<std::string>());
            if (zone.output == 0) throw std::invalid_argument("there is no such signal now");
        }
        zones.push_back(zone);
    }
    if (zones.size() > WorldZones::kMost) throw std::invalid_argument("too many world zones");
    zonesOf(controller, motion).restore(std::move(zones), numberFrom<int>(json.at("last")));
}

} // namespace

void keepWorldZones(Controller& controller, StateKeepers& kept) {
    kept.keepers["worldZones"] = keptPerGroup(
        controller, [&controller](MotionDriver& motion) { return save(controller, motion); },
        [&controller](MotionDriver& motion, const Json& json) { load(controller, motion, json); });
    const auto textOf = [&controller](Handle handle) -> std::string {
        const ZoneShape* shape = controller.service<ZoneShapes>().find(handle);
        return shape == nullptr ? std::string() : rapid::config::textOf(jsonOf(*shape));
    };
    const auto make = [&controller](const std::string& text) {
        return controller.service<ZoneShapes>().intern(shapeFrom(rapid::config::parseJson(text)));
    };
    kept.handles["shapedata"] = {textOf, make};
}

} // namespace rt::lib

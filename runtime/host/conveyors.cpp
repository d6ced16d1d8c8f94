#include "runtime/host/conveyors.h"

#include "config/letter_case.h"
#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "runtime/robot/lengths.h"
#include "runtime/sim/surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace rt {

namespace {

/// A length or a different number of ConveyorSettings, and how options and PROC.cfg call it. There lengths are in m.
struct Parameter {
    const char* key;
    double ConveyorSettings::* value;
    double factor; ///< of the number in PROC.cfg
    double least;
    std::vector<const char*> attributes;
};

constexpr double kAny = -1e9;
constexpr double kAboveZero = 1e-6;

const std::vector<Parameter>& parameters() {
    using S = ConveyorSettings;
    static const std::vector<Parameter> kAll = {
        {"speed", &S::speed, 1, kAny, {}},
        {"acceleration", &S::acceleration, 1, kAboveZero, {}},
        {"every", &S::every, 1, 0, {}},
        {"sync",
         &S::sync,
         robot::kMmPerMetre,
         0,
         {"queuetrckdist", "queuetrackdist", "queuetrackingdistance"}},
        {"window", &S::window, robot::kMmPerMetre, kAboveZero, {"startwinwidth", "startwindowwidth"}},
        {"min", &S::minimum, robot::kMmPerMetre, kAny, {"mindist", "minimumdistance", "mindistance"}},
        {"max", &S::maximum, robot::kMmPerMetre, kAboveZero, {"maxdist", "maximumdistance", "maxdistance"}},
        {"separation", &S::separation, robot::kMmPerMetre, 0, {"syncseparation", "syncsep"}},
        {"adjustment", &S::adjustmentSpeed, 1, kAboveZero, {"adjustmentspeed", "adjspeed"}},
        {"adjustment_acceleration",
         &S::adjustmentAcceleration,
         1,
         kAboveZero,
         {"adjustmentaccel", "adjustmentacceleration", "adjaccel"}},
        {"index", &S::index, robot::kMmPerMetre, kAboveZero, {"indexdistance"}},
        {"index_speed", &S::indexSpeed, 1, kAboveZero, {"indexspeed"}},
        {"counts", &S::countsPerMetre, 1, kAboveZero, {"countspermeter", "countspermetre"}},
    };
    return kAll;
}

/// "start_win_width" and "StartWinWidth" are the same.
std::string folded(std::string_view name) {
    std::string result;
    for (const char c : name)
        if (c != '_' && c != ' ') result += rapid::config::lowerLetter(c);
    return result;
}

/// "100/200/-50"
bool readPosition(std::string_view text, robot::Vec3& position) {
    double* const parts[] = {&position.x, &position.y, &position.z};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t end = i < 2 ? text.find('/') : text.size();
        if (end == std::string_view::npos || !parseNumber(text.substr(0, end), *parts[i])) return false;
        text.remove_prefix(std::min(text.size(), end + 1));
    }
    return true;
}

std::string readSetting(std::string_view key, std::string_view value, ConveyorSettings& settings) {
    double number = 0;
    if (key == "at")
        return readPosition(value, settings.base.pos)
                   ? ""
                   : fmt::format("'at' needs X/Y/Z in mm, found '{}'", value);
    if (key == "signals" || key == "trigger") {
        (key == "signals" ? settings.prefix : settings.trigger) = value;
        return {};
    }
    if (!parseNumber(value, number)) return fmt::format("'{}' of '{}' is not a number", value, key);
    if (key == "turn") {
        settings.base.rot = robot::fromAxisAngle({0, 0, 1}, number);
        return {};
    }
    if (key == "rotating") {
        settings.rotating = number != 0;
        return {};
    }
    if (key == "axis") {
        if (number != std::floor(number) || number < 7 || number > 12)
            return fmt::format(
                "'axis' is the logical axis of the sensor, 7 for eax_a to 12 for eax_f, found '{}'", value);
        settings.axis = static_cast<int>(number) - 7;
        return {};
    }
    std::string known = "at, turn, rotating, trigger, axis, signals";
    for (const Parameter& parameter : parameters()) {
        known += std::string(", ") + parameter.key;
        if (key != parameter.key) continue;
        if (number < parameter.least) return fmt::format("'{}' of '{}' is too small", value, key);
        settings.*parameter.value = number;
        return {};
    }
    return fmt::format("'{}' is not known; a conveyor has {}", key, known);
}

/// Digits at the end of the name: signals of CNV2 are named c2...
std::string prefixOf(std::string_view name) {
    std::size_t digits = name.size();
    while (digits > 0 && std::isdigit(static_cast<unsigned char>(name[digits - 1])) != 0)
        --digits;
    return "c" + (digits < name.size() ? std::string(name.substr(digits)) : "1");
}

/// Instances of PROC.cfg that belong to the conveyor: those with its name, and those that these refer to by name.
std::vector<const CfgInstance*> instancesOf(Controller& controller, std::string_view name) {
    std::vector<const CfgInstance*> all, own;
    for (const CfgFile& file : controller.configuration()) {
        if (!sameName(file.domain, "PROC")) continue;
        for (const CfgSection& section : file.sections)
            for (const CfgInstance& instance : section.instances)
                all.push_back(&instance);
    }
    std::vector<std::string> names{std::string(name)};
    for (std::size_t i = 0; i < names.size() && names.size() < 64; ++i) {
        for (const CfgInstance* instance : all) {
            if (!sameName(instance->text("Name"), names[i]) ||
                std::find(own.begin(), own.end(), instance) != own.end())
                continue;
            own.push_back(instance);
            for (const CfgAttribute& attribute : instance->attributes)
                if (!attribute.values.empty() && folded(attribute.name).starts_with("use"))
                    names.push_back(attribute.values.front());
        }
    }
    return own;
}

void readConfiguration(Controller& controller, ConveyorSettings& settings) {
    for (const CfgInstance* instance : instancesOf(controller, settings.name)) {
        for (const CfgAttribute& attribute : instance->attributes) {
            const std::string name = folded(attribute.name);
            for (const Parameter& parameter : parameters()) {
                double value = 0;
                const bool isMeant = std::any_of(parameter.attributes.begin(), parameter.attributes.end(),
                                                 [&](const char* known) { return name == known; });
                if (isMeant && instance->number(attribute.name, value) &&
                    value * parameter.factor >= parameter.least)
                    settings.*parameter.value = value * parameter.factor;
            }
        }
    }
}

} // namespace

Conveyor* Conveyors::find(std::string_view name) const {
    for (const auto& conveyor : all_)
        if (sameName(conveyor->name(), name)) return conveyor.get();
    return nullptr;
}

std::string readConveyorOption(const std::string& text, ConveyorSettings& settings) {
    std::string_view rest = std::string_view(text);
    const std::size_t equals = rest.find('=');
    settings.name = rest.substr(0, equals);
    settings.prefix = prefixOf(settings.name);
    if (settings.name.empty()) return "the name of the mechanical unit is missing, as in CNV1=speed:200";
    rest = equals == std::string_view::npos ? std::string_view() : rest.substr(equals + 1);
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        const std::string_view part = rest.substr(0, end);
        const std::size_t colon = part.find(':');
        if (colon == std::string_view::npos)
            return fmt::format("found '{}', expected KEY:VALUE such as speed:200", part);
        if (std::string problem = readSetting(part.substr(0, colon), part.substr(colon + 1), settings);
            !problem.empty())
            return problem;
        rest.remove_prefix(std::min(rest.size(), end + 1));
    }
    return settings.minimum < settings.maximum ? "" : "'min' must be less than 'max'";
}

std::vector<std::pair<std::string, std::string>> conveyorSignals(const ConveyorSettings& settings) {
    std::vector<std::pair<std::string, std::string>> result;
    for (const ConveyorSignal& signal : allConveyorSignals()) {
        result.emplace_back(settings.prefix + signal.name,
                            "signal" + rapid::config::lowerCase(signalTypeName(signal.type)));
    }
    return result;
}

std::string openConveyors(Controller& controller, const std::vector<std::string>& options) {
    std::vector<ConveyorSettings> wanted;
    for (const auto& unit : controller.units().all()) {
        if (!unit->isConveyor) continue;
        ConveyorSettings settings;
        settings.name = unit->name;
        settings.prefix = prefixOf(unit->name);
        if (!unit->geometry.joints.empty()) {
            settings.base = unit->geometry.joints.front().base;
            settings.rotating = unit->geometry.joints.front().rotating;
        }
        readConfiguration(controller, settings);
        wanted.push_back(std::move(settings));
    }
    std::vector<std::string> all;
    for (const CfgInstance* instance : controller.instances("RAPIDC", "OPTIONS")) // of rapidc build
        if (std::string option = instance->text("conveyor"); !option.empty())
            all.push_back(std::move(option));
    all.insert(all.end(), options.begin(), options.end());
    for (const std::string& option : all) {
        const std::string name = option.substr(0, option.find('='));
        const auto same = [&](const ConveyorSettings& settings) { return sameName(settings.name, name); };
        auto found = std::find_if(wanted.begin(), wanted.end(), same);
        if (found == wanted.end()) {
            wanted.emplace_back();
            found = wanted.end() - 1;
        }
        if (std::string problem = readConveyorOption(option, *found); !problem.empty())
            return fmt::format("--conveyor={}: {}", option, problem);
        if (!controller.units().addConveyor(found->name))
            return fmt::format("--conveyor={}: the configuration defines {} as another mechanical unit",
                               option, found->name);
    }
    auto& conveyors = controller.service<Conveyors>();
    for (ConveyorSettings& settings : wanted) {
        conveyors.add(std::make_unique<Conveyor>(controller.scheduler(), controller.io(), controller.log(),
                                                 std::move(settings)));
        Conveyor& conveyor = *conveyors.all().back();
        conveyor.addSignals();
        conveyor.begin();
        if (const MechanicalUnit* unit = controller.units().find(conveyor.name()))
            conveyor.setActive(unit->isActive);
        conveyor.onSpeed([&controller] {
            for (const auto& motion : controller.motions())
                motion->refresh();
        });
    }
    controller.service<Surroundings>().addListener(
        [&conveyors](const Surroundings::Name& name, double value) {
            Conveyor* conveyor = conveyors.find(name.unit);
            if (conveyor == nullptr) return;
            if (sameName(name.quantity, Surroundings::kSpeed)) conveyor->setSpeed(value);
            if (sameName(name.quantity, Surroundings::kObject)) conveyor->objectAtSync(value);
        });
    return {};
}

} // namespace rt

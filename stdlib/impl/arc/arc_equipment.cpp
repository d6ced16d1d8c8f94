#include "stdlib/impl/arc/arc_equipment.h"

#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace rt::lib {
namespace {

// In the order of the enumerations.
constexpr const char* kOutputs[] = {"GasOn", "WeldOn", "FeedOn", "FeedOnBwd", "AwError"};
constexpr const char* kInputs[] = {"ArcEst", "GasOk",     "WaterOk",  "WireOk",    "GunOk",
                                   "VoltOk", "CurrentOk", "StopProc", "WeldInhib", "WireStickErr"};
constexpr const char* kReferences[] = {"VoltReference", "FeedReference", "CurrentReference", "SchedulePort",
                                       "ModePort"};

/// Without regard to case and underscores: arc_est is ArcEst.
bool isAttribute(std::string name, std::string_view wanted) {
    std::erase(name, '_');
    return rapid::config::sameName(name, wanted);
}

/// The equipment of one system: PROC.cfg has types ARC_EQUIP... with an instance for each system, in order.
std::vector<const CfgAttribute*> attributesOf(const Controller& controller, int system) {
    constexpr std::string_view kTypes = "ARC_EQUIP";
    std::vector<const CfgAttribute*> found;
    for (const CfgFile& file : controller.configuration()) {
        if (!rapid::config::sameName(file.domain, "PROC")) continue;
        for (const auto& section : file.sections) {
            if (!rapid::config::sameName(std::string_view(section.type).substr(0, kTypes.size()), kTypes) ||
                section.instances.size() < static_cast<std::size_t>(system))
                continue;
            for (const CfgAttribute& attribute :
                 section.instances[static_cast<std::size_t>(system) - 1].attributes)
                found.push_back(&attribute);
        }
    }
    return found;
}

template <class Signals, class Names>
bool assign(const IoSystem& io, const CfgAttribute& attribute, const Names& names, Signals& signals,
            bool (*fits)(SignalType), std::string& problem) {
    for (std::size_t i = 0; i < std::size(names); ++i) {
        if (!isAttribute(attribute.name, names[i])) continue;
        const SignalId id = io.find(attribute.text());
        if (attribute.text().empty()) return true;
        if (id < 0 || !fits(io.config(id).type))
            problem =
                fmt::format("PROC.cfg, line {}: {} names signal \"{}\", which {}. Define it in EIO.cfg.",
                            attribute.line, attribute.name, attribute.text(),
                            id < 0 ? "no configuration defines" : "has a different type");
        else
            signals[i] = id;
        return true;
    }
    return false;
}

} // namespace

std::string ArcEquipment::read(Controller& controller, int system) {
    io_ = &controller.io();
    outputs_.fill(-1);
    inputs_.fill(-1);
    references_.fill(-1);
    std::string problem;
    for (const CfgAttribute* attribute : attributesOf(controller, system)) {
        double seconds = 0;
        if (isAttribute(attribute->name, "IgnitionTimeout") &&
            rapid::config::parseNumber(attribute->text(), seconds) && seconds > 0)
            ignitionTime_ = fromSeconds(seconds);
        const auto digitalOutput = [](SignalType type) { return type == SignalType::DO; };
        const auto digitalInput = [](SignalType type) { return type == SignalType::DI; };
        const auto reference = [](SignalType type) {
            return type == SignalType::AO || type == SignalType::GO;
        };
        (void)(assign(*io_, *attribute, kOutputs, outputs_, digitalOutput, problem) ||
               assign(*io_, *attribute, kInputs, inputs_, digitalInput, problem) ||
               assign(*io_, *attribute, kReferences, references_, reference, problem));
        if (!problem.empty()) break;
    }
    return problem;
}

void ArcEquipment::set(ArcOutput output, bool on) const {
    const SignalId id = outputs_[static_cast<std::size_t>(output)];
    if (id >= 0) (void)io_->set(IoSystem::handleOf(id), on ? 1 : 0);
}

void ArcEquipment::refer(ArcReference reference, double value) const {
    const SignalId id = references_[static_cast<std::size_t>(reference)];
    if (id < 0) return;
    const SignalConfig& config = io_->config(id);
    (void)io_->set(IoSystem::handleOf(id), std::clamp(value, config.minValue, config.maxValue));
}

std::optional<bool> ArcEquipment::input(ArcInput input) const {
    const SignalId id = idOf(input);
    return id < 0 ? std::nullopt : std::optional<bool>(io_->value(id) != 0);
}

} // namespace rt::lib

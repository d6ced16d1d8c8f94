#include "stdlib/impl/process/process_signals.h"

#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>

namespace rt::lib {
namespace {

using Kind = ProcessSignal::Kind;

bool isAttribute(std::string name, std::string_view wanted) {
    std::erase(name, '_');
    std::string plain(wanted);
    std::erase(plain, '_');
    return rapid::config::sameName(name, plain);
}

bool fits(SignalType type, Kind kind) {
    switch (kind) {
    case Kind::Output: return type == SignalType::DO;
    case Kind::Reference: return type == SignalType::AO || type == SignalType::GO;
    case Kind::Input: return type == SignalType::DI;
    }
    return false;
}

template <class Action>
void forEachInstance(const Controller& controller, std::string_view types, Action action) {
    for (const CfgFile& file : controller.configuration()) {
        if (!rapid::config::sameName(file.domain, "PROC")) continue;
        for (const auto& section : file.sections) {
            if (!rapid::config::sameName(std::string_view(section.type).substr(0, types.size()), types))
                continue;
            for (std::size_t i = 0; i < section.instances.size(); ++i)
                action(static_cast<int>(i) + 1, section.instances[i]);
        }
    }
}

} // namespace

int processInstance(const Controller& controller, std::string_view types, std::string_view name) {
    int found = 0;
    forEachInstance(controller, types, [&](int number, const CfgInstance& instance) {
        if (found == 0 && rapid::config::sameName(instance.text("name"), name)) found = number;
    });
    return found;
}

std::string ProcessSignals::read(Controller& controller, std::string_view types, int number,
                                 std::span<const ProcessSignal> signals) {
    io_ = &controller.io();
    attributes_.clear();
    forEachInstance(controller, types, [&](int each, const CfgInstance& instance) {
        if (each != number) return;
        for (const CfgAttribute& attribute : instance.attributes)
            attributes_.push_back(&attribute);
    });
    ids_.assign(signals.size(), -1);
    for (std::size_t i = 0; i < signals.size(); ++i) {
        const SignalId usual = io_->find(fmt::format(fmt::runtime(signals[i].usualName), number));
        if (usual >= 0 && fits(io_->config(usual).type, signals[i].kind)) ids_[i] = usual;
        for (const CfgAttribute* attribute : attributes_) {
            if (!isAttribute(attribute->name, signals[i].attribute)) continue;
            ids_[i] = attribute->text().empty() ? -1 : io_->find(attribute->text());
            const bool isWrong = ids_[i] >= 0 && !fits(io_->config(ids_[i]).type, signals[i].kind);
            if (!attribute->text().empty() && (ids_[i] < 0 || isWrong))
                return fmt::format(
                    "PROC.cfg, line {}: {} names signal \"{}\", which {}. Define it in EIO.cfg",
                    attribute->line, attribute->name, attribute->text(),
                    isWrong ? "has a different type" : "no configuration defines");
        }
    }
    return {};
}

void ProcessSignals::set(std::size_t signal, double value) const {
    const SignalId id = ids_[signal];
    if (id < 0) return;
    const SignalConfig& config = io_->config(id);
    const bool isDigital = config.type == SignalType::DO;
    (void)io_->set(IoSystem::handleOf(id),
                   isDigital ? value : std::clamp(value, config.minValue, config.maxValue));
}

std::optional<bool> ProcessSignals::input(std::size_t signal) const {
    const SignalId id = ids_[signal];
    return id < 0 ? std::nullopt : std::optional<bool>(io_->value(id) != 0);
}

double ProcessSignals::number(std::string_view attribute, double otherwise) const {
    for (const CfgAttribute* each : attributes_) {
        double value = 0;
        if (isAttribute(each->name, attribute) && rapid::config::parseNumber(each->text(), value) &&
            value >= 0)
            return value;
    }
    return otherwise;
}

} // namespace rt::lib

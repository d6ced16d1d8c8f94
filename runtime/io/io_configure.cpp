// IoSystem: from EIO parameters to signals and cross connections.

#include "runtime/base/text_util.h"
#include "runtime/io/io_system.h"
#include "runtime/io/signal.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace rt {
namespace {

constexpr uint32_t kMaxGroupBits = 32;
constexpr int kMaxActors = 5; // Act1 .. Act5

bool parseType(std::string_view text, SignalType& type) {
    for (const SignalType candidate :
         {SignalType::DI, SignalType::DO, SignalType::AI, SignalType::AO, SignalType::GI, SignalType::GO}) {
        if (sameName(text, signalTypeName(candidate))) {
            type = candidate;
            return true;
        }
    }
    return false;
}

bool parseBit(std::string_view text, uint32_t& bit) {
    text = trimmed(text);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bit);
    return !text.empty() && error == std::errc() && end == text.data() + text.size();
}

/// Number of bits that a DeviceMap such as "0-15" or "0-3,8,10-11" takes; 0 when it is not understood.
uint32_t mappedBits(std::string_view map) {
    uint32_t bits = 0;
    while (!map.empty()) {
        const std::size_t comma = map.find(',');
        const std::string_view part = map.substr(0, comma);
        map = comma == std::string_view::npos ? std::string_view() : map.substr(comma + 1);
        const std::size_t dash = part.find('-');
        uint32_t first = 0, last = 0;
        if (!parseBit(part.substr(0, dash), first)) return 0;
        last = first;
        if (dash != std::string_view::npos && !parseBit(part.substr(dash + 1), last)) return 0;
        bits += (first > last ? first - last : last - first) + 1;
        if (bits > 4096) return bits;
    }
    return bits;
}

/// Lists are split by the reader; a map is one text.
std::string joined(const CfgAttribute* attribute) {
    return attribute == nullptr ? std::string() : fmt::format("{}", fmt::join(attribute->values, ","));
}

/// May a RAPID program write with this access level? Levels of EIO_ACCESS are looked up first.
bool accessLetsRapidWrite(const std::string& access, const std::unordered_map<std::string, bool>& levels) {
    const auto found = levels.find(upperCase(access));
    if (found != levels.end()) return found->second;
    return !sameName(access, "ReadOnly") && !sameName(access, "Internal");
}

} // namespace

void IoSystem::configure(const CfgFile& file, std::vector<CfgProblem>& problems) {
    if (!file.domain.empty() && file.domain != "EIO") return;
    for (const CfgSection* section : file.find("EIO_ACCESS")) {
        for (const CfgInstance& instance : section->instances) {
            const CfgAttribute* rapid = instance.find("Rapid");
            const bool write =
                rapid != nullptr && !sameName(rapid->text(), "ReadOnly") && instance.flag("Rapid");
            accessLevels_[upperCase(instance.text("Name"))] = write;
        }
    }
    devices_.configure(file);
    for (const CfgSection* section : file.find("EIO_SIGNAL")) {
        for (const CfgInstance& instance : section->instances)
            configureSignal(instance, file.name, problems);
    }
    for (const CfgSection* section : file.find("EIO_CROSS")) {
        for (const CfgInstance& instance : section->instances)
            pendingConnections_.push_back({instance, file.name});
    }
}

void IoSystem::configureSignal(const CfgInstance& instance, const std::string& file,
                               std::vector<CfgProblem>& problems) {
    const auto problem = [&](std::string message) {
        problems.push_back({file, instance.line, std::move(message)});
    };
    SignalConfig config;
    config.name = instance.text("Name");
    config.file = file;
    config.line = instance.line;
    if (config.name.empty()) return problem("a signal without -Name");
    for (const char* attribute : {"Size", "MaxLog", "MinLog", "Default", "DefValue"}) {
        double ignored = 0;
        const CfgAttribute* written = instance.find(attribute);
        if (written != nullptr && !instance.number(attribute, ignored))
            return problem(fmt::format("signal {}: {} is '{}', must be a number", config.name, attribute,
                                       written->text()));
    }
    const std::string type = instance.text("SignalType");
    if (!parseType(type, config.type)) {
        return problem(fmt::format("signal {}: SignalType is '{}', must be DI, DO, AI, AO, GI or GO",
                                   config.name, type));
    }
    // Names before and after the bar: RobotWare 6 and 7 | RobotWare 5.
    config.device = instance.text("Device", instance.text("Unit"));
    config.deviceMap = joined(instance.find("DeviceMap"));
    if (config.deviceMap.empty()) config.deviceMap = joined(instance.find("UnitMap"));
    config.label = instance.text("Label", instance.text("SignalLabel"));
    config.category = instance.text("Category");
    config.access = instance.text("Access", "Default");
    if (isGroup(config.type)) {
        config.bits = kMaxGroupBits; // a virtual group whose width is nowhere said
        if (!config.deviceMap.empty()) config.bits = mappedBits(config.deviceMap);
        double size = 0;
        if (config.deviceMap.empty() && instance.number("Size", size))
            config.bits = static_cast<uint32_t>(size);
        if (config.bits < 1 || config.bits > kMaxGroupBits) {
            return problem(
                fmt::format("group signal {}: DeviceMap '{}' must name 1 to 32 bits, such as \"0-15\"",
                            config.name, config.deviceMap));
        }
        config.maxValue = std::ldexp(1.0, static_cast<int>(config.bits)) - 1;
    } else if (isAnalog(config.type)) {
        config.minValue = -std::numeric_limits<double>::max();
        config.maxValue = std::numeric_limits<double>::max();
        const bool hasMax = instance.number("MaxLog", config.maxValue);
        const bool hasMin = instance.number("MinLog", config.minValue);
        if (hasMax && !hasMin) config.minValue = std::min(0.0, config.maxValue); // not written: 0
        if (hasMin && !hasMax) config.maxValue = std::max(0.0, config.minValue);
        if (config.minValue > config.maxValue) {
            return problem(fmt::format("signal {}: MinLog is greater than MaxLog", config.name));
        }
    }
    double initial = 0;
    if (!instance.number("Default", initial)) instance.number("DefValue", initial);
    if (!isDigital(config.type) && initial == 0 && instance.find("Default") == nullptr) {
        initial = std::min(std::max(initial, config.minValue), config.maxValue);
    }
    if (normalise(config, initial) != IoResult::Ok) {
        return problem(fmt::format("signal {}: the default {} is outside its limits", config.name,
                                   shortestNumber(initial)));
    }
    config.defaultValue = initial;
    config.store = instance.flag("Store");

    const SignalId known = find(config.name);
    if (known < 0) {
        addSignal(std::move(config));
        return;
    }
    Signal& signal = *signals_[static_cast<std::size_t>(known)];
    if (signal.config.type != config.type) {
        return problem(fmt::format("signal {} is already defined as {} in {}:{}, here as {}", config.name,
                                   signalTypeName(signal.config.type), signal.config.file, signal.config.line,
                                   signalTypeName(config.type)));
    }
    signal.value = config.defaultValue;
    signal.config = std::move(config);
}

SignalId IoSystem::crossSignal(const PendingConnection& pending, const std::string& attribute,
                               std::vector<CfgProblem>& problems) const {
    const std::string name = pending.instance.text(attribute);
    const SignalId id = find(name);
    const auto problem = [&](std::string message) {
        problems.push_back({pending.file, pending.instance.line, std::move(message)});
    };
    if (id < 0) {
        problem(name.empty()
                    ? fmt::format("cross connection without -{}", attribute)
                    : fmt::format("cross connection: signal {} is not defined; add it to EIO_SIGNAL", name));
        problems.back().warning = !name.empty(); // signals of add-ins are not part of a backup
        return -1;
    }
    if (isAnalog(config(id).type)) {
        problem(fmt::format(
            "cross connection: {} is an analog signal; only digital and group signals can be connected",
            name));
        return -1;
    }
    return id;
}

void IoSystem::resolveConnection(const PendingConnection& pending, std::vector<CfgProblem>& problems) {
    const CfgInstance& instance = pending.instance;
    CrossConnection connection;
    connection.name = instance.text("Name");
    connection.result = crossSignal(pending, "Res", problems);
    if (connection.result < 0) return;
    for (int i = 1; i <= kMaxActors; ++i) {
        const std::string attribute = fmt::format("Act{}", i);
        if (i > 1 && instance.text(attribute).empty()) break;
        const SignalId actor = crossSignal(pending, attribute, problems);
        if (actor < 0) return;
        if (i > 1) {
            const std::string word = instance.text(fmt::format("Oper{}", i - 1), "AND");
            if (!sameName(word, "AND") && !sameName(word, "OR")) {
                problems.push_back(
                    {pending.file, instance.line,
                     fmt::format("cross connection: Oper{} is '{}', must be AND or OR", i - 1, word)});
                return;
            }
            connection.operators.push_back(sameName(word, "OR") ? CrossOperator::Or : CrossOperator::And);
        }
        connection.actors.push_back({actor, instance.flag(attribute + "_invert")});
    }
    const std::string result = config(connection.result).name;
    if (!addCrossConnection(std::move(connection))) {
        problems.push_back({pending.file, instance.line,
                            fmt::format("cross connection of {}: the connections form a loop", result)});
    }
}

void IoSystem::finishConfiguration(std::vector<CfgProblem>& problems) {
    for (const PendingConnection& pending : pendingConnections_)
        resolveConnection(pending, problems);
    pendingConnections_.clear();
    for (const auto& signal : signals_) {
        signal->config.writable = accessLetsRapidWrite(signal->config.access, accessLevels_);
    }
    // Chained connections settle whatever the order of their definition, because there is no loop.
    for (bool changed = true; changed;) {
        std::vector<double> before;
        for (const CrossConnection& connection : connections_)
            before.push_back(value(connection.result));
        for (const CrossConnection& connection : connections_) {
            signals_[static_cast<std::size_t>(connection.result)]->value = evaluate(connection);
        }
        changed = false;
        for (std::size_t i = 0; i < connections_.size(); ++i) {
            changed = changed || value(connections_[i].result) != before[i];
        }
    }
}

} // namespace rt

#include "tools/rws/signals.h"

#include "config/text_util.h"
#include "tools/rws/request_values.h"

#include <fmt/format.h>

#include <cmath>

namespace rapidc::rws {

namespace {

using rapid::config::containsName;
using rapid::config::sameName;

constexpr std::size_t kMostSignalsOnPage = 100;
constexpr const char* kSimulated = "simulated";
constexpr const char* kNotSimulated = "not simulated";

Entry& describe(const rt::IoSystem& io, rt::SignalId signal, Entry& entry) {
    const rt::SignalConfig& config = io.config(signal);
    entry.self = hrefBelow("/rw/iosystem/signals", entry.title);
    entry.value("name", config.name)
        .value("type", rt::signalTypeName(config.type))
        .value("category", config.category);
    entry.value("lvalue", shown(io.value(signal)));
    entry.value("lstate", io.isSimulated(signal) ? kSimulated : kNotSimulated);
    entry.value("quality", io.access(rt::IoSystem::handleOf(signal)) == rt::IoResult::Ok ? "good" : "bad");
    return entry;
}

/// One set of criteria of a search; `suffix`: "2" of the second set.
struct Criteria {
    std::string name, device, network, category, type, blocked;
    Criteria(const Request& request, const std::string& suffix) {
        name = fieldOf(request, "name" + suffix);
        device = fieldOf(request, "device" + suffix);
        network = fieldOf(request, "network" + suffix);
        category = fieldOf(request, "category" + suffix);
        type = fieldOf(request, "type" + suffix);
        blocked = fieldOf(request, "blocked" + suffix);
    }
    bool admits(const rt::IoSystem& io, rt::SignalId signal) const {
        const rt::SignalConfig& config = io.config(signal);
        if (!name.empty() && !containsName(config.name, name)) return false;
        if (!device.empty() && !sameName(config.device, device)) return false;
        if (!network.empty() &&
            (config.device.empty() || !sameName(io.devices().networkOf(config.device), network)))
            return false;
        if (!category.empty() && !sameName(config.category, category)) return false;
        if (!type.empty() && !sameName(rt::signalTypeName(config.type), type)) return false;
        const auto simulated = flagIn(blocked);
        return !simulated || *simulated == io.isSimulated(signal);
    }
};

} // namespace

std::string signalTitle(const rt::IoSystem& io, rt::SignalId signal) {
    const rt::SignalConfig& config = io.config(signal);
    if (config.device.empty()) return config.name;
    return fmt::format("{}/{}/{}", io.devices().networkOf(config.device), config.device, config.name);
}

std::optional<Failure> Signals::find(const Request& request, rt::SignalId& signal) const {
    const std::vector<std::string> parts = splitPath(request.parameter("name"));
    signal = parts.empty() ? -1 : io().find(parts.back());
    const bool isBare = parts.size() == 1;
    // Some clients write Local/DRV_1 before the names of virtual signals.
    const bool isVirtual = signal >= 0 && parts.size() == 3 && io().config(signal).device.empty();
    const bool isAtDevice = signal >= 0 && parts.size() == 3 &&
                            sameName(io().config(signal).device, parts[1]) &&
                            sameName(io().devices().networkOf(parts[1]), parts[0]);
    if (signal >= 0 && (isBare || isVirtual || isAtDevice)) return std::nullopt;
    return Failure{ReturnCode::NoSignal, fmt::format("there is no signal {}", request.parameter("name")), 0};
}

Reply Signals::list(const Request& request, const std::vector<rt::SignalId>& signals) const {
    ListPage page;
    if (const auto failure = readListPage(request, signals.size(), kMostSignalsOnPage, page))
        return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    document.next = page.next;
    for (std::size_t i = page.begin; i < page.end; ++i)
        describe(io(), signals[i], document.add("ios-signal-li", signalTitle(io(), signals[i])))
            .numberInJson = "lvalue"; // in lists only, as controllers answer
    return Reply::of(std::move(document));
}

Reply Signals::listAll(const Request& request) const {
    std::vector<rt::SignalId> all(io().size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = static_cast<rt::SignalId>(i);
    return list(request, all);
}

void Signals::describeWhole(rt::SignalId signal, Entry& entry) const {
    const rt::SignalConfig& config = io().config(signal);
    describe(io(), signal, entry);
    entry.value("unitnm", config.device);
    entry.value("pvalue", shown(io().value(signal)));
    entry.value("phstate",
                io().access(rt::IoSystem::handleOf(signal)) == rt::IoResult::Ok ? "valid" : "not valid");
    entry.value("label", config.label).value("access-level", config.access);
}

Reply Signals::one(const Request& request) const {
    rt::SignalId signal = -1;
    if (const auto failure = find(request, signal)) return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    describeWhole(signal, document.add("ios-signal", signalTitle(io(), signal)));
    // Clients of RWS 2.0 look for one of two classes (decision 129).
    if (request.dialect == Dialect::V2)
        describeWhole(signal, document.add("ios-signal-li", signalTitle(io(), signal)));
    return Reply::of(std::move(document));
}

Reply Signals::configuration(const Request& request) const {
    rt::SignalId signal = -1;
    if (const auto failure = find(request, signal)) return Reply::refuse(*failure);
    const rt::SignalConfig& config = io().config(signal);
    Document document;
    document.place = Document::Place::Resources;
    Entry& entry = document.add("ios-signal-cfg", signalTitle(io(), signal));
    entry.value("name", config.name)
        .value("type", rt::signalTypeName(config.type))
        .value("device", config.device);
    entry.value("device-map", config.deviceMap)
        .value("label", config.label)
        .value("category", config.category);
    entry.value("access-level", config.access).value("default", shown(config.defaultValue));
    entry.value("min", shown(config.minValue)).value("max", shown(config.maxValue));
    return Reply::of(std::move(document));
}

// ---- Changes -------------------------------------------------------------------------------------------------------

/// A level of EIO_ACCESS says in which mode remote clients may write.
bool Signals::levelLetsClientsWrite(const std::string& level) const {
    for (const rt::CfgInstance* instance : controller_.core().instances("EIO", "EIO_ACCESS")) {
        if (!sameName(instance->text("Name"), level)) continue;
        const bool automatic = controller_.panel().mode == service::OperatingMode::Auto;
        const rt::CfgAttribute* remote = instance->find(automatic ? "RemoteAuto" : "RemoteManual");
        return remote != nullptr && !sameName(remote->text(), "ReadOnly") &&
               instance->flag(automatic ? "RemoteAuto" : "RemoteManual");
    }
    return !sameName(level, "Internal");
}

std::optional<Failure> Signals::forbidden(rt::SignalId signal) const {
    const rt::SignalConfig& config = io().config(signal);
    if (sameName(config.access, "ReadOnly") || !levelLetsClientsWrite(config.access))
        return Failure{ReturnCode::Rejected,
                       fmt::format("the access level {} of signal {} does not let clients write it",
                                   config.access, config.name),
                       403};
    if (rt::isInput(config.type) && !config.device.empty() && !io().isSimulated(signal))
        return Failure{ReturnCode::Rejected,
                       fmt::format("{} is an input of device {}: simulate it first (lstate simulated)",
                                   config.name, config.device),
                       403};
    return std::nullopt;
}

std::optional<Failure> Signals::setValue(rt::SignalId signal, const std::string& text) {
    if (auto failure = forbidden(signal)) return failure;
    const rt::SignalConfig& config = io().config(signal);
    const auto value = numberIn(text);
    const bool isWhole = value && *value == std::floor(*value);
    if (!value || (rt::isDigital(config.type) && *value != 0 && *value != 1) ||
        (rt::isGroup(config.type) && !isWhole))
        return Failure{ReturnCode::BadParameter,
                       fmt::format("lvalue is '{}', which signal {} ({}) cannot have", text, config.name,
                                   rt::signalTypeName(config.type)),
                       0};
    switch (io().setByClient(signal, *value)) {
    case rt::IoResult::Ok: return std::nullopt;
    case rt::IoResult::NotWritable:
        return Failure{
            ReturnCode::Rejected,
            fmt::format("a cross connection sets {}: simulate it first (lstate simulated)", config.name),
            403};
    default:
        return Failure{ReturnCode::BadParameter,
                       fmt::format("lvalue is {}, outside the range {} to {} of signal {}", text,
                                   shown(config.minValue), shown(config.maxValue), config.name),
                       0};
    }
}

std::optional<Failure> Signals::simulate(rt::SignalId signal, bool on) {
    const rt::SignalConfig& config = io().config(signal);
    if (sameName(config.access, "ReadOnly") || !levelLetsClientsWrite(config.access))
        return Failure{ReturnCode::Rejected,
                       fmt::format("the access level {} of signal {} does not let clients simulate it",
                                   config.access, config.name),
                       403};
    if (io().isSimulated(signal) == on) return std::nullopt;
    io().simulate(signal, on);
    controller_.observers().signal(signal, io().value(signal)); // its state is another one
    return std::nullopt;
}

Reply Signals::set(const Request& request) {
    rt::SignalId signal = -1;
    if (const auto failure = find(request, signal)) return Reply::refuse(*failure);
    const std::string mode = fieldOf(request, "mode"), value = fieldOf(request, "lvalue");
    if (value.empty() && mode.empty() && !fieldOf(request, "lstate").empty()) return setState(request);
    if (!mode.empty() && !sameName(mode, "value") && !sameName(mode, kSimulated))
        return Reply::refuse(ReturnCode::BadParameter, "mode is value or simulated");
    const bool simulates = sameName(mode, kSimulated);
    if (value.empty() && !simulates) return Reply::refuse(ReturnCode::BadParameter, "lvalue is missing");
    const bool wasSimulated = io().isSimulated(signal);
    if (simulates)
        if (const auto failure = simulate(signal, true)) return Reply::refuse(*failure);
    if (value.empty()) return Reply::done();
    const auto failure = setValue(signal, value);
    if (failure && simulates && !wasSimulated) (void)simulate(signal, false); // refused: nothing has changed
    return failure ? Reply::refuse(*failure) : Reply::done();
}

Reply Signals::setState(const Request& request) {
    rt::SignalId signal = -1;
    if (const auto failure = find(request, signal)) return Reply::refuse(*failure);
    const std::string state = fieldOf(request, "lstate");
    if (!sameName(state, kSimulated) && !sameName(state, kNotSimulated))
        return Reply::refuse(ReturnCode::BadParameter, "lstate is 'simulated' or 'not simulated'");
    const auto failure = simulate(signal, sameName(state, kSimulated));
    return failure ? Reply::refuse(*failure) : Reply::done();
}

Reply Signals::endAllSimulations(const Request&) {
    for (std::size_t i = 0; i < io().size(); ++i)
        (void)simulate(static_cast<rt::SignalId>(i), false); // those that may not be simulated are not
    return Reply::done();
}

Reply Signals::search(const Request& request, int sets) const {
    std::vector<Criteria> criteria{Criteria(request, "")};
    if (sets == 2) criteria.emplace_back(request, "2");
    std::vector<rt::SignalId> found;
    for (std::size_t i = 0; i < io().size(); ++i) {
        const auto signal = static_cast<rt::SignalId>(i);
        bool admitted = true;
        for (const Criteria& each : criteria)
            admitted = admitted && each.admits(io(), signal);
        if (admitted) found.push_back(signal);
    }
    return list(request, found);
}

// ---- Routes --------------------------------------------------------------------------------------------------------

void Signals::addSubscription(Subscribables& subscribables) {
    Subscribable signal;
    signal.pattern = "/rw/iosystem/signals/{name*}";
    signal.resource = "state";
    signal.highPriority = true;
    signal.open = [this](const Request& request, const Changed& changed, Subscription& out) {
        rt::SignalId found = -1;
        if (auto failure = find(request, found)) return failure;
        out.initial.push_back(SignalWatches::entryOf(io(), found));
        out.watch = watches_.watch(found, changed);
        return std::optional<Failure>();
    };
    subscribables.add(std::move(signal));
}

void Signals::addTo(Router& router, Subscribables& subscribables) {
    const std::string all = "/rw/iosystem/signals", each = all + "/{name*}";
    router.getBoth(all, [this](const Request& r) { return listAll(r); });
    router.getBoth(each, [this](const Request& r) { return one(r); });
    router.get(Dialect::V2, each + "/config", [this](const Request& r) { return configuration(r); });
    router.action(each, "set", [this](const Request& r) { return set(r); });
    router.action(each, "set-value", [this](const Request& r) { return set(r); });
    router.action(each, "set-lstate", [this](const Request& r) { return setState(r); });
    router.post(Dialect::V2, each + "/set-value", [this](const Request& r) { return set(r); });
    router.post(Dialect::V2, each + "/set-lstate", [this](const Request& r) { return setState(r); });
    for (const char* name : {"unblock-signal", "unblock-signals"})
        router.action(all, name, [this](const Request& r) { return endAllSimulations(r); });
    router.post(Dialect::V2, all + "/unblock-signal",
                [this](const Request& r) { return endAllSimulations(r); });
    router.action(all, "signal-search", [this](const Request& r) { return search(r, 1); });
    router.action(all, "signal-searchex", [this](const Request& r) { return search(r, 2); });
    router.post(Dialect::V2, all + "/signal-search", [this](const Request& r) { return search(r, 1); });
    router.post(Dialect::V2, all + "/signal-search-ex", [this](const Request& r) { return search(r, 2); });
    addSubscription(subscribables);
}

} // namespace rapidc::rws

#include "tools/rws/io_units.h"

#include "config/text_util.h"
#include "tools/rws/request_values.h"
#include "tools/rws/state_watch.h"

#include <fmt/format.h>

namespace rapidc::rws {

namespace {

using rapid::config::containsName;
using rapid::config::sameName;

constexpr std::size_t kMostUnitsOnPage = 100;

Failure noNetwork(const Request& request) {
    return {ReturnCode::NotFound, fmt::format("unknown I/O network {}", request.parameter("network")), 0};
}

Failure noDevice(const Request& request) {
    return {ReturnCode::NotFound, fmt::format("unknown I/O device {}", request.parameter("device")), 0};
}

} // namespace

// ---- Networks ------------------------------------------------------------------------------------------------------

void IoUnits::describeNetwork(const std::string& name, Entry& entry) const {
    const bool works = !devices().isNetworkInError(name);
    entry.self = "/rw/iosystem/networks/" + escapedSegment(name);
    entry.value("name", name)
        .value("pstate", works ? "running" : "halted")
        .value("lstate", works ? "started" : "stopped");
}

Reply IoUnits::networks(const Request& request) const {
    const std::vector<std::string> names = devices().networkNames();
    ListPage page;
    if (const auto failure = readListPage(request, names.size(), kMostUnitsOnPage, page))
        return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    document.next = page.next;
    for (std::size_t i = page.begin; i < page.end; ++i)
        describeNetwork(names[i], document.add("ios-network-li", names[i]));
    return Reply::of(std::move(document));
}

Reply IoUnits::searchNetworks(const Request& request) const {
    const std::string wanted = fieldOf(request, "name"), state = fieldOf(request, "state");
    Document document;
    document.place = Document::Place::Resources;
    for (const std::string& name : devices().networkNames()) {
        const char* own = devices().isNetworkInError(name) ? "halted" : "running";
        if (!containsName(name, wanted) || (!state.empty() && !sameName(state, own))) continue;
        describeNetwork(name, document.add("ios-network-li", name));
    }
    return Reply::of(std::move(document));
}

std::string IoUnits::findNetwork(const Request& request) const {
    for (const std::string& name : devices().networkNames())
        if (sameName(name, request.parameter("network"))) return name;
    return {};
}

Reply IoUnits::network(const Request& request) const {
    const std::string name = findNetwork(request);
    if (name.empty()) return Reply::refuse(noNetwork(request));
    Document document;
    document.place = Document::Place::Resources;
    describeNetwork(name,
                    document.add(request.dialect == Dialect::V1 ? "ios-network" : "ios-network-li", name));
    return Reply::of(std::move(document));
}

Reply IoUnits::setNetwork(const Request& request) {
    const std::string state = fieldOf(request, "lstate");
    const bool starts = sameName(state, "start") || sameName(state, "started");
    if (!starts && !sameName(state, "stop") && !sameName(state, "stopped"))
        return Reply::refuse(ReturnCode::BadParameter, "lstate is 'start' or 'stop'");
    const std::string name = findNetwork(request);
    if (name.empty()) return Reply::refuse(noNetwork(request));
    devices().setNetworkError(name, !starts);
    return Reply::done();
}

// ---- Devices -------------------------------------------------------------------------------------------------------

std::string IoUnits::find(const Request& request) const {
    const std::vector<std::string> parts = splitPath(request.parameter("device"));
    if (parts.empty() || parts.size() > 2) return {};
    for (const std::string& name : devices().deviceNames()) {
        if (!sameName(name, parts.back())) continue;
        return parts.size() == 1 || sameName(devices().networkOf(name), parts.front()) ? name : std::string();
    }
    return {};
}

void IoUnits::describeDevice(const std::string& name, Entry& entry) const {
    const std::string network = devices().networkOf(name);
    entry.self = fmt::format("/rw/iosystem/devices/{}/{}", escapedSegment(network), escapedSegment(name));
    entry.value("name", name).value("lstate", devices().isActive(name) ? "enabled" : "disabled");
    const bool runs = devices().isActive(name) && devices().hasContact(name);
    entry.value("pstate", runs                       ? "running"
                          : devices().isActive(name) ? "error"
                                                     : "disabled")
        .value("address", "-");
    entry.value("network", network);
}

Reply IoUnits::listDevices(const Request& request) const {
    std::vector<std::string> names;
    const std::string network = request.query.text("network");
    for (std::string& name : devices().deviceNames())
        if (network.empty() || sameName(devices().networkOf(name), network)) names.push_back(std::move(name));
    ListPage page;
    if (const auto failure = readListPage(request, names.size(), kMostUnitsOnPage, page))
        return Reply::refuse(*failure);
    Document document;
    document.place = Document::Place::Resources;
    document.next = page.next;
    for (std::size_t i = page.begin; i < page.end; ++i)
        describeDevice(names[i],
                       document.add("ios-device-li", devices().networkOf(names[i]) + "/" + names[i]));
    return Reply::of(std::move(document));
}

Reply IoUnits::device(const Request& request) const {
    const std::string name = find(request);
    if (name.empty()) return Reply::refuse(noDevice(request));
    Document document;
    document.place = Document::Place::Resources;
    describeDevice(name, document.add(request.dialect == Dialect::V1 ? "ios-device" : "ios-device-li",
                                      devices().networkOf(name) + "/" + name));
    return Reply::of(std::move(document));
}

Reply IoUnits::setDevice(const Request& request) {
    const std::string name = find(request), state = fieldOf(request, "lstate");
    if (name.empty()) return Reply::refuse(noDevice(request));
    const bool enables = sameName(state, "enable") || sameName(state, "enabled");
    if (!enables && !sameName(state, "disable") && !sameName(state, "disabled"))
        return Reply::refuse(ReturnCode::BadParameter, "lstate is 'enable' or 'disable'");
    if (!enables && devices().mustStayActive(name))
        return Reply::refuse(ReturnCode::Rejected,
                             fmt::format("the trust level of device {} does not let it be disabled", name));
    devices().setActive(name, enables);
    return Reply::done();
}

Reply IoUnits::search(const Request& request) const {
    const std::string wanted = fieldOf(request, "name"), state = fieldOf(request, "lstate");
    const std::string network = fieldOf(request, "network");
    if (wanted.empty() && state.empty())
        return Reply::refuse(ReturnCode::BadParameter, "give name or lstate");
    Document document;
    document.place = Document::Place::Resources;
    for (const std::string& name : devices().deviceNames()) {
        const bool isState =
            state.empty() || sameName(state, devices().isActive(name) ? "enabled" : "disabled");
        const bool isNetwork = network.empty() || sameName(devices().networkOf(name), network);
        if (!containsName(name, wanted) || !isState || !isNetwork) continue;
        describeDevice(name, document.add("ios-device-li", devices().networkOf(name) + "/" + name));
        if (document.entries.size() == kMostUnitsOnPage) break;
    }
    return Reply::of(std::move(document));
}

Reply IoUnits::networkConfiguration(const Request& request) const {
    const std::string name = findNetwork(request);
    if (name.empty()) return Reply::refuse(noNetwork(request));
    Document document;
    document.place = Document::Place::Resources;
    document.add("ios-network-config-general", name)
        .value("cfgname", "INDUSTRIAL_NETWORK")
        .value("name", name)
        .value("simulated", "TRUE");
    return Reply::of(std::move(document));
}

Reply IoUnits::deviceConfiguration(const Request& request) const {
    const std::string name = find(request);
    if (name.empty()) return Reply::refuse(noDevice(request));
    const std::string network = devices().networkOf(name);
    Document document;
    document.place = Document::Place::Resources;
    document.add("ios-device-config-general", network + "/" + name)
        .value("name", name)
        .value("network", network)
        .value("simulated", "TRUE")
        .value("trustlevel", devices().mustStayActive(name) ? "required" : "default");
    return Reply::of(std::move(document));
}

void IoUnits::subscribe(Subscribables& subscribables) {
    const auto watch = [this](const char* type, const std::string& name, auto describe,
                              const Changed& changed, Subscription& out) {
        const auto read = [this, type, name, describe] {
            Entry entry;
            entry.type = type;
            entry.title = name;
            (this->*describe)(name, entry);
            return entry;
        };
        return watchState(controller_.observers(), {service::Change::Interval}, read, changed, out);
    };
    subscribables.add({"/rw/iosystem/networks/{network}", "state", false, std::nullopt,
                       [this, watch](const Request& request, const Changed& changed,
                                     Subscription& out) -> std::optional<Failure> {
                           const std::string name = findNetwork(request);
                           if (name.empty()) return noNetwork(request);
                           return watch("ios-networkstate-ev", name, &IoUnits::describeNetwork, changed, out);
                       }});
    subscribables.add({"/rw/iosystem/devices/{device*}", "state", false, std::nullopt,
                       [this, watch](const Request& request, const Changed& changed,
                                     Subscription& out) -> std::optional<Failure> {
                           const std::string name = find(request);
                           if (name.empty()) return noDevice(request);
                           return watch("ios-devicestate-ev", name, &IoUnits::describeDevice, changed, out);
                       }});
}

void IoUnits::addTo(Router& router, Subscribables& subscribables) {
    subscribe(subscribables);
    const std::string networks = "/rw/iosystem/networks", devices = "/rw/iosystem/devices";
    const std::string network = networks + "/{network}", device = devices + "/{device*}";
    router.getBoth("/rw/iosystem", [](const Request&) {
        Document document;
        document.place = Document::Place::Resources;
        for (const char* part : {"devices", "networks", "signals"})
            document.add("ios-system-li", part).value("name", part).self =
                fmt::format("/rw/iosystem/{}", part);
        return Reply::of(std::move(document));
    });
    router.getBoth(networks, [this](const Request& r) { return this->networks(r); });
    router.getBoth(network, [this](const Request& r) { return this->network(r); });
    router.post(Dialect::V2, networks, [this](const Request& r) { return searchNetworks(r); });
    router.post(Dialect::V2, devices, [this](const Request& r) { return search(r); });
    router.action(networks, "search", [this](const Request& r) { return searchNetworks(r); });
    router.action(network, "set", [this](const Request& r) { return setNetwork(r); });
    router.post(Dialect::V2, network + "/set-lstate", [this](const Request& r) { return setNetwork(r); });
    router.get(Dialect::V2, network + "/config",
               [this](const Request& r) { return networkConfiguration(r); });
    router.get(Dialect::V2, device + "/config", [this](const Request& r) { return deviceConfiguration(r); });
    router.getBoth(devices, [this](const Request& r) { return listDevices(r); });
    router.getBoth(device, [this](const Request& r) { return this->device(r); });
    router.action(device, "set", [this](const Request& r) { return setDevice(r); });
    router.post(Dialect::V2, device + "/set-lstate", [this](const Request& r) { return setDevice(r); });
    router.add(Dialect::V1,
               {Method::Post, devices, "search", [this](const Request& r) { return search(r); }});
    router.add(Dialect::V2,
               {Method::Post, devices, "search", [this](const Request& r) { return search(r); }});
}

} // namespace rapidc::rws

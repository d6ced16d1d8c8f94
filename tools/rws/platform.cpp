#include "tools/rws/platform.h"

#include "config/letter_case.h"
#include "runtime/host/camera_names.h"
#include "runtime/net/address.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"
#include "tools/service/event_journal.h"

#include <algorithm>
#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

constexpr std::size_t kMostInterfaces = 50;

Handler nothing() {
    return [](const Request&) { return Reply::of(Document{}); };
}

Handler refusing(ReturnCode code, const char* why, int status) {
    return [=](const Request&) { return Reply::refuse(code, why, status); };
}

Handler unsupported() {
    return refusing(ReturnCode::NotSupported, "the resource is not supported on a virtual controller", 404);
}

Handler unsupportedOrder() {
    return refusing(ReturnCode::NotSupported, "the order is not supported on a virtual controller", 403);
}

Reply safetyMode(const char* mode) {
    Document document;
    document.add("safetymodestatus", "status").value("userdata", "0").value("safetymode", mode);
    return Reply::of(std::move(document));
}

Reply noViolation() {
    Document document;
    Entry& entry = document.add("safety-violationinfo", "status");
    entry.value("violation-type", "none");
    for (const char* kind : {"unsynchronized", "tool-pos-violation-status", "upper-arm-violation-status",
                             "axis-range-violation-status"})
        entry.value(kind, "0");
    return Reply::of(std::move(document));
}

std::string textOf(const sockaddr* address) {
    return rt::net::ipText(ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr));
}

} // namespace

// ---- Safety controller -----------------------------------------------------------------------------------------------

/// There are no safety functions: its configuration is the one of a new controller, and nothing violates it.
void Platform::addSafety(Router& router) {
    const std::string base = "/ctrl/safety";
    router.get(Dialect::V1, base, [](const Request& request) {
        const std::string resource = request.query.text("resource");
        if (sameName(resource, "safety-mode")) return safetyMode("SCORCH_SAFETY_MODE_ACTIVE_MODE");
        if (sameName(resource, "violation-info")) return noViolation();
        if (sameName(resource, "loadoperation-status"))
            return oneValue("scorch-load-status", "status", "scorchloadoperationstatus", "OK");
        return oneValue("ctrl-safety", "safety", "state", "active");
    });
    router.get(Dialect::V2, base, [](const Request&) {
        return folder({{"safety-mode-li", "ctrl/safety/mode"},
                       {"safety-cbc-li", "ctrl/safety/cbc?drivenum=1"},
                       {"safety-config-li", "ctrl/safety/config"},
                       {"safety-violation-li", "ctrl/safety/violation"},
                       {"safety-load-li", "ctrl/safety/load"}});
    });
    router.get(Dialect::V2, base + "/mode", [](const Request&) { return safetyMode("active"); });
    router.get(Dialect::V2, base + "/violation", [](const Request&) { return noViolation(); });
    router.post(Dialect::V2, base + "/config", unsupportedOrder());
    for (const char* action :
         {"load", "set-mode", "unlock", "lock", "syncack", "validate-cfg", "invalidate-cfg"})
        router.action(base, action, unsupportedOrder());
    router.get(Dialect::V2, base + "/load", [](const Request&) {
        return oneValue("scorch-load-status", "status", "status", "SCORCH_CONFIG_LOADED");
    });
    router.get(Dialect::V2, base + "/config", [](const Request&) {
        return folder({{"safety-startupstatus-li", "ctrl/safety/config/startupstatus"}});
    });
    router.get(Dialect::V2, base + "/config/startupstatus", [](const Request&) {
        return oneValue("startup-safety-config-load-satus", "status",
                        "config-status-at-startup", // spelled like this
                        "SCORCH_CONFIG_LOADED_AT_STARTUP");
    });
    router.get(Dialect::V2, base + "/cbc", [this](const Request& request) {
        const auto drive = countIn(request.query.text("drivenum"));
        const auto& units = controller_.core().units().all();
        const bool isKnown = drive && std::any_of(units.begin(), units.end(), [&](const auto& unit) {
                                 return unit->group + 1 == *drive;
                             });
        if (!isKnown) return badParameter("drivenum", "the number of a drive module, from 1");
        Document document;
        document.add("cbc-status", "status")
            .value("next-brake-check-time", "0")
            .value("last-brake-check-status", "unknown")
            .value("status", "not required");
        return Reply::of(std::move(document));
    });
    router.postBoth(base + "/cyclic-brake-check", unsupported());
    router.getBoth(base + "/zones", unsupported());
}

// ---- Certificates ----------------------------------------------------------------------------------------------------

Reply Platform::certificates(const Request& request) const {
    struct Store {
        const char* path;
        std::initializer_list<const char*> children;
    };
    static const Store kStores[] = {{"", {"controller", "system"}},
                                    {"controller", {"trust_ca_store"}},
                                    {"system", {"robapi_store", "rws_store"}}};
    const auto path = request.parameters.find("path");
    const std::string wanted = path == request.parameters.end() ? "" : path->second;
    Document document;
    document.place = Document::Place::Resources;
    for (const Store& store : kStores) {
        const std::string prefix = store.path[0] == '\0' ? "" : std::string(store.path) + "/";
        const bool isStore = sameName(store.path, wanted);
        std::size_t number = 0;
        for (const char* child : store.children) {
            if (isStore) {
                Entry& entry = document.add("ctrl-certstore-li", fmt::format("{}", number++));
                entry.self = "/ctrl/certstore/" + prefix + child;
                entry.value("store-name", child);
            } else if (!prefix.empty() && sameName(prefix + child, wanted)) {
                if (sameName(child, "rws_store") && !certificate_.empty())
                    document.add("ctrl-certstore-cert", "0").value("cert-pem", certificate_);
                return Reply::of(std::move(document));
            }
        }
        if (isStore) return Reply::of(std::move(document));
    }
    return Reply::refuse(ReturnCode::NotFound, "there is no certificate store " + wanted);
}

void Platform::addCertificates(Router& router) {
    const std::string base = "/ctrl/certstore", each = base + "/{path*}";
    const Handler stores = [this](const Request& request) { return certificates(request); };
    const Handler fixed =
        refusing(ReturnCode::Rejected, "the certificates of a virtual controller cannot be changed", 403);
    router.get(Dialect::V2, base, stores);
    router.get(Dialect::V2, each, stores);
    router.post(Dialect::V2, each, fixed);
    router.add(Dialect::V2, {Method::Delete, each, {}, fixed});
}

// ---- Network -----------------------------------------------------------------------------------------------------------

/// The interfaces at which the controller can be reached.
Reply Platform::interfaces() const {
    const auto& listen = controller_.settings().options.network.listen;
    const uint32_t wanted = listen.value_or(rt::net::kLoopback);
    Document document;
    ifaddrs* all = nullptr;
    if (::getifaddrs(&all) != 0) return Reply::of(std::move(document));
    for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
        if (each->ifa_addr == nullptr || each->ifa_netmask == nullptr ||
            each->ifa_addr->sa_family != AF_INET || (each->ifa_flags & IFF_UP) == 0)
            continue;
        const std::string address = textOf(each->ifa_addr);
        if (wanted != rt::net::kAnyAddress && address != rt::net::ipText(wanted)) continue;
        document.add("ctrl-netw", each->ifa_name)
            .value("addr", address)
            .value("mask", textOf(each->ifa_netmask))
            .value("name", each->ifa_name);
    }
    ::freeifaddrs(all);
    return Reply::of(std::move(document));
}

void Platform::addNetwork(Router& router) {
    router.get(Dialect::V1, "/ctrl/network", [this](const Request&) { return interfaces(); });
    for (const char* part : {"dns", "routes", "route"}) // it asks no name server and routes nothing
        router.get(Dialect::V1, std::string("/ctrl/network/") + part, nothing());
    router.getBoth("/ctrl/diagnostics",
                   refusing(ReturnCode::BadParameter, "No Diagnostics Saved on controller yet", 400));
    router.post(Dialect::V2, "/ctrl/diagnostics/save",
                refusing(ReturnCode::NotSupported, "a virtual controller saves no diagnostics", 400));
    router.action("/ctrl/diagnostics", "save",
                  refusing(ReturnCode::NotSupported, "a virtual controller saves no diagnostics", 400));
    router.get(Dialect::V2, "/ctrl/registry", nothing());
    router.get(Dialect::V2, "/ctrl/features", nothing());
    const Handler language = [](const Request& request) {
        const std::string code = fieldOf(request, "lang");
        return sameName(code, "en") ? Reply::done() : badParameter("lang", "en");
    };
    router.post(Dialect::V2, "/ctrl/lang", language);
    router.action("/ctrl", "set-lang", language);
    // no published client shows what these look like
    router.get(Dialect::V1, "/rw/rapid/tasks/{task}/execution", unsupported());
    router.get(Dialect::V1, "/ctrl/backup/info", unsupported());
    router.getBoth("/users/remoteuser", unsupported());
    router.postBoth("/users/remoteuser", unsupported());
    for (const char* path : {"compatible", "compatibility", "compatibility/{version}", "syslog", "env",
                             "system", "systems", "compress", "clock/timeserver"})
        router.getBoth(std::string("/ctrl/") + path, unsupported());
    for (const char* path :
         {"compress", "decompress", "tpu/{action}", "system", "system/update", "system/installdpkg",
          "system/validatedpkg", "network", "network/route/{action}"})
        router.postBoth(std::string("/ctrl/") + path, unsupported());
    for (const char* path : {"clock/timezone", "clock/timeserver"})
        router.postBoth(std::string("/ctrl/") + path, unsupportedOrder());
    router.addBoth({Method::Put, "/ctrl/identity", {}, unsupportedOrder()});
    for (const char* action : {"comp", "dcomp"})
        router.action("/ctrl/compress", action, unsupported());
    router.post(Dialect::V2, "/ctrl/system/info",
                refusing(ReturnCode::NotSupported, "a virtual controller writes no system information", 403));
}

// ---- Cameras, energy -----------------------------------------------------------------------------------------------------

Reply Platform::cameras() const {
    const rt::CameraNames& names = controller_.core().service<rt::CameraNames>();
    Document document;
    document.add("number-of-cameras-li", "number-of-cameras")
        .value("number-of-cameras", fmt::format("{}", names.size()));
    for (std::size_t i = 0; i < names.size() && i < kMostInterfaces; ++i) {
        const std::string& name = names.name(static_cast<int>(i));
        Entry& entry = document.add("vision-system-li", name);
        entry.self = "/rw/vision/" + escapedSegment(name);
        entry.value("name", name).value("status", "connected");
    }
    return Reply::of(std::move(document));
}

/// Nothing measures the power of simulated drives: state -1 says that the figures are not valid.
Reply Platform::energy(const Request& request) const {
    if (sameName(request.query.text("resource"), "change-count"))
        return oneValue("sys-energy-changecount", "change-count", "change-count",
                        fmt::format("{}", energyChanges_));
    const int64_t now = controller_.core().calendarSeconds();
    Document document;
    Entry& entry = document.add("sys-energy-state", "energy");
    entry.value("state", "-1").value("energy-state", "not-paused");
    entry.value("change-count", fmt::format("{}", energyChanges_))
        .value("time-stamp", service::calendarText(now))
        .value("reset-time", service::calendarText(energyReset_ == 0 ? now : energyReset_));
    for (const char* figure : {"interval-length", "interval-energy", "accumulated-energy"})
        entry.value(figure, "0");
    return Reply::of(std::move(document));
}

void Platform::addEquipment(Router& router) {
    router.getBoth("/rw/vision", [this](const Request&) { return cameras(); });
    router.getBoth("/rw/vision/{name}", [this](const Request& request) {
        const rt::CameraNames& names = controller_.core().service<rt::CameraNames>();
        const int camera = names.find(request.parameter("name"));
        if (camera < 0)
            return Reply::refuse(ReturnCode::NotFound, "there is no camera " + request.parameter("name"));
        Document document;
        document.add("vision-system", names.name(camera))
            .value("name", names.name(camera))
            .value("status", "connected");
        return Reply::of(std::move(document));
    });
    router.post(Dialect::V2, "/rw/vision/refresh", [](const Request&) { return Reply::done(); });
    router.action("/rw/vision", "refresh", [](const Request&) { return Reply::done(); });
    router.getBoth("/rw/system/energy", [this](const Request& request) { return energy(request); });
    addOrder(router, "/rw/system/energy", "reset", "reset", [this](const Request&) {
        energyReset_ = controller_.core().calendarSeconds();
        ++energyChanges_;
        return Reply::done();
    });
    // An ideal robot has no measurement board, no motors to calibrate and no frames to measure.
    const std::string unit = "/rw/motionsystem/mechunits/{unit}";
    for (const char* path : {"smbdata", "calibrationinfo", "motorcalib"})
        router.getBoth(fmt::format("{}/{}", unit, path), unsupported());
    for (const std::string& path : {unit + "/smbdata", unit + "/calib", unit + "/axes/{axis}",
                                    std::string("/rw/rapid/tasks/{task}/motion/calib")})
        router.postBoth(path, unsupportedOrder());
    const Handler noOption = refusing(ReturnCode::Rejected, "Option is missing: Collision Avoidance", 403);
    for (const char* path : {"snapshot", "loadconfig"})
        router.post(Dialect::V2, std::string("/rw/motionsystem/collisionavoidance/") + path, noOption);
}

void Platform::addTo(Router& router) {
    addSafety(router);
    addCertificates(router);
    addNetwork(router);
    addEquipment(router);
}

} // namespace rapidc::rws

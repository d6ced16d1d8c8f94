#include "tools/rws/control_stations.h"
#include "tools/rws/request_values.h"

#include "tools/rws/rapid_support.h"

#include <algorithm>
#include <cctype>

namespace rapidc::rws {

namespace {

const std::vector<Domain> kAll{Domain::Cfg, Domain::Rapid, Domain::Motion};

/// "{8-4-4-4-12}", hexadecimal digits.
bool isGuid(std::string_view text) {
    constexpr std::string_view kForm = "{xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx}";
    return std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), [](char c, char form) {
        return form == 'x' ? std::isxdigit(static_cast<unsigned char>(c)) != 0 : c == form;
    });
}

bool isNumber(std::string_view text) {
    return !text.empty() && text.size() <= 32 && std::all_of(text.begin(), text.end(), [](char c) {
        return std::isdigit(static_cast<unsigned char>(c)) != 0;
    });
}

Reply one(std::string type, std::string name, std::string value) {
    return oneValue(std::move(type), name, name, std::move(value));
}

} // namespace

const ControlStations::Station* ControlStations::find(uint64_t session) const {
    const auto found = stations_.find(session);
    return found == stations_.end() ? nullptr : &found->second;
}

Handler ControlStations::only8(Handler handler) const {
    return [this, handler = std::move(handler)](const Request& request) {
        if (controller_.settings().robotWare < 8)
            return Reply::refuse(ReturnCode::NotFound, "Control stations exist from RobotWare 8 on");
        return handler(request);
    };
}

void ControlStations::addTo(Router& router) {
    const auto get = [&](const char* pattern, Handler handler) {
        router.get(Dialect::V2, std::string("/rw/controlstation") + pattern, only8(std::move(handler)));
    };
    const auto post = [&](const char* pattern, Handler handler) {
        router.post(Dialect::V2, std::string("/rw/controlstation") + pattern, only8(std::move(handler)));
    };
    get("", [](const Request&) {
        return folder({{"controlstation-register-li", "controlstation/register/remote"},
                       {"controlstation-writeaccess-li", "controlstation/writeaccess/status"}});
    });
    post("/register/remote", [this](const Request& request) { return registerRemote(request); });
    post("/register/local", [](const Request&) {
        return Reply::refuse(ReturnCode::StationRefused, "This controller has no local control station");
    });
    post("/writeaccess/request", [this](const Request& request) { return requestAccess(request); });
    post("/writeaccess/release", [this](const Request& request) { return releaseAccess(request); });
    get("/writeaccess/status", [this](const Request& request) { return status(request); });
    post("/writeaccess/release/appeal", [this](const Request&) {
        ++appeals_;
        return Reply::done();
    });
    get("/writeaccess/release/appeal/changecount", [this](const Request&) {
        return one("controlstation-release-write-access-appeal-change-count", "changecount",
                   std::to_string(appeals_));
    });
    get("/type", [this](const Request& request) {
        return one("controlstation-type", "control-station-type",
                   find(request.session->number) ? "remote" : "none");
    });
    get("/id", [this](const Request& request) {
        const Station* station = find(request.session->number);
        return one("control-station", "control-station-Id", station ? station->id : "none");
    });
    get("/local/isconnected", [](const Request&) {
        return one("controlstation-local-connected", "control-station-local-isconnected", "false");
    });
    get("/tpu/safety/protocol/status", [](const Request&) {
        return one("controlstation-tpu-safety-protocol-status", "is-connected", "false");
    });
    // the class is spelled so on controllers
    get("/allowmotioncontrol", [this](const Request&) {
        return one("controstation-allow-motion-control", "is-enabled", motionControl_ ? "true" : "false");
    });
    post("/allowmotioncontrol", [this](const Request& request) {
        const std::optional<bool> allow = flagIn(request.form.text("allow-motion-control"));
        if (!allow) return badParameter("allow-motion-control", "true or false");
        motionControl_ = *allow;
        return Reply::done();
    });
    post("/disableexternalcontrol", [this](const Request&) {
        externalControl_ = false;
        return Reply::done();
    });
}

Reply ControlStations::registerRemote(const Request& request) {
    Station station{request.form.text("control-station-name"), request.form.text("control-station-id")};
    if (station.name.empty() || station.name.size() > 80)
        return badParameter("control-station-name", "a name of 1 to 80 characters");
    if (!isGuid(station.id))
        return badParameter("control-station-id", "a GUID such as {01234567-89ab-cdef-0123-456789abcdef}");
    if (!isNumber(request.form.text("pincode"))) return badParameter("pincode", "digits");
    stations_[request.session->number] = std::move(station);
    externalControl_ = true;
    return Reply::done();
}

std::optional<Failure> ControlStations::refusal(uint64_t session, bool hasAccess, bool isHeld) const {
    if (find(session) == nullptr)
        return Failure{
            ReturnCode::StationUnknown,
            "The session is not part of a control station: POST /rw/controlstation/register/remote"};
    if (hasAccess) return std::nullopt;
    if (isHeld) return Failure{ReturnCode::WriteAccessHeld, "Another client has write access"};
    return Failure{ReturnCode::NoWriteAccess,
                   "The control station has no write access: POST /rw/controlstation/writeaccess/request"};
}

Reply ControlStations::requestAccess(const Request& request) {
    if (find(request.session->number) == nullptr)
        return Reply::refuse(ReturnCode::StationUnknown, "The session is not part of a control station");
    if (!mastership_.request(kAll, request))
        return Reply::refuse(ReturnCode::WriteAccessHeld, "Another client has write access");
    return Reply::done();
}

Reply ControlStations::releaseAccess(const Request& request) {
    if (!hasAccess(request.session->number))
        return Reply::refuse(ReturnCode::StationRefused, "The control station does not have write access");
    mastership_.release(kAll, request.session->number);
    return Reply::done();
}

Reply ControlStations::status(const Request&) const {
    const Mastership::Holder* holder = mastership_.holder(Domain::Rapid);
    const Station* station = holder ? find(holder->session) : nullptr;
    Document document;
    document.add("controlstation-write-access-status", "status")
        .value("control-station-write-access-held", holder ? "true" : "false")
        .value("held-by-control-station-Id", station ? station->id : "none")
        .value("held-by-control-station-name", station ? station->name : "none")
        .value("control-station-external-control-enabled", externalControl_ ? "true" : "false");
    return Reply::of(std::move(document));
}

} // namespace rapidc::rws

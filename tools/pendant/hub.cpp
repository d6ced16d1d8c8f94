#include "tools/pendant/hub.h"

#include "config/json_text.h"
#include "tools/pendant/areas.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

namespace rapidc::pendant {

namespace {

constexpr int kVersion = 1; // of the protocol

} // namespace

Hub::Hub(service::VirtualController& controller, service::EventJournal& journal, service::ManualMotion& manual)
    : controller_(controller) {
    const Context context{controller, journal, manual, *this};
    for (const auto make : {makePanelArea, makeExecutionArea, makeBreakpointArea, makeModuleArea, makeFileArea,
                            makeSignalArea, makeDataArea, makeDialogArea, makeEventArea, makeUnitArea,
                            makeMotionArea, makeZoneArea, makeJogArea})
        areas_.push_back(make(context));
    for (const auto& area : areas_)
        area->addTo(methods_);
    methods_.add("hello", [this](Client& client, const Json& params) { return hello(client, params); });
    methods_.add("state", [this](Client&, const Json&) { return state(); });
    service::Observer observer;
    observer.changed = [this](service::Change change, const rt::Task*) {
        if (change == service::Change::Generation) broadcast("generation", Json::object());
    };
    observer_ = controller_.observers().add(std::move(observer));
}

Hub::~Hub() {
    controller_.observers().remove(observer_);
}

void Hub::add(std::shared_ptr<Client> client) {
    clients_.push_back(std::move(client));
}

void Hub::remove(const std::shared_ptr<Client>& client) {
    if (std::erase(clients_, client) == 0) return;
    for (const auto& area : areas_)
        area->forget(*client);
}

void Hub::handle(const std::shared_ptr<Client>& client, const Json& request) {
    const Json& id = request.at("id");
    try {
        const auto method = request.find("method");
        if (method == request.end() || !method->is_string()) badRequest("method is missing");
        const auto params = request.find("params");
        const bool hasParams = params != request.end() && !params->is_null();
        if (hasParams && !params->is_object()) badRequest("params must be an object");
        client->answer(id, call(*client, method->get<std::string>(), hasParams ? *params : Json::object()));
    } catch (const RequestError& error) {
        client->refuse(id, error);
    } catch (const std::exception& error) { // a mistake of this program must not end the controller
        client->refuse(id, {code::kFailed, fmt::format("The request failed: {}", error.what())});
    }
}

Json Hub::call(Client& client, const std::string& method, const Json& params) {
    const Method* found = methods_.find(method);
    if (found == nullptr)
        throw RequestError{code::kUnknownMethod, fmt::format("There is no method {}", method.substr(0, 100))};
    if (!client.isGreeted() && method != "hello")
        throw RequestError{code::kLogin, "The connection has not said hello", "Call hello first"};
    Json result = (*found)(client, params);
    return result.is_null() ? Json::object() : result;
}

Json Hub::hello(Client& client, const Json& params) {
    if (client.needsLogin() && !client.isGreeted()) {
        if (!has(params, "password"))
            throw RequestError{code::kLogin, "A password is needed",
                               "Enter the password that was given to rapidc serve"};
        const std::string problem = checkPassword_ ? checkPassword_(client, textOf(params, "password")) : "";
        if (!problem.empty()) throw RequestError{code::kLogin, problem};
    }
    client.greet();
    return {{"version", kVersion},
            {"product", "rapidc"},
            {"robotWare", std::to_string(controller_.settings().robotWare)},
            {"loginNeeded", client.needsLogin()}};
}

Json Hub::state() {
    Json state = Json::object();
    for (const auto& area : areas_)
        area->describe(state);
    state["robotWare"] = std::to_string(controller_.settings().robotWare);
    state["name"] = controller_.core().program().name;
    return state;
}

std::shared_ptr<const std::string> Hub::notification(const char* event, const Json& data) {
    return std::make_shared<const std::string>(rapid::config::textOf(Json{{"event", event}, {"data", data}}));
}

void Hub::broadcast(const char* event, const Json& data) {
    if (clients_.empty()) return;
    const auto text = notification(event, data);
    for (const auto& client : clients_)
        if (client->isGreeted()) client->send(text);
}

void Hub::broadcastUnlessCongested(const char* event, const Json& data) {
    const auto text = notification(event, data);
    for (const auto& client : clients_)
        if (client->isGreeted() && !client->isCongested()) client->send(text);
}

void Hub::tick() {
    if (isDirty_.exchange(false, std::memory_order_relaxed)) controller_.post([this] { flush(); });
}

void Hub::flush() {
    for (const auto& area : areas_)
        area->flush();
}

} // namespace rapidc::pendant

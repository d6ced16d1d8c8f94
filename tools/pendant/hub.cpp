#include "tools/pendant/hub.h"

#include "config/json_text.h"
#include "tools/pendant/areas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace rapidc::pendant {

namespace {

constexpr int kVersion = 1; // of the protocol

/// Whether `action` succeeds; else the client gets the error.
template <class Action> bool answering(Client& client, const Json& id, const Action& action) {
    try {
        action();
        return true;
    } catch (const RequestError& error) {
        client.refuse(id, error);
    } catch (const std::exception& error) { // a mistake of this program must not end the controller
        client.refuse(id, {code::kFailed, fmt::format("The request failed: {}", error.what())});
    }
    return false;
}

} // namespace

Hub::Hub(const Shared& shared) : controller_(shared.controller) {
    const Context context{shared, *this};
    for (const auto make : {makePanelArea, makeExecutionArea, makeBreakpointArea, makeModuleArea,
                            makeFileArea, makeSignalArea, makeDataArea, makeDialogArea, makeEventArea,
                            makeUnitArea, makeMotionArea, makeZoneArea, makeJogArea})
        areas_.push_back(make(context));
    for (const auto& area : areas_)
        area->addTo(methods_);
    methods_.add("hello", [this](Client& client, const Json& params) { return hello(client, params); });
    methods_.add("state", [this](Client&, const Json&) { return state(); });
    service::Observer observer;
    observer.changed = [this](service::Change change, const rt::Task*) {
        if (change == service::Change::Restart) isRestarting_ = true;
        if (change != service::Change::Generation) return;
        if (isRestarting_)
            endAll();
        else
            broadcast("generation", Json::object());
        isRestarting_ = false;
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

/// As a restart does. The page connects again by itself.
void Hub::endAll() {
    for (const auto& client : std::vector(clients_)) {
        client->close(http::CloseCode::ServiceRestart, "the controller restarts");
        remove(client);
    }
}

void Hub::handle(const std::shared_ptr<Client>& client, const std::shared_ptr<const Json>& request) {
    if (std::find(clients_.begin(), clients_.end(), client) == clients_.end()) return client->endRequest();
    const Json& id = request->at("id");
    const MethodTable::Entry* entry = nullptr;
    const bool isKnown = answering(*client, id, [&] {
        const auto method = request->find("method");
        if (method == request->end() || !method->is_string()) badRequest("method is missing");
        const auto params = request->find("params");
        if (params != request->end() && !params->is_null() && !params->is_object())
            badRequest("params must be an object");
        entry = &methodFor(*client, method->get<std::string>());
    });
    if (!isKnown) return client->endRequest();
    const auto params = request->find("params");
    const bool hasParams = params != request->end() && params->is_object();
    const Json given = hasParams ? *params : Json::object();
    const auto send = [client, request](const Json& result) {
        client->answer(request->at("id"), result.is_null() ? Json::object() : result);
    };
    DiskWork work;
    answering(*client, id, [&] {
        if (entry->method)
            send(entry->method(*client, given));
        else
            work = entry->diskMethod(*client, given);
    });
    const auto finish = [client, request, send, work] {
        answering(*client, request->at("id"), [&] { send(work()); });
        client->endRequest();
    };
    if (work && workers_.post(finish)) return;
    if (work) client->refuse(id, {code::kBusy, "Too much waits for the disk", "Send it later"});
    client->endRequest();
}

const MethodTable::Entry& Hub::methodFor(const Client& client, const std::string& name) const {
    const MethodTable::Entry* found = methods_.find(name);
    if (found == nullptr)
        throw RequestError{code::kUnknownMethod, fmt::format("There is no method {}", name.substr(0, 100))};
    if (!client.isGreeted() && name != "hello")
        throw RequestError{code::kLogin, "The connection has not said hello", "Call hello first"};
    return *found;
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
        guarded([&] { area->flush(); });
}

void Hub::guarded(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& error) {
        fmt::print(stderr, "web page: {}\n", error.what());
    }
}

} // namespace rapidc::pendant

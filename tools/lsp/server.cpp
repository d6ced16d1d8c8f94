#include "tools/lsp/server.h"

#include "config/json_text.h"
#include "tools/lsp/requests.h"

#include <exception>
#include <fmt/format.h>
#include <utility>

namespace lsp {

Server::Server(const rapid::workspace::Environment& environment, State::Send send)
    : send_(send), state_(environment, std::move(send)) {}

namespace {

using rapid::query::Cancel;
using rapid::query::CancelReason;

/// Ends a request whose answer is not wanted any more.
void throwIfCancelled(const Cancel* cancel) {
    if (!rapid::query::isCancelled(cancel)) return;
    if (cancel->reason() == CancelReason::Overtaken)
        throw RequestError{error::kContentModified, "the text has changed since the request; send it again"};
    throw RequestError{error::kCancelled, "the request was cancelled"};
}

bool isId(const Json& id) {
    return id.is_string() || id.is_number_integer();
}

/// The id of something that is not a request, as far as it has one.
Json idOf(const Json& message) {
    if (!message.is_object()) return nullptr;
    const auto id = message.find("id");
    return id != message.end() && isId(*id) ? *id : Json(nullptr);
}

bool isRequestOrNotification(const Json& message) {
    if (!message.is_object() || message.value("jsonrpc", Json()) != "2.0") return false;
    const auto method = message.find("method");
    const auto id = message.find("id");
    return method != message.end() && method->is_string() && (id == message.end() || isId(*id));
}

bool isResponse(const Json& message) {
    return message.is_object() && !message.contains("method") && message.contains("id") &&
           (message.contains("result") || message.contains("error"));
}

} // namespace

void Server::receiveGarbage() {
    if (phase_ != Phase::Ended) refuse(nullptr, error::kParse, "the message is not JSON");
}

void Server::receive(const Json& message) {
    if (phase_ == Phase::Ended) return;
    if (isResponse(message)) {
        if (phase_ == Phase::Initialized) state_.answer(message);
        return;
    }
    if (!isRequestOrNotification(message)) {
        refuse(idOf(message), error::kInvalidRequest,
               "the message is not a request: expected an object with \"jsonrpc\": \"2.0\" and a method");
        return;
    }
    const auto method = message.at("method").get<std::string>();
    static const Json kNone;
    const auto params = message.find("params");
    const Json& given = params == message.end() ? kNone : *params;
    if (message.contains("id"))
        request(message.at("id"), method, given);
    else
        notification(method, given);
}

void Server::request(const Json& id, const std::string& method, const Json& params) {
    state_.cancel = cancelOf_ ? cancelOf_(id) : nullptr;
    if (phase_ == Phase::New && method != "initialize")
        return refuse(id, error::kNotInitialized, "the first request has to be 'initialize'");
    if (phase_ == Phase::ShutDown)
        return refuse(id, error::kInvalidRequest, "the server was shut down: only 'exit' may follow");
    if (phase_ == Phase::Initialized && method == "initialize")
        return refuse(id, error::kInvalidRequest, "'initialize' may be sent once only");
    try {
        throwIfCancelled(state_.cancel);
        send_(response(id, answer(method, params)));
    } catch (const RequestError& problem) {
        refuse(id, problem.code, problem.message);
    } catch (const std::exception& problem) {
        refuse(id, error::kInternal, fmt::format("'{}' failed: {}", method, problem.what()));
    }
}

Json Server::answer(const std::string& method, const Json& params) {
    if (!params.is_null() && !params.is_structured())
        throw RequestError{error::kInvalidParams, "'params': expected an object"};
    if (method == "initialize") {
        if (!params.is_object()) throw RequestError{error::kInvalidParams, "'params': expected an object"};
        initialize(state_, params);
        phase_ = Phase::Initialized;
        return capabilities(state_);
    }
    if (method == "shutdown") {
        phase_ = Phase::ShutDown;
        wasShutDown_ = true;
        return nullptr;
    }
    if (method == "textDocument/diagnostic") return pullDiagnostics(state_, params);
    if (method == "workspace/diagnostic") return pullWorkspaceDiagnostics(state_, params);
    const auto handler = requests().find(method);
    if (handler == requests().end())
        throw RequestError{error::kMethodNotFound, fmt::format("there is no request '{}'", method)};
    Json found = handler->second(state_, params);
    // A query that was cancelled has returned a part of its answer.
    throwIfCancelled(state_.cancel);
    return found;
}

void Server::notification(const std::string& method, const Json& params) {
    if (method == "exit") {
        phase_ = Phase::Ended;
        return;
    }
    if (phase_ != Phase::Initialized || method.starts_with("$/")) return;
    if (method == "initialized") return begin();
    const auto handler = notifications().find(method);
    if (handler == notifications().end()) return;
    try {
        handler->second(state_, params);
        if (method == "textDocument/didClose" || method == "textDocument/didOpen")
            publisher_.forget(state_.documents.pathOfUri(documentUri(params)));
        state_.dirty = true;
    } catch (const RequestError& problem) { // there is no answer to notifications
        state_.log(2, fmt::format("'{}' is left out: {}", method, problem.message));
    } catch (const std::exception& problem) {
        state_.log(1, fmt::format("'{}' failed: {}", method, problem.what()));
    }
}

namespace {
constexpr const char* kLoading = "rapidc-loading"; ///< token of the progress
} // namespace

void Server::begin() {
    afterInitialized(state_);
    state_.dirty = true;
    if (state_.workspace.folders().empty() || !state_.can("window.workDoneProgress")) return;
    state_.request("window/workDoneProgress/create", {{"token", kLoading}}, nullptr);
    state_.notify("$/progress",
                  {{"token", kLoading}, {"value", {{"kind", "begin"}, {"title", "Reading RAPID modules"}}}});
    showsProgress_ = true;
}

void Server::endProgress() {
    if (!std::exchange(showsProgress_, false)) return;
    state_.notify("$/progress", {{"token", kLoading}, {"value", {{"kind", "end"}}}});
}

bool Server::isBehind() const {
    return phase_ == Phase::Initialized && state_.dirty &&
           (state_.settingsKnown || std::chrono::steady_clock::now() >= state_.settingsDeadline);
}

void Server::catchUp(bool whole, const std::function<bool()>& interrupted) {
    if (!isBehind()) return;
    state_.workspace.setInterrupted(interrupted);
    try {
        if (state_.workspace.bringUpToDate()) {
            endProgress();
            const bool all = publisher_.publishQuickly(state_) || whole;
            if (all && (!interrupted || !interrupted())) publisher_.publish(state_);
            if (!interrupted || !interrupted()) state_.prepareNames();
        }
    } catch (const std::exception& problem) {
        state_.dirty = false;
        state_.log(1, fmt::format("diagnostics failed: {}", problem.what()));
    }
    state_.workspace.setInterrupted(nullptr);
}

int64_t Server::clientProcess() const {
    const Json* process = optionalField(state_.initialization(), "processId");
    return process && process->is_number_integer() ? process->get<int64_t>() : 0;
}

} // namespace lsp

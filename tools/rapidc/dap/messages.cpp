#include "tools/rapidc/dap/messages.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace rapidc::dap {
namespace {

const Json& nothing() {
    static const Json json = Json::object();
    return json;
}

} // namespace

Arguments::Arguments(const Json& json, std::string prefix)
    : json_(json.is_object() ? json : nothing()), prefix_(std::move(prefix)) {}

const Json* Arguments::find(const char* name) const {
    const auto found = json_.find(name);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
}

bool Arguments::has(const char* name) const {
    return find(name) != nullptr;
}

void Arguments::require(const char* name) const {
    if (!has(name)) refuse(name, "given");
}

void Arguments::refuse(const char* name, const char* wanted) const {
    throw Refusal(find(name) == nullptr ? fmt::format("argument '{}{}' is missing", prefix_, name)
                                        : fmt::format("argument '{}{}' must be {}", prefix_, name, wanted));
}

std::string Arguments::text(const char* name) const {
    const Json* value = find(name);
    if (value == nullptr || !value->is_string()) refuse(name, "a string");
    return value->get<std::string>();
}

std::string Arguments::text(const char* name, const std::string& otherwise) const {
    return has(name) ? text(name) : otherwise;
}

bool Arguments::flag(const char* name, bool otherwise) const {
    const Json* value = find(name);
    if (value == nullptr) return otherwise;
    if (!value->is_boolean()) refuse(name, "true or false");
    return value->get<bool>();
}

int64_t Arguments::wholeNumber(const Json& json, const std::string& name) {
    constexpr double kMost = 9007199254740992.0;
    if (json.is_number_integer() && !json.is_number_unsigned()) return json.get<int64_t>();
    if (json.is_number()) {
        const auto value = json.get<double>();
        if (std::isfinite(value) && std::floor(value) == value && std::abs(value) <= kMost)
            return static_cast<int64_t>(value);
    }
    throw Refusal(fmt::format("argument '{}' must be a whole number", name));
}

int64_t Arguments::number(const char* name) const {
    const Json* value = find(name);
    if (value == nullptr) refuse(name, "a whole number");
    return wholeNumber(*value, prefix_ + name);
}

int64_t Arguments::number(const char* name, int64_t otherwise) const {
    return has(name) ? number(name) : otherwise;
}

std::vector<std::string> Arguments::texts(const char* name) const {
    std::vector<std::string> result;
    const Json* value = find(name);
    if (value == nullptr) return result;
    if (!value->is_array()) refuse(name, "a list of strings");
    for (const Json& element : *value) {
        if (!element.is_string()) refuse(name, "a list of strings");
        result.push_back(element.get<std::string>());
    }
    return result;
}

std::vector<int64_t> Arguments::numbers(const char* name) const {
    std::vector<int64_t> result;
    const Json* value = find(name);
    if (value == nullptr) return result;
    if (!value->is_array()) refuse(name, "a list of numbers");
    for (const Json& element : *value)
        result.push_back(wholeNumber(element, prefix_ + name));
    return result;
}

Arguments Arguments::object(const char* name) const {
    const Json* value = find(name);
    if (value != nullptr && !value->is_object()) refuse(name, "an object");
    return Arguments(value != nullptr ? *value : nothing(), fmt::format("{}{}.", prefix_, name));
}

std::vector<Arguments> Arguments::objects(const char* name) const {
    std::vector<Arguments> result;
    const Json* value = find(name);
    if (value == nullptr) return result;
    if (!value->is_array()) refuse(name, "a list of objects");
    for (const Json& element : *value) {
        if (!element.is_object()) refuse(name, "a list of objects");
        result.emplace_back(element, fmt::format("{}{}[].", prefix_, name));
    }
    return result;
}

void Client::send(Json message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    message["seq"] = ++seq_;
    if (!gone_ && !channel_.write(rapid::config::textOf(message))) gone_ = true;
}

void Client::answer(const Request& request, Json body) {
    Json message{
        {"type", "response"}, {"request_seq", request.seq}, {"command", request.command}, {"success", true}};
    message["body"] = body.is_null() ? Json::object() : std::move(body);
    send(std::move(message));
}

void Client::refuse(const Request& request, const std::string& message) {
    Json error{{"id", 1}, {"format", "{text}"}, {"variables", {{"text", message}}}, {"showUser", true}};
    send({{"type", "response"},
          {"request_seq", request.seq},
          {"command", request.command},
          {"success", false},
          {"message", message},
          {"body", {{"error", std::move(error)}}}});
}

void Client::event(const char* name, Json body) {
    Json message{{"type", "event"}, {"event", name}};
    message["body"] = body.is_null() ? Json::object() : std::move(body);
    send(std::move(message));
}

void Client::output(const char* category, std::string_view text) {
    output(category, text, Json::object());
}

void Client::output(const char* category, std::string_view text, Json place) {
    place["category"] = category;
    place["output"] = std::string(text) + (text.empty() || text.back() != '\n' ? "\n" : "");
    event("output", std::move(place));
}

} // namespace rapidc::dap

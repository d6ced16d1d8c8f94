#include "tools/pendant/protocol.h"

#include "config/json_text.h"

#include <cmath>
#include <fmt/format.h>

namespace rapidc::pendant {

namespace {

const Json* memberOf(const Json& params, const char* name) {
    if (!params.is_object()) return nullptr;
    const auto found = params.find(name);
    return found == params.end() || found->is_null() ? nullptr : &*found;
}

const Json& required(const Json& params, const char* name) {
    const Json* member = memberOf(params, name);
    if (member == nullptr) badRequest(fmt::format("parameter {} is missing", name));
    return *member;
}

std::string capitalized(std::string text) {
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    return text;
}

} // namespace

void refuseUnless(const std::string& refusal) {
    if (refusal.empty()) return;
    const std::size_t colon = refusal.find(": ");
    const bool hasRemedy = colon != std::string::npos && refusal.find('\n') == std::string::npos;
    if (!hasRemedy) throw RequestError{code::kRefused, capitalized(refusal)};
    throw RequestError{code::kRefused, capitalized(refusal.substr(0, colon)),
                       capitalized(refusal.substr(colon + 2))};
}

void notFound(std::string message) {
    throw RequestError{code::kNotFound, std::move(message)};
}

void badRequest(std::string message, std::string remedy) {
    throw RequestError{code::kBadRequest, std::move(message), std::move(remedy)};
}

bool has(const Json& params, const char* name) {
    return memberOf(params, name) != nullptr;
}

std::string textOf(const Json& params, const char* name) {
    const Json& member = required(params, name);
    if (!member.is_string()) badRequest(fmt::format("parameter {} must be a text", name));
    std::string text = member.get<std::string>();
    if (text.find('\0') != std::string::npos)
        badRequest(fmt::format("parameter {} must not hold a NUL", name));
    return text;
}

std::string textOr(const Json& params, const char* name, const char* otherwise) {
    return has(params, name) ? textOf(params, name) : otherwise;
}

bool flagOf(const Json& params, const char* name) {
    const Json& member = required(params, name);
    if (!member.is_boolean()) badRequest(fmt::format("parameter {} must be true or false", name));
    return member.get<bool>();
}

bool flagOr(const Json& params, const char* name, bool otherwise) {
    return has(params, name) ? flagOf(params, name) : otherwise;
}

int64_t wholeOf(const Json& params, const char* name, int64_t least, int64_t most) {
    const double value = numberOf(params, name);
    if (value != std::floor(value) || value < static_cast<double>(least) || value > static_cast<double>(most))
        badRequest(fmt::format("parameter {} must be a whole number from {} to {}", name, least, most));
    return static_cast<int64_t>(value);
}

int64_t wholeOr(const Json& params, const char* name, int64_t otherwise, int64_t least, int64_t most) {
    return has(params, name) ? wholeOf(params, name, least, most) : otherwise;
}

double numberOf(const Json& params, const char* name) {
    const Json& member = required(params, name);
    const double value = member.is_number() ? member.get<double>() : NAN;
    if (!std::isfinite(value)) badRequest(fmt::format("parameter {} must be a number", name));
    return value;
}

std::vector<std::string> textsOf(const Json& params, const char* name, std::size_t most) {
    const Json& member = required(params, name);
    if (!member.is_array()) badRequest(fmt::format("parameter {} must be a list of texts", name));
    if (member.size() > most)
        throw RequestError{code::kTooLarge, fmt::format("parameter {} has {} entries; {} are possible", name,
                                                        member.size(), most)};
    std::vector<std::string> texts;
    for (const Json& each : member) {
        if (!each.is_string()) badRequest(fmt::format("parameter {} must be a list of texts", name));
        texts.push_back(each.get<std::string>());
    }
    return texts;
}

std::vector<double> numbersOf(const Json& params, const char* name, std::size_t most) {
    const Json& member = required(params, name);
    if (!member.is_array() || member.size() > most)
        badRequest(fmt::format("parameter {} must be a list of at most {} numbers", name, most));
    std::vector<double> numbers;
    for (const Json& each : member) {
        if (!each.is_number() || !std::isfinite(each.get<double>()))
            badRequest(fmt::format("parameter {} must be a list of numbers", name));
        numbers.push_back(each.get<double>());
    }
    return numbers;
}

void noSuchWord(const char* name, const std::vector<const char*>& words) {
    std::string list;
    for (const char* word : words)
        list += (list.empty() ? "" : ", ") + std::string(word);
    badRequest(fmt::format("parameter {} must be one of {}", name, list));
}

Json rounded(double value, int decimals) {
    if (!std::isfinite(value)) return nullptr;
    const double scale = std::pow(10.0, decimals);
    const double result = std::round(value * scale) / scale;
    return result == 0 ? Json(0) : Json(result); // no "-0"
}

} // namespace rapidc::pendant

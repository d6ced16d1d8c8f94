#include "tools/lsp/protocol.h"

#include "config/json_text.h"

#include <fmt/format.h>

namespace lsp {

namespace {

[[noreturn]] void wrong(const char* name, const char* expected) {
    throw RequestError{error::kInvalidParams, fmt::format("'{}': expected {}", name, expected)};
}

uint32_t unsignedField(const Json& object, const char* name) {
    const int64_t value = integerField(object, name);
    if (value < 0) wrong(name, "a number from 0 on");
    return static_cast<uint32_t>(std::min<int64_t>(value, INT32_MAX));
}

bool isHex(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/// The code unit of an escape \uXXXX at `at`; nothing when there is none.
std::optional<unsigned> escapeAt(std::string_view text, size_t at) {
    if (at + 6 > text.size() || text[at] != '\\' || text[at + 1] != 'u') return {};
    unsigned unit = 0;
    for (size_t i = at + 2; i < at + 6; ++i) {
        if (!isHex(text[i])) return {};
        const char c = text[i];
        unit = unit * 16 + static_cast<unsigned>(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
    }
    return unit;
}

} // namespace

const Json* optionalField(const Json& object, const char* name) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(name);
    return found == object.end() || found->is_null() ? nullptr : &*found;
}

const Json& field(const Json& object, const char* name) {
    const Json* found = optionalField(object, name);
    if (!found) wrong(name, "a value");
    return *found;
}

const Json& objectField(const Json& object, const char* name) {
    const Json& found = field(object, name);
    if (!found.is_object()) wrong(name, "an object");
    return found;
}

const Json& arrayField(const Json& object, const char* name) {
    const Json& found = field(object, name);
    if (!found.is_array()) wrong(name, "an array");
    return found;
}

std::string textField(const Json& object, const char* name) {
    const Json& found = field(object, name);
    if (!found.is_string()) wrong(name, "text");
    return found.get<std::string>();
}

int64_t integerField(const Json& object, const char* name) {
    const Json& found = field(object, name);
    if (!found.is_number_integer()) wrong(name, "a whole number");
    if (found.is_number_unsigned() && found.get<uint64_t>() > INT64_MAX) return INT64_MAX;
    return found.get<int64_t>();
}

bool boolField(const Json& object, const char* name, bool otherwise) {
    const Json* found = optionalField(object, name);
    if (!found) return otherwise;
    if (!found->is_boolean()) wrong(name, "true or false");
    return found->get<bool>();
}

std::string documentUri(const Json& params) {
    return textField(objectField(params, "textDocument"), "uri");
}

Position positionOf(const Json& json) {
    if (!json.is_object()) wrong("position", "an object");
    return {unsignedField(json, "line"), unsignedField(json, "character")};
}

Range rangeOf(const Json& json) {
    if (!json.is_object()) wrong("range", "an object");
    Range range{positionOf(field(json, "start")), positionOf(field(json, "end"))};
    if (range.end < range.start) std::swap(range.start, range.end);
    return range;
}

bool hasElement(const Json* array, const Json& value) {
    if (!array || !array->is_array()) return false;
    for (const Json& element : *array)
        if (element == value) return true;
    return false;
}

const Json* at(const Json& json, std::string_view path) {
    const Json* found = &json;
    while (!path.empty()) {
        const size_t dot = std::min(path.find('.'), path.size());
        found = optionalField(*found, std::string(path.substr(0, dot)).c_str());
        if (!found) return nullptr;
        path.remove_prefix(std::min(path.size(), dot + 1));
    }
    return found;
}

bool isTrue(const Json& json, std::string_view path) {
    const Json* found = at(json, path);
    return found && found->is_boolean() && found->get<bool>();
}

Json toJson(Position position) {
    return {{"line", position.line}, {"character", position.character}};
}

Json toJson(Range range) {
    return {{"start", toJson(range.start)}, {"end", toJson(range.end)}};
}

Json response(const Json& id, Json result) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}

Json errorResponse(const Json& id, int code, const std::string& message) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}};
}

Json notification(const std::string& method, Json params) {
    return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}};
}

std::string withoutSingleSurrogates(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (size_t i = 0; i < text.size();) {
        if (text[i] != '\\') {
            out.push_back(text[i++]);
            continue;
        }
        const auto unit = escapeAt(text, i);
        if (!unit) { // an escape of two characters
            out.append(text.substr(i, 2));
            i += 2;
            continue;
        }
        const auto next = escapeAt(text, i + 6);
        const bool high = *unit >= 0xD800 && *unit < 0xDC00, low = *unit >= 0xDC00 && *unit < 0xE000;
        const bool pair = high && next && *next >= 0xDC00 && *next < 0xE000;
        if (pair)
            out.append(text.substr(i, 12));
        else
            out.append(high || low ? std::string_view("\\ufffd") : text.substr(i, 6));
        i += pair ? 12 : 6;
    }
    return out;
}

} // namespace lsp

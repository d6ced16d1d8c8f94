#include "config/json_text.h"

namespace rapid::config {

using nlohmann::json;
using nlohmann::ordered_json;

json parseJson(std::string_view text, bool comments) {
    return json::parse(text, nullptr, true, comments);
}

json tryParseJson(std::string_view text) {
    return json::parse(text, nullptr, false);
}

std::string textOf(const json& value, int indent) {
    return value.dump(indent, ' ', false, json::error_handler_t::replace);
}

std::string textOf(const ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

} // namespace rapid::config

#pragma once
// Text of JSON, read and written: the parts of the JSON library that take long to compile, compiled once. For few .cpp
// files; scripts/check_layering.py has the list. Common headers include <nlohmann/json_fwd.hpp>.

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace rapid::config {

/// Throws nlohmann::json::exception. `comments`: they are skipped.
nlohmann::json parseJson(std::string_view text, bool comments = false);
/// A discarded value when the text is not JSON.
nlohmann::json tryParseJson(std::string_view text);

/// On one line, or indented by so many blanks. Bytes that are not UTF-8 are replaced.
std::string textOf(const nlohmann::json& json, int indent = -1);
std::string textOf(const nlohmann::ordered_json& json, int indent = -1);

} // namespace rapid::config

#pragma once
// Targets of requests, queries and forms: text that comes from outside. Text that is not well formed is refused, never guessed.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rapidc::http {

using FieldList = std::vector<std::pair<std::string, std::string>>;

/// Replaces %XX; with `plus`, '+' is a blank as in forms. None for an invalid escape, and for NUL however it is written.
std::optional<std::string> decodePercent(std::string_view text, bool plus = false);
/// Everything but letters, digits and the characters of `keep` becomes %XX.
std::string encodePercent(std::string_view text, std::string_view keep = "-._~/");

/// "a=1&b=2" decoded, in order; a field without '=' has the value "". None when an escape is invalid or there are more than
/// `mostFields`.
std::optional<FieldList> parseFields(std::string_view text, std::size_t mostFields = 10'000);

/// The target of a request line in origin form ("/path?query") or absolute form ("http://host/path?query").
struct Target {
    std::string path;                  ///< decoded, begins with '/', without the '/' at its end
    std::vector<std::string> segments; ///< decoded one by one, without empty ones
    FieldList query;
};
std::optional<Target> parseTarget(std::string_view text);

/// Blanks and tabs at both ends removed.
std::string_view trimBlanks(std::string_view text);
/// The value of a header "type/subtype; parameter=value": the part before the parameters in lower case.
std::string mediaTypeOf(std::string_view header);

/// Bytes in base64; none when the text is not base64.
std::optional<std::string> decodeBase64(std::string_view text);

} // namespace rapidc::http

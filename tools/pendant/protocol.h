#pragma once
// Words of the protocol (docs/pendant.md): errors, and the readers of parameters. A parameter that is missing or wrong becomes a RequestError.

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::pendant {

using Json = nlohmann::json;

namespace code {
inline constexpr const char* kBadRequest = "bad_request";
inline constexpr const char* kUnknownMethod = "unknown_method";
inline constexpr const char* kNotFound = "not_found";
inline constexpr const char* kRefused = "refused";
inline constexpr const char* kLogin = "login";
inline constexpr const char* kBusy = "busy";
inline constexpr const char* kTooLarge = "too_large";
inline constexpr const char* kFailed = "failed";
} // namespace code

/// A request that gets an error as its answer. Thrown by methods, caught where they are called.
struct RequestError {
    const char* code;
    std::string message;
    std::string remedy = {}; ///< "" = none
};

/// Throws `refused` unless the text is empty. "the motors are off: switch them on first" becomes message and remedy.
void refuseUnless(const std::string& refusal);
[[noreturn]] void notFound(std::string message);
[[noreturn]] void badRequest(std::string message, std::string remedy = {});

/// Whether the member is there and not null.
bool has(const Json& params, const char* name);
std::string textOf(const Json& params, const char* name);
/// The value when the member is absent.
std::string textOr(const Json& params, const char* name, const char* otherwise);
bool flagOf(const Json& params, const char* name);
bool flagOr(const Json& params, const char* name, bool otherwise);
/// A whole number in these limits.
int64_t wholeOf(const Json& params, const char* name, int64_t least, int64_t most);
int64_t wholeOr(const Json& params, const char* name, int64_t otherwise, int64_t least, int64_t most);
/// A finite number.
double numberOf(const Json& params, const char* name);
std::vector<std::string> textsOf(const Json& params, const char* name, std::size_t most);
std::vector<double> numbersOf(const Json& params, const char* name, std::size_t most);

template <class Value> struct Word {
    const char* text;
    Value value;
};
[[noreturn]] void noSuchWord(const char* name, const std::vector<const char*>& words);
/// One of the words.
template <class Value, std::size_t N>
Value wordOf(const Json& params, const char* name, const Word<Value> (&words)[N]) {
    const std::string text = textOf(params, name);
    std::vector<const char*> known;
    for (const Word<Value>& word : words) {
        if (text == word.text) return word.value;
        known.push_back(word.text);
    }
    noSuchWord(name, known);
}
template <class Value, std::size_t N> const char* wordFor(Value value, const Word<Value> (&words)[N]) {
    for (const Word<Value>& word : words)
        if (word.value == value) return word.text;
    return "";
}

/// The number with so many decimals, for short messages. Null when it is not finite.
Json rounded(double value, int decimals);

} // namespace rapidc::pendant

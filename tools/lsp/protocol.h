#pragma once
// Words of the language server protocol (LSP 3.17) and of JSON-RPC that all parts of the server share, and the readers of
// parameters.

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsp {

using Json = nlohmann::json;

namespace error {
constexpr int kParse = -32700;
constexpr int kInvalidRequest = -32600;
constexpr int kMethodNotFound = -32601;
constexpr int kInvalidParams = -32602;
constexpr int kInternal = -32603;
constexpr int kNotInitialized = -32002;
constexpr int kCancelled = -32800;
constexpr int kContentModified = -32801;
constexpr int kRequestFailed = -32803;
} // namespace error

/// A request that gets an error as its answer. Thrown by handlers, caught by the dispatcher.
struct RequestError {
    int code;
    std::string message;
};

/// Line and character from 0; the character counts units of the encoding that was agreed on.
struct Position {
    uint32_t line = 0;
    uint32_t character = 0;
    auto operator<=>(const Position&) const = default;
};

struct Range {
    Position start, end;
};

/// The unit that a character of a Position counts.
enum class PositionEncoding : uint8_t { Utf16, Utf8 };

// ---- readers of parameters; what is missing or of a different type becomes a RequestError (kInvalidParams)

/// A member that has to be there.
const Json& field(const Json& object, const char* name);
/// Null when the member is absent or null.
const Json* optionalField(const Json& object, const char* name);
const Json& objectField(const Json& object, const char* name);
const Json& arrayField(const Json& object, const char* name);
std::string textField(const Json& object, const char* name);
int64_t integerField(const Json& object, const char* name);
bool boolField(const Json& object, const char* name, bool otherwise);
/// params.textDocument.uri
std::string documentUri(const Json& params);
Position positionOf(const Json& json);
Range rangeOf(const Json& json);
/// Whether an array has this text or number as an element; false for other values.
bool hasElement(const Json* array, const Json& value);
/// A member of a member ..., e.g. "textDocument.completion.completionItem"; null when something is missing.
const Json* at(const Json& json, std::string_view path);
/// Whether at() finds TRUE.
bool isTrue(const Json& json, std::string_view path);

Json toJson(Position position);
Json toJson(Range range);

// ---- messages

Json response(const Json& id, Json result);
Json errorResponse(const Json& id, int code, const std::string& message);
Json notification(const std::string& method, Json params);

/// The text of JSON that has escapes of single surrogates, which editors can produce in the middle of a character, with
/// U+FFFD in their places.
std::string withoutSingleSurrogates(std::string_view text);

} // namespace lsp

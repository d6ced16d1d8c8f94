#pragma once
// CBOR that may come from anywhere. Not for common headers: JSON is a large one.

#include "config/json_text.h"

#include <string>
#include <string_view>

namespace rt {

/// A discarded value when the bytes are not CBOR or are nested too deeply for a recursive reader.
nlohmann::json readCbor(std::string_view bytes);
std::string writeCbor(const nlohmann::json& json);
/// Bytes of files need not be UTF-8.
nlohmann::json binaryJson(std::string_view bytes);
std::string bytesOf(const nlohmann::json& binary);

} // namespace rt

#pragma once
// RAPID strings are UTF-8 and their positions count characters (manual 1.1.2, RobotWare 7). Strings may hold
// any bytes (character codes \hh), so a byte that does not belong to a valid sequence counts as one
// character.

#include "runtime/abi/rt_abi.h"

#include <string>
#include <string_view>
#include <vector>

namespace rt::lib {

/// Bytes of the character that `text` begins with; 0 for an empty text.
size_t characterSize(std::string_view text);
/// True when every byte is a character of its own (no byte above 0x7F): positions are offsets then.
bool isAscii(std::string_view text);
/// Number of characters.
size_t characterCount(std::string_view text);
/// The characters one by one, views into `text`.
std::vector<std::string_view> characters(std::string_view text);
/// UTF-8 of a code point up to 0x10FFFF.
std::string encodeUtf8(uint32_t codePoint);
/// Code point of one character as `characters` gives it; a stray byte is its own value.
uint32_t codePoint(std::string_view character);
/// At most 80 bytes, cut between characters.
std::string_view cutToString(std::string_view text);

} // namespace rt::lib

#pragma once
// RAPID strings are UTF-8 and their positions count characters (manual 1.1.2, RobotWare 7). Strings may hold
// any bytes (character codes \hh), so a byte that does not belong to a valid sequence counts as one
// character.

#include "runtime/abi/rt_abi.h"
#include "stdlib/impl/support/blocks.h"

#include <cstring>
#include <string>
#include <string_view>

namespace rt::lib {

/// The text from `offset`, which is at most the size. Cannot throw as substr can: inlined natives do not.
inline std::string_view rest(std::string_view text, size_t offset) {
    return {text.data() + offset, text.size() - offset};
}
/// Bytes of a character whose first byte is above 0x7F.
size_t longCharacterSize(std::string_view text);
/// Bytes of the character that `text` begins with; 0 for an empty text.
inline size_t characterSize(std::string_view text) {
    if (text.empty()) return 0;
    const auto lead = static_cast<uint8_t>(text[0]);
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead < 0xE0 && text.size() > 1 && (static_cast<uint8_t>(text[1]) & 0xC0) == 0x80)
        return 2; // letters of European languages
    return longCharacterSize(text);
}
/// The first character of a text that is not empty.
inline std::string_view first(std::string_view text) {
    return {text.data(), characterSize(text)};
}
/// Whether two characters are equal: without a call, for a few bytes.
inline bool same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i]) return false;
    return true;
}
/// True when every byte is a character of its own (no byte above 0x7F): positions are offsets then.
inline bool isAscii(std::string_view text) {
    constexpr uint64_t kHighBits = 0x8080808080808080u;
    const auto load = [&text](auto word, size_t offset) {
        std::memcpy(&word, text.data() + offset, sizeof word);
        return uint64_t{word};
    };
    const size_t size = text.size();
    if (size >= 8) {
        uint64_t seen = load(uint64_t{}, size - 8); // the last word overlaps the one before
#pragma clang loop vectorize(disable)               // at most nine rounds
        for (size_t i = 0; i + 8 < size; i += 8)
            seen |= load(uint64_t{}, i);
        return (seen & kHighBits) == 0;
    }
    if (size >= 4) return ((load(uint32_t{}, 0) | load(uint32_t{}, size - 4)) & kHighBits) == 0;
    if (size >= 2) return ((load(uint16_t{}, 0) | load(uint16_t{}, size - 2)) & kHighBits) == 0;
    return size == 0 || static_cast<uint8_t>(text[0]) < 0x80;
}
/// Number of characters of a text with bytes above 0x7F.
[[gnu::cold, gnu::noinline]] size_t mixedCharacterCount(std::string_view text);
/// Number of characters.
inline size_t characterCount(std::string_view text) {
    return isAscii(text) ? text.size() : mixedCharacterCount(text);
}
inline size_t characterCount(const String& text) {
    if (isAscii(text)) [[likely]]
        return text.size();
    return mixedCharacterCount(text.view()) & 0x7F; // so programs know how many bits it has
}
/// Bytes of the first `count` characters.
size_t bytesOf(std::string_view text, size_t count);
/// UTF-8 of a code point up to 0x10FFFF.
std::string encodeUtf8(uint32_t codePoint);
/// Code point of one character as `characters` gives it; a stray byte is its own value.
uint32_t codePoint(std::string_view character);
/// At most 80 bytes, cut between characters.
std::string_view cutToString(std::string_view text);

/// The characters of a string (at most 80 bytes) one by one, views into `text`.
class Characters {
  public:
    explicit Characters(std::string_view text) : text_(text.data()) {
        while (begins_[size_] < text.size()) {
            const size_t begin = begins_[size_];
            begins_[++size_] = static_cast<uint8_t>(begin + characterSize(rest(text, begin)));
        }
    }
    size_t size() const { return size_; }
    std::string_view operator[](size_t i) const {
        return {text_ + begins_[i], static_cast<size_t>(begins_[i + 1] - begins_[i])};
    }
    /// The position of the character; size() when it is not among them.
    size_t find(std::string_view character) const {
        size_t i = 0;
        while (i < size_ && !same((*this)[i], character))
            ++i;
        return i;
    }
    bool contains(std::string_view character) const { return find(character) < size_; }

  private:
    const char* text_;
    size_t size_ = 0;
    uint8_t begins_[sizeof(String::bytes) + 1] = {};
};

} // namespace rt::lib

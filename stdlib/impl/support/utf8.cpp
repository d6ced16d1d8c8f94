#include "stdlib/impl/support/utf8.h"

#include <cstring>

namespace rt::lib {

namespace {

uint8_t byteAt(std::string_view text, size_t i) {
    return static_cast<uint8_t>(text[i]);
}

} // namespace

size_t longCharacterSize(std::string_view text) {
    const uint8_t lead = byteAt(text, 0);
    const size_t size = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
    if (size == 0 || size > text.size()) return 1;
    for (size_t i = 1; i < size; ++i)
        if ((byteAt(text, i) & 0xC0) != 0x80) return 1;
    return size;
}

size_t mixedCharacterCount(std::string_view text) {
    size_t count = 0;
    for (; !text.empty(); text.remove_prefix(characterSize(text)))
        ++count;
    return count;
}

size_t bytesOf(std::string_view text, size_t count) {
    size_t size = 0;
    while (count-- > 0)
        size += characterSize(rest(text, size));
    return size;
}

std::string encodeUtf8(uint32_t codePoint) {
    const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((codePoint >> shift) & 0x3F)); };
    if (codePoint < 0x80) return {static_cast<char>(codePoint)};
    if (codePoint < 0x800) return {static_cast<char>(0xC0 | (codePoint >> 6)), tail(0)};
    if (codePoint < 0x10000) return {static_cast<char>(0xE0 | (codePoint >> 12)), tail(6), tail(0)};
    return {static_cast<char>(0xF0 | (codePoint >> 18)), tail(12), tail(6), tail(0)};
}

uint32_t codePoint(std::string_view character) {
    if (character.empty()) return 0;
    const uint32_t lead = byteAt(character, 0);
    if (character.size() == 1) return lead;
    uint32_t value = lead & (0x7Fu >> character.size());
    for (size_t i = 1; i < character.size(); ++i)
        value = value << 6 | (byteAt(character, i) & 0x3Fu);
    return value;
}

std::string_view cutToString(std::string_view text) {
    size_t size = 0;
    while (size < text.size()) {
        const size_t next = characterSize(rest(text, size));
        if (size + next > sizeof(String::bytes)) break;
        size += next;
    }
    return text.substr(0, size);
}

} // namespace rt::lib

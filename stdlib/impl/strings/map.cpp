// Manual 1.19: StrMap.

#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

using namespace rt;

namespace {

bool isAsciiByte(char byte) {
    return static_cast<uint8_t>(byte) < 0x80;
}

/// Where positions are offsets. The first place of a character in `from` counts.
void mapAscii(String& result, std::string_view text, std::string_view from, std::string_view to) {
    uint8_t table[128];
    for (size_t i = 0; i < sizeof table; ++i)
        table[i] = static_cast<uint8_t>(i);
    for (size_t i = from.size(); i-- > 0;)
        table[static_cast<uint8_t>(from[i])] = static_cast<uint8_t>(to[i]);
    for (size_t i = 0; i < text.size(); ++i)
        result.bytes[i] = static_cast<char>(table[static_cast<uint8_t>(text[i])]);
    result.length = static_cast<uint32_t>(text.size());
}

} // namespace

extern "C" {

Status rt_StrMap(TaskCore* task, String* result, const String* Str, const String* FromMap,
                 const String* ToMap) {
    const std::string_view text = Str->view();
    const std::string_view from = FromMap->view();
    const std::string_view to = ToMap->view();
    if (lib::characterCount(from) != lib::characterCount(to))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "FromMap and ToMap must have the same number of characters");
    String mapped; // the result may be one of the arguments
    if (lib::isAscii(text) && lib::isAscii(from) && lib::isAscii(to)) {
        mapAscii(mapped, text, from, to);
        *result = mapped;
        return kOk;
    }
    const lib::Characters old(from);
    const lib::Characters replacements(to);
    const lib::Characters characters(text);
    uint8_t places[128]; // of ASCII characters
    std::memset(places, static_cast<int>(old.size()), sizeof places);
    for (size_t i = old.size(); i-- > 0;)
        if (isAsciiByte(old[i][0])) places[static_cast<uint8_t>(old[i][0])] = static_cast<uint8_t>(i);
    for (size_t i = 0; i < characters.size(); ++i) {
        const char lead = characters[i][0];
        const size_t found = isAsciiByte(lead) ? places[static_cast<uint8_t>(lead)] : old.find(characters[i]);
        const std::string_view next = found < old.size() ? replacements[found] : characters[i];
        if (mapped.length + next.size() > sizeof mapped.bytes)
            return lib::fail(task, err::ERR_STRTOOLNG,
                             "the mapped text has more than 80 bytes; a string holds at most 80");
        std::memcpy(mapped.bytes + mapped.length, next.data(), next.size());
        mapped.length += static_cast<uint32_t>(next.size());
    }
    *result = mapped;
    return kOk;
}
}

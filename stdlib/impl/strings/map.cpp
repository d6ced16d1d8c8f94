// Manual 1.19: StrMap.

#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/inlined.h"
#include "stdlib/impl/support/utf8.h"

#include "natives/strings.h"
#include "stdlib_constants.h"

using namespace rt;

namespace {

bool isAsciiByte(char byte) {
    return static_cast<uint8_t>(byte) < 0x80;
}

/// Positions are offsets. The first place of a character in `from` counts. `result` may be one of the texts: the
/// table holds all that is needed of the others.
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

constexpr size_t kFew = 8;

/// As mapAscii for up to kFew characters: without a table.
void mapFew(String& result, const String& text, const String& from, const String& to) {
    char olds[kFew], replacements[kFew]; // the result may be one of the arguments
    std::memcpy(olds, from.bytes, kFew);
    std::memcpy(replacements, to.bytes, kFew);
    const size_t count = from.size();
    const size_t length = text.size();
    for (size_t block = 0; block < length; block += lib::kBlock) {
        char bytes[lib::kBlock], mapped[lib::kBlock];
        std::memcpy(bytes, text.bytes + block, sizeof bytes);
        std::memcpy(mapped, bytes, sizeof mapped);
        for (size_t k = count; k-- > 0;)
            lib::putWhere(mapped, bytes, olds[k], replacements[k]);
        std::memcpy(result.bytes + block, mapped, sizeof mapped);
    }
    result.length = static_cast<uint32_t>(length);
}

/// A text without characters above 0x7F, as most are: STR_LOWER and STR_UPPER have some, which do not occur in it. False: the
/// result would be too long, or FromMap and ToMap differ in their number of characters.
bool mapAsciiText(String& result, std::string_view text, std::string_view from, std::string_view to) {
    constexpr uint8_t kItself = 0xFF;
    uint8_t offsets[128]; // in `to`
    std::memset(offsets, kItself, sizeof offsets);
    size_t offset = 0;
    for (size_t i = 0; i < from.size();) {
        if (offset >= to.size()) return false;
        uint8_t& known = offsets[static_cast<uint8_t>(from[i]) & 0x7F];
        if (isAsciiByte(from[i]) && known == kItself) known = static_cast<uint8_t>(offset);
        i += lib::characterSize(lib::rest(from, i));
        offset += lib::characterSize(lib::rest(to, offset));
    }
    if (offset != to.size()) return false;
    String mapped; // the result may be one of the arguments
    for (const char character : text) {
        const size_t place = offsets[static_cast<uint8_t>(character)];
        const std::string_view next =
            place == kItself ? std::string_view(&character, 1) : lib::first(lib::rest(to, place));
        if (mapped.length + next.size() > sizeof mapped.bytes) return false;
        for (const char byte : next)
            mapped.bytes[mapped.length++] = byte;
    }
    result = mapped;
    return true;
}

/// Any texts.
[[gnu::cold, gnu::noinline]] Status mapMixed(TaskCore* task, String& result, std::string_view text,
                                             std::string_view from, std::string_view to) {
    if (lib::characterCount(from) != lib::characterCount(to))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "FromMap and ToMap must have the same number of characters");
    String mapped; // the result may be one of the arguments
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
    result = mapped;
    return kOk;
}

constexpr int kNoShift = 0x100;

/// The number that is added to the code of each character up to 0x7F that `from` has, as STR_LOWER and STR_UPPER differ; kNoShift: the
/// characters differ in other ways, or in number. Compiled code knows it when both are constants (codegen/constant_calls.h).
[[gnu::noinline]] int shiftOf(const String& from, const String& to) {
    int shift = kNoShift;
    size_t offset = 0;
    size_t place = 0;
    while (offset < from.size() && place < to.size()) {
        if (isAsciiByte(from.bytes[offset])) {
            const int difference = to.bytes[place] - from.bytes[offset];
            if (!isAsciiByte(to.bytes[place]) || (shift != kNoShift && shift != difference)) return kNoShift;
            shift = difference;
        }
        offset += lib::characterSize(lib::rest(from.view(), offset));
        place += lib::characterSize(lib::rest(to.view(), place));
    }
    return offset == from.size() && place == to.size() ? shift : kNoShift;
}

void mapShifted(String& result, const String& text, const lib::AsciiRows& from, int shift) {
    const size_t length = text.size();
    for (size_t block = 0; block < length; block += lib::kBlock)
        from.shift(text.bytes + block, static_cast<char>(shift), result.bytes + block);
    result.length = static_cast<uint32_t>(length);
}

/// Characters that differ by more than a shift.
[[gnu::noinline]] Status mapEach(TaskCore* task, String& result, const String& text, const String& fromMap,
                                 const String& toMap) {
    const std::string_view from = fromMap.view();
    const std::string_view to = toMap.view();
    if (!lib::isAscii(text)) return mapMixed(task, result, text.view(), from, to);
    if (!lib::isAscii(fromMap) || !lib::isAscii(toMap) || from.size() != to.size())
        return mapAsciiText(result, text.view(), from, to) ? kOk
                                                           : mapMixed(task, result, text.view(), from, to);
    if (from.size() <= kFew)
        mapFew(result, text, fromMap, toMap);
    else
        mapAscii(result, text.view(), from, to);
    return kOk;
}

} // namespace

extern "C" {

RAPIDC_INLINED Status rt_StrMap(TaskCore* task, String* result, const String* Str, const String* FromMap,
                                const String* ToMap) {
    const int shift = shiftOf(*FromMap, *ToMap);
    if (shift == kNoShift || !lib::isAscii(*Str)) return mapEach(task, *result, *Str, *FromMap, *ToMap);
    mapShifted(*result, *Str, lib::asciiRowsOf(*FromMap), shift);
    return kOk;
}
}

// Manual 1.19: looking at and into strings. Positions count characters from 1.

#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace rt;

namespace {

/// A whole number from `low` to `high`.
bool readPosition(float value, size_t low, size_t high, size_t& out) {
    if (!(value >= static_cast<float>(low) && value <= static_cast<float>(high))) return false;
    const auto whole = static_cast<int32_t>(value); // a string is short
    out = static_cast<size_t>(whole);
    return static_cast<float>(whole) == value;
}

Status badPosition(TaskCore* task, float position, size_t length) {
    return lib::failWith(task, err::ERR_ARGVALERR,
                         "position {} is outside the string, which has {} characters", position,
                         static_cast<double>(length));
}

/// A number that grows with the rank of a character under an ordering: its first place in it; characters not listed come
/// after, by code point.
size_t rankOf(std::string_view character, std::string_view order) {
    if (static_cast<uint8_t>(character[0]) < 0x80) { // such a byte is never part of another character
        const size_t place = order.find(character[0]);
        return place < order.size() ? place : order.size() + lib::codePoint(character);
    }
    for (size_t place = 0; place < order.size(); place += lib::first(lib::rest(order, place)).size())
        if (lib::same(lib::first(lib::rest(order, place)), character)) return place;
    return order.size() + lib::codePoint(character);
}

/// Not found: the length plus 1.
float offsetToPosition(size_t offset, size_t length) {
    return static_cast<float>(offset < length ? offset + 1 : length + 1);
}

/// StrMemb with characters above 0x7F before the position or in the set, or with a position that is wrong.
[[gnu::cold, gnu::noinline]] Status memberOfMixed(TaskCore* task, bool* result, const String& string,
                                                  float at, const String& set) {
    const lib::Characters text(string.view());
    size_t position = 0;
    if (!readPosition(at, 1, text.size(), position)) return badPosition(task, at, text.size());
    *result = lib::Characters(set.view()).contains(text[position - 1]);
    return kOk;
}

/// StrFind with characters above 0x7F, or with a position that is wrong.
[[gnu::cold, gnu::noinline]] Status findInMixed(TaskCore* task, float* result, const String& string,
                                                float from, const String& ofSet, bool notInSet) {
    const lib::Characters text(string.view());
    const lib::Characters set(ofSet.view());
    size_t position = 0;
    // Nothing can be found in an empty string, but looking there is not a mistake.
    if (!readPosition(from, 1, std::max<size_t>(text.size(), 1), position))
        return badPosition(task, from, text.size());
    while (position <= text.size() && set.contains(text[position - 1]) == notInSet)
        ++position;
    *result = static_cast<float>(std::min(position, text.size() + 1));
    return kOk;
}

/// StrMatch in a text with characters above 0x7F.
[[gnu::cold, gnu::noinline]] Status matchInMixed(TaskCore* task, float* result, const String& string,
                                                 float from, const String& pattern) {
    const std::string_view bytes = string.view();
    const lib::Characters text(bytes);
    size_t position = 0;
    if (!readPosition(from, 1, std::max<size_t>(text.size(), 1), position))
        return badPosition(task, from, text.size());
    for (; position <= text.size(); ++position) {
        const size_t offset = static_cast<size_t>(text[position - 1].data() - bytes.data());
        if (lib::rest(bytes, offset).starts_with(pattern.view())) break;
    }
    *result = static_cast<float>(std::min(position, text.size() + 1));
    return kOk;
}

/// Where `pattern` begins in `text` from `offset` on; the size of `text`: nowhere.
size_t findText(std::string_view text, size_t offset, std::string_view pattern) {
    if (pattern.empty()) return offset;
    while (offset + pattern.size() <= text.size()) {
        const void* found =
            std::memchr(text.data() + offset, pattern[0], text.size() - pattern.size() + 1 - offset);
        if (!found) break;
        offset = static_cast<size_t>(static_cast<const char*>(found) - text.data());
        if (std::memcmp(text.data() + offset, pattern.data(), pattern.size()) == 0) return offset;
        ++offset;
    }
    return text.size();
}

} // namespace

extern "C" {

[[gnu::always_inline]] Status rt_StrLen(TaskCore*, float* result, const String* Str) {
    const size_t count = lib::characterCount(Str->view());
    __builtin_assume(count <= sizeof Str->bytes); // loops up to the length count with integers
    *result = static_cast<float>(count);
    return kOk;
}

Status rt_StrSize(TaskCore*, float* result, const String* Str) {
    *result = static_cast<float>(Str->length);
    return kOk;
}

[[gnu::always_inline]] Status rt_StrPart(TaskCore* task, String* result, const String* Str, float ChPos,
                                         float Len) {
    const std::string_view bytes = Str->view();
    const size_t length = lib::characterCount(bytes);
    size_t first = 0;
    size_t count = 0;
    if (!readPosition(ChPos, 1, length, first)) return badPosition(task, ChPos, length);
    if (!readPosition(Len, 0, length - first + 1, count))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the part is negative or reaches beyond the end of the string");
    size_t begin = first - 1;
    if (length != bytes.size()) {
        begin = lib::bytesOf(bytes, begin);
        count = lib::bytesOf(lib::rest(bytes, begin), count);
    }
    std::memmove(result->bytes, bytes.data() + begin, count); // the result may be the string itself
    result->length = static_cast<uint32_t>(count);
    return kOk;
}

[[gnu::always_inline]] Status rt_StrMemb(TaskCore* task, bool* result, const String* Str, float ChPos,
                                         const String* Set) {
    size_t position = 0;
    const lib::AsciiSet set(Set->view());
    // What follows the position does not matter.
    if (!readPosition(ChPos, 1, Str->length, position) || !set.isComplete() ||
        !lib::isAscii({Str->bytes, position}))
        return memberOfMixed(task, result, *Str, ChPos, *Set);
    *result = set.contains(Str->bytes[position - 1]);
    return kOk;
}

[[gnu::always_inline]] Status rt_StrFind(TaskCore* task, float* result, const String* Str, float ChPos,
                                         const String* Set, bool NotInSet) {
    const std::string_view bytes = Str->view();
    const lib::AsciiSet set(Set->view());
    size_t position = 0;
    if (!readPosition(ChPos, 1, std::max<size_t>(bytes.size(), 1), position) || !set.isComplete() ||
        !lib::isAscii(bytes))
        return findInMixed(task, result, *Str, ChPos, *Set, NotInSet);
    size_t offset = position - 1;
    while (offset < bytes.size() && set.contains(bytes[offset]) == NotInSet)
        ++offset;
    *result = offsetToPosition(offset, bytes.size());
    return kOk;
}

Status rt_StrMatch(TaskCore* task, float* result, const String* Str, float ChPos, const String* Pattern) {
    const std::string_view bytes = Str->view();
    size_t position = 0;
    if (!lib::isAscii(bytes)) return matchInMixed(task, result, *Str, ChPos, *Pattern);
    if (!readPosition(ChPos, 1, std::max<size_t>(bytes.size(), 1), position))
        return badPosition(task, ChPos, bytes.size());
    *result = offsetToPosition(findText(bytes, position - 1, Pattern->view()), bytes.size());
    return kOk;
}

Status rt_StrOrder(TaskCore*, bool* result, const String* Str1, const String* Str2, const String* Order) {
    // Different characters have different ranks: the first difference decides.
    std::string_view a = Str1->view();
    std::string_view b = Str2->view();
    while (!a.empty() && !b.empty() && lib::same(lib::first(a), lib::first(b))) {
        const size_t size = lib::characterSize(a);
        a.remove_prefix(size);
        b.remove_prefix(size);
    }
    if (a.empty() || b.empty())
        *result = a.empty();
    else
        *result = rankOf(lib::first(a), Order->view()) < rankOf(lib::first(b), Order->view());
    return kOk;
}
}

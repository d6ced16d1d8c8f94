// Manual 1.19: looking at and into strings. Positions count characters from 1.

#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace rt;

namespace {

using Characters = std::vector<std::string_view>;

bool contains(const Characters& set, std::string_view character) {
    return std::find(set.begin(), set.end(), character) != set.end();
}

/// A whole number from `low` to `high`.
bool readPosition(float value, size_t low, size_t high, size_t& out) {
    if (!(value >= static_cast<float>(low) && value <= static_cast<float>(high)) ||
        std::trunc(value) != value)
        return false;
    out = static_cast<size_t>(value);
    return true;
}

Status badPosition(TaskCore* task, float position, size_t length) {
    return lib::fail(
        task, err::ERR_ARGVALERR,
        fmt::format("position {} is outside the string, which has {} characters", position, length));
}

/// Rank of a character under an ordering: its first place in it; characters not listed come after, by code point.
size_t rankOf(std::string_view character, const Characters& order) {
    const auto found = std::find(order.begin(), order.end(), character);
    return found != order.end() ? static_cast<size_t>(found - order.begin())
                                : order.size() + lib::codePoint(character);
}

/// Not found: the length plus 1.
float offsetToPosition(size_t offset, size_t length) {
    return static_cast<float>(offset < length ? offset + 1 : length + 1);
}

/// StrFind where positions are offsets.
Status findAscii(TaskCore* task, float* result, const String& text, float from, const String& set,
                 bool notInSet) {
    const std::string_view bytes = text.view();
    size_t position = 0;
    if (!readPosition(from, 1, std::max<size_t>(bytes.size(), 1), position))
        return badPosition(task, from, bytes.size());
    bool listed[128] = {};
    for (const char character : set.view())
        listed[static_cast<uint8_t>(character)] = true;
    size_t offset = position - 1;
    while (offset < bytes.size() && listed[static_cast<uint8_t>(bytes[offset])] == notInSet)
        ++offset;
    *result = offsetToPosition(offset, bytes.size());
    return kOk;
}

} // namespace

extern "C" {

Status rt_StrLen(TaskCore*, float* result, const String* Str) {
    *result = static_cast<float>(lib::characterCount(Str->view()));
    return kOk;
}

Status rt_StrSize(TaskCore*, float* result, const String* Str) {
    *result = static_cast<float>(Str->length);
    return kOk;
}

Status rt_StrPart(TaskCore* task, String* result, const String* Str, float ChPos, float Len) {
    const std::string_view bytes = Str->view();
    const size_t length = lib::characterCount(bytes);
    size_t first = 0;
    size_t count = 0;
    if (!readPosition(ChPos, 1, length, first)) return badPosition(task, ChPos, length);
    if (!readPosition(Len, 0, length - first + 1, count))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the part is negative or reaches beyond the end of the string");
    if (length == bytes.size()) {
        result->assign(bytes.substr(first - 1, count));
        return kOk;
    }
    const Characters text = lib::characters(bytes);
    std::string part;
    for (size_t i = 0; i < count; ++i)
        part += text[first - 1 + i];
    result->assign(part);
    return kOk;
}

Status rt_StrMemb(TaskCore* task, bool* result, const String* Str, float ChPos, const String* Set) {
    const Characters text = lib::characters(Str->view());
    size_t position = 0;
    if (!readPosition(ChPos, 1, text.size(), position)) return badPosition(task, ChPos, text.size());
    *result = contains(lib::characters(Set->view()), text[position - 1]);
    return kOk;
}

Status rt_StrFind(TaskCore* task, float* result, const String* Str, float ChPos, const String* Set,
                  bool NotInSet) {
    if (lib::isAscii(Str->view()) && lib::isAscii(Set->view()))
        return findAscii(task, result, *Str, ChPos, *Set, NotInSet);
    const Characters text = lib::characters(Str->view());
    const Characters set = lib::characters(Set->view());
    size_t position = 0;
    // Nothing can be found in an empty string, but looking there is no mistake.
    if (!readPosition(ChPos, 1, std::max<size_t>(text.size(), 1), position))
        return badPosition(task, ChPos, text.size());
    while (position <= text.size() && contains(set, text[position - 1]) == NotInSet)
        ++position;
    *result = static_cast<float>(std::min(position, text.size() + 1));
    return kOk;
}

Status rt_StrMatch(TaskCore* task, float* result, const String* Str, float ChPos, const String* Pattern) {
    const std::string_view bytes = Str->view();
    size_t position = 0;
    if (lib::isAscii(bytes)) {
        if (!readPosition(ChPos, 1, std::max<size_t>(bytes.size(), 1), position))
            return badPosition(task, ChPos, bytes.size());
        *result = offsetToPosition(bytes.find(Pattern->view(), position - 1), bytes.size());
        return kOk;
    }
    const Characters text = lib::characters(bytes);
    if (!readPosition(ChPos, 1, std::max<size_t>(text.size(), 1), position))
        return badPosition(task, ChPos, text.size());
    for (; position <= text.size(); ++position) {
        const size_t offset = static_cast<size_t>(text[position - 1].data() - bytes.data());
        if (bytes.substr(offset).starts_with(Pattern->view())) break;
    }
    *result = static_cast<float>(std::min(position, text.size() + 1));
    return kOk;
}

Status rt_StrOrder(TaskCore*, bool* result, const String* Str1, const String* Str2, const String* Order) {
    const Characters a = lib::characters(Str1->view());
    const Characters b = lib::characters(Str2->view());
    const Characters order = lib::characters(Order->view());
    *result = !std::lexicographical_compare(
        b.begin(), b.end(), a.begin(), a.end(),
        [&](std::string_view x, std::string_view y) { return rankOf(x, order) < rankOf(y, order); });
    return kOk;
}
}

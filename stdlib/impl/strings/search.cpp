// Manual 1.19: looking at and into strings. Positions count characters from 1.

#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/inlined.h"
#include "stdlib/impl/support/utf8.h"

#include "natives/strings.h"
#include "stdlib_constants.h"

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
    for (size_t place = 0; place < order.size(); place += lib::first(lib::rest(order, place)).size())
        if (lib::same(lib::first(lib::rest(order, place)), character)) return place;
    return order.size() + lib::codePoint(character);
}

/// Stores a position, which may be one more than a string has characters. Programs count with integers when they know how
/// many bits it has.
Status givePosition(float* result, size_t position) {
    static_assert(kStringCapacity + 1 <= 0x7F);
    *result = static_cast<float>(static_cast<int32_t>(position & 0x7F));
    return kOk;
}

// The functions that follow copy the texts that they keep pointers into: so LLVM sees that a caller's string is only read.

/// StrMemb with characters above 0x7F before the position or in the set, or with a position that is wrong.
[[gnu::cold, gnu::noinline]] Status memberOfMixed(TaskCore* task, bool& result, const String& string,
                                                  float at, const String& set) {
    const String copy = string;
    const String copyOfSet = set;
    const lib::Characters text(copy.view());
    size_t position = 0;
    if (!readPosition(at, 1, text.size(), position)) return badPosition(task, at, text.size());
    result = lib::Characters(copyOfSet.view()).contains(text[position - 1]);
    return kOk;
}

// A search may begin one after the last character, where it finds nothing: it is the place that a search in vain gives, and
// programs that take a text apart begin the next search there.

/// StrFind with characters above 0x7F, or with a position that is wrong.
[[gnu::cold, gnu::noinline]] Status findInMixed(TaskCore* task, size_t& position, const String& string,
                                                float from, const String& ofSet, bool notInSet) {
    const String copy = string;
    const String copyOfSet = ofSet;
    const lib::Characters text(copy.view());
    const lib::Characters set(copyOfSet.view());
    if (!readPosition(from, 1, text.size() + 1, position)) return badPosition(task, from, text.size());
    while (position <= text.size() && set.contains(text[position - 1]) == notInSet)
        ++position;
    return kOk;
}

/// StrMatch in a text with characters above 0x7F.
[[gnu::cold, gnu::noinline]] Status matchInMixed(TaskCore* task, size_t& position, const String& string,
                                                 float from, const String& pattern) {
    const String copy = string;
    const String copyOfPattern = pattern;
    const std::string_view bytes = copy.view();
    const lib::Characters text(bytes);
    if (!readPosition(from, 1, text.size() + 1, position)) return badPosition(task, from, text.size());
    for (; position <= text.size(); ++position) {
        const size_t offset = static_cast<size_t>(text[position - 1].data() - bytes.data());
        if (lib::rest(bytes, offset).starts_with(copyOfPattern.view())) break;
    }
    return kOk;
}

/// The first character from `offset` on that is in the set, or is not; the length of the text: none. All of the text is compared
/// with the set first, without a branch: programs that look into a string again and again do this once.
size_t findCharacter(const String& text, size_t offset, const lib::AsciiRows& set, bool notInSet) {
    constexpr size_t kFront = 64;
    const auto membersAt = [&](size_t block) { return uint64_t{set.membersOf(text.bytes + block)}; };
    uint64_t front = membersAt(0) | membersAt(16) << 16 | membersAt(32) << 32 | membersAt(48) << 48;
    uint64_t back = membersAt(kFront);
    if (notInSet) {
        front = ~front;
        back ^= lib::kWholeBlock;
    }
    const size_t length = text.size();
    if (offset < kFront) {
        front >>= offset;
        if (front != 0) return std::min(offset + lib::firstOf(front), length);
        offset = kFront;
    }
    back >>= offset - kFront;
    return back != 0 ? std::min(offset + lib::firstOf(back), length) : length;
}

/// Whether the text has `pattern` at `offset`; it is long enough.
bool hasAt(const String& text, size_t offset, const String& pattern) {
    const size_t size = pattern.size();
    const char* bytes = text.bytes + offset;
    if (size > lib::kBlock || offset + lib::kBlock > sizeof text.bytes)
        return std::memcmp(bytes, pattern.bytes, size) == 0;
    const uint32_t wanted = (1U << size) - 1;
    return (lib::equalBytes(bytes, pattern.bytes) & wanted) == wanted;
}

/// Offset at which `pattern` begins in `text`, from `offset` on; the length of `text`: nowhere.
size_t findText(const String& text, size_t offset, const String& pattern) {
    const size_t length = text.size();
    const size_t size = pattern.size();
    if (size == 0) return offset;
    if (size > length) return length;
    const size_t last = length - size;
    size_t block = offset / lib::kBlock * lib::kBlock;
    uint32_t wanted = lib::kWholeBlock << (offset - block);
    for (; block <= last; block += lib::kBlock) {
        uint32_t begins = lib::bytesEqualTo(text.bytes + block, pattern.bytes[0]) & wanted;
        // The byte that follows the last one is in the next block.
        if (size > 1) begins &= lib::bytesEqualTo(text.bytes + block, pattern.bytes[1]) >> 1 | 0x8000;
        for (; begins != 0; begins &= begins - 1) {
            const size_t begin = block + lib::firstOf(begins);
            if (begin > last) return length;
            if (hasAt(text, begin, pattern)) return begin;
        }
        wanted = lib::kWholeBlock;
    }
    return length;
}

/// Offset at which two texts begin to differ; the length of the shorter one: not before.
size_t firstDifference(const String& a, const String& b) {
    const size_t length = std::min(a.size(), b.size());
    for (size_t block = 0; block < length; block += lib::kBlock) {
        const uint32_t different = ~lib::equalBytes(a.bytes + block, b.bytes + block) & lib::kWholeBlock;
        if (different != 0) return std::min(block + lib::firstOf(different), length);
    }
    return length;
}

/// rankOf for a character up to 0x7F: such a byte is never part of another character.
size_t rankOfAscii(char character, const String& order) {
    const size_t length = order.size();
    for (size_t block = 0; block < length; block += lib::kBlock) {
        const uint32_t found = lib::bytesEqualTo(order.bytes + block, character);
        if (found == 0) continue;
        const size_t place = block + lib::firstOf(found);
        if (place < length) return place;
        break;
    }
    return length + static_cast<uint8_t>(character);
}

/// StrOrder where the texts differ in characters above 0x7F. Different characters have different ranks: the first difference
/// decides.
[[gnu::cold, gnu::noinline]] bool areMixedInOrder(const String& text1, const String& text2,
                                                  const String& ordering) {
    const String copies[] = {text1, text2, ordering};
    std::string_view a = copies[0].view();
    std::string_view b = copies[1].view();
    const std::string_view order = copies[2].view();
    while (!a.empty() && !b.empty() && lib::same(lib::first(a), lib::first(b))) {
        const size_t size = lib::characterSize(a);
        a.remove_prefix(size);
        b.remove_prefix(size);
    }
    if (a.empty() || b.empty()) return a.empty();
    return rankOf(lib::first(a), order) < rankOf(lib::first(b), order);
}

} // namespace

extern "C" {

RAPIDC_INLINED Status rt_StrLen(TaskCore*, float* result, const String* Str) {
    const size_t count = lib::characterCount(*Str);
    if (count > kStringCapacity) __builtin_unreachable(); // loops up to the length count with integers
    *result = static_cast<float>(count);
    return kOk;
}

Status rt_StrSize(TaskCore*, float* result, const String* Str) {
    *result = static_cast<float>(Str->length);
    return kOk;
}

RAPIDC_INLINED Status rt_StrPart(TaskCore* task, String* result, const String* Str, float ChPos, float Len) {
    const std::string_view bytes = Str->view();
    const size_t length = lib::characterCount(*Str);
    size_t first = 0;
    size_t count = 0;
    if (!readPosition(ChPos, 1, length, first)) return badPosition(task, ChPos, length);
    if (!readPosition(Len, 0, length - first + 1, count))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the part is negative or reaches beyond the end of the string");
    size_t begin = first - 1;
    if (length != bytes.size()) [[unlikely]] {
        begin = lib::bytesOf(bytes, begin);
        count = lib::bytesOf(lib::rest(bytes, begin), count);
    }
    // The result may be the string itself.
    lib::copyText(result->bytes, sizeof result->bytes, bytes.data() + begin, sizeof Str->bytes - begin,
                  count);
    result->length = static_cast<uint32_t>(count);
    return kOk;
}

RAPIDC_INLINED Status rt_StrMemb(TaskCore* task, bool* result, const String* Str, float ChPos,
                                 const String* Set) {
    size_t position = 0;
    if (!readPosition(ChPos, 1, Str->size(), position) || !lib::isAscii(*Str)) [[unlikely]] {
        bool isMember = false;
        const Status status = memberOfMixed(task, isMember, *Str, ChPos, *Set);
        *result = isMember;
        return status;
    }
    *result = lib::asciiSetOf(*Set).contains(Str->bytes[position - 1]);
    return kOk;
}

RAPIDC_INLINED Status rt_StrFind(TaskCore* task, float* result, const String* Str, float ChPos,
                                 const String* Set, bool NotInSet) {
    const size_t length = Str->size();
    size_t position = 0;
    if (!readPosition(ChPos, 1, length + 1, position) || !lib::isAscii(*Str)) [[unlikely]] {
        size_t found = 0;
        if (const Status status = findInMixed(task, found, *Str, ChPos, *Set, NotInSet)) return status;
        return givePosition(result, found);
    }
    const lib::AsciiRows set = lib::asciiRowsOf(*Set);
    return givePosition(result, findCharacter(*Str, position - 1, set, NotInSet) + 1);
}

Status rt_StrMatch(TaskCore* task, float* result, const String* Str, float ChPos, const String* Pattern) {
    const size_t length = Str->size();
    size_t position = 0;
    if (!lib::isAscii(*Str)) [[unlikely]] {
        size_t found = 0;
        if (const Status status = matchInMixed(task, found, *Str, ChPos, *Pattern)) return status;
        return givePosition(result, found);
    }
    if (!readPosition(ChPos, 1, length + 1, position)) return badPosition(task, ChPos, length);
    return givePosition(result, findText(*Str, position - 1, *Pattern) + 1);
}

Status rt_StrOrder(TaskCore*, bool* result, const String* Str1, const String* Str2, const String* Order) {
    const size_t place = firstDifference(*Str1, *Str2);
    const bool ends1 = place == Str1->size();
    const bool ends2 = place == Str2->size();
    const char first1 = ends1 ? '\0' : Str1->bytes[place];
    const char first2 = ends2 ? '\0' : Str2->bytes[place];
    // A character up to 0x7F begins where its byte is: the characters before it are the same in both texts.
    if (static_cast<uint8_t>(first1 | first2) >= 0x80) [[unlikely]]
        *result = areMixedInOrder(*Str1, *Str2, *Order);
    else if (ends1 || ends2)
        *result = ends1;
    else
        *result = rankOfAscii(first1, *Order) < rankOfAscii(first2, *Order);
    return kOk;
}
}

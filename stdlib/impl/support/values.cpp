// Strings and values of any type for compiled code.

#include "runtime/abi/support_natives.h"
#include "runtime/abi/whole_division.h"
#include "stdlib/impl/support/blocks.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/inlined.h"

#include "stdlib_constants.h"

#include <cmath>
#include <cstring>

using namespace rt;

namespace {

template <class T> bool sameNumber(const char* a, const char* b) {
    T x;
    T y;
    std::memcpy(&x, a, sizeof x);
    std::memcpy(&y, b, sizeof y);
    return x == y; // -0 equals 0, and a value that is not a number equals nothing, as in compiled comparisons
}

bool sameString(const String& a, const String& b) {
    return a.view() == b.view();
}

bool sameValue(const char* a, const char* b, const TypeDesc& type) {
    switch (type.kind) {
    case DescKind::Num: return sameNumber<float>(a, b);
    case DescKind::Dnum: return sameNumber<double>(a, b);
    case DescKind::String:
        return sameString(*reinterpret_cast<const String*>(a), *reinterpret_cast<const String*>(b));
    case DescKind::Record:
        for (uint32_t i = 0; i < type.count; ++i)
            if (!sameValue(a + type.offsets[i], b + type.offsets[i], *type.fields[i])) return false;
        return true;
    case DescKind::Array: {
        const TypeDesc& element = *type.fields[0];
        for (size_t i = 0; i < type.count; ++i)
            if (!sameValue(a + i * element.size, b + i * element.size, element)) return false;
        return true;
    }
    default: return std::memcmp(a, b, type.size) == 0;
    }
}

} // namespace

extern "C" {

/// The result may be one of the operands; nothing is written when it does not fit.
RAPIDC_INLINED Status rt_strConcat(TaskCore* task, String* result, const String* a, const String* b) {
    const size_t front = a->length;
    const size_t size = front + b->length;
    if (size > sizeof result->bytes)
        return lib::failWith(task, err::ERR_STRTOOLNG,
                             "the joined string has {} bytes; a string holds at most 80",
                             static_cast<double>(size));
    if (size - front <= lib::kBlock && front + lib::kBlock <= sizeof result->bytes) {
        char block[lib::kBlock]; // a short text without a call, with what follows it
        std::memcpy(block, b->bytes, sizeof block);
        if (result != a) lib::copyText(result->bytes, sizeof result->bytes, a->bytes, sizeof a->bytes, front);
        std::memcpy(result->bytes + front, block, sizeof block);
    } else {
        std::memmove(result->bytes + front, b->bytes, size - front);
        if (result != a) std::memcpy(result->bytes, a->bytes, front);
    }
    result->length = static_cast<uint32_t>(size);
    return kOk;
}

bool rt_strEqual(const String* a, const String* b) {
    return sameString(*a, *b);
}

bool rt_anyEqual(const void* a, const void* b, const TypeDesc* type) {
    return sameValue(static_cast<const char*>(a), static_cast<const char*>(b), *type);
}

double rt_wholeQuotient(double a, double b) {
    return rt::wholeQuotient(a, b);
}

double rt_wholeRemainder(double a, double b) {
    return rt::wholeRemainder(a, b);
}
}

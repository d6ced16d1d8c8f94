// stringdig: whole numbers from 0 to 4294967295 held as digits.

#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"
#include "stdlib_natives.h"

#include <charconv>

using namespace rt;

namespace {

constexpr uint64_t kLargest = 4294967295u;

bool readDigits(const String& text, uint64_t& value) {
    const char* end = text.bytes + text.length;
    const auto [stop, error] = std::from_chars(text.bytes, end, value);
    return text.length > 0 && error == std::errc() && stop == end && value <= kLargest;
}

Status readBoth(TaskCore* task, const String& a, const String& b, uint64_t& x, uint64_t& y) {
    if (readDigits(a, x) && readDigits(b, y)) return kOk;
    return lib::fail(task, err::ERR_INT_NOTVAL,
                     "a digit string must be digits of a number from 0 to 4294967295");
}

} // namespace

extern "C" {

Status rt_StrDigCmp(TaskCore* task, bool* result, const String* StrDig1, float Relation,
                    const String* StrDig2) {
    uint64_t x = 0;
    uint64_t y = 0;
    if (const Status status = readBoth(task, *StrDig1, *StrDig2, x, y)) return status;
    if (Relation == k::LT)
        *result = x < y;
    else if (Relation == k::LTEQ)
        *result = x <= y;
    else if (Relation == k::EQ)
        *result = x == y;
    else if (Relation == k::NOTEQ)
        *result = x != y;
    else if (Relation == k::GTEQ)
        *result = x >= y;
    else if (Relation == k::GT)
        *result = x > y;
    else
        return lib::fail(task, err::ERR_ARGVALERR, "the relation must be LT, LTEQ, EQ, NOTEQ, GTEQ or GT");
    return kOk;
}

Status rt_StrDigCalc(TaskCore* task, String* result, const String* StrDig1, float Operation,
                     const String* StrDig2) {
    uint64_t x = 0;
    uint64_t y = 0;
    if (const Status status = readBoth(task, *StrDig1, *StrDig2, x, y)) return status;
    uint64_t value = 0;
    if (Operation == k::OpAdd)
        value = x + y;
    else if (Operation == k::OpSub) {
        if (y > x) return lib::fail(task, err::ERR_CALC_NEG, "the difference would be negative");
        value = x - y;
    } else if (Operation == k::OpMult)
        value = x * y;
    else if (Operation == k::OpDiv || Operation == k::OpMod) {
        if (y == 0) return lib::fail(task, err::ERR_CALC_DIVZERO, "division by zero");
        value = Operation == k::OpDiv ? x / y : x % y;
    } else
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the operation must be OpAdd, OpSub, OpMult, OpDiv or OpMod");
    if (value > kLargest)
        return lib::fail(task, err::ERR_CALC_OVERFLOW, "the result is larger than 4294967295");
    result->assign(std::to_string(value));
    return kOk;
}
}

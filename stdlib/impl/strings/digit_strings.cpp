// stringdig: whole numbers from 0 to 4294967295 held as digits.

#include "stdlib/impl/strings/digits.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/relation.h"

#include "natives/strings.h"
#include "stdlib_constants.h"

#include <charconv>

using namespace rt;

namespace {

Status readBoth(TaskCore* task, const String& a, const String& b, uint64_t& x, uint64_t& y) {
    const auto read = [](const String& text, uint64_t& value) {
        return lib::readDigits(text.view(), 10, lib::kLargestDigitString, value);
    };
    if (read(a, x) && read(b, y)) return kOk;
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
    const std::optional<bool> meets = lib::related(x, Relation, y);
    if (!meets) return lib::fail(task, err::ERR_ARGVALERR, lib::kRelationNames);
    *result = *meets;
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
    if (value > lib::kLargestDigitString)
        return lib::fail(task, err::ERR_CALC_OVERFLOW, "the result is larger than 4294967295");
    result->assign(std::to_string(value));
    return kOk;
}
}

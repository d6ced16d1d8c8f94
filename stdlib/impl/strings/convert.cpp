// Manual 1.19 and 1.6: conversions between strings and values.

#include "runtime/value/value_text.h"
#include "stdlib/impl/strings/digits.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"

#include "natives/strings.h"
#include "natives/various.h"
#include "stdlib_constants.h"

#include <charconv>
#include <cmath>

using namespace rt;

namespace {

Status store(TaskCore* task, String* result, std::string_view text) {
    if (text.size() > sizeof result->bytes)
        return lib::fail(task, err::ERR_STRTOOLNG,
                         "the text has " + std::to_string(text.size()) + " bytes; a string holds at most 80");
    result->assign(text);
    return kOk;
}

Status decimalsText(TaskCore* task, String* result, double value, float dec, bool exponent) {
    if (!(dec >= 0 && dec <= 80) || std::trunc(dec) != dec)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the number of decimals must be a whole number, not negative");
    return store(task, result, formatDecimals(value, static_cast<int>(dec), exponent));
}

std::string digits(uint64_t value, int base, size_t width) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, base);
    (void)error; // 64 characters hold every number
    std::string text(buffer, end);
    for (char& c : text)
        if (c >= 'a') c = static_cast<char>(c - 'a' + 'A');
    if (text.size() < width) text.insert(0, width - text.size(), '0');
    return text;
}

constexpr uint64_t kLargest = 9223372036854775807u; // DecToHex and HexToDec: 63 bits

int baseOf(bool hex, bool octal, bool binary) {
    return hex ? 16 : octal ? 8 : binary ? 2 : 10;
}

} // namespace

extern "C" {

Status rt_NumToStr(TaskCore* task, String* result, float Val, float Dec, bool Exp) {
    return decimalsText(task, result, Val, Dec, Exp);
}

Status rt_DnumToStr(TaskCore* task, String* result, double Val, float Dec, bool Exp) {
    return decimalsText(task, result, Val, Dec, Exp);
}

Status rt_ValToStr(TaskCore* task, String* result, const void* Val, const TypeDesc* ValType) {
    return store(task, result, valueToText(Val, *ValType));
}

Status rt_StrToVal(TaskCore*, bool* result, const String* Str, void* Val, const TypeDesc* ValType) {
    *result = textToValue(Str->view(), Val, *ValType);
    return kOk;
}

Status rt_DecToHex(TaskCore* task, String* result, const String* Str) {
    uint64_t value = 0;
    if (!lib::readDigits(Str->view(), 10, kLargest, value))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the text must be a decimal integer up to 9223372036854775807");
    return store(task, result, digits(value, 16, 1));
}

Status rt_HexToDec(TaskCore* task, String* result, const String* Str) {
    uint64_t value = 0;
    if (!lib::readDigits(Str->view(), 16, kLargest, value))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the text must be a hexadecimal integer up to 7FFFFFFFFFFFFFFF");
    return store(task, result, digits(value, 10, 1));
}

Status rt_ByteToStr(TaskCore* task, String* result, float BitData, bool Hex, bool Okt, bool Bin, bool Char) {
    if (!(BitData >= 0 && BitData <= 255) || std::trunc(BitData) != BitData)
        return lib::fail(task, err::ERR_ARGVALERR, "a byte is a whole number from 0 to 255");
    const auto value = static_cast<uint32_t>(BitData);
    if (Char && value < 0x80) {
        result->bytes[0] = static_cast<char>(value);
        result->length = 1;
        return kOk;
    }
    if (Char) return store(task, result, lib::encodeUtf8(value));
    return store(task, result, digits(value, baseOf(Hex, Okt, Bin), Hex ? 2 : Okt ? 3 : Bin ? 8 : 1));
}

Status rt_StrToByte(TaskCore* task, float* result, const String* ConStr, bool Hex, bool Okt, bool Bin,
                    bool Char) {
    const std::string_view text = ConStr->view();
    uint64_t value = 0;
    if (Char && text.size() == 1) {
        *result = static_cast<uint8_t>(text[0]);
        return kOk;
    }
    const bool valid = Char ? lib::characterCount(text) == 1 && (value = lib::codePoint(text)) <= 255
                            : lib::readDigits(text, baseOf(Hex, Okt, Bin), 255, value);
    if (!valid)
        return lib::fail(task, err::ERR_ARGVALERR,
                         Char ? "the text must be one character with a code up to 255"
                              : "the text must be digits of a number from 0 to 255 in the base asked for");
    *result = static_cast<float>(value);
    return kOk;
}

Status rt_StrFormat(TaskCore* task, String* result, const String* Str, const String* Arg1, const String* Arg2,
                    const String* Arg3, const String* Arg4, const String* Arg5, const String* Arg6) {
    const String* args[] = {Arg1, Arg2, Arg3, Arg4, Arg5, Arg6};
    const std::string_view text = Str->view();
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool placeholder = text[i] == '{' && i + 2 < text.size() && text[i + 2] == '}' &&
                                 text[i + 1] >= '1' && text[i + 1] <= '6';
        const String* arg = placeholder ? args[text[i + 1] - '1'] : nullptr;
        if (!arg) { // a placeholder without argument stays as it is
            out += text[i];
            continue;
        }
        out += arg->view();
        i += 2;
    }
    return store(task, result, out);
}
}

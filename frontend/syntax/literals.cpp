// Values of literal tokens (manual 1.1.2).

#include "frontend/syntax/lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rapid::syntax {

namespace {

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

int hexValue(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if ((c | 32) >= 'a' && (c | 32) <= 'f') return (c | 32) - 'a' + 10;
    return -1;
}

NumberValue radixValue(std::string_view digits, int radix) {
    NumberValue result;
    result.isInteger = true;
    result.valid = !digits.empty();
    for (const char c : digits) {
        const int digit = hexValue(c);
        if (digit < 0 || digit >= radix) {
            result.valid = false;
            break;
        }
        result.value = result.value * radix + digit;
    }
    result.inRange = std::isfinite(result.value);
    if (!result.inRange) result.value = 0;
    return result;
}

} // namespace

bool isWholeLiteral(std::string_view text) {
    const bool prefixed = text.size() > 1 && text[0] == '0' && (text[1] | 32) >= 'a';
    return prefixed || text.find_first_of(".eE") == std::string_view::npos;
}

NumberValue numberValue(std::string_view text) {
    if (text.size() > 1 && text[0] == '0') {
        const char prefix = static_cast<char>(text[1] | 32);
        const int radix = prefix == 'x' ? 16 : prefix == 'o' ? 8 : prefix == 'b' ? 2 : 0;
        if (radix) return radixValue(text.substr(2), radix);
    }
    NumberValue result;
    uint64_t mantissa = 0;
    size_t digits = 0, decimals = 0, i = 0;
    bool dot = false;
    for (; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '.' && !dot) {
            dot = true;
        } else if (c >= '0' && c <= '9') {
            if (++digits <= 19) mantissa = mantissa * 10 + static_cast<uint64_t>(c - '0');
            decimals += dot;
        } else {
            break;
        }
    }
    result.isInteger = !dot;
    // Up to 15 digits and a power of ten up to 22 are exact in binary64, and so is one operation on them.
    if (i == text.size() && digits > 0 && digits <= 15) {
        result.value = static_cast<double>(mantissa) / kPowersOfTen[decimals];
        return result;
    }
    // 9E9 occurs in every taught point.
    const bool shortExponent =
        i + 2 == text.size() && (text[i] | 0x20) == 'e' && text[i + 1] >= '0' && text[i + 1] <= '9';
    if (shortExponent && digits > 0 && digits <= 15 && decimals == 0) {
        result.value = static_cast<double>(mantissa) * kPowersOfTen[text[i + 1] - '0'];
        return result;
    }
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), result.value);
    result.valid = status != std::errc::invalid_argument && end == text.data() + text.size();
    if (status == std::errc::result_out_of_range) {
        // Too small is zero, too large a mistake.
        const size_t exponent = text.find_first_of("eE");
        const bool negative = exponent + 1 < text.size() && text[exponent + 1] == '-';
        const bool tiny = exponent != std::string_view::npos ? negative : text[0] == '0' || text[0] == '.';
        result.inRange = tiny;
        result.value = 0;
    }
    return result;
}

std::string decodeStringLiteral(std::string_view literal) {
    std::string out;
    if (!literal.empty() && literal.front() == '"') literal.remove_prefix(1);
    for (size_t i = 0; i < literal.size(); ++i) {
        const char c = literal[i];
        const char next = i + 1 < literal.size() ? literal[i + 1] : '\0';
        if (c == '"') {
            if (next != '"') break;
            out.push_back('"');
            ++i;
        } else if (c == '\\' && next == '\\') {
            out.push_back('\\');
            ++i;
        } else if (c == '\\' && i + 2 < literal.size() && hexValue(next) >= 0 &&
                   hexValue(literal[i + 2]) >= 0) {
            out.push_back(static_cast<char>(hexValue(next) * 16 + hexValue(literal[i + 2])));
            i += 2;
        } else {
            out.push_back(c);
        }
    }
    return out;
}

} // namespace rapid::syntax

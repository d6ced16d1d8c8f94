#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace rapid::config {
namespace {

/// Length of the UTF-8 sequence at text[i], 0 if it is none (overlong forms and surrogates included).
std::size_t sequenceLength(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char first = byte(i);
    if (first < 0x80) return 1;
    std::size_t length = 0;
    uint32_t code = 0;
    if (first >= 0xC2 && first < 0xE0)
        length = 2, code = first & 0x1Fu;
    else if (first >= 0xE0 && first < 0xF0)
        length = 3, code = first & 0x0Fu;
    else if (first >= 0xF0 && first < 0xF5)
        length = 4, code = first & 0x07u;
    if (length == 0 || i + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(i + k) & 0xC0u) != 0x80u) return 0;
        code = code << 6 | (byte(i + k) & 0x3Fu);
    }
    if ((length == 3 && code < 0x800) || (length == 4 && (code < 0x10000 || code > 0x10FFFF))) return 0;
    return code >= 0xD800 && code < 0xE000 ? 0 : length;
}

bool isUtf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequenceLength(text, i);
        if (length == 0) return false;
        i += length;
    }
    return true;
}

} // namespace

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

bool parseNumber(std::string_view text, double& value) {
    text = trimmed(text);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        return false;
    value = number;
    return true;
}

std::string toUtf8(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    if (isUtf8(text)) return std::string(text);
    std::string result;
    result.reserve(text.size() + text.size() / 8);
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            result += c;
        } else {
            result += static_cast<char>(0xC0u | byte >> 6);
            result += static_cast<char>(0x80u | (byte & 0x3Fu));
        }
    }
    return result;
}

std::vector<std::string> splitPath(std::string_view path) {
    std::vector<std::string> segments;
    while (!path.empty()) {
        const std::size_t end = std::min(path.find('/'), path.size());
        if (end > 0) segments.emplace_back(path.substr(0, end));
        path.remove_prefix(std::min(end + 1, path.size()));
    }
    return segments;
}

std::string shortestNumber(double value) {
    if (value == 0) return "0"; // not "-0"
    const float single = static_cast<float>(value);
    return static_cast<double>(single) == value ? fmt::format("{}", single) : fmt::format("{}", value);
}

std::string indented(std::string_view text) {
    constexpr std::string_view kMargin = "    ";
    std::string out(kMargin);
    for (const char c : text) {
        out += c;
        if (c == '\n') out += kMargin;
    }
    return out;
}

} // namespace rapid::config

#include "tools/http/url.h"

#include "config/letter_case.h"

#include <algorithm>

namespace rapidc::http {

namespace {

int digitOf(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

bool isLetterOrDigit(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// "http://host:port/path" -> "/path"; none when it is neither form.
std::optional<std::string_view> originFormOf(std::string_view target) {
    if (target.starts_with('/')) return target;
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (!rapid::config::beginsWithName(target, scheme)) continue;
        target.remove_prefix(scheme.size());
        const std::size_t end = target.find_first_of("/?");
        if (end == 0) return std::nullopt;
        return end == std::string_view::npos || target[end] == '?' ? "/" : target.substr(end);
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> decodePercent(std::string_view text, bool plus) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '%') {
            const int high = i + 2 < text.size() ? digitOf(text[i + 1]) : -1;
            const int low = high >= 0 ? digitOf(text[i + 2]) : -1;
            if (low < 0) return std::nullopt;
            c = static_cast<char>(high * 16 + low);
            i += 2;
        } else if (c == '+' && plus) {
            c = ' ';
        }
        if (c == '\0') return std::nullopt;
        result += c;
    }
    return result;
}

std::string encodePercent(std::string_view text, std::string_view keep) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string result;
    result.reserve(text.size());
    for (const char c : text) {
        if (isLetterOrDigit(c) || keep.find(c) != std::string_view::npos) {
            result += c;
            continue;
        }
        const auto byte = static_cast<unsigned char>(c);
        result += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
    return result;
}

std::optional<FieldList> parseFields(std::string_view text, std::size_t mostFields) {
    FieldList fields;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('&'), text.size());
        const std::string_view field = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (field.empty()) continue;
        const std::size_t equals = std::min(field.find('='), field.size());
        auto name = decodePercent(field.substr(0, equals), true);
        auto value = decodePercent(field.substr(std::min(equals + 1, field.size())), true);
        if (!name || !value || fields.size() == mostFields) return std::nullopt;
        fields.emplace_back(std::move(*name), std::move(*value));
    }
    return fields;
}

std::optional<Target> parseTarget(std::string_view text) {
    const auto origin = originFormOf(text);
    if (!origin) return std::nullopt;
    const bool isPrintable =
        std::all_of(origin->begin(), origin->end(), [](char c) { return c > ' ' && c != '\x7F'; });
    if (!isPrintable || origin->find('#') != std::string_view::npos) return std::nullopt;
    const std::size_t question = std::min(origin->find('?'), origin->size());
    Target target;
    std::string_view path = origin->substr(0, question);
    while (!path.empty()) {
        const std::size_t end = std::min(path.find('/'), path.size());
        auto segment = decodePercent(path.substr(0, end));
        if (!segment) return std::nullopt;
        path.remove_prefix(std::min(end + 1, path.size()));
        if (segment->empty()) continue;
        target.path += '/' + *segment;
        target.segments.push_back(std::move(*segment));
    }
    if (target.path.empty()) target.path = "/";
    auto query = parseFields(origin->substr(std::min(question + 1, origin->size())));
    if (!query) return std::nullopt;
    target.query = std::move(*query);
    return target;
}

std::string_view trimBlanks(std::string_view text) {
    constexpr std::string_view kBlanks = " \t";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string mediaTypeOf(std::string_view header) {
    return rapid::config::lowerCase(trimBlanks(header.substr(0, header.find(';'))));
}

std::optional<std::string> decodeBase64(std::string_view text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    while (text.ends_with('='))
        text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) return std::nullopt;
        bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xFFFFFFU;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xFFU);
    }
    return bytes;
}

} // namespace rapidc::http

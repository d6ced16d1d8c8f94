#include "tools/rws/request_values.h"

#include "config/text_util.h"
#include "tools/http/url.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using rapid::config::trimmed;

constexpr int64_t kLargestCount = 999'999'999;

} // namespace

std::string withExponents(std::string text) {
    const auto isDigit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    bool inString = false;
    for (std::size_t i = 1; i + 2 < text.size(); ++i) {
        if (text[i - 1] == '"') inString = !inString;
        const bool isExponent = (text[i] == 'E' || text[i] == 'e') && (isDigit(i - 1) || text[i - 1] == '.');
        if (!inString && isExponent && text[i + 1] == ' ' && isDigit(i + 2)) text[i + 1] = '+';
    }
    return text;
}

std::optional<double> numberIn(std::string_view text) {
    double value = 0;
    if (text.empty() || text.size() > 64 || !rapid::config::parseNumber(trimmed(text), value) ||
        !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<int64_t> wholeIn(std::string_view text, int64_t least, int64_t most) {
    int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || value < least || value > most) return std::nullopt;
    return value;
}

std::optional<std::size_t> countIn(std::string_view text) {
    const auto count = wholeIn(text, 0, kLargestCount);
    return count ? std::optional(static_cast<std::size_t>(*count)) : std::nullopt;
}

std::optional<std::vector<double>> numbersIn(std::string_view given, std::size_t count) {
    const std::string whole = withExponents(std::string(trimmed(given)));
    std::string_view text = whole;
    if (text.starts_with('[') != text.ends_with(']')) return std::nullopt;
    if (text.starts_with('[')) text = text.substr(1, text.size() - 2);
    std::vector<double> numbers;
    while (numbers.size() < count) {
        const std::size_t comma = text.find(',');
        const auto number = numberIn(text.substr(0, comma));
        if (!number) return std::nullopt;
        numbers.push_back(*number);
        if (comma == std::string_view::npos)
            return numbers.size() == count ? std::optional(numbers) : std::nullopt;
        text.remove_prefix(comma + 1);
    }
    return std::nullopt;
}

std::optional<bool> flagIn(std::string_view text) {
    for (const char* word : {"true", "1", "on", "enabled"})
        if (sameName(text, word)) return true;
    for (const char* word : {"false", "0", "off", "disabled"})
        if (sameName(text, word)) return false;
    return std::nullopt;
}

std::string shown(double value) {
    if (value == 0) value = 0; // no "-0"
    std::string text = fmt::format("{}", static_cast<float>(value));
    std::replace(text.begin(), text.end(), 'e', 'E'); // 9E+09, as RAPID writes it
    return text;
}

std::string shownExactly(double value) {
    if (value == 0) value = 0;
    return fmt::format("{}", value);
}

std::string fieldOf(const Request& request, std::string_view name) {
    return request.form.has(name) ? request.form.text(name) : request.query.text(name);
}

std::string escapedSegment(std::string_view segment) {
    return http::encodePercent(segment, "-._~$");
}

std::string hrefBelow(std::string_view root, std::string_view name) {
    std::string href(root);
    for (const std::string& segment : splitPath(name))
        href += '/' + escapedSegment(segment);
    return href;
}

std::optional<Page> readPage(const Request& request, std::size_t standardLimit, std::size_t mostLimit) {
    const std::string startText = fieldOf(request, "start"), limitText = fieldOf(request, "limit");
    const auto start = startText.empty() ? std::optional<std::size_t>(0) : countIn(startText);
    const auto limit = limitText.empty() ? std::optional(standardLimit) : countIn(limitText);
    if (!start || !limit || *limit == 0) return std::nullopt;
    return Page{*start, std::min(*limit, mostLimit)};
}

std::optional<Failure> readListPage(const Request& request, std::size_t total, std::size_t most,
                                    ListPage& page, bool countsPages) {
    const std::optional<Page> asked = readPage(request, most, most);
    if (!asked) return Failure{ReturnCode::BadPage, "start is a number from 0, limit one from 1", 0};
    auto [start, size] = *asked;
    if (countsPages) start = start == 0 ? 0 : std::min(start - 1, total) * size;
    if (start > 0 && start >= total)
        return Failure{ReturnCode::BadPage,
                       fmt::format("start is {}, but there are {} entries", start, total), 0};
    page.begin = start;
    page.end = std::min(total, start + size);
    if (page.end == total) return std::nullopt;
    for (const std::string& segment : request.segments)
        page.next += '/' + escapedSegment(segment);
    page.next += fmt::format("?start={}&limit={}", countsPages ? page.end / size + 1 : page.end, size);
    for (const auto& [name, value] : request.query.all()) // json=1, lang=en
        if (!sameName(name, "start") && !sameName(name, "limit"))
            page.next += fmt::format("&{}={}", escapedSegment(name), escapedSegment(value));
    return std::nullopt;
}

} // namespace rapidc::rws

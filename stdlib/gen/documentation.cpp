#include "stdlib/gen/model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace stdlibgen {

namespace {

constexpr std::array<std::string_view, 12> kKeys = {"manual",   "effects",    "raises", "option",
                                                    "deferred", "confidence", "lower",  "class",
                                                    "where",    "flow",       "lint",   "length"};

bool isKey(std::string_view word) {
    return std::find(kKeys.begin(), kKeys.end(), word) != kKeys.end();
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
        text.remove_prefix(1);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
        text.remove_suffix(1);
    return text;
}

/// `text` is all attribute lines of one declaration joined: a key is a known word followed by ':'.
void readAttributes(const std::string& text, Doc& doc, std::string& problem) {
    std::string key;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const bool labelled = word.back() == ':';
        const std::string stem = labelled ? word.substr(0, word.size() - 1) : word;
        if (labelled && isKey(stem)) {
            key = stem;
            doc.attr[key];
            continue;
        }
        if (key.empty()) {
            problem = "unknown attribute '" + word +
                      "'; known are manual, effects, raises, option, confidence, " +
                      "lower, class, where, deferred, flow, lint, length";
            return;
        }
        std::string& value = doc.attr[key];
        value += (value.empty() ? "" : " ") + word;
    }
}

} // namespace

std::string lowered(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

std::string Doc::summary() const {
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') return text.substr(0, i);
        if (text[i] == '.' && (i + 1 == text.size() || text[i + 1] == ' ' || text[i + 1] == '\n'))
            return text.substr(0, i + 1);
    }
    return text;
}

std::string Doc::get(const std::string& key) const {
    const auto found = attr.find(key);
    return found == attr.end() ? std::string() : found->second;
}

Doc readDocumentation(std::string_view text, uint32_t offset, std::string& problem) {
    std::vector<std::string_view> lines;
    size_t lineStart = text.rfind('\n', offset == 0 ? 0 : offset - 1);
    lineStart = lineStart == std::string_view::npos ? 0 : lineStart + 1;
    while (lineStart > 0) {
        const size_t end = lineStart - 1;
        size_t start = end == 0 ? std::string_view::npos : text.rfind('\n', end - 1);
        start = start == std::string_view::npos ? 0 : start + 1;
        const std::string_view line = trimmed(text.substr(start, end - start));
        if (!line.starts_with("!!") && !line.starts_with("!@")) break;
        lines.push_back(line);
        lineStart = start;
    }
    std::reverse(lines.begin(), lines.end());
    Doc doc;
    std::string attributes;
    for (std::string_view line : lines) {
        const std::string_view rest = trimmed(line.substr(2));
        if (line[1] == '@') {
            attributes += std::string(rest) + ' ';
            continue;
        }
        if (!doc.text.empty()) doc.text += '\n';
        doc.text += rest;
    }
    readAttributes(attributes, doc, problem);
    return doc;
}

} // namespace stdlibgen

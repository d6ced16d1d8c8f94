#include "frontend/syntax/declaration_comment.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) + 1 - first);
}

/// "effects:": lower-case letters and a colon.
bool isKey(std::string_view word) {
    return word.size() > 1 && word.back() == ':' &&
           std::all_of(word.begin(), word.end() - 1, [](char c) { return c >= 'a' && c <= 'z'; });
}

void readAttributes(std::string_view line, DeclarationComment& out) {
    while (!(line = trimmed(line)).empty()) {
        const std::string_view word = line.substr(0, line.find_first_of(kSpace));
        line.remove_prefix(word.size());
        if (isKey(word)) {
            out.attributes.push_back({word.substr(0, word.size() - 1), {}});
        } else if (out.attributes.empty()) {
            if (out.stray.empty()) out.stray = word;
        } else {
            std::string& value = out.attributes.back().value;
            if (!value.empty()) value += ' ';
            value += word;
        }
    }
}

} // namespace

std::string_view DeclarationComment::get(std::string_view key) const {
    for (const Attribute& attribute : attributes)
        if (attribute.key == key) return attribute.value;
    return {};
}

DeclarationComment readDeclarationComment(std::string_view before) {
    std::vector<std::string_view> lines;
    before = before.substr(0, before.find_last_not_of(" \t") + 1); // the indentation of the declaration
    if (!before.empty() && before.back() == '\n') before.remove_suffix(1);
    while (!before.empty()) {
        const size_t end = before.rfind('\n');
        const std::string_view line = trimmed(before.substr(end == std::string_view::npos ? 0 : end + 1));
        if (!line.starts_with("!!") && !line.starts_with("!@")) break;
        lines.push_back(line);
        before = before.substr(0, end == std::string_view::npos ? 0 : end);
    }
    DeclarationComment out;
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
        const std::string_view rest = trimmed(line->substr(2));
        if ((*line)[1] == '@') {
            readAttributes(rest, out);
            continue;
        }
        if (!out.text.empty()) out.text += '\n';
        out.text += rest;
    }
    return out;
}

} // namespace rapid::syntax

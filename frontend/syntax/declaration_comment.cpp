#include "frontend/syntax/declaration_comment.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

// One pass each: thousands of lines are read at every start.
bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back()))
        text.remove_suffix(1);
    return text;
}

std::string_view firstWord(std::string_view text) {
    return text.substr(0,
                       static_cast<size_t>(std::find_if(text.begin(), text.end(), isSpace) - text.begin()));
}

/// "effects:": lower-case letters and a colon.
bool isKey(std::string_view word) {
    return word.size() > 1 && word.back() == ':' &&
           std::all_of(word.begin(), word.end() - 1, [](char c) { return c >= 'a' && c <= 'z'; });
}

void addToValue(std::string_view words, DeclarationComment& out) {
    if (words.empty()) return;
    if (out.attributes.empty()) {
        if (out.stray.empty()) out.stray = firstWord(words);
        return;
    }
    std::string& value = out.attributes.back().value;
    if (!value.empty()) value += ' ';
    value += words;
}

void readAttributes(std::string_view line, DeclarationComment& out) {
    std::string_view words; // of the present value
    while (!(line = trimmed(line)).empty()) {
        const std::string_view word = firstWord(line);
        line.remove_prefix(word.size());
        if (isKey(word)) {
            addToValue(words, out);
            words = {};
            out.attributes.push_back({word.substr(0, word.size() - 1), {}});
        } else {
            const char* begin = words.empty() ? word.data() : words.data();
            words = {begin, static_cast<size_t>(word.data() + word.size() - begin)};
        }
    }
    addToValue(words, out);
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
    constexpr size_t kUsual = 8;
    out.attributes.reserve(kUsual);
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

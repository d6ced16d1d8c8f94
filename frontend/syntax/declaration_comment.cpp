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

/// The offset of the key ("effects:", lower-case letters) that ends at a colon; that of the colon if none does.
size_t keyBefore(std::string_view line, size_t colon) {
    size_t begin = colon;
    while (begin > 0 && line[begin - 1] >= 'a' && line[begin - 1] <= 'z')
        --begin;
    const bool isWord =
        (begin == 0 || isSpace(line[begin - 1])) && (colon + 1 == line.size() || isSpace(line[colon + 1]));
    return isWord ? begin : colon;
}

void readAttributes(std::string_view line, DeclarationComment& out) {
    size_t value = 0; // where the words of the present value begin
    for (size_t colon = line.find(':'); colon != std::string_view::npos; colon = line.find(':', colon + 1)) {
        const size_t key = keyBefore(line, colon);
        if (key == colon) continue;
        addToValue(trimmed(line.substr(value, key - value)), out);
        out.attributes.push_back({line.substr(key, colon - key), {}});
        value = colon + 1;
    }
    addToValue(trimmed(line.substr(value)), out);
}

} // namespace

std::string_view DeclarationComment::get(std::string_view key) const {
    for (const Attribute& attribute : attributes)
        if (attribute.key == key) return attribute.value;
    return {};
}

DeclarationComment readDeclarationComment(std::string_view before) {
    before = before.substr(0, before.find_last_not_of(" \t") + 1); // the indentation of the declaration
    if (before.ends_with('\n')) before.remove_suffix(1);
    size_t begin = before.size(); // of the comment
    for (size_t end = begin; end > 0;) {
        const size_t start = before.substr(0, end).rfind('\n') + 1; // 0 for the first line
        const std::string_view line = trimmed(before.substr(start, end - start));
        if (!line.starts_with("!!") && !line.starts_with("!@")) break;
        begin = start;
        end = start == 0 ? 0 : start - 1;
    }
    DeclarationComment out;
    constexpr size_t kUsual = 8;
    out.attributes.reserve(kUsual);
    for (std::string_view rest = before.substr(begin); !rest.empty();) {
        const size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::string_view words = trimmed(line.substr(2));
        if (line[1] == '@') {
            readAttributes(words, out);
            continue;
        }
        if (!out.text.empty()) out.text += '\n';
        out.text += words;
    }
    return out;
}

} // namespace rapid::syntax

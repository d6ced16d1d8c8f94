#include "frontend/sema/builtin_words.h"
#include "frontend/syntax/declaration_comment.h"
#include "stdlib/gen/model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace stdlibgen {

namespace {

template <class Enum, size_t N> std::string choices(const rapid::sema::BuiltinWord<Enum> (&words)[N]) {
    std::string out;
    for (const auto& word : words)
        out += fmt::format("{}{}", out.empty() ? "" : ", ", word.word);
    return out;
}

/// Empty when `value` is one of the words.
template <class Enum, size_t N>
std::string problemOf(std::string_view key, std::string_view value,
                      const rapid::sema::BuiltinWord<Enum> (&words)[N]) {
    if (rapid::sema::valueOf(words, value)) return {};
    return fmt::format("{}: does not know '{}'; it takes {}", key, value, choices(words));
}

std::string problemOf(const rapid::syntax::Attribute& attribute) {
    namespace sema = rapid::sema;
    const std::string_view key = attribute.key, value = attribute.value;
    if (std::find(std::begin(sema::kAttributeKeys), std::end(sema::kAttributeKeys), key) ==
        std::end(sema::kAttributeKeys))
        return fmt::format("unknown attribute '{}:'; known are {}", key,
                           fmt::join(sema::kAttributeKeys, ", "));
    if (key == "effects") return problemOf(key, value, sema::kEffectsWords);
    if (key == "flow") return problemOf(key, value, sema::kFlowWords);
    if (key == "role") return problemOf(key, value, sema::kRoleWords);
    if (key == "meaning") return problemOf(key, value, sema::kMeaningWords);
    if (key == "known") return problemOf(key, value, sema::kKnownTypeWords);
    if (key == "raisedby") return problemOf(key, value, sema::kLanguageErrorWords);
    if (key == "class") return problemOf(key, value, sema::kTypeClassWords);
    if (key == "confidence" && value != "high" && value != "medium" && value != "low")
        return fmt::format("confidence: does not know '{}'; it takes high, medium, low", value);
    std::istringstream words(attribute.value);
    if (key == "traits")
        for (std::string word; words >> word;)
            if (std::string problem = problemOf(key, word, sema::kTraitWords); !problem.empty())
                return problem;
    return {};
}

} // namespace

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

std::pair<std::string, std::string> splitFirstWord(const std::string& text) {
    const size_t space = text.find(' ');
    if (space == std::string::npos) return {text, ""};
    return {text.substr(0, space), text.substr(std::min(text.find_first_not_of(' ', space), text.size()))};
}

Doc readDocumentation(std::string_view text, uint32_t offset, std::string& problem) {
    const auto comment = rapid::syntax::readDeclarationComment(text.substr(0, offset));
    Doc doc;
    doc.text = comment.text;
    if (!comment.stray.empty())
        problem = fmt::format("'{}' follows no attribute: write a key before it", comment.stray);
    for (const auto& attribute : comment.attributes) {
        if (problem.empty()) problem = problemOf(attribute);
        if (problem.empty() && doc.attr.contains(std::string(attribute.key)))
            problem = fmt::format("'!@ {}:' is written twice: join the values", attribute.key);
        doc.attr[std::string(attribute.key)] = attribute.value;
    }
    return doc;
}

std::string whereProblem(const Routine& routine) {
    std::istringstream list(routine.doc.get("where"));
    for (std::string one; std::getline(list, one, ',');) {
        one.erase(0, one.find_first_not_of(' '));
        const size_t is = one.find(" is ");
        const std::string name = one.substr(0, is);
        const bool known = std::any_of(routine.params.begin(), routine.params.end(),
                                       [&](const Param& param) { return param.name == name; });
        if (is == std::string::npos || !known)
            return fmt::format("where: '{}' is not 'Parameter is kind'", one);
        if (std::string problem = problemOf("where", one.substr(is + 4), rapid::sema::kParamClassWords);
            !problem.empty())
            return problem;
    }
    return {};
}

} // namespace stdlibgen

#include "runtime/report/move_text.h"

#include "runtime/base/text_util.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace rt::report {
namespace {

constexpr std::size_t kLongest = 4000; // characters of an instruction

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
           (static_cast<unsigned char>(c) & 0x80) != 0;
}

bool startsWith(std::string_view text, std::string_view start) {
    return sameName(text.substr(0, start.size()), start);
}

std::string_view lineAndRest(std::string_view source, uint32_t line) {
    for (uint32_t at = 1; at < line; ++at) {
        const std::size_t end = source.find('\n');
        if (end == std::string_view::npos) return {};
        source.remove_prefix(end + 1);
    }
    return source;
}

/// The arguments up to the semicolon, blanks as one, without comments. Empty when the instruction does not end.
std::vector<std::string> argumentsOf(std::string_view text) {
    std::vector<std::string> result(1);
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < std::min(text.size(), kLongest); ++i) {
        const char c = text[i];
        if (c == '"') quoted = !quoted;
        if (!quoted && c == '!') {
            i = std::min(text.find('\n', i), text.size());
            continue;
        }
        if (!quoted && c == ';') return result;
        if (!quoted && (c == '(' || c == '[' || c == '{')) ++depth;
        if (!quoted && (c == ')' || c == ']' || c == '}')) --depth;
        std::string& argument = result.back();
        if (!quoted && depth == 0 && c == ',')
            result.emplace_back();
        else if (quoted || std::isspace(static_cast<unsigned char>(c)) == 0)
            argument += c;
        else if (!argument.empty() && argument.back() != ' ')
            argument += ' ';
    }
    return {};
}

/// Without the optional arguments that follow it without a comma: `v500\V:=100`.
std::string requiredPart(const std::string& argument) {
    int depth = 0;
    std::size_t end = 0;
    for (; end < argument.size(); ++end) {
        const char c = argument[end];
        if (c == '(' || c == '[' || c == '{') ++depth;
        if (c == ')' || c == ']' || c == '}') --depth;
        if (depth == 0 && c == '\\') break;
    }
    return std::string(trimmed(std::string_view(argument).substr(0, end)));
}

/// Letters, digits and underlines, then perhaps indices and components.
bool isName(std::string_view text) {
    if (text.empty() || std::isdigit(static_cast<unsigned char>(text[0])) != 0) return false;
    std::size_t at = 0;
    while (at < text.size() && isWordCharacter(text[at]))
        ++at;
    if (at == 0) return false;
    const std::string_view rest = text.substr(at);
    return rest.empty() || (rest[0] == '{' && rest.back() == '}') || rest[0] == '.';
}

/// The target among the required arguments: the last point.
std::size_t targetIndex(std::string_view instruction) {
    std::size_t index = 0;
    std::string_view form = instruction.substr(std::min<std::size_t>(4, instruction.size()));
    if (startsWith(instruction, "Trigg")) form = instruction.substr(5);
    if (startsWith(instruction, "Search")) {
        form = instruction.substr(6);
        index = 2;
    }
    return index + (startsWith(form, "C") ? 1 : 0);
}

} // namespace

MoveText moveTextAt(std::string_view source, uint32_t line, uint32_t column) {
    if (line == 0 || column == 0) return {};
    std::string_view text = lineAndRest(source, line);
    if (text.size() < column) return {};
    text.remove_prefix(column - 1);
    std::size_t length = 0;
    while (length < text.size() && isWordCharacter(text[length]))
        ++length;
    const std::string_view instruction = text.substr(0, length);
    if (!startsWith(instruction, "Move") && !startsWith(instruction, "Trigg") &&
        !startsWith(instruction, "Search"))
        return {};
    std::vector<std::string> required;
    for (const std::string& argument : argumentsOf(text.substr(length))) {
        std::string part = requiredPart(argument);
        if (!part.empty()) required.push_back(std::move(part));
    }
    const std::size_t target = targetIndex(instruction);
    if (required.size() <= target) return {};
    return {toUtf8(instruction), toUtf8(required[target]), isName(required[target])};
}

} // namespace rt::report

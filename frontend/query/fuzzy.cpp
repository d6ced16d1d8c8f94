#include "frontend/query/fuzzy.h"

#include "frontend/sema/names.h"

namespace rapid::query {

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
}

bool beginsWord(std::string_view name, size_t i) {
    if (i == 0) return true;
    const char before = name[i - 1], here = name[i];
    const bool upper = here >= 'A' && here <= 'Z', afterUpper = before >= 'A' && before <= 'Z';
    return before == '_' || (before >= '0' && before <= '9') || (upper && !afterUpper);
}

bool scattered(std::string_view letters, std::string_view name, size_t from) {
    size_t at = 0;
    for (size_t i = from; i < name.size() && at < letters.size(); ++i)
        if (lower(name[i]) == lower(letters[at])) ++at;
    return at == letters.size();
}

} // namespace

bool fuzzyMatch(std::string_view letters, std::string_view name) {
    if (letters.empty()) return true;
    for (size_t i = 0; i < name.size(); ++i)
        if (lower(name[i]) == lower(letters[0]) && beginsWord(name, i) && scattered(letters, name, i))
            return true;
    return false;
}

int fuzzyRank(std::string_view letters, std::string_view name) {
    if (letters == name) return 0;
    if (name.starts_with(letters)) return 1;
    const std::string folded = sema::foldName(name), wanted = sema::foldName(letters);
    if (folded.starts_with(wanted)) return 2;
    if (folded.find(wanted) != std::string::npos) return 3;
    return scattered(letters, name, 0) ? 4 : -1;
}

} // namespace rapid::query

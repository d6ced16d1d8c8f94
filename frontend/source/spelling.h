#pragma once
// The distance of two words: the measure of "did you mean" and of misspelt keywords.

#include <cstddef>
#include <string_view>

namespace rapid {

/// How many edits may lie between a name and what was probably meant by it.
inline unsigned suggestionLimit(size_t length) {
    return length < 6 ? 1 : length < 9 ? 2 : 3;
}

/// Number of edits (insert, delete, replace, swap of neighbours) between two words of the same case, at most `limit` + 1.
unsigned editDistance(std::string_view a, std::string_view b, unsigned limit);

} // namespace rapid

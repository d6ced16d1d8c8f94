#pragma once
// The distance of two words: the measure of "did you mean" and of misspelt keywords.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rapid {

/// How many edits may lie between a name and what was probably meant by it.
inline unsigned suggestionLimit(size_t length) {
    return length < 6 ? 1 : length < 9 ? 2 : 3;
}

/// Number of edits (insert, delete, replace, swap of neighbours) between two words of the same case, at most `limit` + 1.
unsigned editDistance(std::string_view a, std::string_view b, unsigned limit);

/// Length of a word and the set of its letters: most words that are not near are recognised by them, without comparing.
struct WordShape {
    uint32_t length = 0;
    uint32_t letters = 0; ///< a bit for each letter, one for all digits, one for the rest
};
WordShape shapeOf(std::string_view lowerCase);
/// False: more than `limit` edits lie between words of these shapes. An edit changes the length by one, or two of the letters.
inline bool mayBeNear(WordShape a, WordShape b, unsigned limit) {
    const uint32_t more = a.length > b.length ? a.length - b.length : b.length - a.length;
    return more <= limit && static_cast<unsigned>(std::popcount(a.letters ^ b.letters)) <= 2 * limit;
}

} // namespace rapid

#pragma once
// Letters that are typed for a name.

#include <string_view>

namespace rapid::query {

/// The letters are in the name, in this order, in any case; the first one begins the name or a word of it (after '_', a digit, or
/// a capital letter). Empty letters match everything.
bool fuzzyMatch(std::string_view letters, std::string_view name);
/// How well: 0 equal, 1 beginning, 2 beginning in another case, 3 within, 4 scattered; -1: no match.
int fuzzyRank(std::string_view letters, std::string_view name);

} // namespace rapid::query

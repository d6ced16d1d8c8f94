#pragma once
// Values in requests and replies of the plant's resources: numbers, lists of numbers, pages.

#include "tools/rws/message.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::rws {

/// RAPID text in a form that was not escaped: the blank in "9E 09" was a plus sign. Strings stay as they are.
std::string withExponents(std::string text);
/// A finite number; none for every other text.
std::optional<double> numberIn(std::string_view text);
/// A whole number, all of the text; none for every other text, and for numbers outside the limits.
std::optional<int64_t> wholeIn(std::string_view text, int64_t least, int64_t most);
/// A whole number from 0 to 999,999,999; none for every other text.
std::optional<std::size_t> countIn(std::string_view text);
/// "[1,2,3]" or "1,2,3", of `count` finite numbers; none for every other text.
std::optional<std::vector<double>> numbersIn(std::string_view text, std::size_t count);
/// "true", "1", "on", "enabled"; "false", "0", "off", "disabled"; in any case. None for every other text.
std::optional<bool> flagIn(std::string_view text);

/// As numbers are shown: the shortest text that reads back as the same binary32 value.
std::string shown(double value);
/// With all the digits that a double has, for results in metres and radians.
std::string shownExactly(double value);

/// The fields "start" (from 0) and "limit" of a request for a part of a list.
struct Page {
    std::size_t start = 0, limit = 0;
};
/// `standardLimit` applies without a limit; a larger one than `mostLimit` is reduced to it. None: a field is not a count, or the limit
/// is 0.
std::optional<Page> readPage(const Request& request, std::size_t standardLimit, std::size_t mostLimit);

/// A page within a list of known length.
struct ListPage {
    std::size_t begin = 0, end = 0; ///< of the entries
    std::string next;               ///< href of the next page; "" = none
};
/// The page (readPage) of a list of `total` entries, at most `most` of them. Failures: an invalid field, a start after the end.
/// `countsPages`: start is the number of the page, from 1.
std::optional<Failure> readListPage(const Request& request, std::size_t total, std::size_t most,
                                    ListPage& page, bool countsPages = false);

/// The value of a field of the form or, when it has none of this name, of the query.
std::string fieldOf(const Request& request, std::string_view name);
/// A segment of a path, with everything escaped that is not plain.
std::string escapedSegment(std::string_view segment);
/// The link to a resource below `root`, whose name may have several segments ("A/b/c"); they are escaped one by one.
std::string hrefBelow(std::string_view root, std::string_view name);

} // namespace rapidc::rws

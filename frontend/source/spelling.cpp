#include "frontend/source/spelling.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rapid {

unsigned editDistance(std::string_view a, std::string_view b, unsigned limit) {
    constexpr size_t kLongest = 64;
    if (a.size() > b.size()) std::swap(a, b);
    if (b.size() - a.size() > limit || b.size() >= kLongest) return limit + 1;
    using Row = std::array<unsigned, kLongest + 1>;
    std::array<Row, 3> rows; // each is written before it is read
    Row *beforeLast = &rows[0], *last = &rows[1], *row = &rows[2];
    for (size_t j = 0; j <= b.size(); ++j)
        (*last)[j] = static_cast<unsigned>(j);
    for (size_t i = 1; i <= a.size(); ++i) {
        // Farther from the diagonal than the limit nothing can come within it.
        const size_t begin = i > limit ? i - limit : 1, end = std::min(b.size(), i + limit);
        (*row)[begin - 1] = begin == 1 ? static_cast<unsigned>(i) : limit + 1;
        unsigned best = (*row)[begin - 1];
        for (size_t j = begin; j <= end; ++j) {
            const unsigned replace = (*last)[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            unsigned cost = std::min({replace, (*last)[j] + 1, (*row)[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost = std::min(cost, (*beforeLast)[j - 2] + 1);
            (*row)[j] = cost;
            best = std::min(best, cost);
        }
        if (best > limit) return limit + 1;
        if (end < b.size()) (*row)[end + 1] = limit + 1;
        Row* free = std::exchange(beforeLast, last);
        last = std::exchange(row, free);
    }
    return std::min((*last)[b.size()], limit + 1);
}

WordShape shapeOf(std::string_view lowerCase) {
    constexpr unsigned kDigits = 26, kRest = 27;
    WordShape shape{static_cast<uint32_t>(lowerCase.size()), 0};
    for (const char c : lowerCase) {
        const unsigned bit = c >= 'a' && c <= 'z'   ? static_cast<unsigned>(c - 'a')
                             : c >= '0' && c <= '9' ? kDigits
                                                    : kRest;
        shape.letters |= 1u << bit;
    }
    return shape;
}

} // namespace rapid

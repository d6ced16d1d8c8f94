#include "config/nearest.h"

#include "config/text_util.h"

#include <algorithm>
#include <utility>

namespace rapid::config {

namespace {

/// Letters inserted, left out, replaced or swapped with their neighbours.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t k = 0; k <= b.size(); ++k)
        row[k] = k;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before = std::exchange(last, row);
        row[0] = i;
        for (std::size_t k = 1; k <= b.size(); ++k) {
            const std::size_t replaced = last[k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1);
            row[k] = std::min({replaced, last[k] + 1, row[k - 1] + 1});
            const bool swapped = i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1];
            if (swapped) row[k] = std::min(row[k], before[k - 2] + 1);
        }
    }
    return row.back();
}

} // namespace

std::vector<std::string> nearestNames(std::string_view name, const std::vector<std::string>& names) {
    const std::string wanted = upperCase(name);
    std::vector<std::pair<std::size_t, std::string>> ranked;
    for (const std::string& other : names) {
        const std::size_t distance = editDistance(wanted, upperCase(other));
        if (distance * 3 <= std::min(wanted.size(), other.size())) ranked.emplace_back(distance, other);
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<std::string> nearest;
    for (auto& [distance, other] : ranked)
        nearest.push_back(std::move(other));
    return nearest;
}

} // namespace rapid::config

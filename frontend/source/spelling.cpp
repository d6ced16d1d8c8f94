#include "frontend/source/spelling.h"

#include <algorithm>
#include <array>

namespace rapid {

unsigned editDistance(std::string_view a, std::string_view b, unsigned limit) {
    constexpr size_t kLongest = 64;
    if (a.size() > b.size()) std::swap(a, b);
    if (b.size() - a.size() > limit || b.size() >= kLongest) return limit + 1;
    std::array<std::array<unsigned, kLongest>, 3> rows{}; // before previous, previous, current
    for (size_t j = 0; j <= b.size(); ++j)
        rows[1][j] = static_cast<unsigned>(j);
    for (size_t i = 1; i <= a.size(); ++i) {
        rows[2][0] = static_cast<unsigned>(i);
        unsigned best = rows[2][0];
        for (size_t j = 1; j <= b.size(); ++j) {
            const unsigned replace = rows[1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            unsigned cost = std::min({replace, rows[1][j] + 1, rows[2][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost = std::min(cost, rows[0][j - 2] + 1);
            rows[2][j] = cost;
            best = std::min(best, cost);
        }
        if (best > limit) return limit + 1;
        rows[0] = rows[1];
        rows[1] = rows[2];
    }
    return rows[1][b.size()];
}

} // namespace rapid

#pragma once
// The common parts of two versions of a text.

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace rapid {

/// Bytes that are the same at the beginnings and at the ends of two texts; the two parts do not overlap in either text.
struct SameEnds {
    size_t head = 0;
    size_t tail = 0;
};

inline SameEnds sameEnds(std::string_view before, std::string_view now) {
    const auto shorter = static_cast<std::ptrdiff_t>(std::min(before.size(), now.size()));
    const auto head = std::mismatch(now.begin(), now.begin() + shorter, before.begin()).first - now.begin();
    const auto tail =
        std::mismatch(now.rbegin(), now.rbegin() + (shorter - head), before.rbegin()).first - now.rbegin();
    return {static_cast<size_t>(head), static_cast<size_t>(tail)};
}

} // namespace rapid

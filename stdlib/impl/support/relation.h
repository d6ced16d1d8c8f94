#pragma once
// opnum: the comparisons that instructions take as an argument.

#include "stdlib_constants.h"

#include <optional>

namespace rt::lib {

inline constexpr const char* kRelationNames = "the relation must be LT, LTEQ, EQ, NOTEQ, GTEQ or GT";

/// Whether x is in the relation (LT ... GT) to y; nothing when it is none of them.
template <class T> std::optional<bool> related(T x, float relation, T y) {
    if (relation == k::LT) return x < y;
    if (relation == k::LTEQ) return x <= y;
    if (relation == k::EQ) return x == y;
    if (relation == k::NOTEQ) return x != y;
    if (relation == k::GTEQ) return x >= y;
    if (relation == k::GT) return x > y;
    return {};
}

} // namespace rt::lib

#pragma once
// Sizes that the language fixes.

#include <cstddef>

namespace rapid::syntax {

/// Bytes of the longest string (manual 1.1.2).
inline constexpr std::size_t kStringCapacity = 80;

/// Characters of the longest name (manual 1.1.2).
inline constexpr std::size_t kMaxNameLength = 32;

} // namespace rapid::syntax

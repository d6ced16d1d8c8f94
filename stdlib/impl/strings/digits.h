#pragma once
// Digits as numbers.

#include <charconv>
#include <cstdint>
#include <string_view>

namespace rt::lib {

/// The largest number that a stringdig holds.
inline constexpr uint64_t kLargestDigitString = 4294967295u;

/// All of `text` as an unsigned integer of this base, at most `limit`.
inline bool readDigits(std::string_view text, int base, uint64_t limit, uint64_t& value) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    return !text.empty() && error == std::errc() && stop == text.data() + text.size() && value <= limit;
}

} // namespace rt::lib

#pragma once
// Upper and lower case: the one rule for names, keywords, keys and file types.
//
// Case makes no difference for the letters of ASCII, nor for those of ISO 8859-1 that names may have (manual 1.1.2), which are two
// bytes in UTF-8. The rule does not depend on the locale.

#include <string>
#include <string_view>

namespace rapid::config {

/// Lower case of one byte of UTF-8 text; `previous` is the byte before it, 0 at the beginning.
constexpr char lowerByte(char c, char previous) {
    if (c >= 'A' && c <= 'Z') return static_cast<char>(c + 32);
    const auto byte = static_cast<unsigned char>(c);
    const bool isUpper = previous == '\xC3' && byte >= 0x80 && byte <= 0x9E && byte != 0x97;
    return isUpper ? static_cast<char>(byte + 0x20) : c;
}

/// Upper case of one byte, as lowerByte().
constexpr char upperByte(char c, char previous) {
    if (c >= 'a' && c <= 'z') return static_cast<char>(c - 32);
    const auto byte = static_cast<unsigned char>(c);
    const bool isLower = previous == '\xC3' && byte >= 0xA0 && byte <= 0xBE && byte != 0xB7;
    return isLower ? static_cast<char>(byte - 0x20) : c;
}

/// A single letter of ASCII.
constexpr char lowerLetter(char c) {
    return lowerByte(c, 0);
}

inline std::string lowerCase(std::string_view text) {
    std::string result(text);
    for (std::size_t i = 0; i < text.size(); ++i)
        result[i] = lowerByte(text[i], i > 0 ? text[i - 1] : '\0');
    return result;
}

inline std::string upperCase(std::string_view text) {
    std::string result(text);
    for (std::size_t i = 0; i < text.size(); ++i)
        result[i] = upperByte(text[i], i > 0 ? text[i - 1] : '\0');
    return result;
}

/// Equal without regard to case.
constexpr bool sameName(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        const char before = i > 0 ? a[i - 1] : '\0'; // the same in both: upper and lower case begin with 0xC3
        if (lowerByte(a[i], before) != lowerByte(b[i], before)) return false;
    }
    return true;
}

/// The order of the lower-case spellings: negative, 0 or positive.
constexpr int compareNames(std::string_view a, std::string_view b) {
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
        const char before = i > 0 ? a[i - 1] : '\0';
        const auto left = static_cast<unsigned char>(lowerByte(a[i], before));
        const auto right = static_cast<unsigned char>(lowerByte(b[i], before));
        if (left != right) return left < right ? -1 : 1;
    }
    return a.size() == b.size() ? 0 : a.size() < b.size() ? -1 : 1;
}

constexpr bool beginsWithName(std::string_view text, std::string_view prefix) {
    return text.size() >= prefix.size() && sameName(text.substr(0, prefix.size()), prefix);
}

constexpr bool endsWithName(std::string_view text, std::string_view suffix) {
    return text.size() >= suffix.size() && sameName(text.substr(text.size() - suffix.size()), suffix);
}

/// Whether `text` contains `word`, without regard to case.
inline bool containsName(std::string_view text, std::string_view word) {
    return lowerCase(text).find(lowerCase(word)) != std::string::npos;
}

} // namespace rapid::config

#pragma once
// The text by which a routine is called at run time (manual 1.1.5).

#include "runtime/base/text_util.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace rt::lib {

/// A letter, then letters, digits and '_'. Bytes above ASCII count as letters of ISO 8859-1.
inline bool isIdentifier(std::string_view text) {
    const auto isLetter = [](unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; };
    return !text.empty() && isLetter(static_cast<unsigned char>(text[0])) &&
           std::all_of(text.begin(), text.end(),
                       [&](unsigned char c) { return isLetter(c) || std::isdigit(c) != 0 || c == '_'; });
}

/// "name" or "Module:name".
struct CalledName {
    std::string_view module, routine;
    bool isValid = false;

    explicit CalledName(std::string_view written) {
        const std::size_t colon = written.find(':');
        if (colon != std::string_view::npos) module = trimmed(written.substr(0, colon));
        routine = trimmed(written.substr(colon + 1)); // npos + 1 is 0: the whole text
        isValid = isIdentifier(routine) && (colon == std::string_view::npos || isIdentifier(module));
    }
};

} // namespace rt::lib

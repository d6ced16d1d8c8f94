#pragma once
// The text by which a routine is called at run time (manual 1.1.5).

#include "runtime/base/text_util.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace rt::lib {

inline bool isIdentifier(std::string_view text) {
    return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
           std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '_' || c >= 0x80; });
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

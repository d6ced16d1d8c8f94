#include "frontend/diag/catalogue.h"

#include <algorithm>
#include <array>

namespace rapid::diag {

namespace {

constexpr auto kCatalogue = std::to_array<CatalogueEntry>({
#define DIAG(number, name, severity, argCount, text) {number, Severity::severity, argCount, #name, text},
// clang-format off: ascending
#include "frontend/diag/messages/syntax.def"
#include "frontend/diag/messages/names.def"
#include "frontend/diag/messages/expressions.def"
#include "frontend/diag/messages/calls.def"
#include "frontend/diag/messages/flow.def"
#include "frontend/diag/messages/projects.def"
#include "frontend/diag/messages/lowering.def"
#include "frontend/diag/messages/warnings.def"
#include "frontend/diag/messages/internal.def"
// clang-format on
#undef DIAG
});

/// Number in a placeholder at `text[at]`, which is a '{'; -1 when that is plain text.
constexpr int placeholderAt(std::string_view text, size_t at) {
    if (at + 2 >= text.size() || text[at + 2] != '}') return -1;
    const char digit = text[at + 1];
    return digit >= '0' && digit <= '9' ? digit - '0' : -1;
}

constexpr bool numbersAscend() {
    for (size_t i = 1; i < kCatalogue.size(); ++i)
        if (kCatalogue[i - 1].number >= kCatalogue[i].number) return false;
    return kCatalogue.front().number >= 1000 && kCatalogue.back().number <= 9999;
}

/// Every argument is used, and nothing beyond them.
constexpr bool placeholdersMatch() {
    for (const CatalogueEntry& entry : kCatalogue) {
        unsigned used = 0;
        for (size_t i = 0; i < entry.text.size(); ++i)
            if (const int n = entry.text[i] == '{' ? placeholderAt(entry.text, i) : -1; n >= 0)
                used |= 1u << n;
        if (used != (1u << entry.argCount) - 1) return false;
    }
    return true;
}

constexpr bool textsFollowTheWording() {
    for (const CatalogueEntry& entry : kCatalogue)
        if (entry.text.empty() || entry.text.back() == '.') return false;
    return true;
}

static_assert(numbersAscend(), "diag/messages: numbers must ascend within 1000..9999");
static_assert(placeholdersMatch(), "diag/messages: placeholders must match the number of arguments");
static_assert(textsFollowTheWording(), "diag/messages: a text is empty or ends with a full stop");

} // namespace

std::span<const CatalogueEntry> catalogue() {
    return kCatalogue;
}

const CatalogueEntry* findEntry(uint16_t number) {
    const auto found = std::lower_bound(kCatalogue.begin(), kCatalogue.end(), number,
                                        [](const CatalogueEntry& e, uint16_t n) { return e.number < n; });
    return found != kCatalogue.end() && found->number == number ? &*found : nullptr;
}

std::string title(const CatalogueEntry& entry) {
    std::string out;
    for (const char c : entry.name) {
        const bool upper = c >= 'A' && c <= 'Z';
        if (upper && !out.empty()) out.push_back(' ');
        out.push_back(upper && !out.empty() ? static_cast<char>(c + 32) : c);
    }
    return out;
}

std::string kebabName(const CatalogueEntry& entry) {
    std::string out;
    for (const char c : entry.name) {
        const bool upper = c >= 'A' && c <= 'Z';
        if (upper && !out.empty()) out.push_back('-');
        out.push_back(upper ? static_cast<char>(c - 'A' + 'a') : c);
    }
    return out;
}

namespace {

/// Names and quoted text of any length would hide what a message says.
void appendShortened(std::string& out, std::string_view argument) {
    constexpr size_t kLongest = 300;
    if (argument.size() <= kLongest) {
        out += argument;
        return;
    }
    size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(argument[end]) & 0xC0) == 0x80)
        --end; // not inside a character
    out += argument.substr(0, end);
    out += "...";
}

} // namespace

std::string formatText(std::string_view text, std::span<const std::string> args) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        const int n = text[i] == '{' ? placeholderAt(text, i) : -1;
        if (n >= 0 && static_cast<size_t>(n) < args.size()) {
            appendShortened(out, args[static_cast<size_t>(n)]);
            i += 2;
        } else {
            out.push_back(text[i]);
        }
    }
    return out;
}

} // namespace rapid::diag

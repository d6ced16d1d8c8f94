#include "frontend/format/read_settings.h"

#include "frontend/diag/messages/projects.h"
#include "frontend/source/spelling.h"

#include "frontend/sema/names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace rapid::format {

namespace {

namespace say = diag::say;
using project::Setting;

/// The values that one setting takes, and the member that stores it.
struct Entry {
    enum class Kind : uint8_t { Number, Switch, Word };
    std::string_view name;
    Kind kind = Kind::Number;
    uint32_t FormatSettings::* number = nullptr;
    uint32_t least = 0;
    uint32_t most = 0;
    bool FormatSettings::* flag = nullptr;
    std::span<const std::string_view> words; ///< in the order of the enumeration
    void (*setWord)(FormatSettings&, size_t) = nullptr;
};

constexpr std::array<std::string_view, 3> kSpacings = {"tight", "spaced", "keep"};
constexpr std::array<std::string_view, 4> kCommas = {"tight", "arguments", "spaced", "keep"};
constexpr std::array<std::string_view, 3> kKeywords = {"upper", "lower", "keep"};
constexpr std::array<std::string_view, 2> kLabels = {"first-column", "code"};
constexpr std::array<std::string_view, 2> kNames = {"keep", "canonical"};

constexpr Entry number(std::string_view name, uint32_t FormatSettings::* field, uint32_t least,
                       uint32_t most) {
    return {name, Entry::Kind::Number, field, least, most, nullptr, {}, nullptr};
}
constexpr Entry flag(std::string_view name, bool FormatSettings::* field) {
    return {name, Entry::Kind::Switch, nullptr, 0, 0, field, {}, nullptr};
}
constexpr Entry word(std::string_view name, std::span<const std::string_view> words,
                     void (*set)(FormatSettings&, size_t)) {
    return {name, Entry::Kind::Word, nullptr, 0, 0, nullptr, words, set};
}

using S = FormatSettings;
constexpr std::array kEntries = {
    number("indent", &S::indent, 1, 16),
    flag("tabs", &S::tabs),
    number("continuation", &S::continuation, 0, 40),
    number("max-blank-lines", &S::maxBlankLines, 0, 100),
    number("max-line-length", &S::maxLineLength, 0, 10000),
    word("keywords", kKeywords, [](S& s, size_t i) { s.keywords = static_cast<KeywordCase>(i); }),
    word("names", kNames, [](S& s, size_t i) { s.names = static_cast<NameCase>(i); }),
    word("assignments", kSpacings, [](S& s, size_t i) { s.assignments = static_cast<Spacing>(i); }),
    word("operators", kSpacings, [](S& s, size_t i) { s.operators = static_cast<Spacing>(i); }),
    word("commas", kCommas, [](S& s, size_t i) { s.commas = static_cast<CommaSpacing>(i); }),
    word("optional-arguments", kSpacings,
         [](S& s, size_t i) { s.optionalArguments = static_cast<Spacing>(i); }),
    word("labels", kLabels, [](S& s, size_t i) { s.labels = static_cast<LabelPlace>(i); }),
    flag("indent-module", &S::indentModule),
    flag("indent-case", &S::indentCase),
    flag("indent-handlers", &S::indentHandlers),
    flag("keep-comments-in-first-column", &S::keepCommentsInFirstColumn),
};

/// "'a', 'b' or 'c'"
std::string listed(std::span<const std::string_view> words) {
    std::string out;
    for (size_t i = 0; i < words.size(); ++i)
        out += fmt::format("{}'{}'", i == 0 ? "" : i + 1 == words.size() ? " or " : ", ", words[i]);
    return out;
}

/// The setting that is probably meant, or all of them.
std::string expectedNames(const std::string& written) {
    const std::string_view* best = nullptr;
    unsigned limit = suggestionLimit(written.size());
    std::vector<std::string_view> all;
    for (const Entry& entry : kEntries) {
        all.push_back(entry.name);
        const unsigned distance = editDistance(written, entry.name, limit);
        if (distance > limit) continue;
        best = &entry.name;
        limit = distance > 0 ? distance - 1 : 0;
    }
    return best ? fmt::format("'{}'", *best) : listed(all);
}

/// Stores the value; what was expected when it does not fit.
std::string store(const Entry& entry, const Setting& setting, FormatSettings& out) {
    switch (entry.kind) {
    case Entry::Kind::Number: {
        const double* value = std::get_if<double>(&setting.value);
        if (!value || *value != std::floor(*value) || *value < entry.least || *value > entry.most)
            return fmt::format("a whole number from {} to {}", entry.least, entry.most);
        out.*entry.number = static_cast<uint32_t>(*value);
        return {};
    }
    case Entry::Kind::Switch: {
        const bool* value = std::get_if<bool>(&setting.value);
        if (!value) return "true or false";
        out.*entry.flag = *value;
        return {};
    }
    case Entry::Kind::Word:
        for (size_t i = 0; i < entry.words.size(); ++i)
            if (setting.text() && *setting.text() == entry.words[i]) {
                entry.setWord(out, i);
                return {};
            }
        return listed(entry.words);
    }
    return {};
}

} // namespace

FormatSettings readFormatSettings(const project::Settings& settings, diag::Sink& sink) {
    FormatSettings out;
    for (const Setting& setting : settings.entries) {
        if (setting.section != "format") continue;
        const auto* found = std::find_if(kEntries.begin(), kEntries.end(),
                                         [&](const Entry& entry) { return entry.name == setting.name; });
        if (found == kEntries.end()) {
            sink.report(say::UnknownSetting, settings.file, setting.range,
                        {setting.name, expectedNames(setting.name)});
            continue;
        }
        std::string expected = store(*found, setting, out);
        if (!expected.empty())
            sink.report(say::BadSetting, settings.file, setting.range, {setting.name, std::move(expected)});
    }
    return out;
}

} // namespace rapid::format

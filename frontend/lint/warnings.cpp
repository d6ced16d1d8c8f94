#include "frontend/lint/warnings.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/diag/messages/warnings.h"
#include "frontend/source/spelling.h"

#include "frontend/diag/catalogue.h"
#include "frontend/sema/names.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <unordered_map>
#include <utility>

namespace rapid::lint {

using diag::CatalogueEntry;
using diag::Code;
namespace say = diag::say;

namespace {

constexpr uint16_t kFirstLint = 8000;
constexpr uint16_t kLastLint = 8999;

bool isLint(const CatalogueEntry& entry) {
    return entry.number >= kFirstLint && entry.number <= kLastLint;
}

bool isGroup(std::string_view name) {
    return name == "all" || name == "lint";
}

/// Whether `name` means this warning.
bool names(std::string_view name, const CatalogueEntry& entry) {
    if (!isSwitchable(entry)) return false;
    if (name == "all") return true;
    if (name == "lint") return isLint(entry);
    return name == kebabName(entry);
}

bool isWarningName(std::string_view name) {
    const auto all = diag::catalogue();
    return std::any_of(all.begin(), all.end(), [&](const CatalogueEntry& e) { return names(name, e); });
}

// ---- comments in the source ----------------------------------------------------------------------------------------

constexpr std::string_view kMark = "rapidc:";

enum class Word : uint8_t { Ignore, Off, On, Unknown };

struct Directive {
    Word word = Word::Unknown;
    std::string_view written;
    std::vector<std::string_view> names;
    uint32_t line = 0;
    uint32_t lastLine = 0; ///< Ignore: the lines it covers end here
};

bool isBlank(char c) {
    return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back()))
        text.remove_suffix(1);
    return text;
}

/// The beginning of the comment of a line; npos if it has none. Strings do not extend over several lines.
size_t commentStart(std::string_view line) {
    bool inString = false;
    for (size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') inString = !inString;
        if (line[i] == '!' && !inString) return i;
    }
    return std::string_view::npos;
}

/// The first word of `text`, which is shortened by it. Blanks and commas separate.
std::string_view takeWord(std::string_view& text) {
    const size_t begin = text.find_first_not_of(" \t,");
    if (begin == std::string_view::npos) return text = {};
    const size_t end = std::min(text.find_first_of(" \t,", begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

/// The next line with code at or below `line`, for a comment that is alone on its line. Remembers the last answer, so
/// that long comments are read once.
struct CodeLines {
    uint32_t from = 0, to = 0;
    uint32_t next(const SourceFile& file, uint32_t line) {
        if (line >= from && line <= to) return to;
        for (from = to = line; to < file.lineCount(); ++to) {
            const std::string_view text = trimmed(file.lineText(to));
            if (!text.empty() && text.front() != '!') break;
        }
        return to;
    }
};

/// Reads the directive at `offset`, the place of "rapidc:"; false if that is not a comment of its own.
bool readDirective(const SourceFile& file, size_t offset, CodeLines& code, Directive& out) {
    out.line = file.lineColumn(static_cast<uint32_t>(offset)).line;
    const std::string_view line = file.lineText(out.line);
    const size_t column = offset - file.lineStart(out.line);
    const size_t comment = commentStart(line);
    if (comment >= column || !trimmed(line.substr(comment + 1, column - comment - 1)).empty()) return false;
    std::string_view rest = line.substr(column + kMark.size());
    rest = rest.substr(0, rest.find("--"));
    out.written = takeWord(rest);
    out.word = out.written == "ignore" ? Word::Ignore
               : out.written == "off"  ? Word::Off
               : out.written == "on"   ? Word::On
                                       : Word::Unknown;
    for (std::string_view name = takeWord(rest); !name.empty(); name = takeWord(rest))
        out.names.push_back(name);
    const bool alone = trimmed(line.substr(0, comment)).empty();
    out.lastLine = alone ? code.next(file, out.line + 1) : out.line;
    return true;
}

std::vector<Directive> readDirectives(const SourceFile& file) {
    std::vector<Directive> found;
    const std::string_view text = file.text();
    CodeLines code;
    for (size_t at = text.find(kMark); at != std::string_view::npos; at = text.find(kMark, at + 1)) {
        Directive directive;
        if (readDirective(file, at, code, directive)) found.push_back(std::move(directive));
    }
    return found;
}

bool covers(const Directive& directive, const CatalogueEntry& entry) {
    return std::any_of(directive.names.begin(), directive.names.end(),
                       [&](std::string_view name) { return names(name, entry); });
}

/// The lines of a file in which one warning is switched off.
class OffLines {
  public:
    OffLines(const std::vector<Directive>& directives, const CatalogueEntry& entry) {
        constexpr uint32_t kEnd = 0xFFFFFFFFu;
        uint32_t offSince = 0;
        for (const Directive& d : directives) {
            if (!covers(d, entry)) continue;
            if (d.word == Word::Ignore) add(d.line, d.lastLine);
            if (d.word == Word::Off && offSince == 0) offSince = d.line;
            if (d.word == Word::On && offSince != 0) add(std::exchange(offSince, 0), d.line);
        }
        if (offSince != 0) add(offSince, kEnd);
        std::sort(ranges_.begin(), ranges_.end());
        for (size_t i = 1; i < ranges_.size(); ++i)
            ranges_[i].second = std::max(ranges_[i].second, ranges_[i - 1].second);
    }
    bool has(uint32_t line) const {
        const auto next = std::upper_bound(ranges_.begin(), ranges_.end(), std::make_pair(line, 0xFFFFFFFFu));
        return next != ranges_.begin() && std::prev(next)->second >= line;
    }

  private:
    void add(uint32_t first, uint32_t last) { ranges_.emplace_back(first, last); }
    std::vector<std::pair<uint32_t, uint32_t>> ranges_; ///< by first line; the second: the last line so far
};

/// Comments in the files of diagnostics, each read once.
class Directives {
  public:
    bool switchOff(const SourceFile& file, const CatalogueEntry& entry, uint32_t line) {
        const auto [read, isNewFile] = files_.try_emplace(&file);
        if (isNewFile) read->second = readDirectives(file);
        if (read->second.empty()) return false;
        const auto lines = lines_.find({&file, entry.number});
        if (lines != lines_.end()) return lines->second.has(line);
        return lines_.try_emplace({&file, entry.number}, read->second, entry).first->second.has(line);
    }

  private:
    std::unordered_map<const SourceFile*, std::vector<Directive>> files_;
    std::map<std::pair<const SourceFile*, uint16_t>, OffLines> lines_;
};

SourceRange rangeOf(const SourceFile& file, std::string_view part) {
    const auto begin = static_cast<uint32_t>(part.data() - file.text().data());
    return {begin, begin + static_cast<uint32_t>(part.size())};
}

} // namespace

WarningLevels::WarningLevels() {
    for (const CatalogueEntry& entry : diag::catalogue())
        levels_.push_back(entry.severity == diag::Severity::Error ? Level::Error : Level::Warning);
}

Level WarningLevels::of(Code code) const {
    const CatalogueEntry* entry = diag::findEntry(static_cast<uint16_t>(code));
    return entry ? levels_[static_cast<size_t>(entry - diag::catalogue().data())] : Level::Error;
}

bool WarningLevels::anyLint() const {
    const auto all = diag::catalogue();
    for (size_t i = 0; i < all.size(); ++i)
        if (isLint(all[i]) && levels_[i] != Level::Off) return true;
    return false;
}

bool WarningLevels::set(std::string_view name, Level level) {
    bool found = false;
    const auto all = diag::catalogue();
    for (size_t i = 0; i < all.size(); ++i) {
        if (!names(name, all[i])) continue;
        found = true;
        // "All warnings are errors" does not bring back what is switched off.
        if (level == Level::Error && isGroup(name) && levels_[i] == Level::Off) continue;
        levels_[i] = level;
    }
    return found;
}

std::string warningSuggestion(std::string_view name) {
    unsigned limit = suggestionLimit(name.size());
    std::string best;
    for (const CatalogueEntry& entry : diag::catalogue()) {
        if (!isSwitchable(entry)) continue;
        std::string candidate = kebabName(entry);
        const unsigned distance = editDistance(name, candidate, limit);
        if (distance > limit || (!best.empty() && distance == limit)) continue;
        limit = distance;
        best = std::move(candidate);
    }
    return best.empty() ? best : fmt::format("; did you mean '{}'?", best);
}

void applySettings(const project::Settings& settings, WarningLevels& levels, diag::Sink& sink) {
    // "all" and "lint" first: names say more than groups, and a JSON object has no order.
    constexpr size_t kMostUnknown = 1000; // more are not shown
    size_t unknown = 0;
    for (const bool groups : {true, false}) {
        for (const project::Setting& setting : settings.entries) {
            if (setting.section != "warnings") continue;
            if (isGroup(setting.name) != groups) continue;
            if (unknown > kMostUnknown) return;
            const std::string* text = setting.text();
            const bool known = text && (*text == "off" || *text == "warning" || *text == "error");
            if (!known) {
                sink.report(say::BadSetting, settings.file, setting.range,
                            {setting.name, "\"off\", \"warning\" or \"error\""});
                continue;
            }
            const Level level = *text == "off"     ? Level::Off
                                : *text == "error" ? Level::Error
                                                   : Level::Warning;
            if (!levels.set(setting.name, level) && unknown++ < kMostUnknown)
                sink.report(say::UnknownWarning, settings.file, setting.range,
                            {setting.name, warningSuggestion(setting.name)});
        }
    }
}

bool applyOption(std::string_view option, WarningLevels& levels, std::string& problem) {
    std::string_view name = option;
    Level level = Level::Warning;
    if (name == "error") name = "error=all";
    if (name.starts_with("error=")) {
        level = Level::Error;
        name.remove_prefix(6);
    } else if (name.starts_with("no-") && !isWarningName(name)) {
        level = Level::Off;
        name.remove_prefix(3);
    }
    if (levels.set(name, level)) return true;
    problem =
        fmt::format("-W {}: '{}' is not the name of a warning{}", option, name, warningSuggestion(name));
    return false;
}

void checkDirectives(const std::shared_ptr<const SourceFile>& file, diag::Sink& sink) {
    for (const Directive& directive : readDirectives(*file)) {
        if (directive.word == Word::Unknown || directive.names.empty())
            sink.report(say::BadDirective, file,
                        directive.written.empty()
                            ? SourceRange{file->lineStart(directive.line), file->lineStart(directive.line)}
                            : rangeOf(*file, directive.written),
                        {directive.written.empty() ? "nothing"
                         : directive.word == Word::Unknown
                             ? fmt::format("'{}'", directive.written)
                             : fmt::format("'{}' without a name", directive.written)});
        for (const std::string_view name : directive.names)
            if (directive.word != Word::Unknown && !isWarningName(name))
                sink.report(say::UnknownWarning, file, rangeOf(*file, name),
                            {std::string(name), warningSuggestion(name)});
    }
}

void applyLevels(const WarningLevels& levels, diag::Sink& sink) {
    Directives directives;
    sink.revise([&](diag::Diagnostic& d) {
        const CatalogueEntry* entry = diag::findEntry(static_cast<uint16_t>(d.code));
        if (!entry || !isSwitchable(*entry)) return true;
        const Level level = levels.of(d.code);
        if (level == Level::Off) return false;
        d.severity = level == Level::Error ? diag::Severity::Error : diag::Severity::Warning;
        return !d.file || !directives.switchOff(*d.file, *entry, d.file->lineColumn(d.range.begin).line);
    });
}

} // namespace rapid::lint

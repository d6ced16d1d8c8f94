// Diagnostics for people: heading, source excerpt with the place underlined, help, notes.

#include "frontend/diag/catalogue.h"

#include <fmt/format.h>

#include <algorithm>

namespace rapid::diag {

namespace {

constexpr size_t kTabWidth = 4;
constexpr size_t kBefore = 60; ///< columns shown left of the place in a line that is too long
constexpr size_t kWidth = 110; ///< columns shown at most

struct Colours {
    std::string_view reset, bold, error, warning, note, help, gutter;
};
constexpr Colours kPlain{"", "", "", "", "", "", ""};
constexpr Colours kAnsi{"\x1b[0m",    "\x1b[1m",    "\x1b[1;31m", "\x1b[1;35m",
                        "\x1b[1;36m", "\x1b[1;32m", "\x1b[34m"};

std::string_view colourOf(const Colours& colours, Severity severity) {
    switch (severity) {
    case Severity::Error: return colours.error;
    case Severity::Warning: return colours.warning;
    case Severity::Note: return colours.note;
    }
    return colours.error;
}

bool isContinuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// The part of a line that is shown, and where the marked part lies in it (display columns from 0).
struct Excerpt {
    std::string text;
    size_t markBegin = 0;
    size_t markEnd = 0;
};

/// Tabs become spaces and control characters a question mark, so that a file cannot steer the terminal.
Excerpt makeExcerpt(std::string_view line, size_t begin, size_t end) {
    begin = std::min(begin, line.size());
    end = std::clamp(end, begin, line.size());
    size_t from = begin;
    for (size_t columns = 0; from > 0 && columns < kBefore; --from)
        if (!isContinuation(line[from])) ++columns;
    while (from > 0 && from < line.size() && isContinuation(line[from]))
        --from;
    const bool cutLeft = from > 0 && line.size() > kWidth;
    if (!cutLeft) from = 0;

    Excerpt out;
    size_t column = 0;
    if (cutLeft) {
        out.text = "...";
        column = 3;
    }
    size_t i = from;
    for (; i < line.size(); ++i) {
        if (column >= kWidth && !isContinuation(line[i])) break;
        if (i == begin) out.markBegin = column;
        if (i == end) out.markEnd = column;
        const char c = line[i];
        if (c == '\t') {
            const size_t spaces = kTabWidth - column % kTabWidth;
            out.text.append(spaces, ' ');
            column += spaces;
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
            out.text.push_back('?');
            ++column;
        } else if (c == '\xC2' && i + 1 < line.size() && static_cast<unsigned char>(line[i + 1]) < 0xA0) {
            out.text.push_back('?'); // U+0080 to U+009F
            ++column;
            ++i;
        } else {
            out.text.push_back(c);
            if (!isContinuation(c)) ++column;
        }
    }
    if (begin >= i) out.markBegin = column;
    if (end >= i) out.markEnd = column;
    out.markEnd = std::max(out.markEnd, out.markBegin);
    if (i < line.size()) out.text += "...";
    return out;
}

void renderPlace(std::string& out, const SourceFile& file, SourceRange range, std::string_view markColour,
                 const Colours& colours) {
    const LineColumn start = file.lineColumn(range.begin);
    const std::string_view line = file.lineText(start.line);
    const uint32_t lineStart = file.lineStart(start.line);
    const size_t end = std::max(range.end, range.begin) - lineStart;
    const Excerpt excerpt = makeExcerpt(line, range.begin - lineStart, end);
    const size_t marks = std::max<size_t>(excerpt.markEnd - excerpt.markBegin, 1);
    out += fmt::format("{}{:5} | {}{}\n", colours.gutter, start.line, colours.reset, excerpt.text);
    out += fmt::format("{}      | {}{}{}^{}{}\n", colours.gutter, colours.reset,
                       std::string(excerpt.markBegin, ' '), markColour, std::string(marks - 1, '~'),
                       colours.reset);
}

std::string placePrefix(const std::shared_ptr<const SourceFile>& file, SourceRange range) {
    if (!file) return "rapidc: ";
    const LineColumn start = file->lineColumn(range.begin);
    return fmt::format("{}:{}:{}: ", file->path(), start.line, start.column);
}

} // namespace

std::string renderText(const Diagnostic& diagnostic, bool colour) {
    const Colours& colours = colour ? kAnsi : kPlain;
    const std::string_view severityColour = colourOf(colours, diagnostic.severity);
    const CatalogueEntry* entry = findEntry(static_cast<uint16_t>(diagnostic.code));
    const std::string name = entry && isSwitchable(*entry) ? fmt::format(" ({})", kebabName(*entry)) : "";
    std::string out = fmt::format("{}{}{}{}[{}]:{} {}{}{}{}\n", colours.bold,
                                  placePrefix(diagnostic.file, diagnostic.range), severityColour,
                                  severityName(diagnostic.severity), codeName(diagnostic.code), colours.reset,
                                  colours.bold, diagnostic.message, colours.reset, name);
    if (diagnostic.file && !diagnostic.file->isBinary())
        renderPlace(out, *diagnostic.file, diagnostic.range, severityColour, colours);
    for (const Diagnostic::Fix& fix : diagnostic.fixes)
        out += fmt::format("      {}= help:{} {}\n", colours.help, colours.reset, fix.message);
    for (const Diagnostic::Note& note : diagnostic.notes) {
        out += fmt::format("{}{}{}note:{} {}\n", colours.bold, placePrefix(note.file, note.range),
                           colours.note, colours.reset, note.message);
        if (note.file) renderPlace(out, *note.file, note.range, colours.note, colours);
    }
    return out;
}

} // namespace rapid::diag

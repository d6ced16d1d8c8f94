#include "tools/rapidc/text_diff.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace rapidc {

namespace {

constexpr uint32_t kContext = 3;

/// Lines of the old text (from 0, half open) and the text that takes their place.
struct Change {
    uint32_t begin = 0;
    uint32_t end = 0;
    std::string replacement;
};

uint32_t lineOf(const rapid::SourceFile& file, uint32_t offset) {
    uint32_t low = 1, high = file.lineCount();
    while (low < high) {
        const uint32_t middle = (low + high + 1) / 2;
        if (file.lineStart(middle) <= offset)
            low = middle;
        else
            high = middle - 1;
    }
    return low - 1;
}

uint32_t lineBegin(const rapid::SourceFile& file, uint32_t line) {
    return line < file.lineCount() ? file.lineStart(line + 1) : static_cast<uint32_t>(file.text().size());
}

/// Leaves out lines at both ends of a change that stay as they are.
void trim(const rapid::SourceFile& file, Change& change) {
    const auto oldLine = [&](uint32_t line) {
        const uint32_t begin = lineBegin(file, line);
        return file.text().substr(begin, lineBegin(file, line + 1) - begin);
    };
    std::string_view now = change.replacement;
    while (change.begin < change.end && now.starts_with(oldLine(change.begin)) &&
           !oldLine(change.begin).empty())
        now.remove_prefix(oldLine(change.begin++).size());
    const auto beginsLine = [&](std::string_view rest) {
        return rest.empty() || rest.back() == '\n' || rest.back() == '\r';
    };
    while (change.begin < change.end) {
        const std::string_view last = oldLine(change.end - 1);
        if (last.empty() || !now.ends_with(last) || !beginsLine(now.substr(0, now.size() - last.size())))
            break;
        now.remove_suffix(last.size());
        --change.end;
    }
    change.replacement = std::string(now);
}

/// Whole lines that change; edits that share a line make one change.
std::vector<Change> changedLines(const rapid::SourceFile& file, std::span<const rapid::TextEdit> edits) {
    std::vector<Change> changes;
    const std::string_view text = file.text();
    uint32_t done = 0; // of the text: copied into the last change
    const auto finish = [&](Change& change) {
        const uint32_t stop = lineBegin(file, change.end);
        change.replacement += text.substr(done, stop - done);
        trim(file, change);
    };
    for (const rapid::TextEdit& edit : edits) {
        const uint32_t first = lineOf(file, edit.range.begin), last = lineOf(file, edit.range.end) + 1;
        if (changes.empty() || first >= changes.back().end) {
            if (!changes.empty()) finish(changes.back());
            changes.push_back({first, last, {}});
            done = lineBegin(file, first);
        }
        Change& change = changes.back();
        change.replacement += text.substr(done, edit.range.begin - done);
        change.replacement += edit.replacement;
        done = edit.range.end;
        change.end = std::max(change.end, last);
    }
    if (!changes.empty()) finish(changes.back());
    return changes;
}

std::vector<std::string_view> splitLines(std::string_view text) {
    std::vector<std::string_view> lines;
    for (size_t begin = 0; begin < text.size();) {
        size_t end = text.find_first_of("\r\n", begin);
        if (end == std::string_view::npos) {
            lines.push_back(text.substr(begin));
            break;
        }
        lines.push_back(text.substr(begin, end - begin));
        end += text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n' ? 2 : 1;
        begin = end;
    }
    return lines;
}

class Writer {
  public:
    explicit Writer(const rapid::SourceFile& file)
        : file_(file), lineCount_(static_cast<uint32_t>(splitLines(file.text()).size())) {}

    std::string run(const std::vector<Change>& changes) {
        for (size_t begin = 0; begin < changes.size();) {
            size_t end = begin + 1;
            while (end < changes.size() && changes[end].begin <= changes[end - 1].end + 2 * kContext)
                ++end;
            writeHunk(std::span(changes).subspan(begin, end - begin));
            begin = end;
        }
        return std::move(out_);
    }

  private:
    void lines(char mark, uint32_t begin, uint32_t end) {
        for (uint32_t line = begin; line < std::min(end, lineCount_); ++line)
            body_ += fmt::format("{}{}\n", mark, file_.lineText(line + 1));
    }

    void writeHunk(std::span<const Change> changes) {
        body_.clear();
        const uint32_t first = changes.front().begin > kContext ? changes.front().begin - kContext : 0;
        const uint32_t last = std::min(changes.back().end + kContext, lineCount_);
        uint32_t at = first, added = 0, removed = 0;
        for (const Change& change : changes) {
            lines(' ', at, change.begin);
            lines('-', change.begin, change.end);
            removed += std::min(change.end, lineCount_) - std::min(change.begin, lineCount_);
            for (const std::string_view line : splitLines(change.replacement)) {
                body_ += fmt::format("+{}\n", line);
                ++added;
            }
            at = change.end;
        }
        lines(' ', at, last);
        const uint32_t oldCount = last - first;
        const uint32_t newCount = oldCount - removed + added;
        const uint32_t newFirst = first + shift_;
        out_ += fmt::format("@@ -{},{} +{},{} @@\n{}", oldCount ? first + 1 : first, oldCount,
                            newCount ? newFirst + 1 : newFirst, newCount, body_);
        shift_ += added - removed; // modulo 2^32, as newFirst
    }

    const rapid::SourceFile& file_;
    uint32_t lineCount_;
    uint32_t shift_ = 0;
    std::string body_;
    std::string out_;
};

} // namespace

std::string unifiedDiff(const rapid::SourceFile& file, std::span<const rapid::TextEdit> edits) {
    if (edits.empty()) return {};
    return fmt::format("--- {0}\n+++ {0}\n{1}", file.path(), Writer(file).run(changedLines(file, edits)));
}

} // namespace rapidc

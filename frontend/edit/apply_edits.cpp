#include "frontend/edit/apply_edits.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace rapid::edit {

namespace {

EditResult unapplied(std::string problem) {
    return {{}, std::move(problem)};
}

bool isContinuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}
bool cutsCharacter(std::string_view text, uint32_t at) {
    return at < text.size() && isContinuation(text[at]);
}
bool isAscii(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// In the order of their places; equal places in the order given.
std::vector<const TextEdit*> inOrder(std::span<const TextEdit> edits) {
    std::vector<const TextEdit*> order;
    order.reserve(edits.size());
    for (const TextEdit& edit : edits)
        order.push_back(&edit);
    std::sort(order.begin(), order.end(), [](const TextEdit* a, const TextEdit* b) {
        if (a->range.begin != b->range.begin) return a->range.begin < b->range.begin;
        return a->range.end != b->range.end ? a->range.end < b->range.end : a < b;
    });
    return order;
}

/// Why the edits do not fit the text; empty when they do.
std::string findMisfit(std::string_view text, const std::vector<const TextEdit*>& order) {
    uint32_t done = 0;
    for (const TextEdit* edit : order) {
        const auto [begin, end] = edit->range;
        if (begin > end || end > text.size())
            return fmt::format("an edit of bytes {} to {} does not lie in the text of {} bytes", begin, end,
                               text.size());
        if (cutsCharacter(text, begin) || cutsCharacter(text, end))
            return fmt::format("an edit of bytes {} to {} cuts a character in two", begin, end);
        if (begin < done) return fmt::format("two edits overlap at byte {}", begin);
        done = end;
    }
    return {};
}

template <class Keep, class Replace>
void forEachPart(std::string_view text, const std::vector<const TextEdit*>& order, const Keep& keep,
                 const Replace& replace) {
    uint32_t done = 0;
    for (const TextEdit* edit : order) {
        keep(SourceRange{done, edit->range.begin});
        replace(std::string_view(edit->replacement));
        done = edit->range.end;
    }
    keep(SourceRange{done, static_cast<uint32_t>(text.size())});
}

/// True when text of this file is written in ISO 8859-1.
bool writesLatin1(const SourceFile& file) {
    if (file.encoding() != Encoding::Utf8) return file.encoding() == Encoding::Latin1;
    return isAscii(file.text()) && SourceFile::isLegacyFileType(file.path());
}

/// Appends UTF-8 as ISO 8859-1; gives the first character that has no place there.
std::string_view appendLatin1(std::string& out, std::string_view text) {
    for (size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (c < 0x80) {
            out.push_back(text[i]);
            continue;
        }
        size_t end = i + 1;
        while (end < text.size() && isContinuation(text[end]))
            ++end;
        if (end - i != 2 || (c != 0xC2 && c != 0xC3)) return text.substr(i, end - i);
        out.push_back(static_cast<char>((c & 0x03) << 6 | (static_cast<unsigned char>(text[i + 1]) & 0x3F)));
        ++i;
    }
    return {};
}

} // namespace

EditResult applyEditsToText(std::string_view text, std::span<const TextEdit> edits) {
    const auto order = inOrder(edits);
    EditResult result;
    result.problem = findMisfit(text, order);
    if (!result.ok()) return result;
    forEachPart(
        text, order, [&](SourceRange r) { result.bytes += text.substr(r.begin, r.end - r.begin); },
        [&](std::string_view replacement) { result.bytes += replacement; });
    return result;
}

EditResult applyEdits(const SourceFile& file, std::span<const TextEdit> edits) {
    if (file.isBinary()) return unapplied("the file is encrypted or binary and cannot be edited");
    EditResult expected = applyEditsToText(file.text(), edits);
    if (!expected.ok()) return expected;
    if (!isValidUtf8(expected.bytes)) return unapplied("a replacement is not UTF-8");
    const bool latin1 = writesLatin1(file);
    std::string bytes = file.encoding() == Encoding::Utf8Bom ? "\xEF\xBB\xBF" : "";
    std::string_view unfit;
    forEachPart(
        file.text(), inOrder(edits), [&](SourceRange range) { bytes += file.bytes(range); },
        [&](std::string_view replacement) {
            if (!latin1)
                bytes += replacement;
            else if (unfit.empty())
                unfit = appendLatin1(bytes, replacement);
        });
    if (!unfit.empty())
        return unapplied(
            fmt::format("'{}' has no place in ISO 8859-1, the encoding of this file; write other words, or "
                        "save the file as UTF-8 (.modx, .sysx) first",
                        unfit));
    // For example, the last letter that distinguished ISO 8859-1 from UTF-8 may be gone.
    const SourceFile again(file.path(), bytes);
    if (again.isBinary() || again.text() != expected.bytes)
        return unapplied(
            "the changed file would be taken for another encoding and read with other characters; save "
            "the file as UTF-8 (.modx, .sysx) first");
    return {std::move(bytes), {}};
}

std::string_view lineEnd(std::string_view text) {
    size_t crlf = 0, lf = 0, cr = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') {
            ++lf;
        } else if (text[i] == '\r') {
            if (i + 1 < text.size() && text[i + 1] == '\n')
                ++crlf, ++i;
            else
                ++cr;
        }
    }
    if (crlf > 0 && crlf >= lf && crlf >= cr) return "\r\n";
    return cr > lf ? "\r" : "\n";
}

} // namespace rapid::edit

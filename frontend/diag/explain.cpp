#include "frontend/diag/explain.h"

#include "frontend/diag/explain_pages.h"

#include <algorithm>
#include <charconv>

namespace rapid::diag {

namespace {

constexpr std::string_view kKinds[] = {"file", "module", "body", "files"}; // by ExampleKind

/// Takes the example with this title off the end of a page's text; empty when it has none.
std::string_view takeExample(std::string_view& page, std::string_view title, ExampleKind& kind) {
    const size_t at = page.rfind(title);
    if (at == std::string_view::npos) return {};
    std::string_view example = page.substr(at + title.size());
    const size_t line = example.find('\n'), end = example.rfind("\n```");
    if (line == std::string_view::npos || end == std::string_view::npos) return {};
    const std::string_view name = example.substr(0, line);
    const auto found = std::ranges::find(kKinds, name.substr(name.rfind(' ') + 1));
    if (found == std::end(kKinds)) return {};
    kind = static_cast<ExampleKind>(found - std::begin(kKinds));
    page = page.substr(0, at);
    return line < end ? example.substr(line + 1, end - line - 1) : std::string_view();
}

} // namespace

Explanation readPage(std::string_view page) {
    constexpr std::string_view kTitle = "# RAP", kEnd = "\n\n[All", kMessage = "\n> ", kName = "\nName: ";
    Explanation e;
    std::from_chars(page.data() + kTitle.size(), page.data() + page.size(), e.number);
    page = page.substr(0, page.rfind(kEnd));
    page.remove_prefix(std::min(page.find('\n'), page.size()));
    for (const std::string_view before : {kMessage, kName}) {
        const size_t at = page.find(before);
        if (at != std::string_view::npos) page.remove_prefix(std::min(page.find("\n", at + 1), page.size()));
    }
    e.right = takeExample(page, "\n\nRight:\n\n```", e.kind);
    e.wrong = takeExample(page, "\n\nWrong:\n\n```", e.kind);
    while (page.ends_with('\n'))
        page.remove_suffix(1);
    e.meaning = page.substr(std::min(page.find_first_not_of('\n'), page.size()));
    return e;
}

std::span<const Explanation> explanations() {
    static const std::vector<Explanation> kAll = [] {
        std::vector<Explanation> all;
        for (const std::string_view page : embeddedPages())
            if (const Explanation e = readPage(page); !e.meaning.empty()) all.push_back(e);
        return all;
    }();
    return kAll;
}

const Explanation* findExplanation(uint16_t number) {
    const auto all = explanations();
    const auto found = std::ranges::lower_bound(all, number, {}, &Explanation::number);
    return found != all.end() && found->number == number ? &*found : nullptr;
}

std::string_view exampleLanguage(ExampleKind kind) {
    return kind == ExampleKind::Files ? "text" : "rapid";
}

std::string_view exampleKindName(ExampleKind kind) {
    return kKinds[static_cast<size_t>(kind)];
}

namespace {

constexpr std::string_view kBytes = "bytes ", kLatin1 = "ISO 8859-1";

std::string fromHex(std::string_view digits) {
    std::string bytes;
    for (size_t i = 0; i + 1 < digits.size(); i += 3)
        bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
    return bytes;
}

/// Text of letters below U+0100.
std::string toLatin1(std::string_view utf8) {
    std::string bytes;
    for (size_t i = 0; i < utf8.size(); ++i) {
        const auto lead = static_cast<unsigned char>(utf8[i]);
        const bool two = lead >= 0xC2 && lead <= 0xC3 && i + 1 < utf8.size();
        bytes += two ? static_cast<char>((lead & 3) << 6 | (utf8[++i] & 0x3F)) : utf8[i];
    }
    return bytes;
}

/// Puts the number `n` in each place of `sign`.
void number(std::string& line, std::string_view sign, int n) {
    for (size_t at = 0; (at = line.find(sign, at)) != std::string::npos;)
        line.replace(at, sign.size(), std::to_string(n));
}

/// A line of a file, or all lines that it represents.
std::string linesOf(std::string_view line) {
    constexpr std::string_view kRepeat = "(N = 1 to ";
    const size_t repeat = line.rfind(kRepeat);
    if (repeat == std::string_view::npos) return std::string(line) + "\n";
    const int times = std::stoi(std::string(line.substr(repeat + kRepeat.size())));
    line = line.substr(0, line.find_last_not_of(' ', repeat - 1) + 1);
    std::string lines;
    for (int n = 1; n <= times; ++n) {
        std::string one(line);
        number(one, "<N>", n);
        number(one, "<N+1>", n + 1);
        lines += one + "\n";
    }
    return lines;
}

ExampleProject readFiles(std::string_view example) {
    ExampleProject project;
    std::string_view form; // of the last file, between parentheses
    const auto finish = [&] {
        if (form == kLatin1) project.files.back().bytes = toLatin1(project.files.back().bytes);
    };
    while (!example.empty()) {
        const size_t end = std::min(example.find('\n'), example.size());
        std::string_view line = example.substr(0, end);
        example.remove_prefix(std::min(end + 1, example.size()));
        if (line.starts_with("$ ")) {
            project.command = std::string(line.substr(2));
        } else if (line.empty() || line.starts_with("  ")) {
            line.remove_prefix(std::min<size_t>(line.size(), 2));
            project.files.back().bytes += linesOf(line);
        } else { // NAME: or NAME (FORM):
            finish();
            const size_t open = line.find(" (");
            form = open == std::string_view::npos ? std::string_view()
                                                  : line.substr(open + 2, line.size() - open - 4);
            project.files.push_back({std::string(line.substr(0, std::min(open, line.size() - 1))), {}});
            if (form.starts_with(kBytes)) project.files.back().bytes = fromHex(form.substr(kBytes.size()));
        }
    }
    finish();
    return project;
}

} // namespace

ExampleProject exampleProject(ExampleKind kind, std::string_view example) {
    if (kind == ExampleKind::Files) return readFiles(example);
    std::string text = std::string(example) + "\n";
    if (kind == ExampleKind::Body) text = "PROC main()\n" + text + "ENDPROC\n";
    if (kind != ExampleKind::File) text = "MODULE m\n" + text + "ENDMODULE\n";
    return {"rapidc check m.modx", {{"m.modx", std::move(text)}}};
}

} // namespace rapid::diag

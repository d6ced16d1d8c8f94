// Runs the checker over tests/diag: every diagnostic stands as a comment in the program that causes it, and no other
// may be reported. The form of the comments is described in tests/diag/README.md.

#include "sema_testing.h"

#include "frontend/edit/apply_edits.h"
#include "frontend/lint/lint.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

namespace {

using namespace rapid;
namespace fs = std::filesystem;

struct Expected {
    uint32_t line = 0;
    uint32_t column = 0; ///< 0: anywhere in the line
    uint32_t end = 0;
    std::string severity;
    std::string code;
    std::string text;

    bool matches(const diag::Diagnostic& d) const {
        const LineColumn from = d.file->lineColumn(d.range.begin), to = d.file->lineColumn(d.range.end);
        return from.line == line && diag::severityName(d.severity) == severity &&
               diag::codeName(d.code) == code && (column == 0 || from.column == column) &&
               (end == 0 || to.line != line || to.column == end) && d.message.find(text) != std::string::npos;
    }
};

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        if (c == '\n')
            lines.emplace_back();
        else if (c != '\r')
            lines.back() += c;
    }
    return lines;
}

std::vector<Expected> annotations(const std::vector<std::string>& lines) {
    static const std::regex carets(R"(^(\s*!\s*)(\^+)\s*(error|warning)\[(RAP\d{4})\](?::\s*(.*?))?\s*$)");
    static const std::regex atEnd(R"(^.*\S.*!\s*(error|warning)\[(RAP\d{4})\](?::\s*(.*?))?\s*$)");
    static const std::regex elsewhere(
        R"(^.*!@\s*expect\s+@?([+-]?\d+):(\d+)-(\d+)\s+(error|warning)\[(RAP\d{4})\](?::\s*(.*?))?\s*$)");
    std::vector<Expected> found;
    uint32_t codeLine = 0;
    for (uint32_t number = 1; number <= lines.size(); ++number) {
        std::smatch m;
        const std::string& line = lines[number - 1];
        if (std::regex_match(line, m, carets)) {
            const auto begin = static_cast<uint32_t>(m[1].length()) + 1;
            found.push_back(
                {codeLine, begin, begin + static_cast<uint32_t>(m[2].length()), m[3], m[4], m[5]});
            continue;
        }
        if (line.find("!@ expect") != std::string::npos && std::regex_match(line, m, elsewhere)) {
            found.push_back({number + static_cast<uint32_t>(std::stoi(m[1])),
                             static_cast<uint32_t>(std::stoi(m[2])), static_cast<uint32_t>(std::stoi(m[3])),
                             m[4], m[5], m[6]});
            continue;
        }
        codeLine = number;
        const size_t text = line.find_first_not_of(" \t");
        if (text != std::string::npos && line[text] != '!' && std::regex_match(line, m, atEnd))
            found.push_back({number, 0, 0, m[1], m[2], m[3]});
    }
    return found;
}

/// The signals of a configuration file, as far as the tests write them: -Name "x" -SignalType "DI".
std::vector<sema::SignalInfo> signalsOf(const std::string& configuration) {
    static const std::regex line(R"re(-Name\s+"(\w+)"\s+-SignalType\s+"(\w+)")re");
    std::vector<sema::SignalInfo> signals;
    for (std::sregex_iterator m(configuration.begin(), configuration.end(), line), end; m != end; ++m) {
        std::string type = (*m)[2];
        std::transform(type.begin(), type.end(), type.begin(),
                       [](char c) { return static_cast<char>(c | 0x20); });
        signals.push_back({(*m)[1], "signal" + type});
    }
    return signals;
}

sema::CheckOptions optionsOf(const std::vector<std::string>& lines, const fs::path& folder) {
    static const std::regex config(R"(.*--config=\{dir\}/(\S+).*)");
    sema::CheckOptions options;
    options.library = sema::testing::library();
    for (const std::string& line : lines) {
        std::smatch m;
        if (line.find("!@ args:") == std::string::npos || !std::regex_match(line, m, config)) continue;
        options.configurationKnown = true;
        options.signals = signalsOf(sema::testing::readFile((folder / m[1].str()).string()));
    }
    return options;
}

/// The certain fixes that do not touch each other, as `check --fix` takes them.
std::vector<TextEdit> certainEdits(const diag::Sink& sink, size_t& count) {
    std::vector<TextEdit> edits;
    for (const diag::Diagnostic& d : sink.sorted()) {
        if (d.fixes.empty() || !d.fixes.front().certain) continue;
        const std::vector<TextEdit>& fresh = d.fixes.front().edits;
        const bool touches = std::any_of(fresh.begin(), fresh.end(), [&](const TextEdit& a) {
            return std::any_of(edits.begin(), edits.end(), [&](const TextEdit& b) {
                return a.range.begin <= b.range.end && b.range.begin <= a.range.end;
            });
        });
        if (touches) continue;
        edits.insert(edits.end(), fresh.begin(), fresh.end());
        ++count;
    }
    return edits;
}

std::string trimmed(std::string text) {
    static const std::regex annotation(R"(\s*!\s*(error|warning)\[RAP.*$)");
    text = std::regex_replace(text, annotation, "");
    const size_t from = text.find_first_not_of(" \t"), to = text.find_last_not_of(" \t");
    return from == std::string::npos ? std::string() : text.substr(from, to - from + 1);
}

/// `! fixed: reg1 := 5;` below a line says what it is after --fix.
std::vector<std::pair<uint32_t, std::string>> fixedLines(const std::vector<std::string>& lines) {
    static const std::regex fixed(R"(^\s*! fixed:\s*(.*?)\s*$)");
    static const std::regex note(R"(^\s*!.*$)");
    std::vector<std::pair<uint32_t, std::string>> found;
    uint32_t codeLine = 0;
    for (uint32_t number = 1; number <= lines.size(); ++number) {
        std::smatch m;
        if (std::regex_match(lines[number - 1], m, fixed))
            found.emplace_back(codeLine, m[1]);
        else if (!std::regex_match(lines[number - 1], note))
            codeLine = number;
    }
    return found;
}

std::string describe(const diag::Diagnostic& d) {
    const LineColumn from = d.file->lineColumn(d.range.begin), to = d.file->lineColumn(d.range.end);
    return std::to_string(from.line) + ":" + std::to_string(from.column) + "-" + std::to_string(to.column) +
           " " + std::string(diag::severityName(d.severity)) + "[" + diag::codeName(d.code) +
           "]: " + d.message;
}

std::vector<fs::path> diagnosticFiles() {
    std::vector<fs::path> files;
    const fs::path root = fs::path(RAPIDC_SOURCE_DIR) / "tests" / "diag";
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".modx" || extension == ".sysx" || extension == ".mod" || extension == ".sys")
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Expected and reported diagnostics of one file against each other; "" when they agree.
std::string compare(const fs::path& path) {
    const std::string text = sema::testing::readFile(path.string());
    const std::vector<std::string> lines = linesOf(text);
    std::vector<Expected> expected = annotations(lines);
    sema::TaskInput task;
    task.files.push_back(std::make_shared<const SourceFile>(path.filename().string(), text));
    diag::Sink sink;
    const auto program = sema::check({task}, optionsOf(lines, path.parent_path()), sink);
    lint::WarningLevels levels;
    // A program for one rule need not be tidy otherwise; those of 8xxx are about nothing else.
    if (path.parent_path().filename() != "8xxx") levels.set("lint", lint::Level::Off);
    lint::checkDirectives(task.files[0], sink);
    lint::lint(*program, levels, sink);
    lint::applyLevels(levels, sink);
    std::string problems;
    for (const diag::Diagnostic& d : sink.sorted()) {
        if (d.severity == diag::Severity::Note) continue;
        if (!d.file) {
            problems += "without a place: " + d.message + "\n";
            continue;
        }
        const auto hit =
            std::find_if(expected.begin(), expected.end(), [&](const Expected& e) { return e.matches(d); });
        if (hit != expected.end())
            expected.erase(hit);
        else
            problems += "not expected: " + describe(d) + "\n";
    }
    for (const Expected& e : expected)
        problems += "not reported: " + std::to_string(e.line) + ":" + std::to_string(e.column) + "-" +
                    std::to_string(e.end) + " " + e.severity + "[" + e.code + "]: " + e.text + "\n";
    return problems;
}

/// Applies the certain fixes of a program and checks it again: they mend what they are for and break nothing.
std::string compareFixed(const fs::path& path) {
    const std::string text = sema::testing::readFile(path.string());
    const std::vector<std::string> lines = linesOf(text);
    const sema::CheckOptions options = optionsOf(lines, path.parent_path());
    const auto checkText = [&](const std::string& source, diag::Sink& sink) {
        sema::TaskInput task;
        task.files.push_back(std::make_shared<const SourceFile>(path.filename().string(), source));
        sema::check({task}, options, sink);
        return task.files.front();
    };
    diag::Sink before, after;
    const auto file = checkText(text, before);
    size_t count = 0;
    const edit::EditResult edited = edit::applyEditsToText(file->text(), certainEdits(before, count));
    if (!edited.ok()) return edited.problem;
    std::string problems;
    const std::vector<std::string> fixed = linesOf(edited.bytes);
    for (const auto& [line, expected] : fixedLines(lines))
        if (trimmed(fixed.at(line - 1)) != expected)
            problems +=
                "line " + std::to_string(line) + " is fixed to: " + trimmed(fixed.at(line - 1)) + "\n";
    checkText(edited.bytes, after);
    if (after.all().size() + count != before.all().size()) {
        problems += "after --fix:\n";
        for (const diag::Diagnostic& d : after.sorted())
            problems += describe(d) + "\n";
    }
    return problems;
}

} // namespace

TEST_CASE("certain fixes of the programs in tests/diag mend them", "[sema][diag]") {
    for (const fs::path& path : diagnosticFiles()) {
        INFO(path.string());
        CHECK(compareFixed(path) == "");
    }
}

TEST_CASE("the library checks without diagnostics", "[sema]") {
    diag::Sink sink;
    sema::CheckOptions options;
    options.library = sema::testing::library();
    REQUIRE(!options.library.empty());
    sema::check({}, options, sink);
    std::string problems;
    for (const diag::Diagnostic& d : sink.sorted())
        problems += d.file->path() + ":" + describe(d) + "\n";
    CHECK(problems == "");
}

TEST_CASE("programs in tests/diag give the diagnostics in their comments", "[sema][diag]") {
    const std::vector<fs::path> files = diagnosticFiles();
    REQUIRE(files.size() > 20);
    for (const fs::path& path : files) {
        INFO(path.string());
        CHECK(compare(path) == "");
    }
}

TEST_CASE("a diagnostics program is named after a code that it expects", "[sema][diag]") {
    for (const fs::path& path : diagnosticFiles()) {
        const std::string name = path.filename().string();
        if (name.rfind("RAP", 0) != 0) continue;
        INFO(path.string());
        const std::vector<Expected> expected = annotations(linesOf(sema::testing::readFile(path.string())));
        const std::string code = name.substr(0, 7);
        CHECK(
            std::any_of(expected.begin(), expected.end(), [&](const Expected& e) { return e.code == code; }));
    }
}

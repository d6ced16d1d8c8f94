#include "tools/testing/reports.h"

#include "runtime/base/time.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace testing {
namespace {

const char* wordFor(Outcome outcome) {
    switch (outcome) {
    case Outcome::Passed: return "ok";
    case Outcome::Failed: return "FAILED";
    case Outcome::Error: return "ERROR";
    case Outcome::Timeout: return "TIMEOUT";
    case Outcome::Skipped: return "skipped";
    }
    return "";
}

const char* colourFor(Outcome outcome) {
    if (outcome == Outcome::Passed) return "\033[32m";
    return outcome == Outcome::Skipped ? "\033[33m" : "\033[31m";
}

std::string indented(const std::string& text, const char* blanks) {
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        result += blanks + text.substr(begin, end - begin) + "\n";
        begin = end + 1;
    }
    return result;
}

std::string callLine(const Spot& call) {
    return fmt::format("called by {} at {}", call.routine, call.text());
}

bool isBad(Outcome outcome) {
    return outcome != Outcome::Passed && outcome != Outcome::Skipped;
}

bool isControl(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

/// UTF-8 of U+0080 to U+009F, which YAML does not print either.
bool isLaterControl(const std::string& text, std::size_t i) {
    return text[i] == '\xC2' && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
}

/// A text in double quotes as YAML has it.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool isLater = isLaterControl(text, i);
        const char c = isLater ? text[++i] : text[i];
        if (c == '"' || c == '\\')
            result += std::string("\\") + c;
        else if (c == '\n')
            result += "\\n";
        else if (isLater || isControl(c))
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        else
            result += c;
    }
    return result + "\"";
}

/// '#' begins a directive in TAP, and a line has no control characters.
std::string tapEscaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '#' || c == '\\') result += '\\';
        result += isControl(c) ? ' ' : c;
    }
    return result;
}

} // namespace

void Totals::add(Outcome outcome) {
    switch (outcome) {
    case Outcome::Passed: ++passed; break;
    case Outcome::Failed: ++failed; break;
    case Outcome::Error: ++errors; break;
    case Outcome::Timeout: ++timeouts; break;
    case Outcome::Skipped: ++skipped; break;
    }
}

Totals totalsOf(const std::vector<Finished>& results) {
    Totals totals;
    for (const Finished& one : results)
        totals.add(one.result.outcome);
    return totals;
}

std::string humanText(const TestCase& test, const TestResult& result, bool withOutput, bool colour) {
    const char* const word = wordFor(result.outcome);
    std::string text = colour ? fmt::format("{}{:<8}\033[0m{}", colourFor(result.outcome), word, test.id)
                              : fmt::format("{:<8}{}", word, test.id);
    if (result.virtualTime > 0) text += fmt::format("  {} s", rt::formatSeconds(result.virtualTime, 3));
    text += "\n";
    if (result.outcome == Outcome::Skipped) return text + indented(result.message, "        ");
    if (isBad(result.outcome)) {
        const std::string place = result.spot.text();
        text += indented((place.empty() ? "" : place + ": ") + result.message, "        ");
        for (const Spot& call : result.calls)
            text += indented(callLine(call), "          ");
    }
    const bool shows = withOutput || isBad(result.outcome);
    if (shows && !result.output.empty()) text += "        output:\n" + indented(result.output, "        | ");
    const bool showsEvents =
        withOutput || (isBad(result.outcome) && result.assertions == 0 && result.virtualTime == 0);
    if (showsEvents && !result.events.empty())
        text += "        events:\n" + indented(result.events, "        | ");
    return text;
}

std::string humanTotals(const Totals& totals) {
    std::string text =
        fmt::format("{} {}: {} passed", totals.all(), totals.all() == 1 ? "test" : "tests", totals.passed);
    if (totals.failed > 0) text += fmt::format(", {} failed", totals.failed);
    if (totals.errors > 0)
        text += fmt::format(", {} {}", totals.errors, totals.errors == 1 ? "error" : "errors");
    if (totals.timeouts > 0) text += fmt::format(", {} timed out", totals.timeouts);
    if (totals.skipped > 0) text += fmt::format(", {} skipped", totals.skipped);
    return text + "\n";
}

std::string tapHead(std::size_t tests) {
    return fmt::format("TAP version 13\n1..{}\n", tests);
}

std::string tapText(std::size_t number, const TestCase& test, const TestResult& result) {
    const bool good = !isBad(result.outcome);
    std::string text = fmt::format("{} {} - {}", good ? "ok" : "not ok", number, tapEscaped(test.id));
    if (result.outcome == Outcome::Skipped) text += " # SKIP " + tapEscaped(result.message);
    text += "\n";
    if (good) return text;
    text += "  ---\n";
    text += fmt::format("  message: {}\n", quoted(result.message));
    text += fmt::format("  severity: {}\n", result.outcome == Outcome::Failed ? "fail" : "error");
    text += fmt::format("  outcome: {}\n", nameOf(result.outcome));
    if (result.spot.line > 0)
        text += fmt::format("  at:\n    file: {}\n    line: {}\n    column: {}\n", quoted(result.spot.file),
                            result.spot.line, result.spot.column);
    if (!result.expected.empty())
        text += fmt::format("  expected: {}\n  actual: {}\n", quoted(result.expected), quoted(result.actual));
    return text + "  ...\n";
}

} // namespace testing

// JUnit XML, in the form that GitLab, Jenkins, Azure and the actions of GitHub read.

#include "tools/testing/reports.h"

#include <fmt/format.h>

#include <map>

namespace testing {
namespace {

/// The number of bytes of the UTF-8 character that begins at `i`; 0 when there is none, or XML does not allow it.
std::size_t characterAt(const std::string& text, std::size_t i) {
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
    };
    const unsigned first = byte(i);
    if (first < 0x80) return first >= 0x20 || first == '\n' || first == '\t' || first == '\r' ? 1 : 0;
    const std::size_t size = first >= 0xF0 && first < 0xF5   ? 4
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xC2 && first < 0xE0 ? 2
                                                             : 0;
    for (std::size_t k = 1; k < size; ++k)
        if ((byte(i + k) & 0xC0) != 0x80) return 0;
    const bool surrogate = first == 0xED && byte(i + 1) >= 0xA0;
    const bool notCharacter = first == 0xEF && byte(i + 1) == 0xBF && byte(i + 2) >= 0xBE;
    const bool overlong = (first == 0xE0 && byte(i + 1) < 0xA0) || (first == 0xF0 && byte(i + 1) < 0x90);
    return surrogate || notCharacter || overlong || (first == 0xF4 && byte(i + 1) > 0x8F) ? 0 : size;
}

std::string escaped(const std::string& text, bool inAttribute) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t size = characterAt(text, i);
        const char c = text[i];
        if (size == 0)
            result += "\xEF\xBF\xBD";
        else if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"' && inAttribute)
            result += "&quot;";
        else if (inAttribute && size == 1 && static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("&#{};", static_cast<int>(c));
        else
            result += text.substr(i, size);
        i += std::max<std::size_t>(size, 1);
    }
    return result;
}

std::string attribute(const char* name, const std::string& value) {
    return fmt::format(" {}=\"{}\"", name, escaped(value, true));
}

std::string bodyOf(const TestResult& result) {
    const std::string place = result.spot.text();
    std::string text = (place.empty() ? "" : place + ": ") + result.message;
    if (!result.expected.empty()) text += "\nexpected: " + result.expected + "\nactual:   " + result.actual;
    for (const Spot& call : result.calls)
        text += fmt::format("\ncalled by {} at {}", call.routine, call.text());
    return escaped(text, false);
}

std::string caseText(const Finished& one, const std::string& suite) {
    const TestCase& test = one.test;
    const TestResult& result = one.result;
    std::string text = "    <testcase" + attribute("classname", suite) + attribute("name", test.name) +
                       attribute("file", test.file) + fmt::format(" line=\"{}\"", test.line) +
                       fmt::format(" assertions=\"{}\" time=\"{:.3f}\"", result.assertions, result.wallTime);
    std::string inner;
    switch (result.outcome) {
    case Outcome::Passed: break;
    case Outcome::Failed:
        inner += "      <failure type=\"assertion\"" + attribute("message", result.message) + ">" +
                 bodyOf(result) + "</failure>\n";
        break;
    case Outcome::Error:
    case Outcome::Timeout:
        inner += fmt::format("      <error type=\"{}\"",
                             result.outcome == Outcome::Error ? "execution" : "timeout") +
                 attribute("message", result.message) + ">" + bodyOf(result) + "</error>\n";
        break;
    case Outcome::Skipped: inner += "      <skipped" + attribute("message", result.message) + "/>\n"; break;
    }
    if (!result.output.empty())
        inner += "      <system-out>" + escaped(result.output, false) + "</system-out>\n";
    if (!result.events.empty())
        inner += "      <system-err>" + escaped(result.events, false) + "</system-err>\n";
    return text + (inner.empty() ? "/>\n" : ">\n" + inner + "    </testcase>\n");
}

std::string counts(const std::vector<const Finished*>& results) {
    Totals totals;
    double time = 0;
    uint64_t assertions = 0;
    for (const Finished* one : results) {
        totals.add(one->result.outcome);
        time += one->result.wallTime;
        assertions += one->result.assertions;
    }
    return fmt::format(
        " tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" assertions=\"{}\" time=\"{:.3f}\"",
        totals.all(), totals.failed, totals.errors + totals.timeouts, totals.skipped, assertions, time);
}

} // namespace

std::string junitText(const std::vector<Finished>& results) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<const Finished*>> suites;
    std::vector<const Finished*> all;
    for (const Finished& one : results) {
        const std::string suite = one.test.id.substr(0, one.test.id.rfind('.'));
        if (!suites.contains(suite)) order.push_back(suite);
        suites[suite].push_back(&one);
        all.push_back(&one);
    }
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"rapidc\"" + counts(all) + ">\n";
    for (const std::string& suite : order) {
        text += "  <testsuite" + attribute("name", suite) +
                attribute("file", suites[suite].front()->test.file) + counts(suites[suite]) + ">\n";
        for (const Finished* one : suites[suite])
            text += caseText(*one, suite);
        text += "  </testsuite>\n";
    }
    return text + "</testsuites>\n";
}

} // namespace testing

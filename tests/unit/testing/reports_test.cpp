// Reports of unit tests: forms of JUnit, TAP and lcov, what is escaped in them, results from process to process.

#include "tools/testing/coverage.h"
#include "tools/testing/discovery.h"
#include "tools/testing/reports.h"

#include <catch2/catch.hpp>

using namespace testing;

namespace {

Finished finished(const std::string& id, Outcome outcome, const std::string& message = "") {
    Finished one;
    one.test.id = id;
    one.test.module = id.substr(0, id.find('.'));
    one.test.name = id.substr(id.find('.') + 1);
    one.test.file = "cell/" + one.test.module + ".modx";
    one.test.line = 7;
    one.result.outcome = outcome;
    one.result.message = message;
    one.result.spot = {one.test.file, one.test.module, one.test.name, 12, 3};
    return one;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("JUnit: suites, counts, escaped characters", "[testing]") {
    std::vector<Finished> results = {
        finished("A.TestOne", Outcome::Passed),
        finished("B.TestTwo", Outcome::Failed, "expected <1>, actual \"2\" & more"),
        finished("A.TestThree", Outcome::Timeout, "late"),
        finished("A.TestFour", Outcome::Skipped, "no camera")};
    results[0].result.output = "bell \a, half \xC3, whole \xC3\xA9, ]]>\n";
    const std::string text = junitText(results);
    CHECK(has(text, "<testsuites name=\"rapidc\" tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"1\""));
    CHECK(has(
        text,
        "<testsuite name=\"A\" file=\"cell/A.modx\" tests=\"3\" failures=\"0\" errors=\"1\" skipped=\"1\""));
    CHECK(has(
        text,
        "<testsuite name=\"B\" file=\"cell/B.modx\" tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\""));
    CHECK(has(text, "message=\"expected &lt;1&gt;, actual &quot;2&quot; &amp; more\""));
    CHECK(has(text, "<error type=\"timeout\" message=\"late\">cell/A.modx:12: late</error>"));
    CHECK(has(text, "<skipped message=\"no camera\"/>"));
    // XML 1.0 has no characters below 0x20 but these: tab, line feed, carriage return; bytes that are not UTF-8 are replaced
    CHECK(has(text, "bell \xEF\xBF\xBD, half \xEF\xBF\xBD, whole \xC3\xA9, ]]&gt;\n"));
}

TEST_CASE("JUnit: every text is UTF-8 without forbidden characters", "[testing]") {
    std::string bytes;
    for (int byte = 0; byte < 256; ++byte)
        bytes += static_cast<char>(byte);
    Finished one = finished("A.TestOne", Outcome::Error, bytes);
    one.result.output = bytes;
    for (const char c : junitText({one}))
        CHECK((static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t' || c == '\r'));
}

TEST_CASE("TAP 14: plan, directives, blocks", "[testing]") {
    CHECK(tapHead(3) == "TAP version 13\n1..3\n");
    const Finished good = finished("A.TestOne", Outcome::Passed);
    CHECK(tapText(1, good.test, good.result) == "ok 1 - A.TestOne\n");
    const Finished skipped = finished("A.TestTwo", Outcome::Skipped, "part #7");
    CHECK(tapText(2, skipped.test, skipped.result) == "ok 2 - A.TestTwo # SKIP part \\#7\n");
    Finished bad = finished("A.TestThree", Outcome::Failed, "expected \"a\"");
    bad.result.expected = "\"a\"";
    bad.result.actual = "\"b\"";
    CHECK(tapText(3, bad.test, bad.result) ==
          "not ok 3 - A.TestThree\n  ---\n  message: \"expected \\\"a\\\"\"\n  severity: fail\n  outcome: "
          "failed\n"
          "  at:\n    file: \"cell/A.modx\"\n    line: 12\n    column: 3\n"
          "  expected: \"\\\"a\\\"\"\n  actual: \"\\\"b\\\"\"\n  ...\n");
}

TEST_CASE("TAP 14: every byte that RAPID's strings hold makes readable YAML in UTF-8", "[testing]") {
    std::string bytes;
    for (int byte = 0; byte < 256; ++byte)
        bytes += static_cast<char>(byte);
    for (const Outcome outcome : {Outcome::Error, Outcome::Skipped}) {
        Finished one = finished("A.TestOne", outcome, bytes + "\n\xC3\xA9 whole");
        one.result = inUtf8(one.result);
        const std::string text = tapText(1, one.test, one.result);
        for (const char c : text) // YAML 1.2, c-printable; TAP: lines without control characters
            CHECK(((static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) || c == '\n'));
        CHECK(has(text, "\xC3\xBF"));       // byte FF: ISO 8859-1
        CHECK(has(text, "\xC3\xA9 whole")); // UTF-8 stays
        CHECK_FALSE(has(text, "\xFF"));
        if (outcome == Outcome::Error) CHECK(has(text, "\\x7f\\x80\\x81"));
    }
}

TEST_CASE("totals for people", "[testing]") {
    CHECK(humanTotals(totalsOf({finished("A.T", Outcome::Passed)})) == "1 test: 1 passed\n");
    CHECK(humanTotals(totalsOf({finished("A.T", Outcome::Failed), finished("A.U", Outcome::Error),
                                finished("A.V", Outcome::Timeout), finished("A.W", Outcome::Skipped)})) ==
          "4 tests: 0 passed, 1 failed, 1 error, 1 timed out, 1 skipped\n");
    CHECK(totalsOf({finished("A.T", Outcome::Skipped)}).isGood());
    CHECK_FALSE(totalsOf({finished("A.T", Outcome::Timeout)}).isGood());
}

TEST_CASE("a result survives the way from process to process", "[testing]") {
    TestResult result = finished("A.TestOne", Outcome::Error, "why").result;
    result.expected = "1";
    result.actual = "2";
    result.calls = {{"a.modx", "A", "caller", 4, 5}};
    result.assertions = 3;
    result.virtualTime = 1'500'000'000;
    result.executed[{2, 3}] = 17;
    const std::string bytes = pack(result);
    TestResult read;
    REQUIRE(unpack(bytes, read));
    CHECK(read.outcome == Outcome::Error);
    CHECK(read.message == "why");
    CHECK(read.spot.text() == "cell/A.modx:12");
    CHECK(read.calls.at(0).routine == "caller");
    CHECK(read.assertions == 3);
    CHECK(read.virtualTime == 1'500'000'000);
    CHECK(read.executed.at({2, 3}) == 17);
    // a process that ended in the middle of it
    for (size_t size = 0; size < bytes.size(); ++size) {
        TestResult cut;
        CHECK_FALSE(unpack(std::string_view(bytes).substr(0, size), cut));
    }
}

TEST_CASE("filters: parts, patterns, exclusion", "[testing]") {
    std::vector<TestCase> tests;
    for (const char* id : {"Cell.TestGrip", "Cell.TestRelease", "Pallet.TestSlot"})
        tests.push_back(finished(id, Outcome::Passed).test);
    const auto ids = [&](const std::vector<std::string>& patterns) {
        std::string text;
        for (const TestCase& test : filterTests(tests, patterns))
            text += test.name + " ";
        return text;
    };
    CHECK(ids({}) == "TestGrip TestRelease TestSlot ");
    CHECK(ids({"grip"}) == "TestGrip ");
    CHECK(ids({"cell.*"}) == "TestGrip TestRelease ");
    CHECK(ids({"test?lot"}) == "TestSlot ");
    CHECK(ids({"Cell", "!*grip"}) == "TestRelease ");
    CHECK(ids({"!Cell"}) == "TestSlot ");
    CHECK(ids({"lot", "grip"}) == "TestGrip TestSlot ");
    CHECK(ids({"*x*"}).empty());
}

TEST_CASE("shuffled tests: the same order for the same number, none lost", "[testing]") {
    std::vector<TestCase> first;
    for (int i = 0; i < 20; ++i)
        first.push_back(finished("A.Test" + std::to_string(i), Outcome::Passed).test);
    std::vector<TestCase> second = first, other = first;
    const std::vector<TestCase> original = first;
    shuffleTests(first, 4);
    shuffleTests(second, 4);
    shuffleTests(other, 5);
    const auto names = [](const std::vector<TestCase>& tests) {
        std::vector<std::string> result;
        for (const TestCase& test : tests)
            result.push_back(test.name);
        return result;
    };
    CHECK(names(first) == names(second));
    CHECK(names(first) != names(other));
    CHECK(names(first) != names(original));
    auto sorted = names(first), wanted = names(original);
    std::sort(sorted.begin(), sorted.end());
    std::sort(wanted.begin(), wanted.end());
    CHECK(sorted == wanted);
}

TEST_CASE("coverage: lines of all tests together, as lcov", "[testing]") {
    const rt::StmtDesc statements[] = {{3, 5, 3, 9, rt::kStmtPlain, 0, 0, rt::kCanStart, -1},
                                       {4, 5, 4, 9, rt::kStmtPlain, 0, 0, rt::kCanStart, 0},
                                       {4, 11, 4, 15, rt::kStmtPlain, 0, 0, rt::kCanStart, 1},
                                       {6, 5, 6, 9, rt::kStmtPlain, 0, 0, rt::kCannotStart, 2}};
    rt::RoutineDesc routine{}, own{};
    routine.name = "place";
    routine.module = own.module = "Cell";
    routine.file = own.file = "Cell.modx";
    routine.statements = own.statements = statements;
    routine.statementCount = own.statementCount = 4;
    routine.line = 2;
    own.name = "TestPlace";
    own.line = 20;
    rt::RoutineEntry entries[2] = {};
    entries[0].desc = &own;
    entries[1].desc = &routine;
    rt::ProgramDesc program{};
    program.routines = entries;
    program.routineCount = 2;
    Coverage coverage(program,
                      [](const rt::RoutineDesc& desc) { return std::string_view(desc.name) != "TestPlace"; });
    TestResult one, two;
    one.executed = {{{1, 0}, 2}, {{0, 0}, 9}};
    two.executed = {{{1, 0}, 1}, {{1, 2}, 4}};
    coverage.add(one);
    coverage.add(two);
    const std::vector<CoveredFile> files = coverage.files();
    CHECK(lcovText(files) == "TN:rapidc\nSF:Cell.modx\nFN:2,place\nFNDA:3,place\nFNF:1\nFNH:1\n"
                             "DA:3,3\nDA:4,4\nLF:2\nLH:2\nend_of_record\n");
    CHECK(coverageSummary(files) == "covered 2 of 3 statements (66.7 %)\n   66.7 %  Cell.modx\n");
    const std::string page = coveragePage(files, [](const std::string&) { return "a\n<b>\nc\nd & e\n"; });
    CHECK(has(page, "<span class=\"none\">"));
    CHECK(has(page, "&lt;b&gt;"));
    CHECK(has(page, "4x     4</i>d &amp; e</span>"));
}

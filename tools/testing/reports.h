#pragma once
// Results of tests as text: for people, TAP version 13, JUnit XML, JSON.

#include "tools/testing/test_case.h"
#include "tools/testing/test_result.h"

#include <string>
#include <vector>

namespace testing {

struct Finished {
    TestCase test;
    TestResult result;
};

struct Totals {
    std::size_t passed = 0, failed = 0, errors = 0, timeouts = 0, skipped = 0;
    std::size_t all() const { return passed + failed + errors + timeouts + skipped; }
    bool isGood() const { return failed + errors + timeouts == 0; }
    void add(Outcome outcome);
};
Totals totalsOf(const std::vector<Finished>& results);

/// One test for people, with line ends. `withOutput`: what it wrote, even when it passed.
std::string humanText(const TestCase& test, const TestResult& result, bool withOutput, bool colour);
/// "5 tests: 3 passed, 1 failed, 1 skipped", with line end.
std::string humanTotals(const Totals& totals);

std::string tapHead(std::size_t tests);
/// `number` from 1.
std::string tapText(std::size_t number, const TestCase& test, const TestResult& result);

/// A document with a suite for each module.
std::string junitText(const std::vector<Finished>& results);
/// An object with the results and their totals; indented.
std::string jsonText(const std::vector<Finished>& results);
/// The tests without results, as an array.
std::string listJson(const std::vector<TestCase>& tests);

} // namespace testing

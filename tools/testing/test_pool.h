#pragma once
// TestPool: each test in a process of its own, several at a time.

#include "tools/testing/test_case.h"
#include "tools/testing/test_result.h"

#include <functional>
#include <vector>

namespace testing {

struct PoolOptions {
    unsigned jobs = 1;
    double timeout = 60; ///< s of the wall clock, unless a test has its own
};

/// Executes a test in the new process. Output goes to stdout, events to stderr.
using TestBody = std::function<TestResult(const TestCase&)>;
/// Called in the order of the tests, as soon as all before are done.
using TestDone = std::function<void(const TestCase&, const TestResult&)>;

/// Runs all tests; those with a problem or a skip directive are not started. False when a signal (StopSignals) ended it: then the
/// rest has not been run.
bool runTests(const std::vector<TestCase>& tests, const PoolOptions& options, const TestBody& body,
              const TestDone& done);

} // namespace testing

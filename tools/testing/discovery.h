#pragma once
// Finds the tests of a program.

#include "frontend/sema/checked.h"
#include "tools/testing/test_case.h"

#include <string_view>
#include <vector>

namespace testing {

/// All tests in the order of tasks, modules and declarations. A module that several tasks share counts once.
std::vector<TestCase> findTests(const rapid::sema::CheckedProgram& program);

/// A procedure that rapidc test calls: a test, SetUp or TearDown. It must be found by name when the program runs.
bool isTestRoutine(const rapid::sema::RoutineSymbol& routine);

/// Which tests are meant: patterns for id, module or name with * and ?, without them parts of the id; '!' before one leaves
/// tests out. No pattern: all.
std::vector<TestCase> filterTests(const std::vector<TestCase>& tests,
                                  const std::vector<std::string>& patterns);

/// Another order, the same for the same number on every machine.
void shuffleTests(std::vector<TestCase>& tests, uint32_t seed);

} // namespace testing

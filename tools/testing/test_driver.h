#pragma once
// Runs one test on a controller of its own: SetUp, the test, TearDown.

#include "runtime/abi/rt_abi.h"
#include "runtime/host/module_loader.h"
#include "runtime/host/module_store.h"
#include "runtime/host/run_options.h"
#include "tools/testing/test_case.h"
#include "tools/testing/test_result.h"

#include <memory>

namespace testing {

/// Common to all tests of a program.
struct TestProgram {
    const rt::ProgramDesc* program = nullptr;
    rt::RunOptions options;      ///< configuration, robots; limits that a test itself does not give
    bool withOtherTasks = false; ///< the other tasks execute their main as well
    bool withCoverage = false;   ///< the program is one of the stepping profile
};

/// Executes the test in this process. Output of the program goes to stdout, its events to stderr. `loader` serves Load.
TestResult runTest(const TestProgram& program, const TestCase& test, rt::ModuleLoader& loader,
                   std::unique_ptr<rt::ModuleStore> store);

} // namespace testing

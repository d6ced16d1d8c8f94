#pragma once
// Coverage: which statements of a program the tests have executed, all tests together.

#include "runtime/abi/rt_abi.h"
#include "tools/testing/test_result.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace testing {

struct CoveredRoutine {
    std::string name;
    uint32_t line = 0;  ///< of the declaration
    uint64_t calls = 0; ///< how often its first statement was executed
    uint32_t statements = 0, executed = 0;
};

struct CoveredFile {
    std::string path;
    std::map<uint32_t, uint64_t>
        lines; ///< lines where statements begin: how often the most frequent one was executed
    std::vector<CoveredRoutine> routines; ///< in the order of their lines
    uint32_t statements = 0, executed = 0;
};

class Coverage {
  public:
    /// Statements of routines of the program; `isCounted` leaves routines out (the tests themselves).
    Coverage(const rt::ProgramDesc& program, const std::function<bool(const rt::RoutineDesc&)>& isCounted);
    void add(const TestResult& result);

    /// In the order of their paths.
    std::vector<CoveredFile> files() const;

  private:
    struct Row {
        const rt::RoutineDesc* routine = nullptr; ///< null: not counted
        std::vector<uint64_t> counts;
    };
    std::vector<Row> rows_;
};

/// Percentage of the whole; 100 of nothing.
double percent(uint32_t part, uint32_t whole);
/// A trace file of lcov (.info).
std::string lcovText(const std::vector<CoveredFile>& files);
/// "covered 12 of 15 statements (80.0 %)", then a line for each file.
std::string coverageSummary(const std::vector<CoveredFile>& files);
/// A page without further files. `textOf` gives the text of a source as UTF-8.
std::string coveragePage(const std::vector<CoveredFile>& files,
                         const std::function<std::string(const std::string& path)>& textOf);

} // namespace testing

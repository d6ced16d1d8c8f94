#pragma once
// TestResult: how a test ended.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace testing {

enum class Outcome : uint8_t {
    Passed,
    Failed,  ///< an assertion did not hold
    Error,   ///< an execution error, Stop, EXIT, a crash; the test could not be run
    Timeout, ///< of virtual time or of the wall clock; or it waits for something that cannot happen
    Skipped,
};

/// "passed", "failed" ...
const char* nameOf(Outcome outcome);

struct Spot {
    std::string file, module, routine;
    uint32_t line = 0, column = 0; ///< from 1; 0: not known
    /// "file:line"; without a file "module:line", "" when nothing is known.
    std::string text() const;
};

struct TestResult {
    Outcome outcome = Outcome::Passed;
    Spot spot;                    ///< where it failed
    std::string message;          ///< one sentence, or several
    std::string expected, actual; ///< of an assertion, in RAPID's notation
    std::vector<Spot> calls;      ///< callers of `spot`, innermost first
    uint64_t assertions = 0;      ///< that were executed
    int64_t virtualTime = 0;      ///< ns
    double wallTime = 0;          ///< s
    std::string output;           ///< what TPWrite wrote
    std::string events;           ///< event log and dialogs as people read them
    /// How often statements were executed, by the number of the routine in the program and that of the statement.
    std::map<std::pair<uint32_t, uint32_t>, uint64_t> executed;
};

/// With texts in UTF-8, as reports have them: a line that is not UTF-8 is read as ISO 8859-1, in which controllers write.
TestResult inUtf8(TestResult result);

/// From process to process; output and events are not part of it.
std::string pack(const TestResult& result);
/// False when the bytes are not those of pack().
bool unpack(std::string_view bytes, TestResult& result);

} // namespace testing

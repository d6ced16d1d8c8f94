#pragma once
// TestCase: a test that was found in a program.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace testing {

struct TestCase {
    std::string id;           ///< Module.Name; TASK:Module.Name in a program of several tasks
    std::string task;         ///< by name,
    uint32_t taskIndex = 0;   ///< and its place in the program
    std::string module, name; ///< as declared
    std::string file;
    uint32_t line = 0, column = 0, endLine = 0; ///< of the declaration, from 1
    bool hasSetUp = false, hasTearDown = false; ///< the module has these routines
    std::string problem; ///< why it cannot be run: it has parameters, a directive is wrong; "" when it can
    // Directives (`!@ key: value`) above the routine
    std::optional<std::string> skip; ///< the reason
    std::optional<double> maxTime;   ///< s of virtual time
    std::optional<double> timeout;   ///< s of the wall clock
    std::optional<uint32_t> seed;
    std::string stimulusFile;  ///< path; "" for none
    std::string stimulusLines; ///< written in directives, as in a file
};

/// The names of fixture routines; compared without regard to case.
inline constexpr const char* kSetUp = "SetUp";
inline constexpr const char* kTearDown = "TearDown";
inline constexpr const char* kTestPrefix = "test";

} // namespace testing

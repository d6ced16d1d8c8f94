#pragma once
// Takes modules the whole way: check, lower, verify, machine code, a bounded run. What check accepts must come through, and
// must do the same in all profiles.

#include "frontend/sema/checker.h"

#include <string>
#include <vector>

namespace rapid::fuzz {

struct Way {
    bool stepping = false;
    bool optimise = true;
    bool interpreted = false;
    bool records = false; ///< events, signals and errors are part of the result
    bool inParts = false; ///< compiled routine by routine when they are called, as large programs are
};

struct RunResult {
    int status = 0;
    std::string output;                  ///< of TPWrite
    std::string events, signals, errors; ///< the files that a run writes; empty without Way::records
};

/// Texts of the modules of each task; the first one is T_ROB1.
using TaskTexts = std::vector<std::vector<std::string>>;

/// The results of this built-in differ from run to run.
bool dependsOnWallTime(std::string_view name);

class ProgramRunner {
  public:
    ProgramRunner();
    /// The library alone, checked.
    const sema::CheckedProgram& library() const { return *library_; }
    /// True when there are no errors; then run() can be called. `robots`: how many of the tasks have one.
    bool check(const TaskTexts& tasks, size_t robots = 1);
    /// Errors of the last check, for people.
    const std::string& errors() const { return errors_; }
    /// The modules of the last check, with their names.
    const std::string& sources() const { return sources_; }
    /// The program of the last check; lower it only when check() returned true.
    const sema::CheckedProgram& program() const { return *program_; }
    const sema::CheckOptions& options() const { return options_; }
    /// One file for each module; its name begins with that of the task.
    static std::vector<sema::TaskInput> inputsOf(const TaskTexts& tasks, size_t robots);
    /// Breaks off the process with a message when the program does not come through.
    RunResult run(Way way);

  private:
    std::vector<sema::LibraryText> texts_;
    sema::CheckOptions options_;
    std::unique_ptr<sema::CheckedProgram> library_, program_;
    std::string errors_, sources_;
    bool refusable_ = false; ///< it names what a controller may have, but this one has not
};

/// How many programs were tried and how many of them check has accepted.
struct Tally {
    size_t all = 0, accepted = 0, compared = 0, ended = 0; ///< ended: without an unhandled error
};

/// Checks, runs in two profiles, compares what they print unless `hasTime`. False: check refuses the program. `optimise`: the
/// release profile with the optimiser, as a whole and in parts, which must print the same.
bool tryProgram(ProgramRunner& runner, const TaskTexts& tasks, bool hasTime, bool optimise);

/// Checks, and compares output, events, signals with their times, and errors of all profiles. False: check refuses the program.
/// `optimise`: the release profile with the optimiser as well, as a whole and in parts.
bool tryTasks(ProgramRunner& runner, const TaskTexts& tasks, size_t robots, bool optimise = false);

/// Of tryProgram() in this process; shown when it ends. RAPIDC_FUZZ_SHOW=1 shows programs and refusals as well.
Tally& tally();

} // namespace rapid::fuzz

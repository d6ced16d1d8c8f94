#pragma once
// What the tests of queries share: programs with marked places, `$1` to `$9`, which are taken out of the text.

#include "frontend/query/completion.h"

#include "tests/unit/sema/sema_testing.h"

#include <map>

namespace rapid::query::testing {

/// A text without its markers, and where they were.
struct MarkedText {
    std::string text;
    std::map<int, uint32_t> places;
};
MarkedText withoutMarkers(std::string_view text);

/// A checked program of modules with marked places. Markers are numbered over all modules.
class Program {
  public:
    explicit Program(std::vector<std::string> texts, std::vector<std::string> configuration = {},
                     sema::CheckOptions options = {});
    /// Tasks, each a list of modules.
    static Program ofTasks(std::vector<std::vector<std::string>> tasks);

    const Snapshot& snapshot() const { return *snapshot_; }
    const FileView& file(int marker = 1) const;
    uint32_t offset(int marker = 1) const { return places_.at(marker).second; }
    const sema::CheckedProgram& checked() const { return *checked_->program; }
    sema::testing::Checked& result() const { return *checked_; }
    const std::vector<sema::TaskInput>& tasks() const { return tasks_; }
    const sema::CheckOptions& options() const { return options_; }

  private:
    Program() = default;
    void open(std::vector<std::vector<std::string>> tasks, std::vector<std::string> configuration);

    sema::CheckOptions options_;
    std::vector<sema::TaskInput> tasks_;
    std::unique_ptr<sema::testing::Checked> checked_;
    std::unique_ptr<Snapshot> snapshot_;
    std::map<int, std::pair<std::string, uint32_t>> places_; ///< path and offset
};

/// The body of `PROC main()` in a module, with declarations before it.
std::string inMain(std::string_view body, std::string_view declarations = {});

} // namespace rapid::query::testing

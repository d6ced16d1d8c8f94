#pragma once
// What is said of a checked program besides the messages of the check itself: built-ins that are not implemented, warnings
// of 8xxx, comments that switch warnings; and the levels of all warnings.

#include "frontend/lint/lint.h"
#include "frontend/workspace/compilation.h"

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>

namespace rapid::workspace {

/// Built-ins that are called but declared only: each is reported once, at its first call.
class UnimplementedCalls {
  public:
    explicit UnimplementedCalls(const Environment& environment);
    /// Takes in the modules of one file, which several tasks may load.
    void file(const sema::CheckedProgram& program, std::span<sema::Module* const> modules);
    void report(diag::Sink& sink) const;

  private:
    void findRoutines(const sema::CheckedProgram& program);

    struct Use {
        std::shared_ptr<const SourceFile> file;
        SourceRange first;
        size_t count = 0;
    };

    std::unordered_set<std::string_view> names_;
    bool known_ = false;
    std::set<std::shared_ptr<const SourceFile>> seen_;
    std::map<std::string, Use> uses_;
    std::unordered_set<const sema::RoutineSymbol*> routines_;
};

/// One look at a program, file by file and then as a whole. Refers to its arguments until it ends.
class Judge {
  public:
    Judge(const Compilation& compilation, const Environment& environment, diag::Sink& sink);
    /// The modules of one file, as soon as it is checked.
    void file(const sema::CheckedProgram& program, const sema::Task& task,
              std::span<sema::Module* const> modules);
    /// All files of a program that is checked already.
    void files(const sema::CheckedProgram& program);
    /// When all files are through. `sink` then has everything, with its final levels.
    void finish(const sema::CheckedProgram& program, std::span<const sema::TaskInput> tasks);

  private:
    const Compilation& compilation_;
    diag::Sink& sink_;
    UnimplementedCalls unimplemented_;
    lint::Lint lint_;
};

} // namespace rapid::workspace

#pragma once
// Warnings worth reading (8xxx): what is correct RAPID and yet probably a mistake. Runs over the checked program.

#include "frontend/lint/warnings.h"
#include "frontend/sema/checked.h"

#include <memory>
#include <set>
#include <string>

namespace rapid::lint {

/// Reports the warnings that `levels` has switched on. Routines and modules with errors in `sink` are left out; what
/// depends on the whole program is judged only when the program is whole.
void lint(const sema::CheckedProgram& program, const WarningLevels& levels, diag::Sink& sink);

/// The same in steps, while a program is being checked: what is inside the routines of a file is looked at once.
class Lint {
  public:
    /// Refers to both until it ends. `configured`: what the configuration files name, in lower case: routines among it
    /// are called from outside.
    Lint(const WarningLevels& levels, diag::Sink& sink, bool severalTasks,
         std::set<std::string> configured = {});
    ~Lint();
    Lint(const Lint&) = delete;
    Lint& operator=(const Lint&) = delete;
    /// The modules of one file, when it is checked.
    void file(const sema::CheckedProgram& program, const sema::Task& task,
              std::span<sema::Module* const> modules);
    /// Judgements that need the whole program, when all files have been read.
    void finish(const sema::CheckedProgram& program);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace rapid::lint

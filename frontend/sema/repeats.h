#pragma once
// Errors that one mistake explains: they are reported once, with a note for each place.

#include "frontend/sema/one_mistake.h"
#include "frontend/sema/part.h"

namespace rapid::sema {

class Repeats : CheckerPart {
  public:
    Repeats(State& state, const Parts& parts);

    /// While the routines of a file are known: which of its unknown names have one cause.
    void gatherUnknown(std::span<Module* const> modules);
    /// The same for declarations and uses that contradict each other. `first`: of the errors reported while the file was checked.
    void gatherRepeats(std::span<Module* const> modules, size_t first);
    /// When all files are known: the last pass over the diagnostics of the task. Causes that one mistake explains are
    /// merged into its report.
    void mergeCauses();

  private:
    void explainUnknown(const Module& module);
    void explainByType(const Module& module, std::string_view declared);
    bool explainUnknown(const Module& module, SourceRange where, bool routines, size_t lost);

    Scopes& scopes_;
    std::vector<Repeat> repeats_; ///< errors of the files checked so far that one mistake explains
};

} // namespace rapid::sema

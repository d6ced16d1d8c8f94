#pragma once
// One mistake reported in several places: a declaration with a wrong type makes each use of it wrong.

#include "frontend/sema/reports.h"

#include <span>
#include <string>
#include <vector>

namespace rapid::sema {

/// Errors of one file that one mistake explains.
struct Repeat {
    std::vector<diag::Diagnostic> members; ///< in the order of the text
    /// Reported instead, with a note for each member; without it the first member is reported for all.
    struct Declared {
        SourceRange type; ///< as the declaration names it
        std::string name, found, needed;
        std::string replacement; ///< of the type; empty: not known
    };
    std::vector<Declared> declared; ///< one or none
    const Symbol* guard = nullptr;  ///< what other files may use, too; null: nothing
};

/// What `said`, the errors of one file, report more than once: declarations that all uses contradict in the same way, and
/// data that all instructions need of a different kind. `modules`: those of the file, whose routines are still known;
/// `misfits`: the places of the tree that the reports are about.
std::vector<Repeat> findRepeats(const CheckedProgram& program, std::span<Module* const> modules,
                                const std::vector<const diag::Diagnostic*>& said,
                                std::span<const ReportedMisfit> misfits);

/// When everything is reported: the first report about the words of a line that lacks its semicolon, and the one that says so,
/// become one report.
void mergeLineCauses(diag::Sink& sink);

} // namespace rapid::sema

#pragma once
// The common part of the tests of the checker: the library as text, checking of a text, the diagnostics in short form.

#include "frontend/sema/checker.h"

#include <memory>
#include <string>
#include <vector>

namespace rapid::sema::testing {

/// The whole text of a file; empty if it cannot be read.
std::string readFile(const std::string& path);

/// All declaration files of the standard library, read from the source tree once.
std::span<const LibraryText> library();

struct Checked {
    std::unique_ptr<CheckedProgram> program;
    diag::Sink sink;
    /// "RAP2104 at 5:10: message", sorted, notes (severity) left out.
    std::vector<std::string> messages() const;
    /// Codes alone, sorted by place.
    std::vector<std::string> codes() const;
};

/// Checks the texts as files of one task.
std::unique_ptr<Checked> checkTexts(const std::vector<std::string>& texts, CheckOptions options = {});
/// Checks several tasks, each a list of texts.
std::unique_ptr<Checked> checkTasks(const std::vector<std::vector<std::string>>& tasks,
                                    CheckOptions options = {});

/// Finds data, a routine or a type at module level of the first task, or null.
const Symbol* findSymbol(const CheckedProgram& program, std::string_view name);

} // namespace rapid::sema::testing

#include "tools/rapidc/apply_fixes.h"

#include "config/atomic_file.h"
#include "config/temporary.h"
#include "frontend/edit/apply_edits.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapidc {

using rapid::SourceFile;
using rapid::SourceRange;
using rapid::TextEdit;
using rapid::diag::Diagnostic;

namespace {

/// True as well when one begins where the other ends: the text between them then is not known.
bool touch(SourceRange a, SourceRange b) {
    return a.begin <= b.end && b.begin <= a.end;
}

struct FileFixes {
    std::shared_ptr<const SourceFile> file;
    std::vector<TextEdit> edits;
    size_t count = 0;

    /// A module that several tasks share is checked, and its fixes are found, several times.
    void add(const Diagnostic::Fix& fix) {
        for (const TextEdit& fresh : fix.edits)
            for (const TextEdit& taken : edits)
                if (touch(fresh.range, taken.range)) return;
        edits.insert(edits.end(), fix.edits.begin(), fix.edits.end());
        ++count;
    }
};

} // namespace

FixOutcome applyCertainFixes(std::span<const Diagnostic> diagnostics) {
    std::map<std::string, FileFixes> files;
    for (const Diagnostic& diagnostic : diagnostics) {
        const auto certain = std::find_if(diagnostic.fixes.begin(), diagnostic.fixes.end(),
                                          [](const Diagnostic::Fix& fix) { return fix.certain; });
        if (!diagnostic.file || certain == diagnostic.fixes.end()) continue;
        FileFixes& fixes = files[diagnostic.file->path()];
        if (!fixes.file) fixes.file = diagnostic.file;
        fixes.add(*certain);
    }
    FixOutcome outcome;
    std::vector<std::string> paths;
    for (const auto& [path, fixes] : files)
        paths.push_back(path);
    rapid::config::removeLeftoversBeside(paths);
    for (const auto& [path, fixes] : files) {
        const rapid::edit::EditResult changed = rapid::edit::applyEdits(*fixes.file, fixes.edits);
        const std::string problem = changed.ok()
                                        ? rapid::config::replaceFile(path, changed.bytes)
                                        : fmt::format("'{}' is left as it is: {}", path, changed.problem);
        if (problem.empty())
            outcome.fixed[path] = fixes.count;
        else
            outcome.problems.push_back(problem);
    }
    return outcome;
}

} // namespace rapidc

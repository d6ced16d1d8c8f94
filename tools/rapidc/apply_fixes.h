#pragma once
// check --fix: the certain fixes of diagnostics, applied to the files they are about.

#include "frontend/diag/diagnostic.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace rapidc {

struct FixOutcome {
    std::map<std::string, size_t> fixed; ///< number of fixes by path of the file
    std::vector<std::string> problems;   ///< files that could not be changed, and why
};

/// Writes every file for which there are certain fixes, each at once and whole (rapid::config::replaceFile). Fixes that touch
/// each other are not applied together: check again and call it again.
FixOutcome applyCertainFixes(std::span<const rapid::diag::Diagnostic> diagnostics);

} // namespace rapidc

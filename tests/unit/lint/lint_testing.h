#pragma once
// The common part of the tests of the warnings: checks texts and gives the remaining diagnostics.

#include "frontend/lint/lint.h"

#include <string>
#include <vector>

namespace rapid::lint::testing {

/// Checks the texts as files of one task, with all warnings and the comments in the texts; "RAP8003 at 5:10: message",
/// sorted.
std::vector<std::string> messages(const std::vector<std::string>& texts, const WarningLevels& levels = {});

/// Codes alone, sorted by place.
std::vector<std::string> codes(const std::vector<std::string>& texts, const WarningLevels& levels = {});

/// Codes of the warnings of several tasks, each a list of texts.
std::vector<std::string> codesOfTasks(const std::vector<std::vector<std::string>>& tasks);

} // namespace rapid::lint::testing

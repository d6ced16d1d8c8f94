#pragma once
// The common part of the tests of the formatter.

#include "frontend/edit/apply_edits.h"
#include "frontend/format/formatter.h"
#include "unit/syntax/syntax_test.h"

namespace rapid::test {

/// The formatted text, or "refused: why".
inline std::string formatText(const std::string& text, const format::FormatRequest& request = {},
                              const std::string& path = "test.modx") {
    const Parsed parsed = parseText(text, request.declarations, path);
    const auto result = format::format(*parsed.tree, format::errorRanges(parsed.sink), request);
    if (!result.ok()) return "refused: " + result.problem;
    const auto changed = edit::applyEdits(*parsed.tree->source, result.edits);
    return changed.ok() ? changed.bytes : "refused: " + changed.problem;
}

} // namespace rapid::test

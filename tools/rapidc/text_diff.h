#pragma once
// A change of a text as people and `patch` read it.

#include "frontend/source/source_file.h"

#include <span>
#include <string>

namespace rapidc {

/// Unified diff with three lines of context. `edits` are in order, do not overlap and belong to the text of `file`.
std::string unifiedDiff(const rapid::SourceFile& file, std::span<const rapid::TextEdit> edits);

} // namespace rapidc

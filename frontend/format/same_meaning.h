#pragma once
// The formatter's own check: is the new text the old one but for layout?

#include "frontend/syntax/ast.h"

#include <optional>

namespace rapid::format {

/// No value when both trees have the same tokens (names and words in any case), the same comments (white space at their
/// ends apart) and, if `nodes`, the same nodes; else the place in the old text where they begin to differ.
std::optional<SourceRange> findDifference(const syntax::SyntaxTree& before, const syntax::SyntaxTree& after,
                                          bool nodes);

} // namespace rapid::format

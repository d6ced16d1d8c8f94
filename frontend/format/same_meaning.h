#pragma once
// The formatter's own check: is the new text the old one but for layout?

#include "frontend/syntax/ast.h"

#include <string>

namespace rapid::format {

/// Empty when both trees have the same tokens (names and words in any case), the same comments (white space at their
/// ends apart) and, if `nodes`, the same nodes; else the first difference, for people.
std::string findDifference(const syntax::SyntaxTree& before, const syntax::SyntaxTree& after, bool nodes);

} // namespace rapid::format

#pragma once
// Whether two tokens of a line are separated by a space.

#include "frontend/format/line_plan.h"

namespace rapid::format {

/// True when one space separates token `next` from the one before it, both on one line.
bool spaceBetween(const syntax::SyntaxTree& tree, const std::vector<TokenPlan>& plan,
                  const FormatSettings& settings, syntax::TokenIndex next);

} // namespace rapid::format

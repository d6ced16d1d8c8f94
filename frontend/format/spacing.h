#pragma once
// Whether a space stands between two tokens of a line.

#include "frontend/format/line_plan.h"

namespace rapid::format {

/// True when one space stands between token `next` and the one before it, both on one line.
bool spaceBetween(const syntax::SyntaxTree& tree, const std::vector<TokenPlan>& plan,
                  const FormatSettings& settings, syntax::TokenIndex next);

} // namespace rapid::format

#pragma once
// The position of every token and comment: the white space before each atom.

#include "frontend/format/atoms.h"
#include "frontend/format/line_plan.h"

namespace rapid::format {

/// White space before one atom: `newlines` line ends, then `levels` times the indentation and `spaces`.
struct Gap {
    uint32_t newlines = 0;
    uint32_t levels = 0;
    uint32_t spaces = 0;
    bool keep = false; ///< the white space stays as it is
};

/// One gap for each atom.
std::vector<Gap> layOut(const syntax::SyntaxTree& tree, const std::vector<Atom>& atoms,
                        const std::vector<TokenPlan>& plan, const FormatSettings& settings);

} // namespace rapid::format

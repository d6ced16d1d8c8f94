#pragma once
// Formats a module: white space and the case of keywords change, nothing else.

#include "frontend/diag/diagnostic.h"
#include "frontend/format/format_settings.h"
#include "frontend/syntax/ast.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace rapid::format {

/// Spelling of predefined names by their lower-case form; see canonical_names.h.
using NameTable = std::unordered_map<std::string, std::string>;

struct FormatRequest {
    FormatSettings settings;
    /// Only these lines of the text are changed, both inclusive, from 1; columns are those of the whole file.
    uint32_t firstLine = 1;
    uint32_t lastLine = UINT32_MAX;
    /// Declarations in which a mistake lies stay as they are; without it a tree with mistakes is refused.
    bool keepErrors = false;
    bool declarations = false;        ///< the text declares built-ins, see syntax::ParseOptions
    const NameTable* names = nullptr; ///< for NameCase::Canonical
};

struct [[nodiscard]] FormatResult {
    std::vector<TextEdit> edits; ///< in the order of the text; empty: it is formatted already
    std::string problem;         ///< why there are no edits; empty: success
    bool ok() const { return problem.empty(); }
};

/// Places of the errors that reading a file gave.
std::vector<SourceRange> errorRanges(const diag::Sink& sink);

/// The edits that format the text of `tree`. `errors` are the places of its mistakes (see errorRanges). Comments stay
/// as they are but for white space at their ends. Before it answers, the changed text is read again: if its tokens,
/// comments or tree were not those of `tree`, the result is a problem and no edit.
FormatResult format(const syntax::SyntaxTree& tree, const std::vector<SourceRange>& errors,
                    const FormatRequest& request);

} // namespace rapid::format

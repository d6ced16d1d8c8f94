#pragma once
// The parameters of the call around an offset, of functions and of instructions without parentheses.

#include "frontend/query/cursor.h"

namespace rapid::query {

struct SignatureParameter {
    uint32_t begin = 0, end = 0; ///< bytes in SignatureHelp::label
    std::string documentation;
};

struct SignatureHelp {
    std::string label; ///< "PROC report(string text\num count)"
    std::string documentation;
    std::vector<SignatureParameter> parameters;
    int active = -1;  ///< parameter at the offset; -1: none
    SourceRange name; ///< of the routine, in the call
};

/// Of the innermost call. None outside of calls, in comments, and for names that are not routines.
std::optional<SignatureHelp> signatureHelpAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);

} // namespace rapid::query

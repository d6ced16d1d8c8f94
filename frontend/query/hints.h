#pragma once
// What an editor shows between the lines: names of parameters, values of constants, lenses above routines.

#include "frontend/query/name_walk.h"

namespace rapid::query {

struct InlayHint {
    uint32_t offset = 0;
    std::string label;       ///< "ToPoint:" before an argument, "= 10" after a constant
    bool isParameter = true; ///< else: a value
    std::string tooltip;
};
/// The name of the parameter before each required argument without a name; the value of constants that are not literals.
std::vector<InlayHint> inlayHints(const Snapshot& snapshot, const FileView& file, SourceRange range,
                                  const Cancel* cancel = nullptr);

/// A line above a routine. The texts are the editor's: `references` counts are asked for one by one (countUses).
struct CodeLens {
    SourceRange range; ///< the name of the routine
    std::string routine;
    std::string module;
    std::string task;
    bool canRun = false; ///< a procedure without required parameters
    std::string key;     ///< of the routine (item_key.h), for countReferences
};
std::vector<CodeLens> codeLenses(const Snapshot& snapshot, const FileView& file);
/// Uses of the routine of a lens; 0 when it is not there any more.
size_t countReferences(const Snapshot& snapshot, std::string_view key, const Cancel* cancel = nullptr);

} // namespace rapid::query

#pragma once
// Outline of a file, and names of the whole workspace.

#include "frontend/query/meaning.h"

namespace rapid::query {

enum class OutlineKind : uint8_t {
    Module,
    Record,
    Component,
    Alias,
    Constant,
    Variable,
    Persistent,
    Procedure,
    Function,
    Trap
};

struct OutlineSymbol {
    std::string name;
    std::string detail; ///< "num", "(string text)"
    OutlineKind kind = OutlineKind::Module;
    SourceRange range;                   ///< of the whole declaration
    SourceRange selection;               ///< of the name, within `range`
    std::vector<OutlineSymbol> children; ///< in the order of the text
};

/// One symbol for each module, from the tree alone: no check is needed, and mistakes leave out only what has no name.
std::vector<OutlineSymbol> outlineOf(const syntax::SyntaxTree& tree);

struct WorkspaceSymbol {
    std::string name;
    std::string container; ///< the module
    OutlineKind kind = OutlineKind::Module;
    Location place;
};
/// Types, data of modules, routines and modules whose names have the letters, the best matches first.
std::vector<WorkspaceSymbol> workspaceSymbols(const Snapshot& snapshot, std::string_view letters,
                                              size_t limit = 500, const Cancel* cancel = nullptr);

} // namespace rapid::query

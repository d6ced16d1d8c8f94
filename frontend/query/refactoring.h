#pragma once
// Changes of a program that an editor offers at a selection. The changed program still checks, except where the text was
// wrong before.

#include "frontend/query/edit_places.h"

namespace rapid::query {

enum class RefactoringKind : uint8_t { QuickFix, Extract, Inline, Rewrite, Organize };

struct Refactoring {
    std::string title; ///< "Create procedure 'pick'"
    std::string id;    ///< "create-routine", stable
    RefactoringKind kind = RefactoringKind::Rewrite;
    std::vector<TextEdit> edits; ///< of the file, in the order of the text
    SourceRange name;            ///< of a new name after the edits, to be renamed next; empty: none
};

/// All that is possible at a selection (empty: at an offset).
std::vector<Refactoring> refactoringsAt(const Snapshot& snapshot, const FileView& file, SourceRange selection,
                                        const Cancel* cancel = nullptr);

} // namespace rapid::query

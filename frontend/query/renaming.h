#pragma once
// Renaming by place: what can be renamed, and the edits in all files, checked before they are given.

#include "frontend/edit/edit_set.h"
#include "frontend/query/references.h"
#include "frontend/sema/checker.h"

namespace rapid::query {

struct RenameTarget {
    SourceRange range;
    std::string name;
    std::string problem; ///< why it cannot be renamed, one sentence; empty: it can
};
RenameTarget renameTargetAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);

/// A string that spells the old name and stays as it is: the user should look at it.
struct RenameNote {
    Location place;
    std::string text;
};
struct RenameResult {
    std::vector<edit::FileEdits> files;
    std::vector<RenameNote> notes;
    std::string problem;
};

/// Edits of every place that means the same thing. The changed program (`tasks`, `options`: those of the snapshot's program) is
/// checked again: mistakes that were not there before, or another meaning of a name, are a problem. Named arguments follow
/// their parameter.
RenameResult renameAt(const Snapshot& snapshot, const FileView& file, uint32_t offset,
                      std::string_view newName, const std::vector<sema::TaskInput>& tasks,
                      const sema::CheckOptions& options, const Cancel* cancel = nullptr);

} // namespace rapid::query

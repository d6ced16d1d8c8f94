#pragma once
// Folding and selection, from the tree alone.

#include "frontend/query/position.h"

namespace rapid::query {

struct FoldingRange {
    uint32_t firstLine = 1, lastLine = 1; ///< from 1; the line of the end word stays visible
    bool isComment = false;
};
std::vector<FoldingRange> foldingRanges(const FileView& file, const Cancel* cancel = nullptr);

/// The ranges around an offset from the word to the whole text, each within the next one.
std::vector<SourceRange> selectionRanges(const FileView& file, uint32_t offset);

} // namespace rapid::query

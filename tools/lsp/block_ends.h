#pragma once
// The end of a block that was just begun: ENDIF after the line with IF ... THEN.

#include "frontend/source/source_file.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsp {

/// The edits after a line end was typed, with the cursor on line `line` (from 0): that line is moved in as the block around it is, or
/// by `step` when nothing is around it, and the end word follows on the next one. Nothing when the line above begins no block, or when the block has its end already.
std::optional<std::vector<rapid::TextEdit>> endOfBlock(const rapid::SourceFile& file, uint32_t line,
                                                       const std::string& step);

} // namespace lsp

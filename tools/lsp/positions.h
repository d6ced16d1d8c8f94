#pragma once
// Places in a text as the protocol counts them: lines and UTF-16 or UTF-8 units, from 0.

#include "frontend/source/source_file.h"
#include "tools/lsp/protocol.h"

#include <memory>
#include <string_view>
#include <vector>

namespace lsp {

/// Of one text. Quick for texts of one line with many megabytes, too.
class PositionMap {
  public:
    PositionMap(std::shared_ptr<const rapid::SourceFile> file, PositionEncoding encoding);
    const rapid::SourceFile& file() const { return *file_; }
    const std::shared_ptr<const rapid::SourceFile>& source() const { return file_; }

    Position at(uint32_t offset) const;
    Range range(rapid::SourceRange range) const { return {at(range.begin), at(range.end)}; }
    /// A character beyond its line means the end of the line, a line beyond the text the end of the text. Never in the middle
    /// of a character.
    uint32_t offset(Position position) const;
    rapid::SourceRange offsets(Range range) const { return {offset(range.start), offset(range.end)}; }
    /// Units of a part of the text.
    uint32_t units(rapid::SourceRange range) const {
        return unitsBefore(range.end) - unitsBefore(range.begin);
    }

  private:
    uint32_t unitsBefore(uint32_t offset) const;

    std::shared_ptr<const rapid::SourceFile> file_;
    bool bytesAreUnits_;
    std::vector<uint32_t> blocks_; ///< units before each block of the text; unless bytes are units
};

/// The same for a text that is being edited; one search through it.
size_t offsetIn(std::string_view text, Position position, PositionEncoding encoding);

} // namespace lsp

#pragma once
// What an editor shows of the thing under the pointer.

#include "frontend/query/describe.h"

#include <optional>

namespace rapid::query {

struct Hover {
    SourceRange range;         ///< of the name
    std::string declaration;   ///< RAPID, see declarationText
    std::string documentation; ///< Markdown; empty: none
    std::string value;         ///< of a constant, "5"; empty: not known without a run
    std::string table;         ///< Markdown table of a robtarget, jointtarget and their like; empty: none
    std::string facts; ///< one line: "Number of the error: 1003", the definition of a signal; empty: none

    /// All of it as Markdown, the declaration as a code block.
    std::string markdown() const;
};

/// None for an offset without a name that has a meaning, and in comments. Keywords have a short explanation.
std::optional<Hover> hoverAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);

/// A robtarget or jointtarget (or a record with such parts) as a Markdown table; empty for other types.
std::string targetTable(const sema::ConstValue& value, const sema::Type& type);

} // namespace rapid::query

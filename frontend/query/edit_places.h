#pragma once
// Places where new declarations and handlers go, and the text that a value of a type begins with.

#include "frontend/query/meaning.h"

namespace rapid::query {

/// What whole lines need that are inserted: offset, and the text before and after each block.
struct InsertPlace {
    uint32_t offset = 0;
    std::string indent; ///< of the lines
    std::string eol = "\n";
    bool lineBefore = true; ///< the lines follow the end of a line: "\n" + line; else line + "\n"
    bool usable = false;

    /// The edit that inserts lines, which get the indentation; they are separated by '\n'.
    TextEdit edit(std::string_view lines) const;
};

/// One level of indentation as the module uses it; 3 spaces where it shows nothing.
std::string indentUnit(const FileView& file, const sema::Module& module);
/// The blanks with which the line of the offset begins.
std::string indentAt(std::string_view text, uint32_t offset);

/// After the last data of the module, or at its beginning.
InsertPlace moduleDataPlace(const FileView& file, const sema::Module& module);
/// After the last data of the routine, or after its header.
InsertPlace routineDataPlace(const FileView& file, const syntax::RoutineDecl& routine);
/// After the end of the routine.
InsertPlace afterRoutine(const FileView& file, const syntax::RoutineDecl& routine);

/// The value new data of the type begin with: 0, FALSE, "", `[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,...]]`; empty: the type
/// has no values.
std::string initialText(const sema::DataType& type);

/// A name that nothing in the scope has: `base`, or with the next free number.
std::string freeName(const Scope& scope, std::string_view base, uint32_t first = 1, uint32_t step = 1);

} // namespace rapid::query

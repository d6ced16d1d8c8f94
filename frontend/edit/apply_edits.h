#pragma once
// Edits of a text -> the bytes of the changed file. Bytes outside the edits stay as they are, in every encoding.

#include "frontend/source/source_file.h"

#include <span>
#include <string>

namespace rapid::edit {

/// The new bytes of a file, or why there are none: one sentence for people, lower-case start, no full stop.
struct [[nodiscard]] EditResult {
    std::string bytes;
    std::string problem; ///< empty: success
    bool ok() const { return problem.empty(); }
};

/// Applies edits given in any order; their ranges are offsets in file.text(). Insertions at the same place follow each
/// other in the order given. Replacements are taken as they are, line ends included (see lineEnd), and are written in
/// the encoding of the file; a file of ASCII characters only has the encoding of its type: ISO 8859-1 for `.mod`,
/// `.sys` and `.prg`, else UTF-8.
///
/// Refused: ranges that overlap, lie outside of the text or cut a character; a replacement that is not UTF-8 or that
/// the encoding of the file cannot hold; binary files; a result that would be read with other characters than meant.
EditResult applyEdits(const SourceFile& file, std::span<const TextEdit> edits);

/// The same as text: what text() of the changed file will be. `problem` as above, encodings apart.
EditResult applyEditsToText(std::string_view text, std::span<const TextEdit> edits);

/// The line end that most lines of a text have: "\r\n", "\n" or "\r"; "\n" when there is no line end at all.
std::string_view lineEnd(std::string_view text);

} // namespace rapid::edit

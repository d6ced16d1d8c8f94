#pragma once
// Names of files in texts: `Load "HOME:/part.modx"`, modules of a program file.

#include "frontend/query/name_walk.h"

namespace rapid::query {

struct FileLink {
    SourceRange range;
    std::string path; ///< as the controller names it: "HOME:/part.modx", "Module1.mod"; '/' between folders
};

/// Arguments of instructions that load and unload modules; a path and a `\File` make one.
std::vector<FileLink> documentLinks(const FileView& file, const Cancel* cancel = nullptr);
/// The modules that a program file (.pgf) lists; an entry without a name has an empty path and range.
std::vector<FileLink> programFileLinks(std::string_view text);

} // namespace rapid::query

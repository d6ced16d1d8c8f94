#pragma once
// Edits of one or several files, or why there are none.

#include "frontend/source/source_file.h"

#include <memory>
#include <string>
#include <vector>

namespace rapid::edit {

/// The edits of one file.
struct FileEdits {
    std::shared_ptr<const SourceFile> file;
    std::vector<TextEdit> edits; ///< in the order of the text
};

struct [[nodiscard]] EditSet {
    std::vector<FileEdits> files;
    std::string problem;            ///< one sentence for people; empty: success
    std::vector<std::string> notes; ///< what the user should look at
    bool ok() const { return problem.empty(); }
};

} // namespace rapid::edit

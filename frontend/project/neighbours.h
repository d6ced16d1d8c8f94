#pragma once
// Modules that lie beside those that are checked: often the rest of the same program.

#include "frontend/diag/diagnostic.h"

#include <string>
#include <vector>

namespace rapid::project {

/// Adds a note to each name that is not known here if a module file in the same folder, which is not among `inputs`,
/// declares it. Folders with very many modules are left alone.
void noteNeighbours(diag::Sink& sink, const std::vector<std::string>& inputs);

} // namespace rapid::project

#pragma once
// Current values of persistents into the declarations of a module (manual 1.2.2: when a module is saved).

#include "frontend/edit/apply_edits.h"
#include "frontend/syntax/ast.h"

#include <span>
#include <string>
#include <vector>

namespace rapid::edit {

struct DataValue {
    std::string module, name;
    std::string value; ///< a literal or an aggregate of literals
};

struct SavedModule {
    std::string bytes;              ///< of the whole file, in its own encoding
    std::string problem;            ///< not empty: there is no result
    std::vector<std::string> notes; ///< values that found no place, a sentence each
    bool ok() const { return problem.empty(); }
};

/// The file with these values as initial values of its persistents. Only literals whose value differs are replaced:
/// layout and comments stay, also inside of aggregates. A persistent without an initial value stays without. A declaration
/// that is gone, or whose initial value has another shape by now (the file was changed meanwhile), stays as it is, with a
/// note.
SavedModule saveValues(const syntax::SyntaxTree& tree, std::span<const DataValue> values);

} // namespace rapid::edit

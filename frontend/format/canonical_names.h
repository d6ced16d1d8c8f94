#pragma once
// The spelling of predefined names, from their declarations.

#include "frontend/format/formatter.h"

namespace rapid::format {

/// Adds the names that the modules of `tree` declare: types, data and routines, by their lower-case form.
void addDeclaredNames(const syntax::SyntaxTree& tree, NameTable& names);

} // namespace rapid::format

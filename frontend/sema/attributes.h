#pragma once
// `!@` comments of library declarations (words: builtin_words).

#include "frontend/sema/checked.h"

namespace rapid::sema {

void applyTypeAttributes(const syntax::SyntaxTree& tree, TypeSymbol& symbol);
void applyDataAttributes(const syntax::SyntaxTree& tree, DataSymbol& symbol);
void applyRoutineAttributes(const syntax::SyntaxTree& tree, RoutineSymbol& symbol);

} // namespace rapid::sema

#pragma once
// The textual form of a module (.rir): complete, so that print -> parse -> print gives the same text. See
// ir/LANGREF.md.

#include <string>
#include <string_view>

#include "ir/core/ir.h"

namespace ir {

/// The whole module as text.
std::string printModule(const Module& module);
/// One routine as text (for messages and tests).
std::string printRoutine(const Module& module, const Routine& routine);

/// Reads what printModule writes. On failure returns false and `error` = "line:column: what was found and
/// expected". `module` must be freshly constructed. Checks syntax and references between the parts, not the
/// rules of ir::verify.
bool parseModule(std::string_view text, Module& module, std::string& error);

} // namespace ir

#pragma once
// Checks every rule of ir/LANGREF.md on a module. A finding is a bug in whoever made the module, not in the
// program that is being compiled.

#include <string>
#include <vector>

#include "ir/core/ir.h"

namespace ir {

/// One line per violation, naming routine, block and instruction; empty = well formed.
std::vector<std::string> verify(const Module& module);
/// Everything but the inside of routines; and the inside of one of them, which asks that the tables are well formed.
std::vector<std::string> verifyTables(const Module& module);
std::vector<std::string> verifyRoutine(const Module& module, uint32_t routine);

} // namespace ir

#pragma once
// Checks every rule of ir/LANGREF.md on a module. A finding is a bug in whoever made the module, not in the
// program that is being compiled.

#include <string>
#include <vector>

#include "ir/core/ir.h"

namespace ir {

/// One line per violation, naming routine, block and instruction; empty = well formed.
std::vector<std::string> verify(const Module& module);

} // namespace ir

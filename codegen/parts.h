#pragma once
// How a large program is divided for compilation.

#include <vector>

#include "codegen/module_emitter.h"
#include "ir/core/ir.h"

namespace codegen {

/// IR instructions of a routine that is copied into another part, and into one that has turned out to be worth it.
inline constexpr size_t kLargestCopy = 150, kLargestHotCopy = 250;

/// Routines of at most `largest` instructions that `routines` call, and those that these call: to be compiled into the same part.
std::vector<uint32_t> copiesFor(const ir::Module& module, const std::vector<uint32_t>& routines,
                                size_t largest);

/// Tables first; then for each module of the source a part for its routines that are paced by natives and one for the others, or
/// several when it is large. A very large routine has a part of its own. These are compiled differently. An edit of one module
/// leaves the parts of the others as they are.
std::vector<Part> divide(const ir::Module& module, const CodegenOptions& options);

} // namespace codegen

#pragma once
// The description for the code generator of the standard library that rapidc contains.

#include "codegen/codegen.h"
#include "ir/core/ir.h"
#include "ir/passes/passes.h"

#include <vector>

namespace rapidc {

/// The functions that compiled code may call, for codegen::jit.
std::vector<codegen::NativeSymbol> nativeSymbols();

/// With the bodies of natives that can be inlined.
codegen::CodegenOptions codegenOptions(bool optimise);

/// Makes options.prepare run the passes on each routine of a program that is compiled in parts. `module` must outlive the options.
void runPassesInParts(codegen::CodegenOptions& options, ir::Module& module, const ir::PassOptions& passes);

/// The folder of compiled parts: $RAPIDC_CACHE, else rapidc in $XDG_CACHE_HOME or ~/.cache; "" when none of them is set.
std::string cacheFolder();

} // namespace rapidc

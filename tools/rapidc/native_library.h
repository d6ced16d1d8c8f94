#pragma once
// What the code generator needs to know of the standard library that rapidc contains.

#include "codegen/codegen.h"

#include <vector>

namespace rapidc {

/// The functions that compiled code may call, for codegen::jit.
std::vector<codegen::NativeSymbol> nativeSymbols();

/// With the bodies of natives that can be inlined.
codegen::CodegenOptions codegenOptions(bool optimise);

} // namespace rapidc

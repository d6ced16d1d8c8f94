#pragma once
// Bodies of natives (bitcode made by codegen/bodies) become part of the programs that call them, so that LLVM inlines
// them, and evaluates them where their arguments are known.

#include <llvm/ADT/StringRef.h>
#include <llvm/IR/Module.h>

#include <string>

#include "codegen/codegen.h"

namespace codegen {

/// Functions of the C library that bodies may call. LLVM does not evaluate them: the library of the machine that
/// executes the program decides about the last bit.
bool isLibraryFunction(llvm::StringRef name);

/// Defines the natives that `program` calls and `bodies` has. False and `error` when the bitcode cannot be read.
bool linkNativeBodies(llvm::Module& program, const NativeBodies& bodies, std::string& error);

} // namespace codegen

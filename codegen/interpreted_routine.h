#pragma once
// Routines too long for machine code: what LLVM needs for them grows with the square of their length in places, and is 50 to
// 100 times what the words of runtime/abi/interpreted.h need. LLVM sees a short function that calls the interpreter.

#include <cstdint>

#include "codegen/codegen.h"
#include "ir/core/ir.h"

namespace codegen {

class ModuleEmitter;

/// Very long, or long and waiting for natives most of the time.
bool isInterpreted(const ir::Module& module, const ir::Routine& routine, const CodegenOptions& options);

/// Emits the function of a routine, its words and the functions that it calls others by.
void emitInterpreted(ModuleEmitter& module, uint32_t index);

} // namespace codegen

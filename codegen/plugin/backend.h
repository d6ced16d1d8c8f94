#pragma once
// Code generation as a library that is loaded at the first use: commands that compile nothing start without LLVM.

#include "codegen/codegen.h"
#include "ir/core/ir.h"

namespace codegen {

/// The functions of codegen.h inside the library. The first field never moves.
struct Backend {
    uint64_t layout; ///< layoutOfInterface() of the library
    decltype(&codegen::jit) jit;
    decltype(&codegen::guardMemory) guardMemory;
    decltype(&codegen::emitObject) emitObject;
    decltype(&codegen::emitObjects) emitObjects;
    decltype(&codegen::emitImage) emitImage;
    decltype(&codegen::emitLlvm) emitLlvm;
    decltype(&codegen::emitAsm) emitAsm;
    decltype(&codegen::linkExecutable) linkExecutable;
};

/// A number that is another one when executable and library were made from different structures.
constexpr uint64_t layoutOfInterface() {
    uint64_t number = 14695981039346656037u;
    for (const size_t size :
         {sizeof(Backend), sizeof(CodegenOptions), sizeof(ir::Module), sizeof(ir::Routine), sizeof(ir::Inst),
          sizeof(ir::Global), sizeof(ir::Statement), sizeof(ir::Native)})
        number = (number ^ size) * 1099511628211u;
    return number;
}

/// Name of the library's only exported function.
inline constexpr const char* kBackendSymbol = "rapidc_codegen_backend";
/// The place of the library, relative to the executable.
inline constexpr const char* kBackendPath = "lib/rapidc_codegen.so";

} // namespace codegen

extern "C" const codegen::Backend* rapidc_codegen_backend();

#pragma once
// Code generation as a library that is loaded at the first use: commands that compile nothing start without LLVM.

#include "codegen/codegen.h"

namespace codegen {

/// The functions of codegen.h inside the library.
struct Backend {
    decltype(&codegen::jit) jit;
    decltype(&codegen::guardMemory) guardMemory;
    decltype(&codegen::emitObject) emitObject;
    decltype(&codegen::emitObjects) emitObjects;
    decltype(&codegen::emitImage) emitImage;
    decltype(&codegen::emitLlvm) emitLlvm;
    decltype(&codegen::emitAsm) emitAsm;
    decltype(&codegen::linkExecutable) linkExecutable;
};

/// Name of the library's only exported function.
inline constexpr const char* kBackendSymbol = "rapidc_codegen_backend";
/// Where the library is, relative to the executable.
inline constexpr const char* kBackendPath = "lib/rapidc_codegen.so";

} // namespace codegen

extern "C" const codegen::Backend* rapidc_codegen_backend();

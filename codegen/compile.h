#pragma once
// The common way of JIT and object file: target machine, emission, optimisation.

#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

#include "codegen/abi_types.h"
#include "codegen/codegen.h"
#include "runtime/abi/rt_abi.h"

namespace llvm {
class PassBuilder;
}

namespace codegen {

/// The symbol of the description that every compiled program holds.
inline constexpr const char* kProgramSymbol = RAPIDC_SYMBOL(rapidc_program);

/// Machine code is made for one fixed feature set, never for the host's: results and objects must not depend on it.
std::unique_ptr<llvm::TargetMachine> makeTargetMachine(const CodegenOptions& options, std::string& error);

struct Part;

/// Emits `module`, or a part of it, and checks the result. Null and `error` when LLVM's verifier objects (our bug).
std::unique_ptr<llvm::Module> emit(const ir::Module& module, const CodegenOptions& options,
                                   llvm::TargetMachine& machine, llvm::LLVMContext& context,
                                   std::string& error, const Part* part = nullptr);
/// Optimises what was emitted. When it has a huge routine, sets `machine` to generate code without optimisation.
bool finish(llvm::Module& module, const CodegenOptions& options, llvm::TargetMachine& machine,
            std::string& error);
/// Both.
std::unique_ptr<llvm::Module> compile(const ir::Module& module, const CodegenOptions& options,
                                      llvm::TargetMachine& machine, llvm::LLVMContext& context,
                                      std::string& error, const Part* part = nullptr);

/// Runs LLVM's O2 pipeline, with the extensions of `builder`.
void runO2(llvm::Module& module, llvm::PassBuilder& builder);

/// Machine code of a compiled module as the bytes of an object file, or its assembly.
bool generate(llvm::Module& module, llvm::TargetMachine& machine, llvm::CodeGenFileType type,
              llvm::SmallVectorImpl<char>& out, std::string& error);

/// Both: from the IR to the bytes of an object file or the text of the assembly.
bool compileTo(const ir::Module& module, const CodegenOptions& options, llvm::CodeGenFileType type,
               llvm::SmallVectorImpl<char>& out, std::string& error);

} // namespace codegen

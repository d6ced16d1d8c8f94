#pragma once
// Calls whose result is known when the program is compiled.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// Calls of functions that only read memory, with constants alone as arguments, are evaluated: LLVM does so only where all
/// loops of the inlined function can be unrolled. Natives leave what is made of a constant string (a set of characters, say)
/// to such functions.
class ConstantCalls : public llvm::PassInfoMixin<ConstantCalls> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

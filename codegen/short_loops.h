#pragma once
// Loops around other loops that make few rounds, all of them known (sorting or searching a short list), are written out: the
// branches of each round get a history of their own, by which the processor predicts them. LLVM counts the code of errors and of
// safepoints, too, and would find such loops too long.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// Marks the loops; LLVM's pass does the work.
class ShortLoops : public llvm::PassInfoMixin<ShortLoops> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

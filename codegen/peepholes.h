#pragma once
// Simplifications that LLVM's own passes leave out. They run after each of LLVM's peephole passes.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// Phi nodes of {status, result} become one phi node for each member. LLVM follows a status of 0 through a phi node of
/// integers only; so the checks of statuses disappear where a routine has been inlined, and results keep what is known of them.
class SplitResults : public llvm::PassInfoMixin<SplitResults> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

/// Checks of numbers that are finite for certain (RoutineEmitter::isFinite) become true.
class FiniteChecks : public llvm::PassInfoMixin<FiniteChecks> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

#pragma once
// Numbers that only the way out of a loop needs: of the statement that failed and of its error.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// Where a phi node outside of a loop takes a constant from a branch in the loop, LLVM computes the constant before the branch,
/// in every round. It gets a block of its own on the way out, in a form that LLVM does not move back. Comes last.
class ColdConstants : public llvm::PassInfoMixin<ColdConstants> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

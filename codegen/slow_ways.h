#pragma once
// Checks that can fail on a way that is seldom taken only.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// A branch on a phi node that is true from every way but one (WholeDivisions makes such) moves to the end of that way.
class SlowWays : public llvm::PassInfoMixin<SlowWays> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

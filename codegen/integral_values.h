#pragma once
// Keeps floating-point variables that only ever hold small whole numbers (bytes of the bit functions, indices after their
// check) in integers: the conversions from and to integers of each step cost more than the steps.

#include <llvm/IR/PassManager.h>

namespace codegen {

class IntegralValues : public llvm::PassInfoMixin<IntegralValues> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

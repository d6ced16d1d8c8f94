#pragma once
// MOD and DIV of whole numbers by a constant, without a division.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// trunc(x / c) and x - trunc(x / c) * c, x whole, are computed with 1 / c. When the remainder is from 0 to below c,
/// both are exact, which the division would give as well; otherwise the division is done. Runs once: what is left is of
/// the form that it looks for.
class ConstantDivisions : public llvm::PassInfoMixin<ConstantDivisions> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

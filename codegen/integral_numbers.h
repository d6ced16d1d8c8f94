#pragma once
// Numbers without decimals, of any size.

#include <llvm/ADT/DenseSet.h>
#include <llvm/IR/PassManager.h>

namespace codegen {

/// Which floating-point values of a function are whole numbers, infinite or NaN: sums, differences and products of such values,
/// what is rounded to whole numbers. Rounding to the precision of the type never makes decimals.
class IntegralNumbers {
  public:
    explicit IntegralNumbers(llvm::Function& function);
    bool contains(const llvm::Value* value) const;

  private:
    bool isMade(const llvm::Instruction& inst) const;

    llvm::DenseSet<const llvm::Value*> known_;
};

/// Checks that such a number equals its whole part ask only whether it is NaN.
class WholeChecks : public llvm::PassInfoMixin<WholeChecks> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

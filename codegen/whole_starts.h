#pragma once
// Indices of loops that begin with a number of any kind (a parameter, half of another number) are whole from their first check on,
// but only numbers that are whole from the start can be kept in integers. Such a loop gets a second form for starts that are
// whole; the first form serves the others.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// Runs after inlining: a copy of the loop in a routine could keep that from being inlined.
class WholeStarts : public llvm::PassInfoMixin<WholeStarts> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

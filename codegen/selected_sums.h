#pragma once
// Additions under a condition (`IF found count := count + 1`), which are selections between a number and its sum with a constant.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// The selection chooses the constant or -0, whose addition changes no number: a processor has instructions for that, whereas it
/// branches to select a number that it computes, and such a branch is hard to predict. Comes late: LLVM would reverse it.
class SelectedSums : public llvm::PassInfoMixin<SelectedSums> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

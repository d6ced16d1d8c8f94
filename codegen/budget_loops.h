#pragma once
// Keeps the budget of instructions in a register while a loop runs. In memory, each safepoint would wait for the one before:
// LLVM does not move the budget out of a loop that calls the scheduler, however seldom it does.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// Name of the attribute of functions whose first argument is the task.
inline constexpr const char* kTakesTask = "rapidc-task";

class BudgetLoops : public llvm::PassInfoMixin<BudgetLoops> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

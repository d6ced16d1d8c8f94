#pragma once
// Loops over arrays whose rounds check their results: LLVM does not vectorise a loop that can be left in its middle. Such a loop
// gets a second form that does up to 64 rounds without leaving: it collects what the checks find, and keeps results in a buffer.
// When no check has failed, the results are stored; otherwise the first form repeats these rounds and reports the error.
//
// `wide_loop` does the same when code is emitted, for simpler loops; here routines have been inlined, branches have become
// selections and indices of several dimensions addresses.

#include <llvm/IR/PassManager.h>

namespace codegen {

class UncheckedRounds : public llvm::PassInfoMixin<UncheckedRounds> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

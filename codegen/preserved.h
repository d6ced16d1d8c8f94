#pragma once
// The answer of a pass that changes instructions but no branches.

#include <llvm/IR/PassManager.h>

namespace codegen {

/// Preserved analyses: all when nothing has changed, else those of the control flow.
inline llvm::PreservedAnalyses preservingBlocks(bool changed) {
    if (!changed) return llvm::PreservedAnalyses::all();
    llvm::PreservedAnalyses preserved;
    preserved.preserveSet<llvm::CFGAnalyses>();
    return preserved;
}

} // namespace codegen

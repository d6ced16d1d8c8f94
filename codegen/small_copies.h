#pragma once
// Memory of a size that was unknown when code was emitted (copies of arrays of any size) and has become known by propagating
// arguments: a few KB belong to the frame of the routine, like its variables. So the routine can be inlined, and LLVM sees
// what its elements hold.

#include <llvm/IR/PassManager.h>

namespace codegen {

class SmallCopies : public llvm::PassInfoMixin<SmallCopies> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen

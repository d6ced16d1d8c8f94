#include "codegen/cold_constants.h"

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InlineAsm.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

#include <utility>
#include <vector>

namespace codegen {
namespace {

using llvm::BasicBlock;
using llvm::ConstantInt;

/// Fits a register as it is.
bool isWord(const llvm::Value* value) {
    return llvm::isa<ConstantInt>(value) &&
           (value->getType()->isIntegerTy(32) || value->getType()->isIntegerTy(64));
}

bool takesConstant(const BasicBlock& target, const BasicBlock& from) {
    for (const llvm::PHINode& phi : target.phis())
        if (isWord(phi.getIncomingValueForBlock(&from))) return true;
    return false;
}

/// Empty assembly with the constant as input and output: what it yields is not known to LLVM.
llvm::Value* opaque(llvm::IRBuilder<>& b, llvm::Value* constant) {
    auto* type = llvm::FunctionType::get(constant->getType(), {constant->getType()}, false);
    return b.CreateCall(type, llvm::InlineAsm::get(type, "", "=r,0", /*hasSideEffects=*/false), {constant});
}

} // namespace

llvm::PreservedAnalyses ColdConstants::run(llvm::Function& function,
                                           llvm::FunctionAnalysisManager& analyses) {
    const auto& loops = analyses.getResult<llvm::LoopAnalysis>(function);
    if (loops.empty()) return llvm::PreservedAnalyses::all();
    std::vector<std::pair<BasicBlock*, BasicBlock*>> edges;
    for (BasicBlock& block : function) {
        auto* branch = llvm::dyn_cast<llvm::BranchInst>(block.getTerminator());
        if (!branch || !branch->isConditional() || branch->getSuccessor(0) == branch->getSuccessor(1))
            continue;
        for (BasicBlock* target : branch->successors())
            if (loops.getLoopDepth(target) < loops.getLoopDepth(&block) && takesConstant(*target, block))
                edges.emplace_back(&block, target);
    }
    for (const auto& [from, target] : edges) {
        BasicBlock* between = llvm::SplitEdge(from, target);
        llvm::IRBuilder<> b(between->getTerminator());
        for (llvm::PHINode& phi : target->phis()) {
            const int index = phi.getBasicBlockIndex(between);
            if (index < 0) continue;
            llvm::Value* value = phi.getIncomingValue(static_cast<unsigned>(index));
            if (isWord(value)) phi.setIncomingValue(static_cast<unsigned>(index), opaque(b, value));
        }
    }
    return edges.empty() ? llvm::PreservedAnalyses::all() : llvm::PreservedAnalyses::none();
}

} // namespace codegen

#include "codegen/slow_ways.h"

#include <llvm/ADT/STLExtras.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <vector>

namespace codegen {
namespace {

using llvm::BasicBlock;
using llvm::Value;

/// A block that ends in such a branch.
class Candidate {
  public:
    Candidate(BasicBlock& block, const llvm::DominatorTree& dominators) : block_(block) {
        branch_ = llvm::dyn_cast<llvm::BranchInst>(block.getTerminator());
        if (!branch_ || !branch_->isConditional()) return;
        test_ = llvm::dyn_cast<llvm::PHINode>(branch_->getCondition());
        if (!test_ || test_->getParent() != &block || !test_->hasOneUse() || !findSlow()) return;
        BasicBlock* raise = branch_->getSuccessor(usual_ ? 1 : 0);
        suits_ = branch_->getSuccessor(usual_ ? 0 : 1) != raise && hasNoEffects() &&
                 !dominators.dominates(&block, raise) &&
                 !llvm::is_contained(llvm::predecessors(raise), slow_) && knowsOnSlowWay(*raise);
    }

    bool suits() const { return suits_; }

    void move(llvm::DominatorTree& dominators) {
        BasicBlock* raise = branch_->getSuccessor(usual_ ? 1 : 0);
        BasicBlock* next = branch_->getSuccessor(usual_ ? 0 : 1);
        llvm::Instruction* end = slow_->getTerminator();
        llvm::IRBuilder<> b(end);
        b.CreateCondBr(test_->getIncomingValueForBlock(slow_), usual_ ? &block_ : raise,
                       usual_ ? raise : &block_)
            ->copyMetadata(*branch_, {llvm::LLVMContext::MD_prof});
        end->eraseFromParent();
        for (llvm::PHINode& phi : raise->phis()) {
            Value* value = phi.getIncomingValueForBlock(&block_);
            phi.setIncomingBlock(static_cast<unsigned>(phi.getBasicBlockIndex(&block_)), slow_);
            phi.setIncomingValueForBlock(slow_, onSlowWay(value));
        }
        b.SetInsertPoint(branch_);
        b.CreateBr(next);
        branch_->eraseFromParent();
        test_->eraseFromParent();
        using Update = llvm::DominatorTree::UpdateType;
        dominators.applyUpdates({Update(llvm::DominatorTree::Insert, slow_, raise),
                                 Update(llvm::DominatorTree::Delete, &block_, raise)});
    }

  private:
    /// One constant from all ways but one, which leads nowhere else.
    bool findSlow() {
        const llvm::ConstantInt* usual = nullptr;
        for (BasicBlock* from : test_->blocks()) {
            Value* value = test_->getIncomingValueForBlock(from);
            const auto* constant = llvm::dyn_cast<llvm::ConstantInt>(value);
            if (constant && (!usual || usual == constant))
                usual = constant;
            else if (constant || slow_)
                return false;
            else
                slow_ = from;
        }
        if (!usual || !slow_) return false;
        usual_ = usual->isOne();
        const auto* end = llvm::dyn_cast<llvm::BranchInst>(slow_->getTerminator());
        return end && end->isUnconditional();
    }

    /// The instructions before the branch may be left out when it fails.
    bool hasNoEffects() const {
        return std::none_of(block_.begin(), branch_->getIterator(),
                            [](const llvm::Instruction& inst) { return inst.mayHaveSideEffects(); });
    }

    bool knowsOnSlowWay(const BasicBlock& raise) const {
        return llvm::all_of(raise.phis(), [&](const llvm::PHINode& phi) {
            const auto* made = llvm::dyn_cast<llvm::Instruction>(phi.getIncomingValueForBlock(&block_));
            return !made || made->getParent() != &block_ || llvm::isa<llvm::PHINode>(made);
        });
    }

    Value* onSlowWay(Value* value) const {
        auto* phi = llvm::dyn_cast<llvm::PHINode>(value);
        return phi && phi->getParent() == &block_ ? phi->getIncomingValueForBlock(slow_) : value;
    }

    BasicBlock& block_;
    llvm::BranchInst* branch_ = nullptr;
    llvm::PHINode* test_ = nullptr;
    BasicBlock* slow_ = nullptr;
    bool usual_ = true; ///< what the test is on the other ways
    bool suits_ = false;
};

} // namespace

llvm::PreservedAnalyses SlowWays::run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
    auto& dominators = analyses.getResult<llvm::DominatorTreeAnalysis>(function);
    bool changed = false;
    for (BasicBlock& block : function) {
        Candidate candidate(block, dominators);
        if (!candidate.suits()) continue;
        candidate.move(dominators);
        changed = true;
    }
    return changed ? llvm::PreservedAnalyses::none() : llvm::PreservedAnalyses::all();
}

} // namespace codegen

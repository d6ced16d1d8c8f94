#include "codegen/constant_calls.h"

#include <llvm/ADT/DenseMap.h>
#include <llvm/Analysis/ConstantFolding.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "codegen/preserved.h"

namespace codegen {
namespace {

using llvm::Constant;
using llvm::Value;

/// Executes a function that only reads constants. Null where something is not known, or takes too long.
class Evaluation {
  public:
    explicit Evaluation(const llvm::DataLayout& layout) : layout_(layout) {}

    Constant* run(const llvm::CallInst& call) {
        const llvm::Function& function = *call.getCalledFunction();
        for (const llvm::Argument& parameter : function.args())
            values_[&parameter] = llvm::cast<Constant>(call.getArgOperand(parameter.getArgNo()));
        const llvm::BasicBlock *from = nullptr, *block = &function.getEntryBlock();
        while (block) {
            if (!takePhis(*block, from)) return nullptr;
            for (const llvm::Instruction& inst : *block) {
                if (llvm::isa<llvm::PHINode>(inst)) continue;
                if (inst.isTerminator()) break;
                if (++steps_ > kMostSteps || !execute(inst)) return nullptr;
            }
            if (const auto* done = llvm::dyn_cast<llvm::ReturnInst>(block->getTerminator()))
                return known(done->getReturnValue());
            from = std::exchange(block, next(*block));
        }
        return nullptr;
    }

  private:
    static constexpr unsigned kMostSteps = 5'000; // a string has at most 80 bytes

    Constant* known(const Value* value) const {
        if (const auto* constant = llvm::dyn_cast<Constant>(value)) return const_cast<Constant*>(constant);
        return values_.lookup(value);
    }

    bool takePhis(const llvm::BasicBlock& block, const llvm::BasicBlock* from) {
        std::vector<std::pair<const llvm::PHINode*, Constant*>> taken; // all at once
        for (const llvm::PHINode& phi : block.phis())
            taken.emplace_back(&phi, known(phi.getIncomingValueForBlock(from)));
        for (const auto& [phi, value] : taken)
            if (!(values_[phi] = value)) return false;
        return true;
    }

    bool execute(const llvm::Instruction& inst) {
        if (inst.getType()->isVoidTy()) return llvm::isa<llvm::DbgInfoIntrinsic>(inst);
        std::vector<Constant*> operands;
        for (const Value* operand : inst.operand_values()) {
            operands.push_back(known(operand));
            if (!operands.back()) return false;
        }
        Constant* result = nullptr;
        if (const auto* load = llvm::dyn_cast<llvm::LoadInst>(&inst))
            result = load->isSimple()
                         ? llvm::ConstantFoldLoadFromConstPtr(operands[0], load->getType(), layout_)
                         : nullptr;
        else
            result = llvm::ConstantFoldInstOperands(const_cast<llvm::Instruction*>(&inst), operands, layout_);
        return (values_[&inst] = result) != nullptr;
    }

    const llvm::BasicBlock* next(const llvm::BasicBlock& block) const {
        if (const auto* branch = llvm::dyn_cast<llvm::BranchInst>(block.getTerminator())) {
            if (branch->isUnconditional()) return branch->getSuccessor(0);
            const auto* taken = llvm::dyn_cast_or_null<llvm::ConstantInt>(known(branch->getCondition()));
            return taken ? branch->getSuccessor(taken->isOne() ? 0 : 1) : nullptr;
        }
        return nullptr;
    }

    const llvm::DataLayout& layout_;
    llvm::DenseMap<const Value*, Constant*> values_;
    unsigned steps_ = 0;
};

bool isCandidate(const llvm::Instruction& inst) {
    const auto* call = llvm::dyn_cast<llvm::CallInst>(&inst);
    const llvm::Function* function = call ? call->getCalledFunction() : nullptr;
    return function && !function->isDeclaration() && !function->getReturnType()->isVoidTy() &&
           function->onlyReadsMemory() && function->doesNotThrow() && function->hasExactDefinition() &&
           std::all_of(call->arg_begin(), call->arg_end(),
                       [](const llvm::Use& argument) { return llvm::isa<Constant>(argument); });
}

} // namespace

llvm::PreservedAnalyses ConstantCalls::run(llvm::Function& function, llvm::FunctionAnalysisManager&) {
    bool changed = false;
    for (llvm::Instruction& inst : llvm::make_early_inc_range(llvm::instructions(function))) {
        if (!isCandidate(inst)) continue;
        Constant* result = Evaluation(function.getDataLayout()).run(llvm::cast<llvm::CallInst>(inst));
        if (!result) continue;
        inst.replaceAllUsesWith(result);
        inst.eraseFromParent();
        changed = true;
    }
    return preservingBlocks(changed);
}

} // namespace codegen

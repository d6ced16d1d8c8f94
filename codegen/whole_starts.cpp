#include "codegen/whole_starts.h"

#include <llvm/ADT/SetVector.h>
#include <llvm/Analysis/AssumptionCache.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/MDBuilder.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar/SimplifyCFG.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/LoopSimplify.h>
#include <llvm/Transforms/Utils/LoopUtils.h>

#include "codegen/integral_values.h"
#include "codegen/whole_numbers.h"

namespace codegen {
namespace {

using llvm::BasicBlock;
using llvm::Instruction;
using llvm::Value;

constexpr unsigned kLargestLoop = 250; ///< of the loop, which is copied
constexpr size_t kMostStarts = 4;
constexpr size_t kMostReached = 64;
constexpr unsigned kStartBits = 22; ///< sums of a few of them are exact in F32
constexpr const char* kFirstForm = "rapidc.first.form";

using Starts = llvm::SmallSetVector<Value*, kMostStarts>;

bool isNumber(const Value& value) {
    return value.getType()->isFloatTy() || value.getType()->isDoubleTy();
}

/// Whether an instruction gives a whole number when its operands (from the one returned on) are whole.
bool keepsWhole(const Instruction& inst) {
    switch (inst.getOpcode()) {
    case Instruction::PHI:
    case Instruction::Select:
    case Instruction::FAdd:
    case Instruction::FSub: return true;
    default: return false;
    }
}

/// Adds the numbers of any kind from outside the loop on which it depends whether the index is whole; false when it depends on
/// others as well.
bool findStarts(const llvm::Loop& loop, Value* index, Starts& starts) {
    llvm::SmallSetVector<Value*, 16> reached;
    reached.insert(index);
    for (size_t i = 0; i < reached.size(); ++i) {
        if (reached.size() > kMostReached) return false;
        Value* value = reached[i];
        if (llvm::isa<llvm::Constant>(value) || convertedWhole(value)) continue;
        auto* inst = llvm::dyn_cast<Instruction>(value);
        if (inst && llvm::isa<llvm::SelectInst>(inst) && llvm::isa<llvm::Constant>(inst->getOperand(1)) &&
            llvm::isa<llvm::Constant>(inst->getOperand(2)))
            continue; // the step of a loop that counts up or down
        if (loop.isLoopInvariant(value)) {
            if (i == 0) return false; // it is checked once
            if (!mayBecomeInteger(value)) starts.insert(value);
            continue;
        }
        if (!keepsWhole(*inst)) return false;
        for (unsigned k = llvm::isa<llvm::SelectInst>(inst) ? 1 : 0; k < inst->getNumOperands(); ++k)
            reached.insert(inst->getOperand(k));
    }
    return starts.size() <= kMostStarts;
}

/// The numbers of all indices of the loop; empty: a second form would not help.
Starts startsOf(const llvm::Loop& loop) {
    unsigned length = 0;
    Starts all;
    for (const BasicBlock* block : loop.blocks()) {
        length += static_cast<unsigned>(block->size());
        if (length > kLargestLoop) return {};
        for (const Instruction& inst : *block) {
            if (!llvm::isa<llvm::FPToSIInst>(inst) || !isNumber(*inst.getOperand(0))) continue;
            Starts some = all;
            if (findStarts(loop, inst.getOperand(0), some)) all = some;
        }
    }
    return all;
}

/// Copies the loop; the original is entered when all starts are whole.
class WholeForm {
  public:
    WholeForm(llvm::Loop& loop, const Starts& starts) : loop_(loop), starts_(starts) {}

    /// The headers of the copies of the loop and of those inside.
    llvm::SmallPtrSet<BasicBlock*, 4> make() {
        BasicBlock* entry = loop_.getLoopPreheader();
        copy();
        llvm::IRBuilder<> b(entry->getTerminator());
        Value* all = b.getTrue();
        for (Value* start : starts_)
            all = b.CreateAnd(all, useWhole(b, start));
        llvm::MDBuilder metadata(entry->getContext());
        BasicBlock* first = copyOf(loop_.getHeader());
        b.CreateCondBr(all, loop_.getHeader(), first, metadata.createBranchWeights(1000, 1));
        entry->getTerminator()->eraseFromParent();
        llvm::SmallPtrSet<BasicBlock*, 4> headers;
        for (const llvm::Loop* loop : loop_.getLoopsInPreorder())
            headers.insert(copyOf(loop->getHeader()));
        return headers;
    }

  private:
    BasicBlock* copyOf(BasicBlock* block) { return llvm::cast<BasicBlock>(static_cast<Value*>(map_[block])); }

    void copy() {
        llvm::SmallVector<BasicBlock*> copies;
        for (BasicBlock* block : loop_.blocks()) {
            BasicBlock* copied = llvm::CloneBasicBlock(block, map_, ".first", block->getParent());
            map_[block] = copied;
            copies.push_back(copied);
        }
        llvm::remapInstructionsInBlocks(copies, map_);
        llvm::SmallVector<BasicBlock*> exits;
        loop_.getUniqueExitBlocks(exits);
        for (BasicBlock* exit : exits)
            for (llvm::PHINode& phi : exit->phis())
                for (unsigned i = 0, count = phi.getNumIncomingValues(); i < count; ++i) {
                    Value* value = phi.getIncomingValue(i);
                    const auto copied = map_.find(value);
                    phi.addIncoming(copied == map_.end() ? value : static_cast<Value*>(copied->second),
                                    copyOf(phi.getIncomingBlock(i)));
                }
    }

    /// Takes the start from an integer in the loop; returns whether it is the same number.
    Value* useWhole(llvm::IRBuilder<>& b, Value* start) {
        llvm::Type* bits = b.getIntNTy(start->getType()->getPrimitiveSizeInBits());
        Value* whole = b.CreateFreeze(b.CreateFPToSI(start, b.getInt32Ty()));
        whole = b.CreateAnd(whole, (1U << kStartBits) - 1);
        Value* number = b.CreateUIToFP(whole, start->getType());
        start->replaceUsesWithIf(number, [&](const llvm::Use& use) {
            const auto* user = llvm::dyn_cast<Instruction>(use.getUser());
            return user && loop_.contains(user);
        });
        return b.CreateICmpEQ(b.CreateBitCast(b.CreateFreeze(start), bits), b.CreateBitCast(number, bits));
    }

    llvm::Loop& loop_;
    const Starts& starts_;
    llvm::ValueToValueMapTy map_;
};

class WholeForms {
  public:
    WholeForms(llvm::Function& function, llvm::FunctionAnalysisManager& analyses)
        : function_(function), analyses_(analyses) {}

    /// True when something has changed.
    bool make() {
        bool changed = false;
        for (unsigned i = 0; i < kMostForms && giveOne(); ++i) {
            changed = true;
            analyses_.invalidate(function_, llvm::PreservedAnalyses::none());
            for (llvm::Loop* loop : analyses_.getResult<llvm::LoopAnalysis>(function_).getLoopsInPreorder())
                if (copies_.contains(loop->getHeader()) && !llvm::getBooleanLoopAttribute(loop, kFirstForm)) {
                    llvm::addStringMetadataToLoop(loop, kFirstForm, 1);
                    // It is seldom executed.
                    llvm::addStringMetadataToLoop(loop, "llvm.loop.vectorize.enable", 0);
                    llvm::addStringMetadataToLoop(loop, "llvm.loop.unroll.disable");
                }
        }
        return changed;
    }

  private:
    static constexpr unsigned kMostForms = 16; ///< in a routine

    /// Gives one more loop a second form; outer loops first.
    bool giveOne() {
        auto& loops = analyses_.getResult<llvm::LoopAnalysis>(function_);
        for (llvm::Loop* loop : loops.getLoopsInPreorder()) {
            if (llvm::getBooleanLoopAttribute(loop, kFirstForm) || startsOf(*loop).empty()) continue;
            auto& dominators = analyses_.getResult<llvm::DominatorTreeAnalysis>(function_);
            auto& scev = analyses_.getResult<llvm::ScalarEvolutionAnalysis>(function_);
            auto& assumptions = analyses_.getResult<llvm::AssumptionAnalysis>(function_);
            llvm::simplifyLoop(loop, &dominators, &loops, &scev, &assumptions, nullptr, false);
            llvm::formLCSSARecursively(*loop, dominators, &loops, &scev);
            const Starts starts = startsOf(*loop);
            if (starts.empty() || !loop->isLoopSimplifyForm() || !loop->isLCSSAForm(dominators)) continue;
            const auto headers = WholeForm(*loop, starts).make();
            copies_.insert(headers.begin(), headers.end());
            return true;
        }
        return false;
    }

    llvm::Function& function_;
    llvm::FunctionAnalysisManager& analyses_;
    llvm::SmallPtrSet<BasicBlock*, 8> copies_; ///< headers of first forms
};

} // namespace

llvm::PreservedAnalyses WholeStarts::run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
    if (analyses.getResult<llvm::LoopAnalysis>(function).empty()) return llvm::PreservedAnalyses::all();
    if (!WholeForms(function, analyses).make()) return llvm::PreservedAnalyses::all();
    analyses.invalidate(function, llvm::PreservedAnalyses::none());
    IntegralValues().run(function, analyses);
    analyses.invalidate(function, llvm::PreservedAnalyses::none());
    llvm::InstCombinePass().run(function, analyses);
    analyses.invalidate(function, llvm::PreservedAnalyses::none());
    llvm::SimplifyCFGPass().run(function, analyses);
    return llvm::PreservedAnalyses::none();
}

} // namespace codegen

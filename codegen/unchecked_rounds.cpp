#include "codegen/unchecked_rounds.h"

#include <llvm/ADT/SmallPtrSet.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/LoopSimplify.h>
#include <llvm/Transforms/Utils/LoopUtils.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>
#include <llvm/Transforms/Utils/ScalarEvolutionExpander.h>

#include <vector>

#include "codegen/array_loop.h"

namespace codegen {
namespace {

using llvm::BasicBlock;
using llvm::Instruction;
using llvm::SCEV;
using llvm::Value;

/// GVN computes an index in each branch that needs it; where all of them are the same, one computation shows that it counts.
/// True when something has changed.
bool joinEqualIndices(llvm::Loop& loop, LoopAnalyses& a) {
    bool changed = false;
    for (BasicBlock* block : loop.blocks()) {
        if (block == loop.getHeader()) continue;
        for (llvm::PHINode& phi : llvm::make_early_inc_range(block->phis())) {
            auto* first = llvm::dyn_cast<llvm::BinaryOperator>(phi.getIncomingValue(0));
            if (!first || !phi.getType()->isIntegerTy() || !llvm::isSafeToSpeculativelyExecute(first))
                continue;
            const auto isSame = [&](Value* value) { return a.scev.getSCEV(value) == a.scev.getSCEV(first); };
            const auto isKnown = [&](Value* value) { return a.dominators.dominates(value, &phi); };
            if (!llvm::all_of(phi.incoming_values(), isSame) || !llvm::all_of(first->operands(), isKnown))
                continue;
            Instruction* joined = first->clone();
            joined->dropPoisonGeneratingFlags();
            joined->insertBefore(block->getFirstInsertionPt());
            a.scev.forgetValue(&phi);
            phi.replaceAllUsesWith(joined);
            phi.eraseFromParent();
            changed = true;
        }
    }
    return changed;
}

/// Makes the second form.
class SecondForm {
  public:
    /// `buffers`: those of other loops of the function, which are in use at other times.
    SecondForm(const ArrayLoop& candidate, LoopAnalyses& analyses, std::vector<llvm::AllocaInst*>& buffers)
        : candidate_(candidate), a_(analyses), loop_(candidate.loop()), header_(loop_.getHeader()),
          entry_(loop_.getLoopPreheader()), function_(*header_->getParent()), b_(function_.getContext()),
          i64_(b_.getInt64Ty()), buffers_(buffers) {}

    /// False: an expression cannot be computed where the loop is entered.
    bool make() {
        llvm::SCEVExpander expander(a_.scev, function_.getDataLayout(), "rounds");
        if (!canExpand(expander)) return false;
        Instruction* end = entry_->getTerminator();
        rounds_ = expander.expandCodeFor(candidate_.unchecked(), i64_, end);
        if (candidate_.unchecked() != candidate_.rounds())
            all_ = expander.expandCodeFor(candidate_.rounds(), i64_, end);
        for (const ArrayLoop::Access& store : candidate_.stores())
            targets_.push_back(expander.expandCodeFor(store.address->getStart(), b_.getPtrTy(), end));
        for (const ArrayLoop::Access& load : candidate_.early())
            sources_.push_back(expander.expandCodeFor(load.address->getStart(), b_.getPtrTy(), end));
        b_.SetInsertPoint(end);
        Value* possible = b_.CreateICmpUGE(rounds_, b_.getInt64(kFewestRounds));
        for (const ArrayLoop::Distance& distance : candidate_.distances())
            possible = b_.CreateAnd(possible, isFar(expander, distance));
        for (const ArrayLoop::Check& check : candidate_.conditions()) {
            Value* holds = b_.CreateFreeze(check.condition);
            possible = b_.CreateAnd(possible, check.wanted ? holds : b_.CreateNot(holds));
        }
        b_.SetInsertPoint(end);
        head_ = newBlock("unchecked");
        looked_ = newBlock("unchecked.end");
        store_ = newBlock("unchecked.store");
        next_ = newBlock("unchecked.next");
        rest_ = newBlock("checked");
        b_.CreateCondBr(possible, head_, rest_);
        end->eraseFromParent();
        beginSome();
        cloneRounds();
        endSome();
        return true;
    }

    void promote() {
        llvm::DominatorTree dominators(function_);
        llvm::SmallVector<llvm::AllocaInst*, 2> found{foundBits_[0], foundBits_[1]};
        llvm::PromoteMemToReg(found, dominators, &a_.assumptions);
    }

  private:
    BasicBlock* newBlock(const char* name) {
        return BasicBlock::Create(function_.getContext(), name, &function_, header_);
    }

    bool canExpand(llvm::SCEVExpander& expander) const {
        Instruction* end = entry_->getTerminator();
        const auto can = [&](const SCEV* what) { return expander.isSafeToExpandAt(what, end); };
        const auto canAll = [&](const std::vector<ArrayLoop::Access>& accesses) {
            return llvm::all_of(accesses,
                                [&](const ArrayLoop::Access& a) { return can(a.address->getStart()); });
        };
        return can(candidate_.rounds()) && can(candidate_.unchecked()) && canAll(candidate_.stores()) &&
               canAll(candidate_.early()) &&
               llvm::all_of(candidate_.distances(),
                            [&](const ArrayLoop::Distance& d) { return can(d.least) && can(d.most); });
    }

    /// The load is above the store, or so far below it that the rounds done at once do not meet.
    Value* isFar(llvm::SCEVExpander& expander, const ArrayLoop::Distance& distance) {
        Instruction* end = entry_->getTerminator();
        Value* least = expander.expandCodeFor(distance.least, i64_, end);
        Value* most = expander.expandCodeFor(distance.most, i64_, end);
        b_.SetInsertPoint(end);
        Value* above = b_.CreateICmpSGE(least, b_.getInt64(distance.mayBeEqual ? 0 : kLargestElement));
        Value* below = b_.CreateICmpSLE(most, b_.CreateNeg(b_.getInt64(distance.span)));
        return b_.CreateOr(above, below);
    }

    /// At the beginning of some rounds: what they start with, and how many they are.
    void beginSome() {
        b_.SetInsertPoint(head_);
        for (llvm::PHINode& phi : header_->phis()) {
            llvm::PHINode* copy = b_.CreatePHI(phi.getType(), 2, phi.getName());
            copy->addIncoming(phi.getIncomingValueForBlock(entry_), entry_);
            starts_.push_back(copy);
        }
        done_ = b_.CreatePHI(i64_, 2, "done");
        done_->addIncoming(b_.getInt64(0), entry_);
        count_ = b_.CreateBinaryIntrinsic(llvm::Intrinsic::umin, b_.CreateSub(rounds_, done_),
                                          b_.getInt64(kRoundsAtOnce));
    }

    void cloneRounds() {
        llvm::SmallVector<BasicBlock*> clones;
        for (BasicBlock* block : loop_.blocks()) {
            BasicBlock* clone = llvm::CloneBasicBlock(block, map_, ".unchecked", &function_);
            map_[block] = clone;
            clones.push_back(clone);
        }
        llvm::remapInstructionsInBlocks(clones, map_);
        BasicBlock* header = cloneOf(header_);
        b_.SetInsertPoint(head_);
        b_.CreateBr(header);
        size_t i = 0;
        for (llvm::PHINode& phi : header->phis()) {
            const int from = phi.getBasicBlockIndex(entry_);
            phi.setIncomingBlock(static_cast<unsigned>(from), head_);
            phi.setIncomingValue(static_cast<unsigned>(from), starts_[i++]);
        }
        BasicBlock* latch = cloneOf(loop_.getLoopLatch());
        round_ = llvm::PHINode::Create(i64_, 2, "round", header->begin());
        collectChecks(head_);
        b_.SetInsertPoint(latch->getTerminator());
        Value* following = b_.CreateAdd(round_, b_.getInt64(1), "", true, true);
        round_->addIncoming(b_.getInt64(0), head_);
        round_->addIncoming(following, latch);
        b_.CreateCondBr(b_.CreateICmpEQ(following, count_), looked_, header);
        latch->getTerminator()->eraseFromParent();
        loadEarly();
        buffer();
    }

    /// Without a branch around them, as a vector wants it.
    void loadEarly() {
        for (size_t i = 0; i < sources_.size(); ++i) {
            auto* load = cloneOf(llvm::cast<llvm::LoadInst>(candidate_.early()[i].inst));
            b_.SetInsertPoint(cloneOf(header_)->getTerminator());
            load->moveBefore(&*b_.GetInsertPoint());
            b_.SetInsertPoint(load);
            load->setOperand(0, b_.CreateGEP(load->getType(), sources_[i], b_.CreateAdd(done_, round_)));
        }
    }

    Value* cloneOrSame(Value* value) const {
        const auto clone = map_.find(value);
        return clone == map_.end() ? value : static_cast<Value*>(clone->second);
    }

    template <class T> T* cloneOf(T* original) { return llvm::cast<T>(static_cast<Value*>(map_[original])); }

    /// Collects the results of checks instead of leaving the loop, by the width of the numbers: a vector of results fills a
    /// register as the numbers do.
    void collectChecks(BasicBlock* start) {
        b_.SetInsertPoint(&*function_.getEntryBlock().begin());
        for (llvm::AllocaInst*& slot : foundBits_)
            slot = b_.CreateAlloca(&slot == &foundBits_[0] ? b_.getInt32Ty() : i64_, nullptr, "found");
        b_.SetInsertPoint(start->getTerminator());
        for (llvm::AllocaInst* slot : foundBits_)
            b_.CreateStore(llvm::Constant::getNullValue(slot->getAllocatedType()), slot);
        for (const ArrayLoop::Check& original : candidate_.checks()) {
            b_.SetInsertPoint(cloneOf(original.at));
            Value* holds = cloneOrSame(original.condition);
            Value* fails = original.wanted ? b_.CreateNot(holds) : holds;
            llvm::AllocaInst* slot = foundBits_[isOfDoubles(original.condition) ? 1 : 0];
            llvm::Type* type = slot->getAllocatedType();
            b_.CreateStore(b_.CreateOr(b_.CreateLoad(type, slot), b_.CreateSExt(fails, type)), slot);
        }
        for (llvm::BranchInst* original : candidate_.exits())
            staysInside(cloneOf(original), original);
    }

    void staysInside(llvm::BranchInst* check, llvm::BranchInst* original) {
        const unsigned inside = loop_.contains(original->getSuccessor(0)) ? 0 : 1;
        b_.SetInsertPoint(check);
        b_.CreateBr(cloneOf(original->getSuccessor(inside)));
        check->eraseFromParent();
    }

    static bool isOfDoubles(const Value* condition) {
        const auto* inst = llvm::dyn_cast<Instruction>(condition);
        if (inst == nullptr || inst->getNumOperands() == 0) return false;
        llvm::Type* type = inst->getOperand(0)->getType();
        return type->isIntegerTy(1) ? isOfDoubles(inst->getOperand(0)) : type->getScalarSizeInBits() == 64;
    }

    void buffer() {
        for (size_t i = 0; i < candidate_.stores().size(); ++i) {
            if (i == buffers_.size()) addBuffer();
            auto* write = cloneOf(llvm::cast<llvm::StoreInst>(candidate_.stores()[i].inst));
            b_.SetInsertPoint(write);
            write->setOperand(1,
                              b_.CreateInBoundsGEP(write->getValueOperand()->getType(), buffers_[i], round_));
        }
    }

    void addBuffer() {
        b_.SetInsertPoint(&*function_.getEntryBlock().begin());
        llvm::Type* bytes = llvm::ArrayType::get(b_.getInt8Ty(), kRoundsAtOnce * kLargestElement);
        buffers_.push_back(b_.CreateAlloca(bytes, nullptr, "results"));
        buffers_.back()->setAlignment(llvm::Align(16));
    }

    /// Stores the results when all are fine; else the first form begins with the first of these rounds.
    void endSome() {
        b_.SetInsertPoint(looked_);
        Value* found = b_.CreateZExt(b_.CreateLoad(b_.getInt32Ty(), foundBits_[0]), i64_);
        found = b_.CreateOr(found, b_.CreateLoad(i64_, foundBits_[1]));
        llvm::MDBuilder metadata(function_.getContext());
        b_.CreateCondBr(b_.CreateICmpEQ(found, b_.getInt64(0)), store_, rest_,
                        metadata.createBranchWeights(1000, 1));
        b_.SetInsertPoint(store_);
        llvm::PHINode* each = b_.CreatePHI(i64_, 2, "stored");
        for (size_t i = 0; i < targets_.size(); ++i) {
            auto* write = llvm::cast<llvm::StoreInst>(candidate_.stores()[i].inst);
            llvm::Type* type = write->getValueOperand()->getType();
            Value* result = b_.CreateLoad(type, b_.CreateInBoundsGEP(type, buffers_[i], each));
            Value* target = b_.CreateGEP(type, targets_[i], b_.CreateAdd(done_, each));
            auto* stored = b_.CreateAlignedStore(result, target, write->getAlign());
            stored->copyMetadata(*write);
        }
        Value* following = b_.CreateAdd(each, b_.getInt64(1), "", true, true);
        each->addIncoming(b_.getInt64(0), looked_);
        each->addIncoming(following, store_);
        b_.CreateCondBr(b_.CreateICmpEQ(following, count_), next_, store_);
        continueOrLeave();
    }

    /// After some rounds without failure: more of them, the end of the loop, or the first form for what is left.
    void continueOrLeave() {
        BasicBlock* latch = loop_.getLoopLatch();
        auto* last = llvm::cast<llvm::BranchInst>(latch->getTerminator());
        BasicBlock* exit = last->getSuccessor(loop_.contains(last->getSuccessor(0)) ? 1 : 0);
        b_.SetInsertPoint(next_);
        Value* done = b_.CreateAdd(done_, count_);
        BasicBlock* over = all_ ? newBlock("unchecked.over") : next_;
        b_.CreateCondBr(b_.CreateICmpEQ(done, rounds_), all_ ? over : exit, head_);
        done_->addIncoming(done, next_);
        if (all_) {
            b_.SetInsertPoint(over);
            b_.CreateCondBr(b_.CreateICmpEQ(rounds_, all_), exit, rest_);
        }
        for (llvm::PHINode& phi : exit->phis())
            phi.addIncoming(cloneOrSame(phi.getIncomingValueForBlock(latch)), over);
        b_.SetInsertPoint(rest_);
        size_t i = 0;
        for (llvm::PHINode& phi : header_->phis()) {
            Value* following = cloneOrSame(phi.getIncomingValueForBlock(latch));
            starts_[i]->addIncoming(following, next_);
            llvm::PHINode* begin = b_.CreatePHI(phi.getType(), 2, phi.getName());
            begin->addIncoming(phi.getIncomingValueForBlock(entry_), entry_);
            begin->addIncoming(starts_[i++], looked_);
            if (all_) begin->addIncoming(following, over);
            const auto from = static_cast<unsigned>(phi.getBasicBlockIndex(entry_));
            phi.setIncomingBlock(from, rest_);
            phi.setIncomingValue(from, begin);
        }
        b_.CreateBr(header_);
    }

    const ArrayLoop& candidate_;
    LoopAnalyses& a_;
    llvm::Loop& loop_;
    BasicBlock *header_, *entry_;
    llvm::Function& function_;
    llvm::IRBuilder<> b_;
    llvm::Type* i64_;
    Value *rounds_ = nullptr, *all_ = nullptr; ///< without checks; of the loop
    Value* count_ = nullptr;                   ///< of the rounds done at once
    llvm::PHINode *done_ = nullptr, *round_ = nullptr;
    std::vector<llvm::PHINode*> starts_;
    std::vector<Value*> targets_, sources_;
    std::vector<llvm::AllocaInst*>& buffers_;
    llvm::AllocaInst* foundBits_[2] = {nullptr, nullptr};
    BasicBlock *head_ = nullptr, *looked_ = nullptr, *store_ = nullptr, *next_ = nullptr, *rest_ = nullptr;
    llvm::ValueToValueMapTy map_;
};

/// The loops of one function.
class SecondForms {
  public:
    SecondForms(llvm::Function& function, llvm::FunctionAnalysisManager& analyses)
        : function_(function), analyses_(analyses) {}

    /// True when something has changed.
    bool make() {
        prepare();
        while (giveOne())
            analyses_.invalidate(function_, llvm::PreservedAnalyses::none());
        return changed_;
    }

  private:
    LoopAnalyses needed() {
        return {analyses_.getResult<llvm::ScalarEvolutionAnalysis>(function_),
                analyses_.getResult<llvm::DominatorTreeAnalysis>(function_),
                analyses_.getResult<llvm::LoopAnalysis>(function_),
                analyses_.getResult<llvm::AAManager>(function_),
                analyses_.getResult<llvm::AssumptionAnalysis>(function_)};
    }

    void prepare() {
        LoopAnalyses a = needed();
        for (llvm::Loop* loop : a.loops) {
            changed_ |=
                llvm::simplifyLoop(loop, &a.dominators, &a.loops, &a.scev, &a.assumptions, nullptr, false);
            changed_ |= llvm::formLCSSARecursively(*loop, a.dominators, &a.loops, &a.scev);
        }
    }

    /// Gives one more loop its second form.
    bool giveOne() {
        LoopAnalyses a = needed();
        for (llvm::Loop* loop : a.loops.getLoopsInPreorder()) {
            if (!loop->isInnermost() || !seen_.insert(loop->getHeader()).second) continue;
            changed_ |= joinEqualIndices(*loop, a);
            ArrayLoop candidate(*loop, a);
            if (!loop->isLCSSAForm(a.dominators) || !candidate.suits()) continue;
            SecondForm form(candidate, a, buffers_);
            if (!form.make()) continue;
            form.promote();
            return changed_ = true;
        }
        return false;
    }

    llvm::Function& function_;
    llvm::FunctionAnalysisManager& analyses_;
    llvm::SmallPtrSet<BasicBlock*, 8> seen_; ///< headers of loops that need not be looked at again
    std::vector<llvm::AllocaInst*> buffers_;
    bool changed_ = false;
};

} // namespace

llvm::PreservedAnalyses UncheckedRounds::run(llvm::Function& function,
                                             llvm::FunctionAnalysisManager& analyses) {
    if (analyses.getResult<llvm::LoopAnalysis>(function).empty()) return llvm::PreservedAnalyses::all();
    return SecondForms(function, analyses).make() ? llvm::PreservedAnalyses::none()
                                                  : llvm::PreservedAnalyses::all();
}

} // namespace codegen

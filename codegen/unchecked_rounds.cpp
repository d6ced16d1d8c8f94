#include "codegen/unchecked_rounds.h"

#include <llvm/ADT/SmallPtrSet.h>
#include <llvm/Analysis/AliasAnalysis.h>
#include <llvm/Analysis/AssumptionCache.h>
#include <llvm/Analysis/IVDescriptors.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/Analysis/ScalarEvolutionExpressions.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/IR/ProfDataUtils.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/LoopSimplify.h>
#include <llvm/Transforms/Utils/LoopUtils.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>
#include <llvm/Transforms/Utils/ScalarEvolutionExpander.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace codegen {
namespace {

using llvm::BasicBlock;
using llvm::Instruction;
using llvm::SCEV;
using llvm::Value;

/// Rounds between two looks at what the checks have found.
constexpr uint64_t kAtOnce = 64;
/// Fewer are not worth the preparations.
constexpr uint64_t kFewest = 16;
constexpr size_t kMostStores = 4;
/// Elements of a buffer have at most this size.
constexpr uint64_t kElement = 8;

struct Analyses {
    llvm::ScalarEvolution& scev;
    llvm::DominatorTree& dominators;
    llvm::LoopInfo& loops;
    llvm::AAResults& aliases;
    llvm::AssumptionCache& assumptions;
};

/// Bits of a floating-point number, perhaps without the sign.
bool isBitsOfNumber(const Value* value) {
    while (const auto* op = llvm::dyn_cast<llvm::BinaryOperator>(value)) {
        if (!llvm::isa<llvm::ConstantInt>(op->getOperand(1))) return false;
        value = op->getOperand(0);
    }
    const auto* cast = llvm::dyn_cast<llvm::BitCastInst>(value);
    return cast != nullptr && cast->getSrcTy()->isFloatingPointTy();
}

/// The condition says something of floating-point numbers: no address depends
/// on it.
bool asksForNumbers(const Value* condition) {
    if (llvm::isa<llvm::FCmpInst>(condition) || llvm::isa<llvm::ConstantInt>(condition)) return true;
    if (const auto* compared = llvm::dyn_cast<llvm::ICmpInst>(condition))
        return isBitsOfNumber(compared->getOperand(0)) &&
               llvm::isa<llvm::ConstantInt>(compared->getOperand(1));
    const auto* inst = llvm::dyn_cast<Instruction>(condition);
    if (inst == nullptr) return false;
    const bool joins =
        inst->isBitwiseLogicOp() || llvm::isa<llvm::SelectInst>(inst) || llvm::isa<llvm::FreezeInst>(inst);
    return joins && llvm::all_of(inst->operands(), [](const llvm::Use& use) { return asksForNumbers(use); });
}

/// GVN computes an index in each branch that needs it; where all of them are
/// the same, one computation shows that it counts.
void joinEqualIndices(llvm::Loop& loop, Analyses& a) {
    for (BasicBlock* block : loop.blocks()) {
        if (block == loop.getHeader()) continue;
        for (llvm::PHINode& phi : llvm::make_early_inc_range(block->phis())) {
            auto* first = llvm::dyn_cast<Instruction>(phi.getIncomingValue(0));
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
        }
    }
}

/// A loop that can have the second form, and what is known of it.
class Candidate {
  public:
    Candidate(llvm::Loop& loop, Analyses& analyses) : loop_(loop), a_(analyses) {}

    struct Access {
        Instruction* inst;
        const llvm::SCEVAddRecExpr* address; ///< null: the same in all rounds
        const SCEV* step;
    };

    bool suits() {
        if (!loop_.isInnermost() || !loop_.isLoopSimplifyForm() || !isCounted()) return false;
        return readExits() && readPhis() && readBody() && !stores_.empty() && stores_.size() <= kMostStores &&
               isIndependent();
    }

    llvm::Loop& loop() const { return loop_; }
    const SCEV* rounds() const { return rounds_; }
    /// As many of them pass all checks of indices.
    const SCEV* unchecked() const { return unchecked_; }
    const std::vector<Access>& stores() const { return stores_; }
    /// Loads that not all rounds execute, but could.
    const std::vector<Access>& early() const { return early_; }
    /// What a branch asks for, perhaps among other things, for the loop to
    /// continue.
    struct Check {
        llvm::BranchInst* at;
        Value* condition;
        bool wanted;
    };
    const std::vector<Check>& checks() const { return checks_; } ///< of numbers
    const std::vector<Check>& conditions() const { return conditions_; } ///< the same in all rounds
    const std::vector<llvm::BranchInst*>& exits() const { return exits_; } ///< all but the last
    /// The distances from stores to loads, in bytes, for which the loads see what
    /// was there before the rounds.
    struct Distance {
        const SCEV* least;
        const SCEV* most;
        uint64_t span; ///< of one store in all rounds that are done at once
        bool mayBeEqual;
    };
    const std::vector<Distance>& distances() const { return distances_; }

  private:
    /// The number of rounds is known when the loop is entered, errors apart.
    bool isCounted() {
        BasicBlock* latch = loop_.getLoopLatch();
        auto* branch = llvm::dyn_cast<llvm::BranchInst>(latch->getTerminator());
        if (branch == nullptr || !branch->isConditional() || !loop_.isLoopExiting(latch)) return false;
        const SCEV* count = a_.scev.getExitCount(&loop_, latch);
        if (llvm::isa<llvm::SCEVCouldNotCompute>(count) || !count->getType()->isIntegerTy() ||
            a_.scev.getTypeSizeInBits(count->getType()) > 64)
            return false;
        const unsigned known = a_.scev.getSmallConstantTripCount(&loop_, latch);
        if (known != 0 && known < kFewest) return false;
        llvm::Type* i64 = llvm::Type::getInt64Ty(latch->getContext());
        rounds_ = a_.scev.getAddExpr(a_.scev.getNoopOrZeroExtend(count, i64), a_.scev.getOne(i64));
        unchecked_ = rounds_;
        return true;
    }

    /// All exits but the last are checks that rarely fail.
    bool readExits() {
        llvm::SmallVector<BasicBlock*> exiting;
        loop_.getExitingBlocks(exiting);
        for (BasicBlock* block : exiting) {
            if (block == loop_.getLoopLatch()) continue;
            auto* branch = llvm::dyn_cast<llvm::BranchInst>(block->getTerminator());
            uint64_t first = 0, second = 0;
            if (branch == nullptr || !llvm::extractBranchWeights(*branch, first, second)) return false;
            const bool wanted = loop_.contains(branch->getSuccessor(0));
            if (wanted != (first > second) || !readCondition(*branch, branch->getCondition(), wanted))
                return false;
            exits_.push_back(branch);
        }
        return !exits_.empty();
    }

    /// Takes a check of several things apart.
    bool readCondition(llvm::BranchInst& branch, Value* condition, bool wanted) {
        Value *first = nullptr, *second = nullptr;
        if (wanted ? match(condition, llvm::PatternMatch::m_LogicalAnd(llvm::PatternMatch::m_Value(first),
                                                                       llvm::PatternMatch::m_Value(second)))
                   : match(condition, llvm::PatternMatch::m_LogicalOr(llvm::PatternMatch::m_Value(first),
                                                                      llvm::PatternMatch::m_Value(second))))
            return readCondition(branch, first, wanted) && readCondition(branch, second, wanted);
        if (loop_.isLoopInvariant(condition)) {
            conditions_.push_back({&branch, condition, wanted});
            return true;
        }
        if (asksForNumbers(condition)) {
            checks_.push_back({&branch, condition, wanted});
            return true;
        }
        return boundRounds(llvm::dyn_cast<llvm::ICmpInst>(condition), wanted);
    }

    /// A check of an index: so many rounds pass it, and no more are done without
    /// checks.
    bool boundRounds(const llvm::ICmpInst* compared, bool wanted) {
        if (compared == nullptr) return false;
        llvm::CmpInst::Predicate predicate =
            wanted ? compared->getPredicate() : compared->getInversePredicate();
        const SCEV* index = a_.scev.getSCEV(compared->getOperand(0));
        const SCEV* limit = a_.scev.getSCEV(compared->getOperand(1));
        if (predicate == llvm::CmpInst::ICMP_UGT) {
            std::swap(index, limit);
            predicate = llvm::CmpInst::ICMP_ULT;
        }
        const auto* counter = llvm::dyn_cast<llvm::SCEVAddRecExpr>(index);
        const bool isUntil = predicate == llvm::CmpInst::ICMP_NE;
        if ((predicate != llvm::CmpInst::ICMP_ULT && !isUntil) || counter == nullptr ||
            counter->getLoop() != &loop_ || !counter->isAffine() ||
            !counter->getStepRecurrence(a_.scev)->isOne() || !a_.scev.isLoopInvariant(limit, &loop_) ||
            a_.scev.getTypeSizeInBits(limit->getType()) > 64)
            return false;
        const SCEV* start = counter->getStart();
        const SCEV* passing =
            a_.scev.getMinusSCEV(isUntil ? limit : a_.scev.getUMaxExpr(limit, start), start);
        unchecked_ =
            a_.scev.getUMinExpr(unchecked_, a_.scev.getNoopOrZeroExtend(passing, unchecked_->getType()));
        return true;
    }

    /// Counters, and values of the round before: sums would be added up one after
    /// the other in any form.
    bool readPhis() {
        for (llvm::PHINode& phi : loop_.getHeader()->phis()) {
            const auto* counter = a_.scev.isSCEVable(phi.getType())
                                      ? llvm::dyn_cast<llvm::SCEVAddRecExpr>(a_.scev.getSCEV(&phi))
                                      : nullptr;
            if (counter != nullptr && counter->getLoop() == &loop_ && counter->isAffine()) continue;
            if (!llvm::RecurrenceDescriptor::isFixedOrderRecurrence(&phi, &loop_, &a_.dominators))
                return false;
        }
        return true;
    }

    bool readBody() {
        for (BasicBlock* block : loop_.blocks())
            for (Instruction& inst : *block) {
                if (llvm::isa<llvm::PHINode>(inst) || inst.isTerminator()) continue;
                if (llvm::isa<llvm::LoadInst>(inst) || llvm::isa<llvm::StoreInst>(inst)) {
                    if (!readAccess(inst)) return false;
                } else if (inst.mayReadOrWriteMemory() || !llvm::isSafeToSpeculativelyExecute(&inst) ||
                           (llvm::isa<llvm::CallBase>(inst) && !llvm::isa<llvm::IntrinsicInst>(inst))) {
                    return false;
                }
            }
        return true;
    }

    /// Elements one after the other, which a vector can hold.
    bool readAccess(Instruction& inst) {
        const bool isStore = llvm::isa<llvm::StoreInst>(inst);
        Value* pointer = llvm::getLoadStorePointerOperand(&inst);
        llvm::Type* type = llvm::getLoadStoreType(&inst);
        if (inst.isVolatile() || inst.isAtomic() || !type->isSingleValueType() || type->isVectorTy())
            return false;
        const SCEV* address = a_.scev.getSCEV(pointer);
        if (!isStore && a_.scev.isLoopInvariant(address, &loop_)) {
            loads_.push_back({&inst, nullptr, nullptr});
            return true;
        }
        const auto* moving = llvm::dyn_cast<llvm::SCEVAddRecExpr>(address);
        if (moving == nullptr || moving->getLoop() != &loop_ || !moving->isAffine()) return false;
        const SCEV* step = moving->getStepRecurrence(a_.scev);
        const auto* known = llvm::dyn_cast<llvm::SCEVConstant>(step);
        const uint64_t size = inst.getDataLayout().getTypeStoreSize(type);
        if (known == nullptr || known->getAPInt() != size || size > kElement) return false;
        if (isStore && !a_.dominators.dominates(inst.getParent(), loop_.getLoopLatch())) return false;
        (isStore ? stores_ : loads_).push_back({&inst, moving, step});
        if (!isStore && !a_.dominators.dominates(inst.getParent(), loop_.getLoopLatch()) &&
            isInObject(moving, size))
            early_.push_back(loads_.back());
        return true;
    }

    /// In all rounds the address lies in the object that it begins with.
    bool isInObject(const SCEV* address, uint64_t size) const {
        const auto* base = llvm::dyn_cast<llvm::SCEVUnknown>(a_.scev.getPointerBase(address));
        const auto* object = base ? llvm::dyn_cast<llvm::GlobalVariable>(base->getValue()) : nullptr;
        if (object == nullptr || !object->hasInitializer() || object->isInterposable()) return false;
        const uint64_t bytes = object->getDataLayout().getTypeAllocSize(object->getValueType());
        const llvm::ConstantRange offsets = a_.scev.getSignedRange(a_.scev.removePointerBase(address));
        return size <= bytes && offsets.getSignedMin().isNonNegative() &&
               offsets.getSignedMax().ule(bytes - size);
    }

    bool isIndependent() {
        for (const Access& store : stores_)
            for (const Access& load : loads_)
                if (!sees(load, store)) return false;
        return true;
    }

    /// The load reads what was there before the rounds that are done at once, or
    /// a condition for that is noted.
    bool sees(const Access& load, const Access& store) {
        const auto anywhere = [](const Instruction* inst) {
            return llvm::MemoryLocation::getBeforeOrAfter(llvm::getLoadStorePointerOperand(inst));
        };
        if (a_.aliases.isNoAlias(anywhere(load.inst), anywhere(store.inst))) return true;
        if (load.address == nullptr || load.step != store.step) return false;
        const SCEV* from = a_.scev.getLosslessPtrToIntExpr(store.address->getStart());
        const SCEV* to = a_.scev.getLosslessPtrToIntExpr(load.address->getStart());
        if (llvm::isa<llvm::SCEVCouldNotCompute>(from) || llvm::isa<llvm::SCEVCouldNotCompute>(to))
            return false;
        const SCEV* distance = a_.scev.getMinusSCEV(to, from);
        const uint64_t size =
            store.inst->getDataLayout().getTypeStoreSize(llvm::getLoadStoreType(store.inst));
        const bool before = isBefore(load.inst, store.inst);
        if (const auto* known = llvm::dyn_cast<llvm::SCEVConstant>(distance)) {
            const llvm::APInt& bytes = known->getAPInt();
            return bytes.isStrictlyPositive() ? bytes.uge(size)
                   : bytes.isZero()           ? before
                                              : (-bytes).uge(size * kAtOnce);
        }
        note(distance, size, before);
        return true;
    }

    /// Distances that differ by constants are compared together.
    void note(const SCEV* distance, uint64_t size, bool mayBeEqual) {
        const auto isLess = [&](const SCEV* a, const SCEV* b) -> std::optional<bool> {
            const auto* known = llvm::dyn_cast<llvm::SCEVConstant>(a_.scev.getMinusSCEV(a, b));
            if (known == nullptr) return std::nullopt;
            return known->getAPInt().isNegative();
        };
        for (Distance& other : distances_) {
            const std::optional<bool> less = isLess(distance, other.least);
            if (!less || other.span != size * kAtOnce || other.mayBeEqual != mayBeEqual) continue;
            if (*less) other.least = distance;
            if (isLess(other.most, distance).value_or(false)) other.most = distance;
            return;
        }
        distances_.push_back({distance, distance, size * kAtOnce, mayBeEqual});
    }

    bool isBefore(const Instruction* load, const Instruction* store) const {
        if (load->getParent() == store->getParent()) return load->comesBefore(store);
        return !a_.dominators.dominates(store->getParent(), load->getParent());
    }

    llvm::Loop& loop_;
    Analyses& a_;
    const SCEV *rounds_ = nullptr, *unchecked_ = nullptr;
    std::vector<llvm::BranchInst*> exits_;
    std::vector<Check> checks_, conditions_;
    std::vector<Access> stores_, loads_, early_;
    std::vector<Distance> distances_;
};

/// Makes the second form.
class SecondForm {
  public:
    SecondForm(const Candidate& candidate, Analyses& analyses)
        : candidate_(candidate), a_(analyses), loop_(candidate.loop()), header_(loop_.getHeader()),
          entry_(loop_.getLoopPreheader()), function_(*header_->getParent()), b_(function_.getContext()),
          i64_(b_.getInt64Ty()) {}

    /// False: an expression cannot be computed where the loop is entered.
    bool make() {
        llvm::SCEVExpander expander(a_.scev, function_.getDataLayout(), "rounds");
        if (!canExpand(expander)) return false;
        Instruction* end = entry_->getTerminator();
        rounds_ = expander.expandCodeFor(candidate_.unchecked(), i64_, end);
        if (candidate_.unchecked() != candidate_.rounds())
            all_ = expander.expandCodeFor(candidate_.rounds(), i64_, end);
        for (const Candidate::Access& store : candidate_.stores())
            targets_.push_back(expander.expandCodeFor(store.address->getStart(), b_.getPtrTy(), end));
        for (const Candidate::Access& load : candidate_.early())
            sources_.push_back(expander.expandCodeFor(load.address->getStart(), b_.getPtrTy(), end));
        b_.SetInsertPoint(end);
        Value* possible = b_.CreateICmpUGE(rounds_, b_.getInt64(kFewest));
        for (const Candidate::Distance& distance : candidate_.distances())
            possible = b_.CreateAnd(possible, isFar(expander, distance));
        for (const Candidate::Check& check : candidate_.conditions()) {
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
        const auto canAll = [&](const std::vector<Candidate::Access>& accesses) {
            return llvm::all_of(accesses,
                                [&](const Candidate::Access& a) { return can(a.address->getStart()); });
        };
        return can(candidate_.rounds()) && can(candidate_.unchecked()) && canAll(candidate_.stores()) &&
               canAll(candidate_.early()) &&
               llvm::all_of(candidate_.distances(),
                            [&](const Candidate::Distance& d) { return can(d.least) && can(d.most); });
    }

    /// Loads lie ahead of the store, or so far behind it that the rounds done at
    /// once do not meet.
    Value* isFar(llvm::SCEVExpander& expander, const Candidate::Distance& distance) {
        Instruction* end = entry_->getTerminator();
        Value* least = expander.expandCodeFor(distance.least, i64_, end);
        Value* most = expander.expandCodeFor(distance.most, i64_, end);
        b_.SetInsertPoint(end);
        Value* ahead = b_.CreateICmpSGE(least, b_.getInt64(distance.mayBeEqual ? 0 : kElement));
        Value* behind = b_.CreateICmpSLE(most, b_.CreateNeg(b_.getInt64(distance.span)));
        return b_.CreateOr(ahead, behind);
    }

    /// At the beginning of some rounds: what they start with, and how many they
    /// are.
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
                                          b_.getInt64(kAtOnce));
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

    /// Instead of leaving the loop. What the checks ask for is collected by the
    /// width of the numbers, so that a vector of it fills a register as the
    /// numbers do.
    void collectChecks(BasicBlock* start) {
        b_.SetInsertPoint(&*function_.getEntryBlock().begin());
        for (llvm::AllocaInst*& slot : foundBits_)
            slot = b_.CreateAlloca(&slot == &foundBits_[0] ? b_.getInt32Ty() : i64_, nullptr, "found");
        b_.SetInsertPoint(start->getTerminator());
        for (llvm::AllocaInst* slot : foundBits_)
            b_.CreateStore(llvm::Constant::getNullValue(slot->getAllocatedType()), slot);
        for (const Candidate::Check& original : candidate_.checks()) {
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
        for (const Candidate::Access& store : candidate_.stores()) {
            auto* write = cloneOf(llvm::cast<llvm::StoreInst>(store.inst));
            llvm::Type* type = write->getValueOperand()->getType();
            b_.SetInsertPoint(&*function_.getEntryBlock().begin());
            llvm::AllocaInst* buffer =
                b_.CreateAlloca(llvm::ArrayType::get(type, kAtOnce), nullptr, "results");
            buffer->setAlignment(llvm::Align(16));
            buffers_.push_back(buffer);
            b_.SetInsertPoint(write);
            write->setOperand(1, b_.CreateInBoundsGEP(type, buffer, round_));
        }
    }

    /// Stores the results when all are fine; else the first form begins with the
    /// first of these rounds.
    void endSome() {
        b_.SetInsertPoint(looked_);
        Value* found = b_.CreateZExt(b_.CreateLoad(b_.getInt32Ty(), foundBits_[0]), i64_);
        found = b_.CreateOr(found, b_.CreateLoad(i64_, foundBits_[1]));
        llvm::MDBuilder metadata(function_.getContext());
        b_.CreateCondBr(b_.CreateICmpEQ(found, b_.getInt64(0)), store_, rest_,
                        metadata.createBranchWeights(1000, 1));
        b_.SetInsertPoint(store_);
        llvm::PHINode* each = b_.CreatePHI(i64_, 2, "stored");
        for (size_t i = 0; i < buffers_.size(); ++i) {
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
        goOn();
    }

    void goOn() {
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

    const Candidate& candidate_;
    Analyses& a_;
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
    std::vector<llvm::AllocaInst*> buffers_;
    llvm::AllocaInst* foundBits_[2] = {nullptr, nullptr};
    BasicBlock *head_ = nullptr, *looked_ = nullptr, *store_ = nullptr, *next_ = nullptr, *rest_ = nullptr;
    llvm::ValueToValueMapTy map_;
};

/// Gives one more loop its second form. `seen`: headers of loops that need not
/// be looked at again.
bool giveOne(Analyses& analyses, llvm::SmallPtrSetImpl<BasicBlock*>& seen) {
    for (llvm::Loop* loop : analyses.loops.getLoopsInPreorder()) {
        if (!loop->isInnermost() || !seen.insert(loop->getHeader()).second) continue;
        joinEqualIndices(*loop, analyses);
        Candidate candidate(*loop, analyses);
        if (!loop->isLCSSAForm(analyses.dominators) || !candidate.suits()) continue;
        SecondForm form(candidate, analyses);
        if (!form.make()) continue;
        form.promote();
        return true;
    }
    return false;
}

} // namespace

llvm::PreservedAnalyses UncheckedRounds::run(llvm::Function& function,
                                             llvm::FunctionAnalysisManager& analyses) {
    llvm::SmallPtrSet<BasicBlock*, 8> seen;
    bool changed = false;
    for (;;) {
        Analyses needed{analyses.getResult<llvm::ScalarEvolutionAnalysis>(function),
                        analyses.getResult<llvm::DominatorTreeAnalysis>(function),
                        analyses.getResult<llvm::LoopAnalysis>(function),
                        analyses.getResult<llvm::AAManager>(function),
                        analyses.getResult<llvm::AssumptionAnalysis>(function)};
        if (!changed)
            for (llvm::Loop* loop : needed.loops) {
                llvm::simplifyLoop(loop, &needed.dominators, &needed.loops, &needed.scev, &needed.assumptions,
                                   nullptr, false);
                llvm::formLCSSARecursively(*loop, needed.dominators, &needed.loops, &needed.scev);
            }
        if (!giveOne(needed, seen)) break;
        changed = true;
        analyses.invalidate(function, llvm::PreservedAnalyses::none());
    }
    return changed ? llvm::PreservedAnalyses::none() : llvm::PreservedAnalyses::all();
}

} // namespace codegen

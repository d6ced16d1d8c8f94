#include "codegen/array_loop.h"

#include <llvm/Analysis/IVDescriptors.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/IR/ProfDataUtils.h>

#include <optional>
#include <utility>

namespace codegen {

using llvm::BasicBlock;
using llvm::Instruction;
using llvm::SCEV;
using llvm::Value;

namespace {

constexpr size_t kMostStores = 4;

/// Bits of a floating-point number, perhaps without the sign.
bool isBitsOfNumber(const Value* value) {
    while (const auto* op = llvm::dyn_cast<llvm::BinaryOperator>(value)) {
        if (!llvm::isa<llvm::ConstantInt>(op->getOperand(1))) return false;
        value = op->getOperand(0);
    }
    const auto* cast = llvm::dyn_cast<llvm::BitCastInst>(value);
    return cast != nullptr && cast->getSrcTy()->isFloatingPointTy();
}

/// The condition says something of floating-point numbers: no address depends on it.
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

} // namespace

bool ArrayLoop::suits() {
    if (!loop_.isInnermost() || !loop_.isLoopSimplifyForm() || !isCounted()) return false;
    return readExits() && readPhis() && readBody() && !stores_.empty() && stores_.size() <= kMostStores &&
           isIndependent();
}

/// The number of rounds is known when the loop is entered, errors apart.
bool ArrayLoop::isCounted() {
    BasicBlock* latch = loop_.getLoopLatch();
    auto* branch = llvm::dyn_cast<llvm::BranchInst>(latch->getTerminator());
    if (branch == nullptr || !branch->isConditional() || !loop_.isLoopExiting(latch)) return false;
    const SCEV* count = a_.scev.getExitCount(&loop_, latch);
    if (llvm::isa<llvm::SCEVCouldNotCompute>(count) || !count->getType()->isIntegerTy() ||
        a_.scev.getTypeSizeInBits(count->getType()) > 64)
        return false;
    const unsigned known = a_.scev.getSmallConstantTripCount(&loop_, latch);
    if (known != 0 && known < kFewestRounds) return false;
    llvm::Type* i64 = llvm::Type::getInt64Ty(latch->getContext());
    rounds_ = a_.scev.getAddExpr(a_.scev.getNoopOrZeroExtend(count, i64), a_.scev.getOne(i64));
    unchecked_ = rounds_;
    return true;
}

/// All exits but the last are checks that rarely fail.
bool ArrayLoop::readExits() {
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
bool ArrayLoop::readCondition(llvm::BranchInst& branch, Value* condition, bool wanted) {
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

/// A check of an index: so many rounds pass it, and no more are done without checks.
bool ArrayLoop::boundRounds(const llvm::ICmpInst* compared, bool wanted) {
    if (compared == nullptr) return false;
    llvm::CmpInst::Predicate predicate = wanted ? compared->getPredicate() : compared->getInversePredicate();
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
        !limit->getType()->isIntegerTy() || a_.scev.getTypeSizeInBits(limit->getType()) > 64)
        return false;
    const SCEV* start = counter->getStart();
    const SCEV* passing = a_.scev.getMinusSCEV(isUntil ? limit : a_.scev.getUMaxExpr(limit, start), start);
    unchecked_ = a_.scev.getUMinExpr(unchecked_, a_.scev.getNoopOrZeroExtend(passing, unchecked_->getType()));
    return true;
}

/// Counters, and values of the round before: sums would be added up one after the other in any form.
bool ArrayLoop::readPhis() {
    for (llvm::PHINode& phi : loop_.getHeader()->phis()) {
        const auto* counter = a_.scev.isSCEVable(phi.getType())
                                  ? llvm::dyn_cast<llvm::SCEVAddRecExpr>(a_.scev.getSCEV(&phi))
                                  : nullptr;
        if (counter != nullptr && counter->getLoop() == &loop_ && counter->isAffine()) continue;
        if (!llvm::RecurrenceDescriptor::isFixedOrderRecurrence(&phi, &loop_, &a_.dominators)) return false;
    }
    return true;
}

bool ArrayLoop::readBody() {
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
bool ArrayLoop::readAccess(Instruction& inst) {
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
    if (known == nullptr || known->getAPInt() != size || size > kLargestElement) return false;
    if (isStore && !a_.dominators.dominates(inst.getParent(), loop_.getLoopLatch())) return false;
    (isStore ? stores_ : loads_).push_back({&inst, moving, step});
    if (!isStore && !a_.dominators.dominates(inst.getParent(), loop_.getLoopLatch()) &&
        isInObject(moving, size))
        early_.push_back(loads_.back());
    return true;
}

/// In all rounds the address lies in the object that it begins with.
bool ArrayLoop::isInObject(const SCEV* address, uint64_t size) const {
    const auto* base = llvm::dyn_cast<llvm::SCEVUnknown>(a_.scev.getPointerBase(address));
    const auto* object = base ? llvm::dyn_cast<llvm::GlobalVariable>(base->getValue()) : nullptr;
    if (object == nullptr || !object->hasInitializer() || object->isInterposable()) return false;
    const uint64_t bytes = object->getDataLayout().getTypeAllocSize(object->getValueType());
    const llvm::ConstantRange offsets = a_.scev.getSignedRange(a_.scev.removePointerBase(address));
    return size <= bytes && offsets.getSignedMin().isNonNegative() &&
           offsets.getSignedMax().ule(bytes - size);
}

bool ArrayLoop::isIndependent() {
    for (const Access& store : stores_)
        for (const Access& load : loads_)
            if (!sees(load, store)) return false;
    return true;
}

/// The load reads what was there before the rounds that are done at once, or a condition for that is noted.
bool ArrayLoop::sees(const Access& load, const Access& store) {
    const auto anywhere = [](const Instruction* inst) {
        return llvm::MemoryLocation::getBeforeOrAfter(llvm::getLoadStorePointerOperand(inst));
    };
    if (a_.aliases.isNoAlias(anywhere(load.inst), anywhere(store.inst))) return true;
    if (load.address == nullptr || load.step != store.step) return false;
    const SCEV* from = a_.scev.getLosslessPtrToIntExpr(store.address->getStart());
    const SCEV* to = a_.scev.getLosslessPtrToIntExpr(load.address->getStart());
    if (llvm::isa<llvm::SCEVCouldNotCompute>(from) || llvm::isa<llvm::SCEVCouldNotCompute>(to)) return false;
    const SCEV* distance = a_.scev.getMinusSCEV(to, from);
    const uint64_t size = store.inst->getDataLayout().getTypeStoreSize(llvm::getLoadStoreType(store.inst));
    const bool before = isBefore(load.inst, store.inst);
    if (const auto* known = llvm::dyn_cast<llvm::SCEVConstant>(distance)) {
        const llvm::APInt& bytes = known->getAPInt();
        return bytes.isStrictlyPositive() ? bytes.uge(size)
               : bytes.isZero()           ? before
                                          : (-bytes).uge(size * kRoundsAtOnce);
    }
    note(distance, size, before);
    return true;
}

/// Distances that differ by constants are compared together.
void ArrayLoop::note(const SCEV* distance, uint64_t size, bool mayBeEqual) {
    const auto isLess = [&](const SCEV* a, const SCEV* b) -> std::optional<bool> {
        const auto* known = llvm::dyn_cast<llvm::SCEVConstant>(a_.scev.getMinusSCEV(a, b));
        if (known == nullptr) return std::nullopt;
        return known->getAPInt().isNegative();
    };
    for (Distance& other : distances_) {
        const std::optional<bool> less = isLess(distance, other.least);
        if (!less || other.span != size * kRoundsAtOnce || other.mayBeEqual != mayBeEqual) continue;
        if (*less) other.least = distance;
        if (isLess(other.most, distance).value_or(false)) other.most = distance;
        return;
    }
    distances_.push_back({distance, distance, size * kRoundsAtOnce, mayBeEqual});
}

bool ArrayLoop::isBefore(const Instruction* load, const Instruction* store) const {
    if (load->getParent() == store->getParent()) return load->comesBefore(store);
    return !a_.dominators.dominates(store->getParent(), load->getParent());
}

} // namespace codegen

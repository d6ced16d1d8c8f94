#include "codegen/finite_sums.h"

#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/Transforms/Utils/Local.h>

#include <vector>

#include "codegen/preserved.h"

namespace codegen {
namespace {

using llvm::CmpInst;
using llvm::Value;
using namespace llvm::PatternMatch;

/// A sum that serves a check only: in whichever order it is formed, an infinity or NaN among its terms shows in it.
class Sum {
  public:
    explicit Sum(Value* root) {
        collect(root);
        for (auto& [vector, lanes] : lanes_) {
            const auto count = llvm::cast<llvm::FixedVectorType>(vector->getType())->getNumElements();
            if (lanes.size() == count && count <= 4)
                vectors_.push_back(vector);
            else
                terms_.insert(terms_.end(), lanes.begin(), lanes.end());
        }
    }

    bool hasVectors() const { return vectors_.size() > 1; }

    Value* form(llvm::IRBuilder<>& b) {
        while (!vectors_.empty()) {
            Value* sum = vectors_.back();
            vectors_.pop_back();
            const auto end = std::remove_if(vectors_.begin(), vectors_.end(), [&](Value* other) {
                if (other->getType() != sum->getType()) return false;
                sum = b.CreateFAdd(other, sum);
                return true;
            });
            vectors_.erase(end, vectors_.end());
            const auto count = llvm::cast<llvm::FixedVectorType>(sum->getType())->getNumElements();
            for (unsigned lane = 0; lane < count; ++lane)
                terms_.push_back(b.CreateExtractElement(sum, lane));
        }
        while (terms_.size() > 1) {
            std::vector<Value*> pairs;
            for (size_t i = 0; i + 1 < terms_.size(); i += 2)
                pairs.push_back(b.CreateFAdd(terms_[i], terms_[i + 1]));
            if (terms_.size() % 2 == 1) pairs.push_back(terms_.back());
            terms_ = std::move(pairs);
        }
        return terms_.front();
    }

  private:
    void collect(Value* value) {
        auto* sum = llvm::dyn_cast<llvm::BinaryOperator>(value);
        if (sum && sum->getOpcode() == llvm::Instruction::FAdd && sum->hasOneUse() && isForChecks(*sum)) {
            collect(sum->getOperand(0));
            collect(sum->getOperand(1));
            return;
        }
        Value* vector = nullptr;
        if (match(value, m_ExtractElt(m_Value(vector), m_ConstantInt())) &&
            llvm::isa<llvm::FixedVectorType>(vector->getType()))
            addLane(vector, value);
        else
            terms_.push_back(value);
    }

    /// A lane that comes twice may come once.
    void addLane(Value* vector, Value* element) {
        std::vector<Value*>& lanes = lanes_[vector];
        const Value* index = llvm::cast<llvm::ExtractElementInst>(element)->getIndexOperand();
        for (const Value* known : lanes)
            if (llvm::cast<llvm::ExtractElementInst>(known)->getIndexOperand() == index) return;
        lanes.push_back(element);
    }

    llvm::MapVector<Value*, std::vector<Value*>> lanes_;
    std::vector<Value*> vectors_, terms_;
};

} // namespace

FiniteCheck FiniteCheck::find(llvm::Instruction& inst) {
    Value *number = nullptr, *part = nullptr;
    CmpInst::Predicate predicate = CmpInst::BAD_ICMP_PREDICATE;
    uint64_t limit = 0;
    if (match(&inst, m_ICmp(predicate, m_Shl(m_Value(part), m_One()), m_ConstantInt(limit))) &&
        match(part, m_BitCast(m_Value(number))) && number->getType()->isFloatTy()) {
        const bool alone = number->hasOneUse() && part->hasOneUse() && inst.getOperand(0)->hasOneUse();
        if (predicate == CmpInst::ICMP_ULT && limit == 0xFF000000) return {&inst, number, true, alone};
        if (predicate == CmpInst::ICMP_UGT && limit == 0xFEFFFFFF) return {&inst, number, false, alone};
        return {};
    }
    if (!match(&inst, m_FCmp(predicate, m_FAbs(m_Value(number)), m_Inf())) || number->getType()->isVectorTy())
        return {};
    const bool alone = number->hasOneUse() && inst.getOperand(0)->hasOneUse();
    if (predicate == CmpInst::FCMP_OLT || predicate == CmpInst::FCMP_ONE) return {&inst, number, true, alone};
    if (predicate == CmpInst::FCMP_UGE || predicate == CmpInst::FCMP_UEQ)
        return {&inst, number, false, alone};
    return {};
}

std::vector<FiniteCheck> FiniteCheck::of(Value& number) {
    std::vector<FiniteCheck> found;
    const auto collect = [&](auto& self, Value& value, unsigned depth) -> void {
        for (llvm::User* user : value.users()) {
            auto* inst = llvm::dyn_cast<llvm::Instruction>(user);
            if (!inst) continue;
            if (const FiniteCheck check = find(*inst); check.inst && check.number == &number)
                found.push_back(check);
            else if (depth > 0 &&
                     llvm::isa<llvm::BitCastInst, llvm::BinaryOperator, llvm::IntrinsicInst>(inst))
                self(self, *inst, depth - 1);
        }
    };
    collect(collect, number, 2);
    return found;
}

void FiniteCheck::replaceBy(Value* test) const {
    inst->replaceAllUsesWith(test);
    llvm::RecursivelyDeleteTriviallyDeadInstructions(inst);
}

void markForChecks(llvm::Value* sum) {
    if (auto* inst = llvm::dyn_cast<llvm::Instruction>(sum)) inst->setHasAllowReciprocal(true);
}

bool isForChecks(const llvm::Instruction& sum) {
    return sum.hasAllowReciprocal();
}

llvm::PreservedAnalyses FiniteSums::run(llvm::Function& function, llvm::FunctionAnalysisManager&) {
    const llvm::SimplifyQuery query(function.getDataLayout());
    std::vector<FiniteCheck> checks;
    for (llvm::Instruction& inst : llvm::instructions(function))
        if (const FiniteCheck check = FiniteCheck::find(inst); check.inst) checks.push_back(check);
    bool changed = false;
    for (const FiniteCheck& check : checks) {
        llvm::IRBuilder<> b(check.inst);
        const auto known = llvm::computeKnownFPClass(check.number, llvm::fcNegative, 0,
                                                     query.getWithInstruction(check.inst));
        if (known.cannotBeOrderedLessThanZero()) {
            Value* infinity = llvm::ConstantFP::getInfinity(check.number->getType());
            check.replaceBy(check.trueWhenFinite ? b.CreateFCmpOLT(check.number, infinity)
                                                 : b.CreateFCmpUGE(check.number, infinity));
            changed = true;
        } else if (check.onlyUser) {
            Sum sum(check.number);
            Value* number = sum.hasVectors() ? sum.form(b) : check.number;
            Value* difference = b.CreateFSub(number, number); // NaN when it is infinite or NaN
            check.replaceBy(check.trueWhenFinite ? b.CreateFCmpORD(difference, difference)
                                                 : b.CreateFCmpUNO(difference, difference));
            changed = true;
        }
    }
    return preservingBlocks(changed);
}

} // namespace codegen
